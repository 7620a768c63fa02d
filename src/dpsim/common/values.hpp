// SPDX-License-Identifier: Apache-2.0
/// Words, numbers, times and octets as they are typed into a simulator.
#pragma once

#include "telegram.hpp"

#include "dpslave/base/number.hpp"
#include "dpslave/base/typed.hpp"

#include <string_view>

namespace dpslave::sim {

/// Parts of a line between blanks; a `#` at the start of a word begins a comment.
std::vector<std::string> words_of(std::string_view line);

/// The word of this place as read_number() has it; nothing beyond the limits, or if there is no such word.
std::optional<std::int64_t> number_at(const std::vector<std::string>& words, std::size_t at,
                                      std::int64_t least, std::int64_t most);

/// The words from this place on, one blank between them.
std::string rest_of(const std::vector<std::string>& words, std::size_t from);

/// The longest delay of a reply that a command may ask for.
inline constexpr std::chrono::minutes kLongestDelay{1};

/// "on" or "off" as the word of this place and the last one.
std::optional<bool> switch_at(const std::vector<std::string>& words, std::size_t at);

/// "68 05", "6805" or "68,05"; an odd number of digits or another character is an error in words.
Result<Octets, std::string> octets_of(std::string_view text);

/// A word of the process image: "1250 (0x04E2)", "-30000 (0x8AD0)".
std::string show_word(std::uint16_t word);

} // namespace dpslave::sim
