// SPDX-License-Identifier: Apache-2.0
#include "table.hpp"

#include "columns.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kNarrowest = 10; ///< no column of words becomes narrower
constexpr std::size_t kBetween = 2;
constexpr std::size_t kWidestCharacter = 2;

std::string blanks(std::size_t wanted, std::string_view text)
{
    return std::string(wanted - std::min(wanted, columns_of(text)), ' ');
}

void end_line(std::string& out)
{
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out += '\n';
}

/// One line without line ends, broken. Precondition: any character fits.
void wrap_line(std::string_view line, std::size_t columns, std::vector<std::string>& into)
{
    while (columns_of(line) > columns) {
        const std::size_t fits = octets_within(line, columns);
        const std::size_t blank = line[fits] == ' ' ? fits : line.rfind(' ', fits);
        const bool at_blank = blank != std::string_view::npos && blank > line.find_first_not_of(' ');
        const std::size_t end = at_blank ? blank : fits;
        into.emplace_back(line.substr(0, end));
        line.remove_prefix(end);
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    }
    into.emplace_back(line);
}

} // namespace

std::string painted(std::string_view text, Tone tone, Look look)
{
    if (!look.colour || tone == Tone::plain || text.empty()) return std::string{text};
    const char* on = tone == Tone::good ? "\033[32m" : tone == Tone::bad ? "\033[31m" : "\033[1m";
    return std::string{on}.append(text).append("\033[0m");
}

std::vector<std::string> wrapped(std::string_view text, std::size_t columns)
{
    std::vector<std::string> lines;
    const std::size_t room = std::max(columns, kWidestCharacter);
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        wrap_line(text.substr(at, end - at), room, lines);
        at = end + 1;
    }
    return lines;
}

std::string paragraph(std::string_view first, std::string_view text, std::size_t columns)
{
    const std::size_t indent = columns_of(first);
    std::string out{first};
    bool is_first = true;
    for (const std::string& line : wrapped(text, std::max(columns, indent + kNarrowest) - indent)) {
        if (!std::exchange(is_first, false)) out.append(indent, ' ');
        out += line;
        end_line(out);
    }
    return out;
}

std::string headline(const std::string& name, const std::string& rest, Look look)
{
    std::string out;
    for (const std::string& line : wrapped(name + rest, look.width)) {
        const bool is_first = out.empty() && line.starts_with(name);
        out += is_first ? painted(name, Tone::strong, look) + line.substr(name.size()) : line;
        end_line(out);
    }
    return out;
}

std::string title(std::string_view text, Tone tone, Look look)
{
    constexpr std::size_t kIndent = 3;
    std::string out;
    for (const std::string& line : wrapped(text, std::max(look.width, kNarrowest) - kIndent))
        out += std::string(out.empty() ? 0 : kIndent, ' ') + painted(line, tone, look) + '\n';
    return out;
}

Table::Table(std::vector<std::string> header) : header_(std::move(header))
{
    for (std::string& name : header_) {
        right_.push_back(!name.empty() && name.front() == '>');
        if (right_.back()) name.erase(0, 1);
    }
}

void Table::add(std::vector<Cell> row)
{
    row.resize(header_.size(), Cell{""});
    rows_.push_back(std::move(row));
}

/// What each column gets of `room`: the widest one of words gives way first.
std::vector<std::size_t> Table::widths(std::size_t room) const
{
    std::vector<std::size_t> result;
    for (const std::string& name : header_) result.push_back(columns_of(name));
    for (const auto& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i) result[i] = std::max(result[i], columns_of(row[i].text));
    const std::size_t between = result.empty() ? 0 : kBetween * (result.size() - 1);
    for (;;) {
        if (std::accumulate(result.begin(), result.end(), between) <= room) return result;
        std::size_t widest = result.size();
        for (std::size_t i = 0; i < result.size(); ++i)
            if (!right_[i] && result[i] > kNarrowest &&
                (widest == result.size() || result[i] > result[widest]))
                widest = i;
        if (widest == result.size()) return result;
        --result[widest];
    }
}

std::string Table::str(Look look, std::size_t indent) const
{
    std::vector<std::vector<Cell>> rows{{header_.begin(), header_.end()}};
    for (Cell& cell : rows.front()) cell.tone = Tone::strong;
    rows.insert(rows.end(), rows_.begin(), rows_.end());
    const std::vector<std::size_t> columns = widths(std::max(look.width, indent) - indent);

    std::string out;
    for (const auto& row : rows) {
        std::vector<std::vector<std::string>> cells;
        std::size_t lines = 1;
        for (std::size_t i = 0; i < row.size(); ++i) {
            cells.push_back(wrapped(row[i].text, columns[i]));
            lines = std::max(lines, cells.back().size());
        }
        for (std::size_t line = 0; line < lines; ++line) {
            out.append(indent, ' ');
            for (std::size_t i = 0; i < row.size(); ++i) {
                const std::string text = line < cells[i].size() ? cells[i][line] : std::string{};
                const std::string fill = blanks(columns[i], text);
                const std::string shown = painted(text, row[i].tone, look);
                out += std::string(i == 0 ? 0 : kBetween, ' ') + (right_[i] ? fill + shown : shown + fill);
            }
            end_line(out);
        }
    }
    return out;
}

void Block::add(std::string name, std::string value, Tone tone)
{
    lines_.push_back({std::move(name), std::move(value), tone});
}

std::string Block::str(std::size_t indent, Look look) const
{
    std::size_t names = 0;
    for (const Line& line : lines_) names = std::max(names, columns_of(line.name));
    std::string out;
    for (const Line& line : lines_) {
        if (line.name.empty()) {
            out += '\n';
            continue;
        }
        const std::string head = std::string(indent, ' ') + line.name + blanks(names, line.name) + "  ";
        std::string text = paragraph(head, line.value, look.width);
        if (line.tone != Tone::plain) { // painted after it was measured
            const std::size_t end = std::min(text.find_first_of(",: \n", head.size()), text.size());
            text = head + painted(text.substr(head.size(), end - head.size()), line.tone, look) +
                   text.substr(end);
        }
        out += text;
    }
    return out;
}

} // namespace dpslave::dpctl
