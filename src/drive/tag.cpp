// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/tag.hpp"

#include "digits.hpp"

#include "dpslave/base/letters.hpp"

#include <algorithm>
#include <cstddef>

namespace dpslave::drive {
namespace {

constexpr std::string_view kHexDigits = "0123456789ABCDEF";
constexpr std::string_view kTagDigits = "0123456789abcdefghijklmnopqrstuvwxyz";

std::int32_t counts_of(const Tag& tag, std::uint16_t word)
{
    const bool is_signed = tag.type == TagType::number && !tag.is_unsigned;
    return is_signed ? std::int32_t{static_cast<std::int16_t>(word)} : std::int32_t{word};
}

std::string labels_of(const Tag& tag, std::uint16_t word)
{
    std::string out;
    for (const Label& label : tag.labels) {
        const bool holds =
            label.is_bit ? label.number < 16 && ((word >> label.number) & 1) != 0 : label.number == word;
        if (!holds) continue;
        if (!out.empty()) out += ", ";
        out += label.text;
    }
    return out;
}

/// Returns the counts of a decimal text; nullopt if it is none, or if it has a digit other than 0 beyond the
/// tag's decimals.
std::optional<std::int64_t> parse_decimal(std::string_view text, unsigned decimals)
{
    const bool negative = !text.empty() && text.front() == '-';
    if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
    std::int64_t counts = 0;
    unsigned behind = 0;
    bool point = false;
    bool any = false;
    for (const char c : text) {
        if (c == '.' && !point) {
            point = true;
        } else if (c < '0' || c > '9') {
            return std::nullopt;
        } else if (point && behind == decimals) {
            if (c != '0') return std::nullopt;
        } else {
            any = true;
            counts = std::min(counts * 10 + (c - '0'), kTooLarge);
            if (point) ++behind;
        }
    }
    if (!any) return std::nullopt;
    for (; behind < decimals; ++behind) counts = std::min(counts * 10, kTooLarge);
    return negative ? -counts : counts;
}

/// The 16 bits after '>' or 0x; nothing if the text has no such form.
std::optional<ParsedValue> parse_hex(std::string_view text)
{
    if (text.starts_with('>')) {
        text.remove_prefix(1);
    } else if (text.starts_with("0x") || text.starts_with("0X")) {
        text.remove_prefix(2);
    } else {
        return std::nullopt;
    }
    if (text.empty()) return ParsedValue{0, AccessError::value_not_encoded};
    std::int64_t value = 0;
    for (const char c : text) {
        const int digit = hex_digit(c);
        if (digit < 0) return ParsedValue{0, AccessError::value_not_encoded};
        value = std::min(value * 16 + digit, kTooLarge);
    }
    if (value > 0xFFFF) return ParsedValue{0, AccessError::out_of_range};
    return ParsedValue{static_cast<std::uint16_t>(value), AccessError::none};
}

constexpr std::string_view kCounts = " counts";

struct Span {
    std::int64_t min, max;
};

Span span_of(const Tag& tag)
{
    switch (tag.type) {
        case TagType::number: return tag.is_unsigned ? Span{0, 65535} : Span{-32768, 32767};
        case TagType::boolean: return {0, 1};
        case TagType::enumeration: return {0, 255};
        case TagType::word:
        case TagType::string: break;
    }
    return {0, 65535};
}

ParsedValue checked(const Tag& tag, std::int64_t counts)
{
    const Span span = span_of(tag);
    if (counts < span.min || counts > span.max) return {0, AccessError::out_of_range};
    if (tag.min && counts < *tag.min) return {0, AccessError::out_of_range};
    if (tag.max && counts > *tag.max) return {0, AccessError::out_of_range};
    return {static_cast<std::uint16_t>(counts & 0xFFFF), AccessError::none};
}

std::array<char, 2> two_digits(unsigned number)
{
    return {kTagDigits[number / 36], kTagDigits[number % 36]};
}

constexpr unsigned kFirstPno = 1000, kPnos = 128;

std::optional<std::array<char, 2>> by_pno(unsigned number)
{
    const unsigned pno = number < kFirstPno ? number : number - kFirstPno;
    if (pno >= kPnos) return std::nullopt;
    return std::array{kHexDigits[pno >> 4], kHexDigits[pno & 15]};
}

std::optional<std::array<char, 2>> by_590plus(unsigned number)
{
    if (number >= kFirstPno && number < kFirstPno + kPnos) return by_pno(number);
    if (number < 936) return two_digits(number + 360);
    const unsigned k = number - 936;
    if (k >= 26 * 26) return std::nullopt;
    return std::array{static_cast<char>('a' + k / 26), static_cast<char>('A' + k % 26)};
}

/// The manual divides by 126 here; that gives 520 collisions and must be a misprint of 26 (EI-ASCII
/// reference, section 3).
std::optional<std::array<char, 2>> by_ac(unsigned number)
{
    if (number < 1296) return two_digits(number);
    const unsigned k = number - 1296;
    if (k >= 26 * 26) return std::nullopt;
    return std::array{static_cast<char>('a' + k % 26), static_cast<char>('A' + k / 26)};
}

} // namespace

std::string_view text(TagType type) noexcept
{
    switch (type) {
        case TagType::number: return "INT";
        case TagType::word: return "WORD";
        case TagType::boolean: return "BOOL";
        case TagType::enumeration: return "ENUM";
        case TagType::string: return "STRING";
    }
    return "?";
}

std::string_view type_name(const Tag& tag) noexcept
{
    return tag.type == TagType::number && tag.is_real ? "REAL" : text(tag.type);
}

std::string_view text(WritableWhen when) noexcept
{
    switch (when) {
        case WritableWhen::not_said: return "";
        case WritableWhen::stopped: return "stopped";
        case WritableWhen::configuration: return "configuration";
    }
    return "?";
}

Tag unlisted_tag(std::uint16_t number)
{
    Tag tag;
    tag.number = number;
    tag.type = TagType::word;
    tag.listed = false;
    return tag;
}

Tag unlisted_tag(std::uint16_t number, std::uint8_t decimals)
{
    Tag tag = unlisted_tag(number);
    tag.type = TagType::number;
    tag.decimals = decimals;
    return tag;
}

bool has_scale(const Tag& tag) noexcept
{
    if (!tag.confirmed) return false;
    if (tag.type == TagType::number) return tag.decimals_known;
    return tag.listed;
}

std::string displayed(const Tag& tag, std::uint16_t word)
{
    const bool hexadecimal = tag.type == TagType::word || tag.type == TagType::string || !tag.confirmed;
    const unsigned decimals = tag.type == TagType::number ? tag.decimals : 0;
    std::string out = hexadecimal ? hex_text(word, 4) : decimal_text(counts_of(tag, word), decimals);
    const std::string labels = labels_of(tag, word);
    if (!labels.empty()) out += " (" + labels + ")";
    return tag.in_counts && !hexadecimal ? out.append(kCounts) : out;
}

void mark_counts(std::vector<Tag>& tags)
{
    constexpr std::uint16_t kIeeeArea = 0x8000; // what is read there has its true value
    for (Tag& tag : tags)
        tag.in_counts = tag.type == TagType::number && tag.is_real && !tag.follows_display &&
                        tag.decimals == 0 && tag.modbus_register.value_or(tag.number) < kIeeeArea;
}

ParsedValue parse_value(const Tag& tag, std::string_view text)
{
    if (tag.type == TagType::string) return {0, AccessError::unsupported_type};
    text = trimmed(text);
    if (tag.in_counts && text.ends_with(kCounts)) text.remove_suffix(kCounts.size());
    for (const Label& label : tag.labels)
        if (!label.is_bit && same_any_case(label.text, text))
            return checked(tag, counts_of(tag, label.number));
    if (const auto bits = parse_hex(text)) {
        if (bits->error != AccessError::none) return *bits;
        return checked(tag, counts_of(tag, bits->word));
    }
    if (tag.type == TagType::word && text.size() != 1) return {0, AccessError::value_not_encoded};
    const auto counts = parse_decimal(text, tag.type == TagType::number ? tag.decimals : 0);
    if (!counts) return {0, AccessError::value_not_encoded};
    return checked(tag, *counts);
}

std::optional<Limits> limits_of(const Tag& tag, std::string_view min, std::string_view max)
{
    const ParsedValue least = parse_value(tag, min);
    const ParsedValue most = parse_value(tag, max);
    if (least.error != AccessError::none || most.error != AccessError::none) return std::nullopt;
    const Limits limits{counts_of(tag, least.word), counts_of(tag, most.word)};
    return limits.min <= limits.max ? std::optional{limits} : std::nullopt;
}

bool is_within_limits(const Tag& tag, std::uint16_t word)
{
    return checked(tag, counts_of(tag, word)).error == AccessError::none;
}

bool is_same_value(const Tag& a, const Tag& b)
{
    const auto is = [&](Access access) { return (a.access == access) == (b.access == access); };
    return a.number == b.number && a.type == b.type && a.is_real == b.is_real && a.decimals == b.decimals &&
           a.is_unsigned == b.is_unsigned && a.mnemonic == b.mnemonic &&
           a.modbus_register == b.modbus_register && is(Access::read_only) && is(Access::write_only);
}

TagTable::TagTable(std::vector<Tag> tags) : tags_(std::move(tags))
{
    std::sort(tags_.begin(), tags_.end(), [](const Tag& a, const Tag& b) { return a.number < b.number; });
}

const Tag* TagTable::find(std::uint16_t number) const
{
    const auto at =
        std::lower_bound(tags_.begin(), tags_.end(), number,
                         [](const Tag& tag, std::uint16_t wanted) { return tag.number < wanted; });
    return at != tags_.end() && at->number == number ? &*at : nullptr;
}

std::vector<const Tag*> TagTable::search(std::string_view name) const
{
    std::vector<const Tag*> found;
    for (const Tag& tag : tags_) {
        const bool by_alias =
            std::any_of(tag.aliases.begin(), tag.aliases.end(),
                        [name](const std::string& alias) { return contains_any_case(alias, name); });
        if (by_alias || contains_any_case(tag.name, name)) found.push_back(&tag);
    }
    return found;
}

std::vector<const Tag*> TagTable::in_table_order() const
{
    std::vector<const Tag*> ordered;
    for (const Tag& tag : tags_) ordered.push_back(&tag);
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const Tag* a, const Tag* b) { return a->position < b->position; });
    return ordered;
}

std::optional<std::array<char, 2>> mnemonic_of(const Tag& tag, MnemonicRule rule)
{
    if (tag.mnemonic.size() == 2) return std::array{tag.mnemonic[0], tag.mnemonic[1]};
    return mnemonic_by_rule(tag.number, rule);
}

std::optional<std::array<char, 2>> mnemonic_by_rule(std::uint16_t number, MnemonicRule rule)
{
    switch (rule) {
        case MnemonicRule::none: return std::nullopt;
        case MnemonicRule::dc_590plus: return by_590plus(number);
        case MnemonicRule::ac: return by_ac(number);
        case MnemonicRule::pno: return by_pno(number);
    }
    return std::nullopt;
}

std::optional<MnemonicRule> mnemonic_rule_of(std::string_view name)
{
    const auto* const found = std::find_if(kMnemonicRules.begin(), kMnemonicRules.end(),
                                           [&](const NamedRule& one) { return one.name == name; });
    return found == kMnemonicRules.end() ? std::nullopt : std::optional{found->rule};
}

std::string_view text(MnemonicRule rule) noexcept
{
    for (const NamedRule& one : kMnemonicRules)
        if (one.rule == rule) return one.name;
    return "?";
}

} // namespace dpslave::drive
