// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/number.hpp"

#include <charconv>

namespace dpslave {
namespace {

bool has_prefix(std::string_view text)
{
    return text.starts_with("0x") || text.starts_with("0X");
}

std::string hex_word(std::uint32_t word)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out = "0x";
    for (int shift = 12; shift >= 0; shift -= 4) out += digits[(word >> shift) & 15];
    return out;
}

} // namespace

std::optional<std::int64_t> read_number(std::string_view text)
{
    const bool negative = text.starts_with('-');
    if (negative) text.remove_prefix(1);
    const bool is_hexadecimal = has_prefix(text);
    if (is_hexadecimal) text.remove_prefix(2);
    std::int64_t value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value, is_hexadecimal ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size() || text.starts_with('-'))
        return std::nullopt;
    return negative ? -value : value;
}

std::optional<std::int64_t> read_number(std::string_view text, std::int64_t least, std::int64_t most)
{
    const auto number = read_number(text);
    return number && *number >= least && *number <= most ? number : std::nullopt;
}

TypedIdent read_ident(std::string_view text)
{
    constexpr std::size_t kSureDigits = 3;
    constexpr std::int64_t kMost = 0xFFFF;
    const auto number = read_number(text, 1, kMost);
    const std::string typed{text};
    if (number && (has_prefix(text) || text.size() <= kSureDigits))
        return {static_cast<std::uint16_t>(*number), {}};
    const auto as_hexadecimal = has_prefix(text) ? std::nullopt : read_number("0x" + typed, 1, kMost);
    if (!as_hexadecimal) {
        if (!number) return {{}, typed + ": write a number from 0x0001 to 0xFFFF, such as 0x1649"};
        const std::string only = hex_word(static_cast<std::uint32_t>(*number));
        return {{}, typed + " is " + only + ": write " + only};
    }
    const std::string first = hex_word(static_cast<std::uint32_t>(*as_hexadecimal));
    if (!number) return {{}, typed + ": write " + first};
    const std::string second = hex_word(static_cast<std::uint32_t>(*number));
    return {{},
            typed + " could mean " + first + " or " + typed + " = " + second + ": write " + first + " or " +
                second};
}

std::string NumberOption::operator()(std::string& text) const
{
    const auto number = read_number(text, least, most);
    if (!number)
        return text + ": write a number from " + std::to_string(least) + " to " + std::to_string(most);
    text = std::to_string(*number);
    return {};
}

} // namespace dpslave
