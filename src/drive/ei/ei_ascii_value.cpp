// SPDX-License-Identifier: Apache-2.0
/// The text form of values on an EI-ASCII line (EI-ASCII reference, section 2).
#include "drive/digits.hpp"

#include "dpslave/drive/ei_ascii.hpp"

#include <algorithm>
#include <optional>

namespace dpslave::drive::ei {
namespace {

/// The point is mandatory, zeros at the end are not sent.
std::string number_text(std::int32_t counts, unsigned decimals)
{
    std::string digits = decimal_text(counts, decimals);
    if (decimals == 0) digits += '.';
    while (digits.back() == '0') digits.pop_back(); // ends at the point at the latest
    return digits;
}

/// Returns the counts of a decimal number. A digit beyond the table's decimals, even a 0, shows that the
/// table is wrong: drives send no zeros without a meaning.
Result<std::int64_t, ValueFlaw> decode_counts(std::string_view text, unsigned decimals)
{
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    std::int64_t counts = 0;
    std::optional<unsigned> behind;
    bool any = false;
    for (const char c : text) {
        if (c == '.' && !behind) {
            behind = 0;
            continue;
        }
        if (c < '0' || c > '9') return Failure{ValueFlaw::not_a_value};
        any = true;
        if (behind && ++*behind > decimals) continue;
        counts = std::min(counts * 10 + (c - '0'), kTooLarge);
    }
    if (!any) return Failure{ValueFlaw::not_a_value};
    if (behind.value_or(0) > decimals) return Failure{ValueFlaw::too_many_decimals};
    for (unsigned i = behind.value_or(0); i < decimals; ++i) counts = std::min(counts * 10, kTooLarge);
    return negative ? -counts : counts;
}

Result<std::uint16_t, ValueFlaw> within(std::int64_t counts, std::int64_t min, std::int64_t max)
{
    if (counts < min || counts > max) return Failure{ValueFlaw::out_of_span};
    return static_cast<std::uint16_t>(counts & 0xFFFF);
}

/// BOOL and ENUM: hexadecimal or decimal, as the family does it.
Result<std::uint16_t, ValueFlaw> decode_small(std::string_view text, std::uint16_t max)
{
    if (text.starts_with('>')) {
        const auto word = decode_word(text);
        if (!word) return word;
        return within(*word, 0, max);
    }
    const auto counts = decode_counts(text, 0);
    if (!counts) return Failure{counts.error()};
    return within(*counts, 0, max);
}

} // namespace

std::string_view text(ValueFlaw flaw) noexcept
{
    switch (flaw) {
        case ValueFlaw::not_a_value: return "it is no value";
        case ValueFlaw::too_many_decimals: return "it has more decimals than the tag table gives";
        case ValueFlaw::out_of_span: return "it does not fit";
        case ValueFlaw::wrong_form: return "the tag table gives another type";
        case ValueFlaw::unsupported_type: return "a STRING is not transported";
    }
    return "?";
}

Result<std::string, ValueFlaw> encode_value(const Tag& tag, std::uint16_t word, EnumForm enums)
{
    switch (tag.type) {
        case TagType::number: {
            const auto counts =
                tag.is_unsigned ? std::int32_t{word} : std::int32_t{static_cast<std::int16_t>(word)};
            return number_text(counts, tag.decimals);
        }
        case TagType::word: return hex_text(word, 4);
        case TagType::boolean:
            if (word > 1) return Failure{ValueFlaw::out_of_span};
            return hex_text(word, 2);
        case TagType::enumeration:
            if (word > 0xFF) return Failure{ValueFlaw::out_of_span};
            return enums == EnumForm::hexadecimal ? hex_text(word, 2) : number_text(word, 0);
        case TagType::string: break;
    }
    return Failure{ValueFlaw::unsupported_type};
}

Result<std::uint16_t, ValueFlaw> decode_word(std::string_view text)
{
    text = trimmed(text);
    if (!text.starts_with('>')) return Failure{ValueFlaw::wrong_form};
    text.remove_prefix(1);
    if (text.empty() || text.size() > 4) return Failure{ValueFlaw::not_a_value};
    unsigned value = 0;
    for (const char c : text) {
        const int digit = hex_digit(c);
        if (digit < 0) return Failure{ValueFlaw::not_a_value};
        value = value * 16 + static_cast<unsigned>(digit);
    }
    return static_cast<std::uint16_t>(value);
}

Result<std::uint16_t, ValueFlaw> decode_value(const Tag& tag, std::string_view text)
{
    text = trimmed(text);
    switch (tag.type) {
        case TagType::number: {
            if (text.starts_with('>')) return Failure{ValueFlaw::wrong_form};
            const auto counts = decode_counts(text, tag.decimals);
            if (!counts) return Failure{counts.error()};
            return tag.is_unsigned ? within(*counts, 0, 65535) : within(*counts, -32768, 32767);
        }
        case TagType::word: return decode_word(text);
        case TagType::boolean: return decode_small(text, 1);
        case TagType::enumeration: return decode_small(text, 255);
        case TagType::string: break;
    }
    return Failure{ValueFlaw::unsupported_type};
}

} // namespace dpslave::drive::ei
