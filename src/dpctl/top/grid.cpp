// SPDX-License-Identifier: Apache-2.0
#include "grid.hpp"

#include "dpctl/cli/columns.hpp"

#include <algorithm>
#include <numeric>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kGridGap = 2;
constexpr std::size_t kNarrowestWords = 6;

} // namespace

Grid::Grid(std::vector<std::string> header)
{
    for (std::string& name : header) {
        right_.push_back(name.starts_with('>'));
        header_.emplace_back(right_.back() ? name.substr(1) : name, Tone::strong);
    }
}

void Grid::add(std::vector<Cell> row)
{
    row.resize(header_.size(), Cell{""});
    rows_.push_back(std::move(row));
}

/// Of the columns that stay. The widest one of words gives way first, then the last column.
std::vector<std::size_t> Grid::widths(std::size_t columns) const
{
    std::vector<std::size_t> wanted;
    for (const Cell& cell : header_) wanted.push_back(columns_of(cell.text));
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i) wanted[i] = std::max(wanted[i], columns_of(row[i].text));

    std::vector<std::size_t> given = wanted;
    while (given.size() > 1) {
        const std::size_t all = std::accumulate(given.begin(), given.end(), kGridGap * (given.size() - 1));
        if (all <= columns) return given;
        std::size_t widest = given.size();
        for (std::size_t i = 0; i < given.size(); ++i)
            if (!right_[i] && given[i] > kNarrowestWords &&
                (widest == given.size() || given[i] > given[widest]))
                widest = i;
        if (widest < given.size()) {
            given[widest] = std::max(kNarrowestWords, given[widest] - std::min(given[widest], all - columns));
        } else {
            given.pop_back();
            std::copy_n(wanted.begin(), given.size(), given.begin()); // there is more room again
        }
    }
    for (std::size_t& one : given) one = std::min(one, columns);
    return given;
}

std::string Grid::line(const std::vector<Cell>& row, const std::vector<std::size_t>& widths, Look look) const
{
    std::string out;
    std::size_t blanks = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const std::string text = fitted(row[i].text, widths[i], right_[i]);
        const std::size_t behind = text.find_last_not_of(' ') + 1; // 0: nothing but blanks
        if (behind > 0) out += std::string(blanks, ' ') + painted(text.substr(0, behind), row[i].tone, look);
        blanks = (behind > 0 ? 0 : blanks) + text.size() - behind + kGridGap;
    }
    return out;
}

std::vector<std::string> Grid::lines(Look look, std::size_t columns, std::size_t first,
                                     std::size_t count) const
{
    const std::vector<std::size_t> given = widths(columns);
    std::vector<std::string> out{line(header_, given, look)};
    for (std::size_t i = first; i < rows_.size() && i - first < count; ++i)
        out.push_back(line(rows_[i], given, look));
    return out;
}

} // namespace dpslave::dpctl
