// SPDX-License-Identifier: Apache-2.0
#include "diagnosis_texts.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace dpslave::dpctl {
namespace {

/// More bits than a diagnosis has.
constexpr std::uint32_t kMostBits = 8 * 244;

/// A text between quotes, or what stands there.
std::string text_in(std::string_view value)
{
    const std::size_t first = value.find('"'), last = value.rfind('"');
    if (first != std::string_view::npos && last > first) value = value.substr(first + 1, last - first - 1);
    return printable(value);
}

std::optional<std::uint32_t> bit_in(std::string_view text)
{
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return std::nullopt;
    text.remove_prefix(begin);
    std::uint32_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc{} || number >= kMostBits) return std::nullopt;
    return number;
}

/// "16-23". Nothing: no such span, or more bits than a number has here.
std::optional<DiagnosisTexts::Area> area_of(const gsd::Block& block)
{
    constexpr std::uint32_t kMostBitsOfANumber = 32;
    const std::size_t dash = block.head.find('-');
    if (dash == std::string::npos) return std::nullopt;
    const auto first = bit_in(std::string_view{block.head}.substr(0, dash));
    const auto last = bit_in(std::string_view{block.head}.substr(dash + 1));
    if (!first || !last || *last < *first || *last - *first >= kMostBitsOfANumber) return std::nullopt;
    DiagnosisTexts::Area area{*first, *last, {}};
    for (const gsd::Entry& entry : block.body)
        if (same_any_case(entry.keyword, "Value") && entry.index)
            area.values[*entry.index] = text_in(entry.value);
    return area;
}

bool bit_of(Bytes block, std::uint32_t bit)
{
    const std::size_t octet = 1 + bit / 8;
    return octet < block.size() && ((block[octet] >> bit % 8) & 1) != 0;
}

void append(std::string& all, const std::string& text)
{
    if (!text.empty()) all += (all.empty() ? "" : ", ") + text;
}

} // namespace

DiagnosisTexts diagnosis_texts(const gsd::Document& document)
{
    DiagnosisTexts texts;
    texts.model = printable(document.text("Model_Name"));
    for (const gsd::Entry& entry : document.keywords)
        if (same_any_case(entry.keyword, "Unit_Diag_Bit") && entry.index && *entry.index < kMostBits)
            texts.bits[*entry.index] = text_in(entry.value);
    for (const gsd::Block& block : document.blocks)
        if (same_any_case(block.kind, "Unit_Diag_Area"))
            if (auto area = area_of(block)) texts.areas.push_back(*std::move(area));
    return texts;
}

std::string texts_of_octet(const DiagnosisTexts& texts, Bytes block, std::size_t octet)
{
    if (octet == 0) return {};
    std::string all;
    const auto first = static_cast<std::uint32_t>(8 * (octet - 1));
    for (std::uint32_t bit = first; bit < first + 8; ++bit)
        if (const auto text = texts.bits.find(bit); text != texts.bits.end() && bit_of(block, bit))
            append(all, text->second);
    for (const DiagnosisTexts::Area& area : texts.areas) {
        if (area.first < first || area.first >= first + 8) continue;
        std::uint32_t value = 0;
        for (std::uint32_t bit = area.first; bit <= area.last; ++bit)
            if (bit_of(block, bit)) value |= std::uint32_t{1} << (bit - area.first);
        if (const auto text = area.values.find(value); text != area.values.end()) append(all, text->second);
    }
    return all;
}

} // namespace dpslave::dpctl
