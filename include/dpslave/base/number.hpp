// SPDX-License-Identifier: Apache-2.0
/// The one reader of whole numbers that a person types: on a command line, in a script, in a list.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave {

/// Reads "70", "070" and "0x46" as seventy: decimal, with or without zeros before it, and hexadecimal only
/// after 0x. A minus may stand before it. Returns nullopt if the text is no such number or does not fit.
std::optional<std::int64_t> read_number(std::string_view text);

/// Reads a number from `least` to `most`; returns nullopt if it lies outside.
std::optional<std::int64_t> read_number(std::string_view text, std::int64_t least, std::int64_t most);

/// An Ident_Number. Four digits without 0x are not guessed: people write it in hexadecimal.
struct TypedIdent {
    std::optional<std::uint16_t> number;
    std::string fault; ///< what to write instead; empty: `number` is there
};
TypedIdent read_ident(std::string_view text);

/// Checks the value of an option that is a whole number within limits. CLI11 alone would take 070 as octal.
struct NumberOption {
    std::int64_t least = 0, most = 0;

    /// Returns an empty text if `text` is valid; `text` is then the same number in plain decimal. Otherwise
    /// it returns what is wrong.
    std::string operator()(std::string& text) const;
};

} // namespace dpslave
