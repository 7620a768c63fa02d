// SPDX-License-Identifier: Apache-2.0
/// Looking into a reply without trusting it: what is missing or of another type reads as "?", a dash or
/// nothing.
#pragma once

#include "dpslave/control/protocol.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

using control::Json;

std::string text(const Json& object, const char* key, std::string_view without = "?");
bool flag(const Json& object, const char* key);
std::optional<std::int64_t> integer(const Json& object, const char* key);
std::optional<double> real(const Json& object, const char* key);
/// An integer as text; "-" without one.
std::string number(const Json& object, const char* key, std::string_view without = "-");
/// "-" without one.
std::string number(std::optional<std::int64_t> value, std::string_view without = "-");
/// The array, or an empty one.
const Json& list(const Json& object, const char* key);
/// The object, or an empty one.
const Json& part(const Json& object, const char* key);
/// The texts and integers of an array with `between` them.
std::string joined(const Json& array, std::string_view between);
std::string joined(const std::vector<std::string>& texts, std::string_view between);

} // namespace dpslave::dpctl
