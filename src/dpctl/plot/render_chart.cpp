// SPDX-License-Identifier: Apache-2.0
#include "axis.hpp"
#include "dpctl/cli/columns.hpp"
#include "dpctl/cli/table.hpp"
#include "render_plot.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kScreen = 23; ///< lines of a small terminal, without that of the prompt
constexpr std::size_t kLowest = 3;  ///< lines of a chart
constexpr std::size_t kLabel = 10;

/// A field of characters, each of which has several dots where the terminal can show them.
class Canvas {
public:
    Canvas(std::size_t columns, std::size_t rows, bool braille)
        : columns_(columns),
          across_(braille ? 2 : 1),
          down_(braille ? 4 : 1),
          rows_(rows),
          dots_(columns * rows),
          marks_(columns * rows)
    {}
    std::size_t width() const { return columns_ * across_; }
    std::size_t height() const { return rows_ * down_; }

    /// The dots of one column between two heights; 0 is the lowest.
    void line(std::size_t x, std::size_t from, std::size_t to, Mark mark)
    {
        static constexpr std::uint8_t kDots[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
        for (std::size_t y = std::min(from, to); y <= std::max(from, to); ++y) {
            const std::size_t down = height() - 1 - y;
            const std::size_t cell = down / down_ * columns_ + x / across_;
            dots_[cell] = static_cast<std::uint8_t>(dots_[cell] | kDots[down % down_][x % across_]);
            marks_[cell] = std::max(marks_[cell], mark);
        }
    }
    std::string row(std::size_t at) const
    {
        std::string out;
        for (std::size_t cell = at * columns_; cell < (at + 1) * columns_; ++cell) out += character(cell);
        out.erase(out.find_last_not_of(' ') + 1);
        return out;
    }

private:
    std::string character(std::size_t cell) const
    {
        switch (marks_[cell]) {
            case Mark::none: return " ";
            case Mark::held: return "o";
            case Mark::failed: return "x";
            case Mark::good: break;
        }
        if (down_ == 1) return "*";
        const unsigned dots = dots_[cell]; // U+2800 and the dots, in UTF-8
        return {'\xE2', static_cast<char>(0xA0 | dots >> 6), static_cast<char>(0x80 | (dots & 0x3F))};
    }

    std::size_t columns_, across_, down_, rows_;
    std::vector<std::uint8_t> dots_;
    std::vector<Mark> marks_;
};

void draw(Canvas& canvas, const Series& series, Span time, const ValueAxis& axis)
{
    const auto column = [&](std::int64_t at) {
        const auto x = static_cast<double>(at - time.from_ms) * static_cast<double>(canvas.width()) /
                       static_cast<double>(time.to_ms - time.from_ms);
        return std::min(static_cast<std::size_t>(x), canvas.width() - 1);
    };
    std::optional<std::size_t> before;
    for_each_standing(series, time, [&](const Point& point, Span span) {
        if (point.mark == Mark::none) {
            before.reset();
            return;
        }
        const auto y = static_cast<std::size_t>(
            std::lround(axis.share(point.scaled) * static_cast<double>(canvas.height() - 1)));
        const std::size_t first = column(span.from_ms), last = column(span.to_ms - 1);
        canvas.line(first, before.value_or(y), y, point.mark);
        for (std::size_t x = first; x <= last; ++x) canvas.line(x, y, y, point.mark);
        before = y;
    });
}

std::string now_text(const Series& series)
{
    if (series.points.empty() || series.points.back().mark == Mark::none) return ": no value now";
    const Point& newest = series.points.back();
    const char* const marked = newest.mark == Mark::held     ? " (held)"
                               : newest.mark == Mark::failed ? " (failed)"
                                                             : "";
    return ": " + newest.value + marked;
}

std::string chart(const Series& series, const Plot& plot, std::size_t width, std::size_t rows, bool braille)
{
    const Extent extent = extent_of(series, plot.time);
    const ValueAxis axis = value_axis(extent.lowest, extent.highest, std::max<std::size_t>(2, rows / 3));
    Canvas canvas{width - kLabel - 2, rows, braille};
    draw(canvas, series, plot.time, axis);
    std::vector<std::string> labels(rows);
    for (const double tick : axis.ticks())
        labels[static_cast<std::size_t>(
            std::lround((1 - axis.share(tick)) * static_cast<double>(rows - 1)))] = axis.label(tick);
    std::string out = cut(printable(series.title() + now_text(series)), width) + '\n';
    for (std::size_t i = 0; i < rows; ++i) {
        std::string line = fmt::format("{:>{}} |", labels[i], kLabel) + canvas.row(i);
        out += line + '\n';
    }
    return out;
}

/// The line of the axis and the times below it.
std::string time_axis(Span time, std::size_t width)
{
    const std::size_t columns = width - kLabel - 2;
    std::string axis(columns, '-'), words(width, ' ');
    std::size_t free = 0;
    for (const std::int64_t tick : time_ticks(time.from_ms, time.to_ms, columns / 14)) {
        const auto at = std::min(
            columns - 1, static_cast<std::size_t>((tick - time.from_ms) * static_cast<std::int64_t>(columns) /
                                                  (time.to_ms - time.from_ms)));
        axis[at] = '+';
        const std::string word = clock(tick);
        const std::size_t middle = kLabel + 2 + at;
        const std::size_t begin = std::min(middle - word.size() / 2, width - word.size());
        if (begin < free) continue;
        words.replace(begin, word.size(), word);
        free = begin + word.size() + 1;
    }
    words.erase(words.find_last_not_of(' ') + 1);
    return std::string(kLabel + 1, ' ') + '+' + axis + '\n' + words + '\n';
}

std::string legend(const Plot& plot)
{
    std::string out;
    if (has(plot, Mark::held)) out = "o held: the drive did not answer";
    if (has(plot, Mark::failed)) out += out.empty() ? "x failed: refused" : "  x failed: refused";
    return out.empty() ? out : out + '\n';
}

std::string notes(const Plot& plot, std::size_t width)
{
    std::string out;
    for (const std::string& note : plot.notes) out += paragraph("", note, width);
    return out;
}

} // namespace

std::string render_chart(const Plot& plot, std::size_t width, bool braille)
{
    const std::string tail = time_axis(plot.time, width) + legend(plot) + notes(plot, width);
    const auto others = 1 + static_cast<std::size_t>(std::count(tail.begin(), tail.end(), '\n'));
    const std::size_t room = kScreen - std::min(others, kScreen);
    const std::size_t of_one = room / std::max<std::size_t>(1, plot.series.size());
    std::string out = cut(printable(fmt::format("{}, {} to {}", plot.station,
                                                date_and_clock(plot.time.from_ms), clock(plot.time.to_ms))),
                          width) +
                      '\n';
    for (const Series& series : plot.series) // the title is a line, too
        out +=
            chart(series, plot, width, std::max(kLowest, of_one - std::min<std::size_t>(1, of_one)), braille);
    return out + tail;
}

} // namespace dpslave::dpctl
