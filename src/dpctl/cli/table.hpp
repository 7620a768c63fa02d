// SPDX-License-Identifier: Apache-2.0
/// Aligned text: tables with a header line, and blocks of "name  value", no wider than the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// How text is to look.
struct Look {
    Look(bool with_colour = false, std::size_t columns = 80) : colour(with_colour), width(columns) {}
    bool colour;
    std::size_t width; ///< of the terminal, in columns
};

enum class Tone { plain, good, bad, strong };

/// `text` in its colour, where colours are wanted.
std::string painted(std::string_view text, Tone tone, Look look);

/// Lines of at most `width` columns (2 at least), broken at blanks; a word that is longer is broken within.
/// Line ends stay. At least one line.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

/// `text` behind `first`, its other lines under its beginning; each line ended.
std::string paragraph(std::string_view first, std::string_view text, std::size_t width);

/// `name` in bold and `rest` behind it: the head of a block. Each line ended.
std::string headline(const std::string& name, const std::string& rest, Look look);

/// The head of a finding: further lines are indented by three. Each line ended.
std::string title(std::string_view text, Tone tone, Look look);

struct Cell {
    Cell(std::string t, Tone with = Tone::plain) : text(std::move(t)), tone(with) {}
    Cell(const char* t) : text(t) {}
    std::string text;
    Tone tone = Tone::plain;
};

class Table {
public:
    /// A name that begins with '>' heads a column of numbers, set to the right and never broken.
    explicit Table(std::vector<std::string> header);
    void add(std::vector<Cell> row);
    bool empty() const { return rows_.empty(); }
    /// Each line indented by `indent` blanks and ended. The widest columns of words are broken until the
    /// table fits, as far as they can be.
    std::string str(Look look, std::size_t indent = 0) const;

private:
    std::vector<std::size_t> widths(std::size_t room) const;

    std::vector<std::string> header_;
    std::vector<bool> right_;
    std::vector<std::vector<Cell>> rows_;
};

/// "  name      value" lines under each other; a value that is too long, or has line ends, goes on below
/// itself.
class Block {
public:
    void add(std::string name, std::string value, Tone tone = Tone::plain);
    void add_blank_line() { lines_.push_back({}); }
    std::string str(std::size_t indent = 2, Look look = {}) const;

private:
    struct Line {
        std::string name, value;
        Tone tone = Tone::plain; ///< of the value's first word
    };
    std::vector<Line> lines_;
};

} // namespace dpslave::dpctl
