// SPDX-License-Identifier: Apache-2.0
/// Aligned text: tables with a header line, and blocks of "name  value".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

enum class Tone { plain, good, bad, strong };

/// `text` in its colour, where colours are wanted.
std::string painted(std::string_view text, Tone tone, bool colour);

struct Cell {
    Cell(std::string t, Tone with = Tone::plain) : text(std::move(t)), tone(with) {}
    Cell(const char* t) : text(t) {}
    std::string text;
    Tone tone = Tone::plain;
};

class Table {
public:
    /// A name that begins with '>' heads a column of numbers, set to the right.
    explicit Table(std::vector<std::string> header);
    void add(std::vector<Cell> row);
    bool empty() const { return rows_.empty(); }
    /// Each line indented by `indent` blanks and ended.
    std::string str(bool colour, std::size_t indent = 0) const;

private:
    std::vector<std::string> header_;
    std::vector<bool> right_;
    std::vector<std::vector<Cell>> rows_;
};

/// "  name      value" lines under each other; a value with line ends goes on below itself.
class Block {
public:
    void add(std::string name, std::string value);
    std::string str(std::size_t indent = 2) const;

private:
    struct Line {
        std::string name, value;
    };
    std::vector<Line> lines_;
};

} // namespace dpslave::dpctl
