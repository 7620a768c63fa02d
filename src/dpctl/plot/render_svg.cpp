// SPDX-License-Identifier: Apache-2.0
#include "axis.hpp"
#include "render_plot.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr int kWidth = 960, kLeft = 90, kRight = 40, kInner = kWidth - kLeft - kRight;
constexpr int kHead = 44, kTitle = 22, kHeight = 150, kAxis = 26, kNote = 18;
constexpr std::size_t kTicks = 6, kTimeTicks = 9;

constexpr const char* kStyle =
    "text{font:12px sans-serif;fill:#222}\n"
    ".head{font-size:15px}.y{text-anchor:end}.x{text-anchor:middle}\n"
    ".grid{stroke:#ccc;stroke-width:1}.gap{fill:#ddd}\n"
    "path{fill:none;stroke-width:1.5}\n"
    ".good{stroke:#1f5fa8}.held{stroke:#b45f06;stroke-dasharray:7 3}.failed{stroke:#b00020;stroke-dasharray:2 3}\n";

const char* class_of(Mark mark)
{
    return mark == Mark::good ? "good" : mark == Mark::held ? "held" : "failed";
}

double x_of(std::int64_t at, Span time)
{
    return kLeft +
           static_cast<double>(at - time.from_ms) * kInner / static_cast<double>(time.to_ms - time.from_ms);
}

/// Steps: one path for each run of values that are marked alike. Where one follows on a value, it begins at
/// it.
class Steps {
public:
    Steps(Span time, const ValueAxis& axis, int top) : time_(time), axis_(axis), top_(top) {}

    void take(const Point& point, Span span)
    {
        if (point.mark == Mark::none) {
            end();
            before_ = -1;
            gaps_ +=
                fmt::format("<rect class=\"gap\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>\n",
                            x_of(span.from_ms, time_), top_,
                            x_of(span.to_ms, time_) - x_of(span.from_ms, time_), kHeight);
            return;
        }
        const double y = top_ + kHeight * (1 - axis_.share(point.scaled));
        const double x = x_of(span.from_ms, time_);
        if (point.mark != mark_) {
            end();
            mark_ = point.mark;
            path_ = fmt::format("M{:.1f} {:.1f}", x, before_ < 0 ? y : before_);
            if (before_ >= 0 && y != before_) path_ += fmt::format("V{:.1f}", y);
        } else if (y != before_) {
            path_ += fmt::format("H{:.1f}V{:.1f}", x, y);
        }
        before_ = y;
        until_ = x_of(span.to_ms, time_);
    }
    std::string done()
    {
        end();
        return gaps_ + paths_;
    }

private:
    void end()
    {
        if (mark_ == Mark::none) return;
        paths_ += fmt::format("<path class=\"{}\" d=\"{}H{:.1f}\"/>\n", class_of(mark_), path_, until_);
        mark_ = Mark::none;
    }

    Span time_;
    ValueAxis axis_;
    int top_;
    Mark mark_ = Mark::none; ///< of the path that is being made
    std::string path_, paths_, gaps_;
    double before_ = -1; ///< height of the value before; -1: there is none
    double until_ = 0;
};

std::string chart(const Series& series, Span time, int top)
{
    const Extent extent = extent_of(series, time);
    const ValueAxis axis = value_axis(extent.lowest, extent.highest, kTicks);
    std::string out =
        fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", kLeft, top - 8, xml_text(series.title()));
    for (const double tick : axis.ticks()) {
        const double y = top + kHeight * (1 - axis.share(tick));
        out += fmt::format("<path class=\"grid\" d=\"M{} {:.1f}H{}\"/>\n"
                           "<text class=\"y\" x=\"{}\" y=\"{:.1f}\">{}</text>\n",
                           kLeft, y, kLeft + kInner, kLeft - 8, y + 4, axis.label(tick));
    }
    Steps steps{time, axis, top};
    for_each_standing(series, time, [&steps](const Point& point, Span span) { steps.take(point, span); });
    return out + steps.done();
}

std::string legend(const Plot& plot, int& y)
{
    std::string out;
    const auto line = [&](const std::string& sample, const char* words) {
        y += kNote;
        out += sample + fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", kLeft + 40, y, words);
    };
    const auto stroke = [&](const char* name) {
        return fmt::format("<path class=\"{}\" d=\"M{} {}H{}\"/>\n", name, kLeft, y + kNote - 4, kLeft + 30);
    };
    if (has(plot, Mark::held)) line(stroke("held"), "held: the drive did not answer, the last value stands");
    if (has(plot, Mark::failed)) line(stroke("failed"), "failed: the drive or the tag table refuses it");
    if (has(plot, Mark::none))
        line(fmt::format("<rect class=\"gap\" x=\"{}\" y=\"{}\" width=\"30\" height=\"10\"/>\n", kLeft,
                         y + kNote - 9),
             "no values");
    return out;
}

} // namespace

std::string xml_text(std::string_view text)
{
    const std::string safe = printable(text);
    std::string out;
    for (std::string_view rest = safe; !rest.empty();) {
        const std::string_view one = rest.substr(0, std::max<std::size_t>(1, character_length(rest)));
        rest.remove_prefix(one.size());
        const std::uint32_t number = code_point(one);
        if (one == "&")
            out += "&amp;";
        else if (one == "<")
            out += "&lt;";
        else if (one == ">")
            out += "&gt;";
        else if (one == "\"")
            out += "&quot;";
        else if (one == "'")
            out += "&apos;";
        else if (number == 0xFFFE || number == 0xFFFF) // XML 1.0, 2.2: no characters
            out += fmt::format("\\u{:04X}", number);
        else
            out += one;
    }
    return out;
}

std::string render_svg(const Plot& plot)
{
    std::string body;
    int y = kHead;
    for (const Series& series : plot.series) {
        body += chart(series, plot.time, y + kTitle);
        y += kTitle + kHeight + kTitle / 2;
    }
    for (const std::int64_t tick : time_ticks(plot.time.from_ms, plot.time.to_ms, kTimeTicks))
        body += fmt::format("<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/>\n"
                            "<text class=\"x\" x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
                            x_of(tick, plot.time), kHead + kTitle, y, y + 14, clock(tick));
    y += kAxis;
    body += legend(plot, y);
    for (const std::string& note : plot.notes) {
        y += kNote;
        body += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", kLeft, y, xml_text(note));
    }
    const std::string head = xml_text(fmt::format(
        "{}, {} to {}", plot.station, date_and_clock(plot.time.from_ms), date_and_clock(plot.time.to_ms)));
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n<title>{2}</title>\n<style>\n{3}</style>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n"
        "<text class=\"head\" x=\"{4}\" y=\"24\">{2}</text>\n{5}</svg>\n",
        kWidth, y + kNote, head, kStyle, kLeft, body);
}

} // namespace dpslave::dpctl
