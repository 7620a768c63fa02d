// SPDX-License-Identifier: Apache-2.0
#include "table.hpp"

#include <algorithm>

namespace dpslave::dpctl {
namespace {

/// Characters, not octets, of UTF-8.
std::size_t width(std::string_view text)
{
    const auto starts = std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    return static_cast<std::size_t>(starts);
}

std::string blanks(std::size_t wanted, std::string_view text)
{
    return std::string(wanted - std::min(wanted, width(text)), ' ');
}

void end_line(std::string& out)
{
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out += '\n';
}

} // namespace

std::string painted(std::string_view text, Tone tone, bool colour)
{
    if (!colour || tone == Tone::plain || text.empty()) return std::string{text};
    const char* on = tone == Tone::good ? "\033[32m" : tone == Tone::bad ? "\033[31m" : "\033[1m";
    return std::string{on}.append(text).append("\033[0m");
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

std::string Table::str(bool colour, std::size_t indent) const
{
    std::vector<std::vector<Cell>> lines{{header_.begin(), header_.end()}};
    for (Cell& cell : lines.front()) cell.tone = Tone::strong;
    lines.insert(lines.end(), rows_.begin(), rows_.end());
    std::vector<std::size_t> widths(header_.size(), 0);
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], width(line[i].text));

    std::string out;
    for (const auto& line : lines) {
        out.append(indent, ' ');
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::string fill = blanks(widths[i], line[i].text);
            const std::string shown = painted(line[i].text, line[i].tone, colour);
            out += (i == 0 ? "" : "  ") + (right_[i] ? fill + shown : shown + fill);
        }
        end_line(out);
    }
    return out;
}

void Block::add(std::string name, std::string value)
{
    lines_.push_back({std::move(name), std::move(value)});
}

std::string Block::str(std::size_t indent) const
{
    std::size_t names = 0;
    for (const Line& line : lines_) names = std::max(names, width(line.name));
    std::string out;
    for (const Line& line : lines_) {
        out += std::string(indent, ' ') + line.name + blanks(names, line.name) + "  ";
        for (const char c : line.value) {
            if (c == '\n') {
                end_line(out);
                out.append(indent + names + 2, ' ');
            } else {
                out += c;
            }
        }
        end_line(out);
    }
    return out;
}

} // namespace dpslave::dpctl
