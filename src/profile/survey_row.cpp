// SPDX-License-Identifier: Apache-2.0
#include "survey_row.hpp"

#include "dpslave/input/wording.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::profile {
namespace {

using drive::Tag;
using drive::TagType;

constexpr unsigned kMaxDecimals = 4;
constexpr std::int64_t kSignedMax = 32767, kSignedMin = -32768, kUnsignedMax = 65535;
constexpr std::string_view kModbusNote = "Modbus shows 16 bits only: type and decimals are in the manual";

std::int64_t counts_with(SeenNumber number, unsigned decimals)
{
    for (; number.decimals < decimals; ++number.decimals) number.counts *= 10;
    for (; number.decimals > decimals; --number.decimals) number.counts /= 10;
    return number.counts;
}

/// Returns the number as the drive wrote it: a word in hexadecimal.
std::string shown(SeenNumber number, bool is_word)
{
    if (!is_word) return text(number);
    std::string digits(4, '0');
    for (std::size_t i = 0; i < 4; ++i)
        digits[3 - i] = "0123456789ABCDEF"[(static_cast<std::uint64_t>(number.counts) >> (4 * i)) & 15];
    return '>' + digits;
}

/// Reads a cell seen_min or seen_max; returns nullopt if it is empty, or something else was written there.
std::optional<SeenNumber> seen_cell(std::string_view cell)
{
    Sighting one;
    one.add({SurveyAnswer::Kind::text, std::string{cell}, 0});
    if (one.form != SurveyForm::number && one.form != SurveyForm::hexadecimal) return std::nullopt;
    return one.lowest;
}

bool below(SeenNumber a, SeenNumber b)
{
    const unsigned decimals = std::max(a.decimals, b.decimals);
    return counts_with(a, decimals) < counts_with(b, decimals);
}

std::string_view type_of(const Sighting& one)
{
    switch (one.form) {
        case SurveyForm::number: return "INT";
        case SurveyForm::hexadecimal:
            if (one.digits > 2) return "WORD";
            return one.highest.counts > 1 ? "ENUM" : "BOOL";
        case SurveyForm::other: return "STRING";
        case SurveyForm::word: return "WORD";
        case SurveyForm::none:
        case SurveyForm::mixed: break;
    }
    return "";
}

/// Can a row of this type have answered so?
bool may_be(std::string_view type, const Sighting& one)
{
    const bool is_whole =
        one.decimals == 0 && one.lowest.counts >= 0 && one.form != SurveyForm::other && one.digits <= 2;
    if (type == "BOOL") return is_whole && one.highest.counts <= 1;
    if (type == "ENUM") return is_whole && one.highest.counts <= 255;
    if (type == "WORD") return one.form == SurveyForm::hexadecimal || one.form == SurveyForm::word;
    if (type == "STRING") return one.form == SurveyForm::other;
    return one.form == SurveyForm::number || one.form == SurveyForm::word;
}

/// Numbers above 32767 are unsigned, which a table says by its limits.
void limits(Cells& cells, const Sighting& one, unsigned decimals)
{
    const bool is_unsigned = one.form == SurveyForm::number &&
                             counts_with(one.highest, decimals) > kSignedMax &&
                             counts_with(one.lowest, decimals) >= 0;
    if (!is_unsigned || !cells["min"].empty() || !cells["max"].empty()) return;
    cells["min"] = "0";
    cells["max"] = text(SeenNumber{kUnsignedMax, decimals});
}

std::string decimals_text(unsigned decimals)
{
    return std::to_string(decimals) + (decimals == 1 ? " decimal" : " decimals");
}

unsigned decimals_of(std::string_view cell)
{
    unsigned decimals = 0;
    std::from_chars(cell.data(), cell.data() + cell.size(), decimals);
    return decimals;
}

} // namespace

std::optional<std::string> no_row_for(const Sighting& one)
{
    if (one.form == SurveyForm::mixed)
        return "it answers in more than one form, the last time " + input::in_quotes(one.last) +
               ": no row can be made";
    if (one.form != SurveyForm::number) return std::nullopt;
    if (one.decimals > kMaxDecimals)
        return "it answers " + input::in_quotes(one.last) + ": a table has 4 decimals at most";
    const bool fits =
        counts_with(one.lowest, one.decimals) >= kSignedMin &&
        counts_with(one.highest, one.decimals) <= (one.lowest.counts < 0 ? kSignedMax : kUnsignedMax);
    if (fits) return std::nullopt;
    return "it answered " + text(one.lowest) + " to " + text(one.highest) + " with up to " +
           std::to_string(one.decimals) + " decimals: more than the 16 bits of PROFIBUS hold";
}

Cells new_row(const Sighting& one)
{
    Cells cells;
    cells["type"] = type_of(one);
    if (one.form == SurveyForm::number) cells["decimals"] = std::to_string(one.decimals);
    cells["confirmed"] = "no";
    if (one.form == SurveyForm::word) cells["notes"] = kModbusNote;
    widen_row(cells, one);
    return cells;
}

void widen_row(Cells& cells, const Sighting& one)
{
    if (!may_be(cells["type"], one)) {
        cells["type"] = type_of(one);
        for (const char* const column : {"decimals", "min", "max", "seen_min", "seen_max"})
            cells[column].clear();
    }
    if (one.form == SurveyForm::number && may_be("INT", one) && cells["type"] != "BOOL" &&
        cells["type"] != "ENUM") {
        const unsigned decimals = std::max(decimals_of(cells["decimals"]), one.decimals);
        cells["decimals"] = std::to_string(decimals);
        limits(cells, one, decimals);
    }
    if (cells["mnemonic"].empty()) cells["mnemonic"] = one.mnemonic;
    if (one.form == SurveyForm::other) return;
    const bool is_word = one.form == SurveyForm::hexadecimal && one.digits > 2;
    const auto lowest = seen_cell(cells["seen_min"]), highest = seen_cell(cells["seen_max"]);
    if (!lowest || below(one.lowest, *lowest)) cells["seen_min"] = shown(one.lowest, is_word);
    if (!highest || below(*highest, one.highest)) cells["seen_max"] = shown(one.highest, is_word);
}

std::vector<std::string> against(const Tag& row, bool has_decimals, const Sighting& one)
{
    if (one.answers == 0) {
        const bool is_odd = one.denials > 0 && row.access != drive::Access::write_only;
        return is_odd ? std::vector{"the drive denies it (" + one.denied + ")"} : std::vector<std::string>{};
    }
    const std::string type{drive::type_name(row)};
    if (one.form == SurveyForm::mixed || !may_be(type, one))
        return {"its row says " + type + ", the drive answered " + input::in_quotes(one.last)};
    if (row.type != TagType::number || one.form != SurveyForm::number) return {};
    if (!has_decimals)
        return {"its row says no decimals, the drive answers with " + std::to_string(one.decimals) +
                " at least: fill in column decimals by the manual"};
    if (one.decimals > row.decimals)
        return {"its row says " + decimals_text(row.decimals) + ", the drive answers with " +
                std::to_string(one.decimals)};
    std::vector<std::string> out;
    const std::int64_t lowest = counts_with(one.lowest, row.decimals),
                       highest = counts_with(one.highest, row.decimals);
    const std::int64_t least = row.min.value_or(row.is_unsigned ? 0 : kSignedMin);
    const std::int64_t most = row.max.value_or(row.is_unsigned ? kUnsignedMax : kSignedMax);
    if (lowest < least)
        out.push_back("the drive answered " + text(one.lowest) + ", its row allows " +
                      text(SeenNumber{least, row.decimals}) + " at least");
    if (highest > most)
        out.push_back("the drive answered " + text(one.highest) + ", its row allows " +
                      text(SeenNumber{most, row.decimals}) + " at most");
    return out;
}

} // namespace dpslave::profile
