// SPDX-License-Identifier: Apache-2.0
#include "values.hpp"

#include <fmt/format.h>

#include <charconv>

namespace dpslave::sim {
namespace {

/// Two hexadecimal digits.
std::optional<std::uint8_t> octet_of(std::string_view text)
{
    std::uint8_t value = 0;
    const auto* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, 16);
    if (error != std::errc{} || stop != end || text.empty()) return std::nullopt;
    return value;
}

} // namespace

std::vector<std::string> words_of(std::string_view line)
{
    std::vector<std::string> words;
    std::size_t at = 0;
    while (true) {
        at = line.find_first_not_of(" \t\r", at);
        if (at == std::string_view::npos || line[at] == '#') return words;
        const auto end = std::min(line.find_first_of(" \t\r", at), line.size());
        words.emplace_back(line.substr(at, end - at));
        at = end;
    }
}

std::optional<std::int64_t> number_at(const std::vector<std::string>& words, std::size_t at,
                                      std::int64_t least, std::int64_t most)
{
    return at < words.size() ? read_number(words[at], least, most) : std::nullopt;
}

std::string rest_of(const std::vector<std::string>& words, std::size_t from)
{
    std::string rest;
    for (std::size_t i = from; i < words.size(); ++i) rest += (rest.empty() ? "" : " ") + words[i];
    return rest;
}

std::optional<bool> switch_at(const std::vector<std::string>& words, std::size_t at)
{
    if (words.size() != at + 1 || (words[at] != "on" && words[at] != "off")) return std::nullopt;
    return words[at] == "on";
}

Result<Octets, std::string> octets_of(std::string_view text)
{
    std::string digits;
    for (const char c : text) {
        if (c == ' ' || c == '\t' || c == ',') continue;
        digits += c;
    }
    if (digits.size() % 2 != 0)
        return Failure{fmt::format("'{}' has an odd number of hexadecimal digits", text)};
    Octets octets;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        const auto octet = octet_of(std::string_view{digits}.substr(i, 2));
        if (!octet) return Failure{fmt::format("'{}' is no hexadecimal octet", digits.substr(i, 2))};
        octets.push_back(*octet);
    }
    return octets;
}

std::string show_word(std::uint16_t word)
{
    return fmt::format("{} (0x{:04X})", static_cast<std::int16_t>(word), word);
}

} // namespace dpslave::sim
