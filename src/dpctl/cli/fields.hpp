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
/// The array, or an empty one.
const Json& list(const Json& object, const char* key);
/// "-" without one.
std::string number(std::optional<std::int64_t> value, std::string_view without = "-");
/// The texts with `between` them.
std::string joined(const std::vector<std::string>& texts, std::string_view between);

} // namespace dpslave::dpctl
