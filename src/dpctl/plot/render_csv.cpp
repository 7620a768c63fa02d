// SPDX-License-Identifier: Apache-2.0
#include "axis.hpp"
#include "render_plot.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

/// A field of RFC 4180, always on one line.
std::string field(std::string_view text)
{
    std::string safe = printable(text);
    if (safe.find_first_of(",\"") == std::string::npos) return safe;
    for (std::size_t at = 0; (at = safe.find('"', at)) != std::string::npos; at += 2) safe.insert(at, 1, '"');
    return '"' + safe + '"';
}

std::string row(const Series& series, const Point& point)
{
    const std::string values = point.mark == Mark::none
                                   ? std::string{",,"}
                                   : fmt::format("{},{},{}", field(point.value), point.scaled, point.raw);
    return fmt::format("{},{},{},{},{},{}\n", utc_time(point.unix_ms), series.tag, field(series.name),
                       field(series.direction.value_or("")), values, field(point.state));
}

} // namespace

std::string render_csv(const Plot& plot)
{
    struct Place {
        const Series* series;
        const Point* point;
    };
    std::vector<Place> all;
    for (const Series& series : plot.series)
        for (const Point& point : series.points) all.push_back({&series, &point});
    std::stable_sort(all.begin(), all.end(),
                     [](const Place& a, const Place& b) { return a.point->unix_ms < b.point->unix_ms; });
    std::string out = "time,tag,name,direction,value,scaled,raw,state\n";
    for (const Place& one : all) out += row(*one.series, *one.point);
    return out;
}

} // namespace dpslave::dpctl
