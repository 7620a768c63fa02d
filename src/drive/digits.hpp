// SPDX-License-Identifier: Apache-2.0
/// Digits of values, as users type them and as drives send them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::drive {

/// Beyond every span of 16 bits and its decimals: further digits change nothing, and nothing overflows.
inline constexpr std::int64_t kTooLarge = 1'000'000'000;

inline std::string_view trimmed(std::string_view text)
{
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

/// -1 where `c` is no hexadecimal digit.
constexpr int hex_digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
}

/// ">1A2B": `digits` digits after the mark.
inline std::string hex_text(unsigned value, unsigned digits)
{
    std::string out(1, '>');
    for (unsigned shift = digits * 4; shift > 0; shift -= 4)
        out += "0123456789ABCDEF"[(value >> (shift - 4)) & 15];
    return out;
}

/// "-0.05" with all its decimals; no point where there are none.
inline std::string decimal_text(std::int32_t counts, unsigned decimals)
{
    std::string digits = std::to_string(counts < 0 ? -counts : counts);
    if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
    if (decimals > 0) digits.insert(digits.size() - decimals, 1, '.');
    return counts < 0 ? "-" + digits : digits;
}

} // namespace dpslave::drive
