// SPDX-License-Identifier: Apache-2.0
/// Words for faults: what is legal, and what was probably meant.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace dpslave::input {

/// The one of `legal` that differs least from `wrong`; empty if none is near enough to be what was meant.
std::string_view nearest(std::string_view wrong, std::span<const std::string> legal);

/// Finds the nearest word of which at most `most` characters differ.
std::string_view nearest(std::string_view wrong, std::span<const std::string> legal, std::size_t most);

/// A control character of a terminal: below U+0020, and U+007F to U+009F. `text` is UTF-8.
bool has_control_characters(std::string_view text);

std::string in_quotes(std::string_view text);

/// `"a", "b" or "c"`: for a sentence that names what is legal.
std::string listed(std::span<const std::string> legal);

} // namespace dpslave::input
