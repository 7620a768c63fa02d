// SPDX-License-Identifier: Apache-2.0
#include "tune.hpp"

#include <algorithm>

namespace dpslave::dpctl {
namespace {

std::optional<std::uint64_t> unsigned_of(std::optional<std::int64_t> value)
{
    return value && *value >= 0 ? std::optional{static_cast<std::uint64_t>(*value)} : std::nullopt;
}

std::optional<std::uint64_t> counter(const report::CounterGroup& group, std::string_view name)
{
    for (const report::Counter& one : group.counters)
        if (one.name == name) return unsigned_of(one.value);
    return std::nullopt;
}

Traffic traffic_of(const report::GetCountersReply& counters)
{
    static const report::CounterGroup kNothing;
    const report::CounterGroup* bus = &kNothing;
    for (const report::CounterGroup& group : counters.groups)
        if (group.name == "bus") bus = &group;
    Traffic traffic;
    const std::uint64_t replies = counter(*bus, "replies").value_or(0);
    traffic.replies = replies - std::min(replies, counter(*bus, "unsent").value_or(0));
    traffic.too_late = counter(*bus, "late").value_or(0) + counter(*bus, "too_late").value_or(0);
    traffic.overtaken = counter(*bus, "overtaken").value_or(0);
    traffic.repeated = counter(*bus, "retries").value_or(0);
    for (const report::Distribution& one : counters.turnaround) {
        if (one.unit != "us") continue;
        traffic.measured = unsigned_of(one.count).value_or(0);
        traffic.p999_us = unsigned_of(one.p999);
        traffic.highest_us = unsigned_of(one.highest);
    }
    traffic.page_faults = counter(*bus, "page_faults").value_or(0);
    return traffic;
}

} // namespace

BusFacts bus_facts(const report::Bus& bus, const report::GetInfoReply& info,
                   const report::GetCountersReply& counters)
{
    BusFacts facts;
    if (bus.baud > 0 && bus.baud_state != "Baud_Search")
        facts.baud = baud_of(static_cast<std::uint32_t>(bus.baud));
    for (const report::Info& station : info.stations) {
        for (std::size_t i = 0; i < std::min(station.bauds.size(), station.max_tsdr.size()); ++i) {
            const auto known = baud_of(static_cast<std::uint32_t>(station.bauds[i]));
            if (!known) continue;
            auto& promised = facts.promised[index_of(*known)];
            const auto time = static_cast<std::uint32_t>(station.max_tsdr[i]);
            promised = promised ? std::min(*promised, time) : time;
        }
    }
    facts.traffic = traffic_of(counters);
    return facts;
}

} // namespace dpslave::dpctl
