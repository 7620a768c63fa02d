// SPDX-License-Identifier: Apache-2.0
#include "series.hpp"

#include "axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::dpctl {
namespace {

constexpr double kLargest = 1e12; ///< what came may be anything; no value of 16 bits is larger
constexpr std::size_t kMostGaps = 3;

Point point_of(const report::Sample& sample, std::int64_t not_before, std::int64_t not_after)
{
    return {std::max(not_before, std::min(sample.unix_ms, not_after)),
            mark_of(sample.state),
            std::clamp(sample.scaled, -kLargest, kLargest),
            sample.raw,
            sample.value,
            sample.state};
}

std::vector<Span> gaps_of(const Series& series, Span time)
{
    std::vector<Span> gaps;
    for_each_standing(series, time, [&gaps](const Point& point, Span span) {
        if (point.mark != Mark::none) return;
        if (!gaps.empty() && gaps.back().to_ms == span.from_ms)
            gaps.back().to_ms = span.to_ms;
        else
            gaps.push_back(span);
    });
    return gaps;
}

/// "22:14:00 to 22:14:51, 22:14:52 to 22:14:54"; empty: there are none.
std::string gaps_in_words(const std::vector<Span>& gaps)
{
    std::string said;
    for (std::size_t i = 0; i < gaps.size() && i < kMostGaps; ++i)
        said += fmt::format("{}{} to {}", i == 0 ? "" : ", ", clock(gaps[i].from_ms), clock(gaps[i].to_ms));
    if (gaps.size() > kMostGaps) said += fmt::format(" and {} more times", gaps.size() - kMostGaps);
    return said;
}

} // namespace

Mark mark_of(std::string_view state)
{
    if (state == "good") return Mark::good;
    if (state == "stale") return Mark::held;
    return state == "none" || state == "untried" || state == "lost" ? Mark::none : Mark::failed;
}

std::string Series::title() const
{
    std::string out = fmt::format("tag {}", tag);
    if (!name.empty()) out += ' ' + name;
    return direction ? out + ", " + *direction : out + ", not in the present layout";
}

bool Series::has_values() const
{
    return std::any_of(points.begin(), points.end(),
                       [](const Point& point) { return point.mark != Mark::none; });
}

Series series_of(const std::vector<report::GetSamplesReply>& replies)
{
    Series series{replies.front().tag, replies.front().name.value_or(""), replies.back().direction, {}};
    for (const report::GetSamplesReply& reply : replies) {
        if (&reply != &replies.front() && reply.lost > 0 && !series.points.empty())
            series.points.push_back({series.points.back().unix_ms, Mark::none, 0, 0, "", "lost"});
        for (const report::Sample& sample : reply.samples)
            series.points.push_back(point_of(sample, series.points.empty() ? 0 : series.points.back().unix_ms,
                                             replies.back().now_unix_ms));
    }
    return series;
}

void for_each_standing(const Series& series, Span time, const std::function<void(const Point&, Span)>& take)
{
    const auto clipped = [&](const Point& point, std::int64_t from, std::int64_t to) {
        const Span span{std::max(from, time.from_ms), std::min(to, time.to_ms)};
        if (span.from_ms < span.to_ms) take(point, span);
    };
    const std::vector<Point>& points = series.points;
    const Point nothing{};
    clipped(nothing, time.from_ms, points.empty() ? time.to_ms : points.front().unix_ms);
    for (std::size_t i = 0; i < points.size(); ++i)
        clipped(points[i], points[i].unix_ms, i + 1 < points.size() ? points[i + 1].unix_ms : time.to_ms);
}

Extent extent_of(const Series& series, Span time)
{
    std::optional<Extent> found;
    for_each_standing(series, time, [&found](const Point& point, Span) {
        if (point.mark == Mark::none) return;
        if (!found) found = Extent{point.scaled, point.scaled};
        found->lowest = std::min(found->lowest, point.scaled);
        found->highest = std::max(found->highest, point.scaled);
    });
    return found.value_or(Extent{});
}

bool has(const Plot& plot, Mark mark)
{
    bool found = false;
    for (const Series& series : plot.series)
        for_each_standing(series, plot.time,
                          [&](const Point& point, Span) { found = found || point.mark == mark; });
    return found;
}

std::vector<std::string> notes_of(const Plot& plot, const std::vector<report::GetSamplesReply>& first_replies)
{
    std::vector<std::string> notes;
    for (const report::GetSamplesReply& reply : first_replies)
        if (notes.empty() && reply.lost > 0 && reply.oldest_unix_ms.value_or(0) > plot.time.from_ms)
            notes.push_back(fmt::format(
                "Older samples did not fit: they reach back to {} (samples_kib in [trace] sets the size)",
                clock(*reply.oldest_unix_ms)));
    std::vector<std::pair<std::string, std::string>> gaps; // when, and the tags
    for (const Series& series : plot.series) {
        const std::string when = gaps_in_words(gaps_of(series, plot.time));
        if (when.empty()) continue;
        const auto same =
            std::find_if(gaps.begin(), gaps.end(), [&when](const auto& one) { return one.first == when; });
        if (same == gaps.end())
            gaps.emplace_back(when, fmt::format("{}", series.tag));
        else
            same->second += fmt::format(", {}", series.tag);
    }
    for (const auto& [when, tags] : gaps)
        notes.push_back(tags.find(',') == std::string::npos
                            ? fmt::format("Tag {} has no values {}", tags, when)
                            : fmt::format("Tags {} have no values {}", tags, when));
    return notes;
}

} // namespace dpslave::dpctl
