// SPDX-License-Identifier: Apache-2.0
/// The small grammar of a GSD's values (wire reference 9.1).
#pragma once

#include "dpslave/base/letters.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::gsd {

std::string_view trimmed(std::string_view text);

/// Reads decimal or 0x1AF, with nothing before or after it; up to 32 bits.
std::optional<std::uint32_t> parse_number(std::string_view text);
/// Reads a number like parse_number(), with a sign allowed.
std::optional<std::int64_t> parse_signed(std::string_view text);

/// A string in quotes at the start of a value, and the text after it, trimmed.
struct Quoted {
    std::string text;
    std::string_view rest; ///< points into the value
};
std::optional<Quoted> parse_quoted(std::string_view value);

/// Parts between commas, trimmed; one empty part for an empty text.
std::vector<std::string_view> split(std::string_view text, char between);

/// Reads numbers 0..255 between commas; returns nullopt if a part is no such number.
std::optional<std::vector<std::uint8_t>> parse_octets(std::string_view value);

std::string hex_octet(std::uint8_t octet);                     ///< "0x7F"
std::string hex_word(std::uint32_t word);                      ///< "0x0533"
std::string in_quotes(std::string_view text);                  ///< with double quotes, for a sentence
std::string count_of(std::size_t count, std::string_view one); ///< "1 octet", "2 octets"

} // namespace dpslave::gsd
