// SPDX-License-Identifier: Apache-2.0
/// Letters of ASCII without their case, whatever the locale is. All other characters stay.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace dpslave {

constexpr char to_lower(char c) noexcept
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string to_lower(std::string_view text)
{
    std::string out{text};
    for (char& c : out) c = to_lower(c);
    return out;
}

constexpr bool same_any_case(std::string_view a, std::string_view b) noexcept
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return to_lower(x) == to_lower(y); });
}

constexpr bool contains_any_case(std::string_view text, std::string_view part) noexcept
{
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [](char x, char y) { return to_lower(x) == to_lower(y); }) != text.end();
}

} // namespace dpslave
