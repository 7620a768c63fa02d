// SPDX-License-Identifier: Apache-2.0
#include "text.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::gsd {

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\v\f";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<std::uint32_t> parse_number(std::string_view text)
{
    int base = 10;
    if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
        base = 16;
        text.remove_prefix(2);
    }
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<std::int64_t> parse_signed(std::string_view text)
{
    const bool negative = !text.empty() && text.front() == '-';
    const auto value = parse_number(negative ? text.substr(1) : text);
    if (!value) return std::nullopt;
    return negative ? -std::int64_t{*value} : std::int64_t{*value};
}

std::optional<Quoted> parse_quoted(std::string_view value)
{
    if (value.empty() || value.front() != '"') return std::nullopt;
    const auto close = value.find('"', 1);
    if (close == std::string_view::npos) return std::nullopt;
    return Quoted{std::string{value.substr(1, close - 1)}, trimmed(value.substr(close + 1))};
}

std::vector<std::string_view> split(std::string_view text, char between)
{
    std::vector<std::string_view> parts;
    for (;;) {
        const auto at = text.find(between);
        parts.push_back(trimmed(text.substr(0, at)));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

std::optional<std::vector<std::uint8_t>> parse_octets(std::string_view value)
{
    std::vector<std::uint8_t> octets;
    for (const std::string_view part : split(value, ',')) {
        const auto number = parse_number(part);
        if (!number || *number > 0xFF) return std::nullopt;
        octets.push_back(static_cast<std::uint8_t>(*number));
    }
    return octets;
}

std::string hex_octet(std::uint8_t octet)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    return {'0', 'x', digits[octet >> 4], digits[octet & 15]};
}

std::string hex_word(std::uint32_t word)
{
    return hex_octet(static_cast<std::uint8_t>(word >> 8 & 0xFF)) +
           hex_octet(static_cast<std::uint8_t>(word & 0xFF)).substr(2);
}

std::string in_quotes(std::string_view text)
{
    return '"' + std::string{text} + '"';
}

std::string count_of(std::size_t count, std::string_view one)
{
    return std::to_string(count) + ' ' + std::string{one} + (count == 1 ? "" : "s");
}

} // namespace dpslave::gsd
