// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/printable.hpp"

#include <cstdint>

namespace dpslave {
namespace {

std::uint8_t octet_of(char c)
{
    return static_cast<std::uint8_t>(c);
}

bool is_control(std::uint32_t code)
{
    const auto within = [code](std::uint32_t from, std::uint32_t to) { return from <= code && code <= to; };
    return code < 0x20 || within(0x7F, 0x9F) || // C0, DEL, C1
           code == 0x061C || within(0x200E, 0x200F) || within(0x202A, 0x202E) ||
           within(0x2066, 0x2069) || // the direction of writing (Unicode, annex 9)
           within(0x2028, 0x2029) || // ends of lines and paragraphs
           code == 0xFEFF || within(0xFFF9, 0xFFFB) || within(0xE0000, 0xE007F); // not seen at all
}

/// ISO 8859-1 to UTF-8.
void append_latin1(std::string& out, std::uint8_t octet)
{
    if (octet >= 0x80) out += static_cast<char>(0xC0 | octet >> 6);
    out += static_cast<char>(octet >= 0x80 ? 0x80 | (octet & 0x3F) : octet);
}

void append_hex(std::string& out, std::uint32_t code, int digits)
{
    constexpr std::string_view hex = "0123456789ABCDEF";
    for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += hex[code >> shift & 15U];
}

void append_escaped(std::string& out, std::uint32_t code)
{
    out += code < 0x100 ? "\\x" : "\\u";
    append_hex(out, code, code < 0x100 ? 2 : code < 0x10000 ? 4 : 5);
}

} // namespace

std::size_t character_length(std::string_view rest) noexcept
{
    const auto octet = [&](std::size_t i) { return i < rest.size() ? octet_of(rest[i]) : std::uint8_t{0}; };
    const auto follows = [&](std::size_t i) { return (octet(i) & 0xC0) == 0x80; };
    const std::uint8_t first = octet(0);
    if (rest.empty()) return 0;
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        const bool overlong = first == 0xE0 && octet(1) < 0xA0;
        const bool surrogate = first == 0xED && octet(1) >= 0xA0;
        return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        const bool overlong = first == 0xF0 && octet(1) < 0x90;
        const bool too_large = first == 0xF4 && octet(1) >= 0x90;
        return follows(1) && follows(2) && follows(3) && !overlong && !too_large ? 4 : 0;
    }
    return 0;
}

std::uint32_t code_point(std::string_view character) noexcept
{
    const std::uint8_t first = octet_of(character[0]);
    std::uint32_t code = first;
    if (character.size() == 2) code = first & 0x1FU;
    if (character.size() == 3) code = first & 0x0FU;
    if (character.size() == 4) code = first & 0x07U;
    for (const char next : character.substr(1)) code = code << 6 | (octet_of(next) & 0x3FU);
    return code;
}

bool is_control(std::string_view character) noexcept
{
    return !character.empty() && is_control(code_point(character));
}

std::string utf8(std::string_view text)
{
    bool is_utf8 = true;
    for (std::string_view rest = text; is_utf8 && !rest.empty();) {
        const std::size_t length = character_length(rest);
        is_utf8 = length > 0;
        rest.remove_prefix(length);
    }
    if (is_utf8) return std::string{text};
    std::string out;
    for (const char each : text) append_latin1(out, octet_of(each));
    return out;
}

std::string printable(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, length > 0 ? length : 1);
        const std::uint32_t code = length > 0 ? code_point(character) : octet_of(text[0]);
        if (is_control(code))
            append_escaped(out, code);
        else if (length > 0)
            out += character;
        else
            append_latin1(out, octet_of(text[0]));
        text.remove_prefix(character.size());
    }
    return out;
}

std::string printable_json(std::string_view json)
{
    std::string out;
    out.reserve(json.size());
    while (!json.empty()) {
        const std::size_t length = character_length(json);
        const std::string_view character = json.substr(0, length > 0 ? length : 1);
        const std::uint32_t code = length > 0 ? code_point(character) : octet_of(json[0]);
        if (code < 0x20 || !is_control(code)) { // what is below 20h JSON escapes itself, or it is layout
            out += character;
        } else if (code < 0x10000) {
            out += "\\u";
            append_hex(out, code, 4);
        } else { // as UTF-16 has it
            out += "\\u";
            append_hex(out, 0xD800 + ((code - 0x10000) >> 10), 4);
            out += "\\u";
            append_hex(out, 0xDC00 + ((code - 0x10000) & 0x3FF), 4);
        }
        json.remove_prefix(character.size());
    }
    return out;
}

} // namespace dpslave
