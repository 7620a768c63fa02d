// SPDX-License-Identifier: Apache-2.0
/// How deep a TOML text is nested, found before a parser walks down into it: a parser that calls itself for
/// each level ends the program at some hundred thousand of them.
#pragma once

#include "dpslave/toml/document.hpp"

#include <optional>
#include <string_view>

namespace dpslave::toml {

/// Deepest nesting that is parsed; the deepest of a configuration, [station.diagnosis] and its lists, has 4.
inline constexpr unsigned kMaxNesting = 16;

/// Where `text` is nested deeper than kMaxNesting: brackets and braces within each other, or parts of one
/// dotted key (TOML 1.0). Linear in time; text that is no TOML at all is judged too.
std::optional<Place> too_deep(std::string_view text);

} // namespace dpslave::toml
