// SPDX-License-Identifier: Apache-2.0
#include "doctor.hpp"

#include "dpslave/base/number.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace dpslave::dpctl {
namespace {

template <class T>
const T kNothing{};

/// The one with this name; an empty one without.
template <class T>
const T& named(const std::vector<T>& all, const std::string& name)
{
    for (const T& one : all)
        if (one.name == name) return one;
    return kNothing<T>;
}

Family family_of(const report::Info& info, const report::Tec& tec)
{
    if (!tec.name.empty()) return Family::technology_box;
    return info.comms_status.value_or("").empty() ? Family::option_board : Family::controller;
}

/// The counters of a station: the first group is that of the bus, whatever a station is called.
const report::CounterGroup& group_of(const report::GetCountersReply& counters, const std::string& name)
{
    bool is_bus = true;
    for (const report::CounterGroup& group : counters.groups)
        if (!std::exchange(is_bus, false) && group.name == name) return group;
    return kNothing<report::CounterGroup>;
}

/// The first causes of each station and of the bus, and all notes.
std::vector<Finding> without_the_least(std::vector<Finding> findings)
{
    std::map<std::string, std::size_t> causes;
    std::erase_if(findings, [&](const Finding& one) {
        return one.rule->rank != Rank::note && ++causes[one.station] > kMostCauses;
    });
    return findings;
}

} // namespace

bool is_meant(const report::Station& station, const std::string& wanted)
{
    return wanted.empty() || station.name == wanted || read_number(wanted) == station.address;
}

std::vector<Finding> diagnose(const Replies& replies, const std::string& wanted)
{
    const report::Bus& bus = replies.status.bus;
    const report::CounterGroup& counters = named(replies.counters.groups, "bus");
    const std::int64_t uptime = replies.status.uptime_ms;
    std::vector<Finding> findings;
    for (const Rule& rule : rules()) {
        if (is_of_bus(rule)) {
            const Facts facts{replies,
                              bus,
                              counters,
                              uptime,
                              Family::option_board,
                              kNothing<report::Station>,
                              kNothing<report::CounterGroup>,
                              kNothing<report::Info>,
                              kNothing<report::Diagnosis>,
                              kNothing<report::Tec>,
                              kNothing<report::StationIo>};
            if (std::string seen = rule.seen(facts); !seen.empty())
                findings.push_back({"", &rule, std::move(seen)});
            continue;
        }
        for (const report::Station& station : replies.status.stations) {
            if (!is_meant(station, wanted)) continue;
            const std::string& name = station.name;
            const report::Info& info = named(replies.info.stations, name);
            const report::Tec& tec = named(replies.tec.stations, name);
            const Facts facts{replies,
                              bus,
                              counters,
                              uptime,
                              family_of(info, tec),
                              station,
                              group_of(replies.counters, name),
                              info,
                              named(replies.diagnosis.stations, name),
                              tec,
                              named(replies.io.stations, name)};
            if (std::string seen = rule.seen(facts); !seen.empty())
                findings.push_back({name, &rule, std::move(seen)});
        }
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& one, const Finding& other) {
        return one.rule->rank < other.rule->rank;
    });
    return without_the_least(std::move(findings));
}

std::optional<LineLimit> line_limit(const report::Bus& bus)
{
    if (bus.baud_state == "Baud_Search") return std::nullopt;
    for (const LineLimit& limit : kLineLimits)
        if (limit.baud == bus.baud) return limit;
    return std::nullopt;
}

} // namespace dpslave::dpctl
