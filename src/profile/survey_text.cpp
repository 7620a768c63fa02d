// SPDX-License-Identifier: Apache-2.0
// The options of a survey as text, and its record as a file.
#include "csv.hpp"

#include "dpslave/base/number.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/profile/survey.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::profile {
namespace {

/// A complete text as a number; nullopt if it is anything else.
template <class T>
std::optional<T> whole(std::string_view text)
{
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

constexpr std::string_view kRecordHeader =
    "tag,mnemonic,answers,silences,denials,form,digits,decimals,lowest,highest,last,denied,station";
enum class RecordColumn : std::size_t {
    tag,
    mnemonic,
    answers,
    silences,
    denials,
    form,
    digits,
    decimals,
    lowest,
    highest,
    last,
    denied,
    station,
};
constexpr std::size_t kRecordColumns = 13;

constexpr std::array kForms = {SurveyForm::none,  SurveyForm::number, SurveyForm::hexadecimal,
                               SurveyForm::other, SurveyForm::mixed,  SurveyForm::word};

/// "-12.50"
std::optional<SeenNumber> seen_number(std::string_view text)
{
    std::string digits{text};
    SeenNumber number;
    if (const auto point = digits.find('.'); point != std::string::npos) {
        number.decimals = static_cast<unsigned>(digits.size() - point - 1);
        digits.erase(point, 1);
    }
    const auto counts = whole<std::int64_t>(digits);
    if (!counts) return std::nullopt;
    number.counts = *counts;
    return number;
}

std::optional<std::pair<std::uint16_t, Sighting>> record_row(const Row& row)
{
    if (row.cells.size() != kRecordColumns) return std::nullopt;
    const auto cell = [&](RecordColumn column) -> std::string_view {
        return row.cells[static_cast<std::size_t>(column)].text;
    };
    const auto tag = whole<std::uint16_t>(cell(RecordColumn::tag));
    const auto answers = whole<std::uint32_t>(cell(RecordColumn::answers));
    const auto silences = whole<std::uint32_t>(cell(RecordColumn::silences));
    const auto denials = whole<std::uint32_t>(cell(RecordColumn::denials));
    const auto digits = whole<unsigned>(cell(RecordColumn::digits));
    const auto decimals = whole<unsigned>(cell(RecordColumn::decimals));
    const auto form = std::find_if(kForms.begin(), kForms.end(),
                                   [&](SurveyForm one) { return text(one) == cell(RecordColumn::form); });
    const auto lowest =
        cell(RecordColumn::lowest).empty() ? SeenNumber{} : seen_number(cell(RecordColumn::lowest));
    const auto highest =
        cell(RecordColumn::highest).empty() ? SeenNumber{} : seen_number(cell(RecordColumn::highest));
    if (!tag || !answers || !silences || !denials || !digits || !decimals || form == kForms.end() ||
        !lowest || !highest)
        return std::nullopt;
    Sighting one;
    one.mnemonic = cell(RecordColumn::mnemonic);
    one.answers = *answers;
    one.silences = *silences;
    one.denials = *denials;
    one.form = *form;
    one.digits = *digits;
    one.decimals = *decimals;
    one.lowest = *lowest;
    one.highest = *highest;
    one.last = cell(RecordColumn::last);
    one.denied = cell(RecordColumn::denied);
    return std::pair{*tag, std::move(one)};
}

} // namespace

std::string spans_text(std::span<const std::uint16_t> tags)
{
    std::string out;
    for (std::size_t i = 0; i < tags.size();) {
        std::size_t end = i + 1;
        while (end < tags.size() && tags[end] == tags[end - 1] + 1) ++end;
        if (!out.empty()) out += ", ";
        out += std::to_string(tags[i]);
        if (end - i > 1) out += (end - i > 2 ? "-" : ", ") + std::to_string(tags[end - 1]);
        i = end;
    }
    return out;
}

std::string record_text(const Survey& survey, std::string_view station)
{
    std::string out{kRecordHeader};
    out += '\n';
    for (const auto& [tag, one] : survey) {
        const bool has_number = one.answers > 0 && one.form != SurveyForm::other;
        for (const std::string& cell :
             {std::to_string(tag), csv_cell(one.mnemonic), std::to_string(one.answers),
              std::to_string(one.silences), std::to_string(one.denials), std::string{text(one.form)},
              std::to_string(one.digits), std::to_string(one.decimals),
              has_number ? text(one.lowest) : std::string{}, has_number ? text(one.highest) : std::string{},
              csv_cell(one.last)})
            out += cell + ',';
        out += csv_cell(one.denied) + ',' + csv_cell(station) + '\n';
    }
    return out;
}

Result<Survey, input::Faults> read_record(std::string_view content, const std::string& file,
                                          std::string_view station)
{
    input::Faults faults;
    const std::vector<Row> rows = read_csv(content, file, faults);
    Survey survey;
    if (!content.starts_with(kRecordHeader))
        faults.push_back(
            {file, 1, 1, "this is not the record of a survey: leave out --resume to begin a new one."});
    for (std::size_t i = 1; i < rows.size() && faults.empty(); ++i) {
        auto read = record_row(rows[i]);
        if (read && rows[i].cells.back().text != station)
            faults.push_back({file, rows[i].line, 1,
                              "this is the record of station '" + std::string{rows[i].cells.back().text} +
                                  "', not of '" + std::string{station} +
                                  "': name another table with --output."});
        else if (read)
            survey.insert(*std::move(read));
        else
            faults.push_back(
                {file, rows[i].line, 1,
                 "this line was not written by a survey: leave out --resume to begin a new one."});
    }
    if (!faults.empty()) return Failure{faults};
    return survey;
}

} // namespace dpslave::profile
