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
std::string bounds(const Json& one)
{
    const auto from = integer(one, "from"), to = integer(one, "to");
    if (!from) return "?";
    if (!to) return fmt::format("{} and more", *from);
    return *from == *to ? fmt::format("{}", *from) : fmt::format("{} to {}", *from, *to);
}

/// The figures of all units side by side.
Table figures(const Json& distributions)
{
    std::vector<std::string> header{""};
    for (const Json& one : distributions) header.push_back(">" + text(one, "unit"));
    Table table(std::move(header));
    constexpr std::pair<const char*, const char*> kFigures[] = {
        {"half of them within", "p50"}, {"99 %", "p99"}, {"99.9 %", "p999"}, {"the slowest", "highest"}};
    for (const auto& [name, key] : kFigures) {
        std::vector<Cell> row{name};
        for (const Json& one : distributions) row.emplace_back(number(one, key));
        table.add(std::move(row));
    }
    return table;
}

Table classes(const Json& distribution)
{
    const std::int64_t count = integer(distribution, "count").value_or(0);
    std::int64_t most = 0;
    for (const Json& one : list(distribution, "classes"))
        most = std::max(most, integer(one, "count").value_or(0));
    Table table({">" + text(distribution, "unit"), ">REPLIES", ">SHARE", ""});
    for (const Json& one : list(distribution, "classes")) {
        const std::int64_t here = integer(one, "count").value_or(0);
        table.add({bounds(one), number(one, "count"), percent(here, count), bar(here, most)});
    }
    return table;
}

std::string turnaround(const Json& distributions, Look look)
{
    const std::int64_t replies =
        distributions.empty() ? 0 : integer(distributions.front(), "count").value_or(0);
    if (replies <= 0) return painted("turnaround", Tone::strong, look) + ": no reply was sent yet\n";
    std::string out = fmt::format("{} of {} {}, from the end of the request to the end of the write\n{}",
                                  painted("turnaround", Tone::strong, look), replies,
                                  replies == 1 ? "reply" : "replies", figures(distributions).str(look, 2));
    for (const Json& one : distributions)
        if (const Table table = classes(one); !table.empty()) out += '\n' + table.str(look, 2);
    return out;
}

} // namespace

std::string render_counters(const Json& reply, Look look)
{
    std::string out;
    for (const Json& group : list(reply, "groups")) {
        Table table({">COUNT", ">LAST MINUTE", "OF", "MEANING"});
        for (const Json& c : list(group, "counters"))
            table.add({number(c, "value"), number(c, "minute"), text(c, "name"), text(c, "meaning")});
        out += fmt::format("{}{}\n{}", out.empty() ? "" : "\n",
                           painted(text(group, "name"), Tone::strong, look), table.str(look, 2));
    }
    return out + (out.empty() ? "" : "\n") + turnaround(list(reply, "turnaround"), look);
}

} // namespace dpslave::dpctl
