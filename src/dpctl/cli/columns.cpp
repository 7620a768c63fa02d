// SPDX-License-Identifier: Apache-2.0
#include "columns.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace dpslave::dpctl {
namespace {

struct CodeSpan {
    std::uint32_t first, last;
};

/// Scripts in blocks, without the few letters inside of them that are no accents.
constexpr std::array kWithoutColumn = std::to_array<CodeSpan>({
    {0x00AD, 0x00AD},   {0x0300, 0x036F}, {0x0483, 0x0489}, {0x0591, 0x05BD}, {0x05BF, 0x05BF},
    {0x05C1, 0x05C2},   {0x05C4, 0x05C5}, {0x0610, 0x061A}, {0x064B, 0x065F}, {0x0670, 0x0670},
    {0x06D6, 0x06DC},   {0x06DF, 0x06E4}, {0x0900, 0x0902}, {0x093A, 0x093A}, {0x093C, 0x093C},
    {0x0941, 0x0948},   {0x094D, 0x094D}, {0x0E31, 0x0E31}, {0x0E34, 0x0E3A}, {0x0E47, 0x0E4E},
    {0x1160, 0x11FF},   {0x1AB0, 0x1ACE}, {0x1DC0, 0x1DFF}, {0x200B, 0x200D}, {0x2060, 0x2064},
    {0x20D0, 0x20F0},   {0x302A, 0x302D}, {0x3099, 0x309A}, {0xFE00, 0xFE0F}, {0xFE20, 0xFE2F},
    {0xE0100, 0xE01EF},
});

constexpr std::array kTwoColumns = std::to_array<CodeSpan>({
    {0x1100, 0x115F},   {0x231A, 0x231B},   {0x2329, 0x232A},   {0x23E9, 0x23EC},   {0x23F0, 0x23F0},
    {0x23F3, 0x23F3},   {0x25FD, 0x25FE},   {0x2614, 0x2615},   {0x2648, 0x2653},   {0x267F, 0x267F},
    {0x2693, 0x2693},   {0x26A1, 0x26A1},   {0x26AA, 0x26AB},   {0x26BD, 0x26BE},   {0x26C4, 0x26C5},
    {0x26CE, 0x26CE},   {0x26D4, 0x26D4},   {0x26EA, 0x26EA},   {0x26F2, 0x26F3},   {0x26F5, 0x26F5},
    {0x26FA, 0x26FA},   {0x26FD, 0x26FD},   {0x2705, 0x2705},   {0x270A, 0x270B},   {0x2728, 0x2728},
    {0x274C, 0x274C},   {0x274E, 0x274E},   {0x2753, 0x2755},   {0x2757, 0x2757},   {0x2795, 0x2797},
    {0x27B0, 0x27B0},   {0x27BF, 0x27BF},   {0x2B1B, 0x2B1C},   {0x2B50, 0x2B50},   {0x2B55, 0x2B55},
    {0x2E80, 0x303E},   {0x3041, 0x3247},   {0x3250, 0x4DBF},   {0x4E00, 0xA4C6},   {0xA960, 0xA97C},
    {0xAC00, 0xD7A3},   {0xF900, 0xFAFF},   {0xFE10, 0xFE19},   {0xFE30, 0xFE6B},   {0xFF01, 0xFF60},
    {0xFFE0, 0xFFE6},   {0x16FE0, 0x18CD5}, {0x1AFF0, 0x1B2FB}, {0x1F004, 0x1F004}, {0x1F0CF, 0x1F0CF},
    {0x1F18E, 0x1F18E}, {0x1F191, 0x1F19A}, {0x1F200, 0x1F320}, {0x1F32D, 0x1F335}, {0x1F337, 0x1F37C},
    {0x1F37E, 0x1F393}, {0x1F3A0, 0x1F3CA}, {0x1F3CF, 0x1F3D3}, {0x1F3E0, 0x1F3F0}, {0x1F3F4, 0x1F3F4},
    {0x1F3F8, 0x1F43E}, {0x1F440, 0x1F440}, {0x1F442, 0x1F4FC}, {0x1F4FF, 0x1F53D}, {0x1F54B, 0x1F567},
    {0x1F57A, 0x1F57A}, {0x1F595, 0x1F596}, {0x1F5A4, 0x1F5A4}, {0x1F5FB, 0x1F64F}, {0x1F680, 0x1F6C5},
    {0x1F6CC, 0x1F6CC}, {0x1F6D0, 0x1F6D7}, {0x1F6DC, 0x1F6DF}, {0x1F6EB, 0x1F6EC}, {0x1F6F4, 0x1F6FC},
    {0x1F7E0, 0x1F7F0}, {0x1F90C, 0x1F93A}, {0x1F93C, 0x1F945}, {0x1F947, 0x1FAFF}, {0x20000, 0x3FFFD},
});

/// `spans` in their order.
bool is_among(std::uint32_t code, const auto& spans)
{
    const auto next = std::upper_bound(spans.begin(), spans.end(), code,
                                       [](std::uint32_t c, const CodeSpan& span) { return c < span.first; });
    return next != spans.begin() && code <= std::prev(next)->last;
}

/// The character at the start of `text`, which is not empty.
struct Character {
    std::size_t octets = 1, columns = 1;
};

Character first_character(std::string_view text)
{
    const std::size_t octets = character_length(text);
    if (octets < 2) return {};
    const std::uint32_t code = code_point(text.substr(0, octets));
    if (is_among(code, kWithoutColumn)) return {octets, 0};
    return {octets, is_among(code, kTwoColumns) ? std::size_t{2} : std::size_t{1}};
}

} // namespace

std::size_t columns_of(std::string_view text)
{
    std::size_t columns = 0;
    while (!text.empty()) {
        const Character one = first_character(text);
        columns += one.columns;
        text.remove_prefix(one.octets);
    }
    return columns;
}

std::size_t octets_within(std::string_view text, std::size_t columns)
{
    std::size_t at = 0;
    while (at < text.size()) {
        const Character one = first_character(text.substr(at));
        if (one.columns > columns) break;
        columns -= one.columns;
        at += one.octets;
    }
    return at;
}

std::string cut(std::string_view text, std::size_t columns)
{
    if (columns_of(text) <= columns) return std::string{text};
    if (columns == 0) return {};
    const std::string_view kept = text.substr(0, octets_within(text, columns - 1));
    return std::string{kept} + std::string(columns - columns_of(kept), '~');
}

std::string fitted(std::string_view text, std::size_t columns, bool to_the_right)
{
    const std::string shown = cut(text, columns);
    const std::string fill(columns - columns_of(shown), ' ');
    return to_the_right ? fill + shown : shown + fill;
}

} // namespace dpslave::dpctl
