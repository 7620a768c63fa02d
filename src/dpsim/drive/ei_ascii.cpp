// SPDX-License-Identifier: Apache-2.0
#include "ei_ascii.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace dpslave::sim {
namespace {

/// 0..9, then a..z.
char digit(unsigned k)
{
    return static_cast<char>(k < 10 ? '0' + k : 'a' + (k - 10));
}

std::optional<std::int32_t> hex_number(std::string_view data, std::size_t most)
{
    if (data.size() < 2 || data.size() > most + 1 || data[0] != '>') return std::nullopt;
    std::uint16_t value = 0;
    const auto* const end = data.data() + data.size();
    const auto [stop, error] = std::from_chars(data.data() + 1, end, value, 16);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

/// Returns the counts of a decimal text; the point is mandatory, at most five digits are before it, digits
/// beyond `decimals` must be zeros.
std::optional<std::int32_t> counts_of(std::string_view data, unsigned decimals)
{
    const bool negative = data.starts_with('-');
    if (negative) data.remove_prefix(1);
    const auto point = data.find('.');
    if (point == std::string_view::npos || point > 5 || data.size() < 2) return std::nullopt;
    std::string_view fraction = data.substr(point + 1);
    while (fraction.size() > decimals && fraction.ends_with('0')) fraction.remove_suffix(1);
    if (fraction.size() > decimals) return std::nullopt;
    std::string digits{data.substr(0, point)};
    digits += fraction;
    digits.append(decimals - fraction.size(), '0');
    if (!std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
        return std::nullopt;
    std::int32_t counts = 0;
    if (digits.size() > 9) return std::nullopt;
    for (const char c : digits) counts = counts * 10 + (c - '0');
    return negative ? -counts : counts;
}

bool sends_decimal_enum(Model model)
{
    return model == Model::ac584s || model == Model::ac;
}
bool takes_decimal_enum(Model model)
{
    return model != Model::dc590;
}

std::optional<std::int32_t> number_of_data(Model model, const SimTag& tag, std::string_view data)
{
    switch (tag.type) {
        case TagKind::word: return hex_number(data, 4);
        case TagKind::boolean: return hex_number(data, 2);
        case TagKind::enumeration:
            if (data.starts_with('>')) return hex_number(data, 2);
            return takes_decimal_enum(model) ? counts_of(data, 0) : std::nullopt;
        case TagKind::number: return counts_of(data, tag.decimals);
        case TagKind::string: break;
    }
    return std::nullopt;
}

} // namespace

std::optional<Model> model_of(std::string_view name)
{
    if (name == "590" || name == "590plus") return Model::dc590;
    if (name == "584s") return Model::ac584s;
    if (name == "620") return Model::dc620;
    if (name == "584sv" || name == "605" || name == "690plus") return Model::ac;
    return std::nullopt;
}

std::uint8_t block_check(Bytes after_stx)
{
    std::uint8_t check = 0;
    for (const std::uint8_t octet : after_stx) check ^= octet;
    return check;
}

Octets reply_frame(std::string_view mnemonic, std::string_view data)
{
    Octets frame{kStx};
    frame.insert(frame.end(), mnemonic.begin(), mnemonic.end());
    frame.insert(frame.end(), data.begin(), data.end());
    frame.push_back(kEtx);
    frame.push_back(block_check(Bytes{frame}.subspan(1)));
    return frame;
}

std::optional<Rule> rule_of(std::string_view name)
{
    if (name == "590plus") return Rule::dc_590plus;
    if (name == "ac") return Rule::ac;
    if (name == "pno") return Rule::pno;
    return std::nullopt;
}

Rule rule_of(Model model)
{
    return model == Model::ac ? Rule::ac : Rule::dc_590plus;
}

std::string mnemonic_of(Rule rule, std::uint16_t tag)
{
    constexpr unsigned kLetters = 26, kNumbers = 128, kFirstNumber = 1000;
    const bool is_number = tag >= kFirstNumber && tag < kFirstNumber + kNumbers;
    if (rule != Rule::ac && is_number) return fmt::format("{:02X}", tag - kFirstNumber);
    if (rule == Rule::pno) return tag < kNumbers ? fmt::format("{:02X}", tag) : std::string{};
    const bool is_ac = rule == Rule::ac;
    const unsigned first = is_ac ? tag : tag + 360U;
    if (first < 36 * 36) return {digit(first / 36), digit(first % 36)};
    const unsigned beyond = first - 36 * 36;
    if (beyond >= kLetters * kLetters) return {};
    const unsigned slow = beyond / kLetters, fast = beyond % kLetters; // the AC drives put the fast one first
    return {static_cast<char>('a' + (is_ac ? fast : slow)), static_cast<char>('A' + (is_ac ? slow : fast))};
}

std::string Naming::name(const SimTag& tag) const
{
    if (table_first_ && !tag.mnemonic.empty()) return tag.mnemonic;
    if (rule_) return mnemonic_of(*rule_, tag.number);
    const auto row =
        std::find_if(rows_.begin(), rows_.end(), [&](const SimTag& one) { return one.number == tag.number; });
    return row == rows_.end() ? std::string{} : row->mnemonic;
}

std::string drive_text(Model model, const SimTag& tag, const SimValue& value)
{
    switch (tag.type) {
        case TagKind::string: return value.text;
        case TagKind::word: return fmt::format(">{:04X}", value.counts & 0xFFFF);
        case TagKind::boolean: return fmt::format(">{:02X}", value.counts & 1);
        case TagKind::enumeration:
            return sends_decimal_enum(model) ? fmt::format("{}.", value.counts)
                                             : fmt::format(">{:02X}", value.counts & 0xFF);
        case TagKind::number: break;
    }
    std::string text = displayed(tag, value);
    if (tag.decimals == 0) return text + '.';
    while (text.ends_with('0')) text.pop_back(); // trailing zeros go, the point stays
    return text;
}

Result<SimValue, Ee> drive_value(Model model, const SimTag& tag, std::string_view data)
{
    if (tag.type == TagKind::string) {
        if (data.size() > 16) return Failure{Ee::invalid_data};
        return SimValue{0, std::string{data}};
    }
    const auto counts = number_of_data(model, tag, data);
    if (!counts) return Failure{Ee::invalid_data};
    if (*counts < tag.min || *counts > tag.max) return Failure{Ee::out_of_range};
    return SimValue{*counts, {}};
}

} // namespace dpslave::sim
