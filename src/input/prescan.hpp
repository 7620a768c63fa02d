// SPDX-License-Identifier: Apache-2.0
/// Finds texts that must not reach the parser. The parser calls itself for each level of nesting, so some
/// hundred thousand of them end the program. And toml++ 3.3 has no defined behaviour for many characters
/// beyond ASCII outside of texts and comments, where TOML 1.0 has none of them, where something else than a
/// name follows the bracket of a table, where a brace closes a bracket, and where a number follows a date.
#pragma once

#include "dpslave/input/document.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace dpslave::input {

/// Deepest nesting that is parsed; the deepest of a configuration, [station.diagnosis] and its lists, has 4.
inline constexpr unsigned kMaxNesting = 16;

struct Unparsed {
    enum class Why {
        nesting,
        no_name,
        closes_another,
        second_number,
        control,
        not_ascii,
        not_ascii_after_backslash
    };
    Place place;
    Why why;
};

/// The first place of `text` that must not be parsed: brackets and braces within each other, or parts of one
/// dotted key, deeper than kMaxNesting. Or the bracket of a table that no name follows. Or a bracket or brace
/// that closes something else. Or a number after another and a blank. Or a control character. Or an octet
/// beyond ASCII outside of texts and comments, or after the backslash of a line that continues (TOML 1.0).
/// Linear in time; text that is no TOML at all is judged too.
std::optional<Unparsed> prescan(std::string_view text);

/// Returns a sentence that says what is wrong there, and what to do.
std::string text(Unparsed::Why why);

} // namespace dpslave::input
