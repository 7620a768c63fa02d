// SPDX-License-Identifier: Apache-2.0
// What was counted: by group, and how the turnaround of the replies lies.
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dpslave::dpctl {
namespace {

std::string percent(std::int64_t part, std::int64_t whole)
{
    const double share =
        100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::int64_t>(whole, 1));
    return share < 0.05 ? "< 0.1 %" : fmt::format("{:.1f} %", share);
}

std::string bar(std::int64_t count, std::int64_t most)
{
    constexpr std::int64_t kWidth = 32;
    if (count <= 0) return {};
    const double share = static_cast<double>(count) / static_cast<double>(std::max(count, most));
    return std::string(std::max<std::size_t>(static_cast<std::size_t>(std::lround(share * kWidth)), 1), '#');
}

/// "12", "64 to 79", "14336 and more".
std::string bounds(const report::DistributionClass& one)
{
    if (!one.to) return fmt::format("{} and more", one.from);
    return one.from == *one.to ? std::to_string(one.from) : fmt::format("{} to {}", one.from, *one.to);
}

/// The figures of all units side by side.
Table figures(const std::vector<report::Distribution>& distributions)
{
    std::vector<std::string> header{""};
    for (const report::Distribution& one : distributions) header.push_back(">" + one.unit);
    Table table(std::move(header));
    using report::Distribution;
    const std::pair<const char*, std::optional<std::int64_t> Distribution::*> figures[] = {
        {"half of them within", &Distribution::p50},
        {"99 %", &Distribution::p99},
        {"99.9 %", &Distribution::p999},
        {"the slowest", &Distribution::highest}};
    for (const auto& [name, figure] : figures) {
        std::vector<Cell> row{name};
        for (const Distribution& one : distributions) row.emplace_back(number(one.*figure));
        table.add(std::move(row));
    }
    return table;
}

Table classes(const report::Distribution& distribution)
{
    const std::int64_t count = distribution.count;
    std::int64_t most = 0;
    for (const report::DistributionClass& one : distribution.classes) most = std::max(most, one.count);
    Table table({">" + distribution.unit, ">REPLIES", ">SHARE", ""});
    for (const report::DistributionClass& one : distribution.classes) {
        const std::int64_t here = one.count;
        table.add({bounds(one), number(one.count), percent(here, count), bar(here, most)});
    }
    return table;
}

std::string turnaround(const std::vector<report::Distribution>& distributions, Look look)
{
    const std::int64_t replies = distributions.empty() ? 0 : distributions.front().count;
    if (replies <= 0) return painted("turnaround", Tone::strong, look) + ": no reply was sent yet\n";
    std::string out = fmt::format("{} of {} {}, from the end of the request to the end of the write\n{}",
                                  painted("turnaround", Tone::strong, look), replies,
                                  replies == 1 ? "reply" : "replies", figures(distributions).str(look, 2));
    for (const report::Distribution& one : distributions)
        if (const Table table = classes(one); !table.empty()) out += '\n' + table.str(look, 2);
    return out;
}

} // namespace

std::string render_counters(const Json& json, Look look)
{
    const auto reply = report::read<report::GetCountersReply>(json);
    std::string out;
    for (const report::CounterGroup& group : reply.groups) {
        Table table({">COUNT", ">LAST MINUTE", "OF", "MEANING"});
        for (const report::Counter& c : group.counters)
            table.add({number(c.value), number(c.minute), c.name, c.meaning});
        out += fmt::format("{}{}\n{}", out.empty() ? "" : "\n", painted(group.name, Tone::strong, look),
                           table.str(look, 2));
    }
    return out + (out.empty() ? "" : "\n") + turnaround(reply.turnaround, look);
}

} // namespace dpslave::dpctl
