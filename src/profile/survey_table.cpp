// SPDX-License-Identifier: Apache-2.0
// Makes the rows of a tag table from what a survey saw.
#include "csv.hpp"
#include "survey_row.hpp"

#include "dpslave/input/text_source.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/profile/survey.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

constexpr std::string_view kNewTable =
    "tag,name,type,decimals,min,max,access,mnemonic,values,section,notes,confirmed,seen_min,seen_max";

/// A table as text, row by row: what is not changed stays as it was written.
class TableText {
public:
    TableText(std::string_view table, const std::string& file, input::Faults& faults)
        : rows_(read_csv(table, file, faults)),
          end_of_line_(table.find("\r\n") < table.find('\n') ? "\r\n" : "\n")
    {
        if (!faults.empty() || rows_.empty()) return;
        for (const Cell& cell : rows_.front().cells) columns_.push_back(cell.text);
        for (const Row& row : rows_) written_.emplace_back(row.written);
    }

    std::size_t rows() const { return rows_.size(); }
    unsigned line(std::size_t row) const { return rows_[row].line; }
    std::string_view cell(std::size_t row, std::string_view column) const
    {
        const auto found = std::find(columns_.begin(), columns_.end(), column);
        const auto index = static_cast<std::size_t>(found - columns_.begin());
        return index < rows_[row].cells.size() ? std::string_view{rows_[row].cells[index].text}
                                               : std::string_view{};
    }

    /// Adds the column at the end, if there is none.
    void need(std::string_view column)
    {
        if (std::find(columns_.begin(), columns_.end(), column) != columns_.end()) return;
        columns_.emplace_back(column);
        for (std::size_t i = 0; i < written_.size(); ++i)
            written_[i] += ',' + (i == 0 ? std::string{column} : std::string{});
        rows_.front().cells.push_back({std::string{column}, 0, 0});
    }

    void add(const Cells& cells) { written_.push_back(line_of(cells)); }
    void replace(std::size_t row, const Cells& changed)
    {
        Cells cells;
        for (std::size_t i = 0; i < rows_[row].cells.size(); ++i)
            cells[columns_[i]] = rows_[row].cells[i].text;
        for (const auto& [column, text] : changed) cells[column] = text;
        written_[row] = line_of(cells);
    }

    std::string text() const
    {
        std::string all;
        for (const std::string& row : written_) all += row + end_of_line_;
        return all;
    }

private:
    std::string line_of(const Cells& cells) const
    {
        std::string line;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const auto found = cells.find(columns_[i]);
            line += (i > 0 ? "," : "") + (found == cells.end() ? std::string{} : csv_cell(found->second));
        }
        return line;
    }

    std::vector<Row> rows_;
    std::vector<std::string> columns_;
    std::vector<std::string> written_; ///< by row, without its end
    std::string end_of_line_;
};

/// The row of each tag: the first one that says more than a name.
std::map<std::uint16_t, std::size_t> rows_by_tag(const TableText& table)
{
    std::map<std::uint16_t, std::size_t> rows;
    for (std::size_t i = 1; i < table.rows(); ++i) {
        const auto tag = static_cast<std::uint16_t>(std::stoul(std::string{table.cell(i, "tag")}));
        const auto [known, is_new] = rows.try_emplace(tag, i);
        if (!is_new && table.cell(known->second, "type").empty() && !table.cell(i, "type").empty())
            known->second = i;
    }
    return rows;
}

bool waits(const TableText& table, std::size_t row)
{
    return table.cell(row, "confirmed") == "no";
}

class Merger {
public:
    Merger(TableText table, const drive::TagTable& tags, MnemonicCells cells)
        : table_(std::move(table)), tags_(tags), mnemonic_cells_(cells)
    {}

    SurveyedTable merge(const Survey& seen)
    {
        const auto rows = rows_by_tag(table_);
        for (const auto& [tag, row] : rows)
            if (const std::string mnemonic{table_.cell(row, "mnemonic")}; !mnemonic.empty())
                mnemonics_.emplace(mnemonic, tag);
        for (std::size_t i = 1; i < table_.rows(); ++i)
            if (waits(table_, i))
                waiting_.push_back(
                    static_cast<std::uint16_t>(std::stoul(std::string{table_.cell(i, "tag")})));
        for (const auto& [tag, one] : seen) {
            const auto found = rows.find(tag);
            if (found == rows.end())
                add(tag, one);
            else if (waits(table_, found->second))
                widen(found->second, tag, one);
            else
                compare(found->second, tag, one);
        }
        std::sort(waiting_.begin(), waiting_.end());
        waiting_.erase(std::unique(waiting_.begin(), waiting_.end()), waiting_.end());
        return {table_.text(), std::move(added_), std::move(waiting_), std::move(contradictions_)};
    }

private:
    void need_columns()
    {
        for (const std::string_view column :
             {"type", "decimals", "min", "max", "mnemonic", "notes", "confirmed", "seen_min", "seen_max"})
            table_.need(column);
    }

    void add(std::uint16_t tag, const Sighting& one)
    {
        if (one.answers == 0) return;
        auto why = no_row_for(one);
        const auto same = mnemonics_.find(one.mnemonic);
        if (!why && same != mnemonics_.end())
            why = "its mnemonic is that of tag " + std::to_string(same->second) +
                  ": they are one parameter, and one row is enough";
        if (why) {
            contradictions_.push_back("tag " + std::to_string(tag) + ": " + *why);
            return;
        }
        if (!one.mnemonic.empty()) mnemonics_.emplace(one.mnemonic, tag);
        need_columns();
        Cells cells = new_row(one);
        cells["tag"] = std::to_string(tag);
        table_.add(cells);
        added_.push_back(tag);
        waiting_.push_back(tag);
    }

    void widen(std::size_t row, std::uint16_t tag, const Sighting& one)
    {
        if (const auto why = no_row_for(one)) {
            contradictions_.push_back(place(row, tag) + *why);
            return;
        }
        if (one.answers == 0) return;
        need_columns();
        Cells cells;
        for (const std::string_view column : kSurveyColumns)
            cells[std::string{column}] = table_.cell(row, column);
        const Cells before = cells;
        widen_row(cells, one);
        const std::string mnemonic = cells["mnemonic"];
        if (mnemonic != before.at("mnemonic") && !mnemonics_.try_emplace(mnemonic, tag).second)
            cells["mnemonic"].clear(); // another row has it; the rule of the family gives it all the same
        if (cells != before) table_.replace(row, cells);
    }

    void compare(std::size_t row, std::uint16_t tag, const Sighting& one)
    {
        const bool has_decimals = !table_.cell(row, "decimals").empty();
        const auto objections = against(*tags_.find(tag), has_decimals, one);
        for (const std::string& what : objections) contradictions_.push_back(place(row, tag) + what);
        if (objections.empty() && one.answers > 0) fill_mnemonic(row, tag, one);
    }

    void fill_mnemonic(std::size_t row, std::uint16_t tag, const Sighting& one)
    {
        const bool is_wanted = mnemonic_cells_ == MnemonicCells::fill && !one.mnemonic.empty() &&
                               table_.cell(row, "mnemonic").empty();
        if (!is_wanted) return;
        const auto [known, is_new] = mnemonics_.try_emplace(one.mnemonic, tag);
        if (!is_new) {
            contradictions_.push_back(place(row, tag) + "its mnemonic by the rule is that of tag " +
                                      std::to_string(known->second));
            return;
        }
        table_.need("mnemonic");
        table_.replace(row, {{"mnemonic", one.mnemonic}});
    }

    std::string place(std::size_t row, std::uint16_t tag) const
    {
        const std::string name{table_.cell(row, "name")};
        return "tag " + std::to_string(tag) + (name.empty() ? "" : " (" + name + ")") + ", line " +
               std::to_string(table_.line(row)) + ": ";
    }

    TableText table_;
    const drive::TagTable& tags_;
    MnemonicCells mnemonic_cells_;
    std::map<std::string, std::uint16_t> mnemonics_; ///< that rows have, with their tags
    std::vector<std::uint16_t> added_, waiting_;
    std::vector<std::string> contradictions_;
};

} // namespace

Result<SurveyedTable, input::Faults> merge_survey(std::string_view table, const std::string& file,
                                                  const Survey& seen, MnemonicCells mnemonics)
{
    const bool is_marked = table.starts_with(input::kByteOrderMark);
    if (table.size() == (is_marked ? input::kByteOrderMark.size() : 0)) table = kNewTable;
    const auto tags = read_tags(table, file);
    if (!tags) return Failure{tags.error()};
    if (table.starts_with(input::kByteOrderMark)) table.remove_prefix(input::kByteOrderMark.size());
    input::Faults faults;
    TableText text{table, file, faults};
    if (!faults.empty()) return Failure{faults};
    SurveyedTable merged = Merger{std::move(text), *tags, mnemonics}.merge(seen);
    if (is_marked) merged.text.insert(0, input::kByteOrderMark); // the spreadsheet program needs it
    return merged;
}

} // namespace dpslave::profile
