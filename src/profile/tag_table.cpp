// SPDX-License-Identifier: Apache-2.0
// Tag tables: CSV rows become drive::TagTable, completely or not at all.
#include "csv.hpp"
#include "tag_row.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/input/text_source.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/profile/profile.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace dpslave::profile {
namespace {

using drive::Tag;

constexpr std::size_t kMostColumns = 200; ///< own columns of a user included

class TableReader {
public:
    explicit TableReader(std::string file) : file_(std::move(file)) {}

    Result<drive::TagTable, input::Faults> read(std::string_view content)
    {
        const std::vector<Row> rows = read_csv(content, file_, faults_);
        if (rows.empty()) {
            fault(0, 0, "the table is empty: its first line names the columns, tag at least.");
            return Failure{faults_};
        }
        if (rows.front().good && header(rows.front())) {
            for (std::size_t i = 1; i < rows.size() && faults_.size() <= input::kMaxFaults; ++i)
                if (rows[i].good) add(rows[i]);
            refuse_shared_mnemonics();
        }
        if (!faults_.empty()) {
            std::stable_sort(
                faults_.begin(), faults_.end(), [](const input::Fault& left, const input::Fault& right) {
                    return std::pair{left.line, left.column} < std::pair{right.line, right.column};
                });
            cap(faults_);
            return Failure{faults_};
        }
        return drive::TagTable{std::move(tags_)};
    }

private:
    /// The row that says what a tag is.
    struct First {
        std::size_t index = 0; ///< in tags_
        unsigned line = 0;
        bool is_name_only = false;
    };

    bool header(const Row& row)
    {
        columns_.width = row.cells.size();
        if (columns_.width > kMostColumns) {
            fault(row.line, 1,
                  "the first line names " + std::to_string(columns_.width) + " columns, more than the " +
                      std::to_string(kMostColumns) + " that a table may have: check its commas.");
            return false;
        }
        std::vector<std::string> names;
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const Cell& cell = row.cells[i];
            names.push_back(cell.text);
            const auto column = std::find(kColumnNames.begin(), kColumnNames.end(), cell.text);
            if (column == kColumnNames.end()) {
                if (const auto meant = nearly_a_column(cell.text); !meant.empty())
                    fault(cell.line, cell.column,
                          "column " + input::in_quotes(cell.text) + " is nearly " + input::in_quotes(meant) +
                              " and would not be read: write " + input::in_quotes(meant) +
                              ", or give the column a name that is not so near.");
                continue;
            }
            std::size_t& index = columns_.index[static_cast<std::size_t>(column - kColumnNames.begin())];
            if (index == Columns::kAbsent)
                index = i;
            else
                fault(cell.line, cell.column,
                      "a second column " + input::in_quotes(cell.text) + ": remove or rename one of them.");
        }
        if (columns_.index[kTag] != Columns::kAbsent) return true;
        std::string what = "no column tag: the first line must name the columns, tag at least";
        if (row.cells.size() == 1 && row.cells[0].text.find(';') != std::string::npos)
            what += "; separate them by commas, not by semicolons";
        else if (const auto meant = input::nearest("tag", names); !meant.empty())
            what += "; is " + input::in_quotes(meant) + " meant?";
        fault(row.line, 1, what + (what.back() == '?' ? "" : "."));
        return false;
    }

    void add(const Row& row)
    {
        if (row.cells.size() != columns_.width) {
            fault(row.line, 0,
                  "this line has " + std::to_string(row.cells.size()) + " cells, the first line has " +
                      std::to_string(columns_.width) +
                      ": check its commas, and put a cell that holds one in quotes.");
            return;
        }
        auto tag = read_tag(row, columns_, file_, faults_);
        if (!tag) return;
        tag->position = rows_++;
        const First here{tags_.size(), row.line, is_name_only(row, columns_)};
        const auto [known, is_new] = firsts_.try_emplace(tag->number, here);
        if (is_new) {
            tags_.push_back(*std::move(tag));
        } else if (known->second.is_name_only && !here.is_name_only) {
            known->second = {known->second.index, here.line, false};
            make_first(tags_[known->second.index], *std::move(tag));
        } else {
            join(known->second, *tag, row);
        }
    }

    /// The rows before this one were names only: this one is the tag, they are its further names.
    void make_first(Tag& known, Tag tag)
    {
        std::vector<std::string> names = std::move(known.aliases);
        names.insert(names.begin(), known.name);
        for (std::string& name : names) {
            if (name.empty() || name == tag.name) continue;
            aliases_.emplace(tag.number, name);
            tag.aliases.push_back(std::move(name));
        }
        known = std::move(tag);
    }

    /// A further row of a tag gives it a further name.
    void join(const First& known, const Tag& tag, const Row& row)
    {
        Tag& first = tags_[known.index];
        if (const auto column = contradiction(first, tag, row, columns_)) {
            const input::Place at = columns_.place(row, *column);
            fault(at.line, at.column,
                  "tag " + std::to_string(tag.number) + " has another " + std::string{kColumnNames[*column]} +
                      " on line " + std::to_string(known.line) +
                      ": make them equal, or leave the cell empty in a line that gives a further name.");
        } else if (!tag.name.empty() && tag.name != first.name &&
                   aliases_.emplace(tag.number, tag.name).second) {
            first.aliases.push_back(tag.name);
        }
    }

    /// Two tags that one mnemonic reaches are one parameter under two scales.
    void refuse_shared_mnemonics()
    {
        std::map<std::string, const Tag*> known;
        for (const Tag& tag : tags_) {
            if (tag.mnemonic.empty()) continue;
            const auto [first, is_new] = known.try_emplace(tag.mnemonic, &tag);
            if (is_new) continue;
            fault(
                firsts_.at(tag.number).line, 0,
                "mnemonic " + input::in_quotes(tag.mnemonic) + " of tag " + std::to_string(tag.number) +
                    " is that of tag " + std::to_string(first->second->number) + " on line " +
                    std::to_string(firsts_.at(first->second->number).line) +
                    ": one of the two is wrong, correct it or leave its cell empty for the profile's rule.");
        }
    }

    void fault(unsigned line, unsigned column, std::string what)
    {
        faults_.push_back({file_, line, column, std::move(what)});
    }

    std::string file_;
    input::Faults faults_;
    Columns columns_;
    std::vector<Tag> tags_;
    std::map<std::uint16_t, First> firsts_; ///< by tag
    std::set<std::pair<std::uint16_t, std::string>> aliases_;
    std::size_t rows_ = 0;
};

} // namespace

Result<drive::TagTable, input::Faults> load_tags(const input::TextSource& source, const std::string& file)
{
    auto content = input::read_text(source, file);
    if (!content) return Failure{input::Faults{content.error()}};
    return read_tags(*content, file);
}

Result<drive::TagTable, input::Faults> read_tags(std::string_view content, const std::string& file)
{
    if (content.starts_with(input::kByteOrderMark)) content.remove_prefix(input::kByteOrderMark.size());
    return TableReader{file}.read(utf8(content));
}

} // namespace dpslave::profile
