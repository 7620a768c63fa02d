// SPDX-License-Identifier: Apache-2.0
#include "figures.hpp"

#include "dpslave/base/histogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dpslave::dpctl {
namespace {

const report::Distribution* in_bit_times(const report::GetCountersReply& reply)
{
    for (const report::Distribution& one : reply.turnaround)
        if (one.unit == "T_bit") return &one;
    return reply.turnaround.empty() ? nullptr : &reply.turnaround.front();
}

/// What came may be anything: with these bounds no sum and no difference of counts is too large.
report::Distribution within_bounds(report::Distribution all)
{
    if (all.classes.size() > Histogram::kClasses) all.classes.resize(Histogram::kClasses);
    for (report::DistributionClass& one : all.classes)
        one.count = std::clamp<std::int64_t>(one.count, 0, std::int64_t{1} << 53);
    return all;
}

/// The upper end of the class in which `share` of all lie; none: in the last one, which has no end.
std::optional<std::int64_t> quantile_of(const report::Distribution& all, double share)
{
    const double wanted = share * static_cast<double>(all.count);
    std::int64_t seen = 0;
    for (const report::DistributionClass& one : all.classes) {
        seen += one.count;
        if (static_cast<double>(seen) >= wanted) return one.to;
    }
    return std::nullopt;
}

void set_figures(report::Distribution& all)
{
    all.count = 0;
    for (const report::DistributionClass& one : all.classes) all.count += one.count;
    all.p50 = quantile_of(all, 0.5);
    all.p99 = quantile_of(all, 0.99);
    all.highest = all.classes.empty() ? std::nullopt : all.classes.back().to;
}

/// What `now` has more than `before`; a class that has less began anew and counts in full.
report::Distribution grown(const report::Distribution& before, const report::Distribution& now)
{
    report::Distribution out;
    out.unit = now.unit;
    for (report::DistributionClass one : now.classes) {
        const auto old = std::find_if(before.classes.begin(), before.classes.end(),
                                      [&](const auto& b) { return b.from == one.from; });
        if (old != before.classes.end() && old->count <= one.count) one.count -= old->count;
        if (one.count > 0) out.classes.push_back(one);
    }
    set_figures(out);
    return out;
}

/// The class of Histogram in which `value` lies: its classes are finer where the values are small.
std::size_t place_of(std::int64_t value)
{
    std::size_t at = 0;
    while (at + 1 < Histogram::kClasses && Histogram::lower_end(at + 1) <= value) ++at;
    return at;
}

} // namespace

const report::CounterGroup* bus_group(const report::GetCountersReply& reply)
{
    return reply.groups.empty() ? nullptr : &reply.groups.front();
}

/// The first group is the bus, the last the control socket.
const report::CounterGroup* station_group(const report::GetCountersReply& reply, std::string_view station)
{
    for (std::size_t i = 1; i + 1 < reply.groups.size(); ++i)
        if (reply.groups[i].name == station) return &reply.groups[i];
    return nullptr;
}

std::vector<Rate> rates(const report::CounterGroup* before, const report::CounterGroup* now,
                        std::chrono::nanoseconds passed)
{
    std::vector<Rate> all;
    if (before == nullptr || now == nullptr || passed <= std::chrono::nanoseconds::zero()) return all;
    std::map<std::string_view, std::int64_t> old;
    for (const report::Counter& one : before->counters) old[one.name] = one.value;
    const double seconds = std::chrono::duration<double>(passed).count();
    for (const report::Counter& one : now->counters) {
        const auto found = old.find(one.name);
        if (found == old.end() || one.value < found->second || one.name.ends_with("_ms")) continue;
        // Of numbers of the daemon, which may be any: the difference may be more than fits.
        all.push_back(
            {one.name, (static_cast<double>(one.value) - static_cast<double>(found->second)) / seconds});
    }
    return all;
}

std::optional<double> rate_of(const std::vector<Rate>& all, std::string_view name)
{
    for (const Rate& one : all)
        if (one.name == name) return one.per_second;
    return std::nullopt;
}

void RecentTurnaround::add(std::chrono::nanoseconds at, const report::GetCountersReply& counters)
{
    const report::Distribution* const counted = in_bit_times(counters);
    if (counted == nullptr) return;
    seen_.push_back({at, within_bounds(*counted)});
    while (seen_.size() > 2 && seen_[1].at + kSpan <= at) seen_.pop_front();
}

bool RecentTurnaround::is_recent() const
{
    return seen_.size() > 1 && !grown(seen_.front().counted, seen_.back().counted).classes.empty();
}

std::optional<report::Distribution> RecentTurnaround::now() const
{
    if (seen_.empty()) return std::nullopt;
    report::Distribution out = seen_.back().counted;
    if (is_recent())
        out = grown(seen_.front().counted, out);
    else
        set_figures(out);
    return out.count > 0 ? std::optional{std::move(out)} : std::nullopt;
}

std::string sparkline(const report::Distribution& distribution, std::size_t columns, bool blocks)
{
    static constexpr std::array<std::string_view, 9> kBlocks{" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    static constexpr std::array<std::string_view, 9> kAscii{" ", ".", ":", "-", "=", "+", "*", "%", "#"};
    if (distribution.classes.empty() || columns == 0) return {};
    const std::size_t first = place_of(distribution.classes.front().from);
    const std::size_t last = std::max(first, place_of(distribution.classes.back().from));
    const std::size_t together = (last - first) / columns + 1;
    std::vector<double> counts((last - first) / together + 1);
    for (const report::DistributionClass& one : distribution.classes) {
        const std::size_t place = std::clamp(place_of(one.from), first, last) - first;
        counts[place / together] += static_cast<double>(one.count);
    }
    const double most = std::max(1.0, *std::max_element(counts.begin(), counts.end()));
    std::string out;
    for (const double count : counts) {
        const auto height = static_cast<std::size_t>(std::clamp(std::ceil(count / most * 8), 0.0, 8.0));
        out += (blocks ? kBlocks : kAscii)[height];
    }
    return out;
}

} // namespace dpslave::dpctl
