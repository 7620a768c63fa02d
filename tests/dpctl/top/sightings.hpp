// SPDX-License-Identifier: Apache-2.0
/// What `dpctl top` sees of the daemon of fixtures: the unwinder in exchange, the rewinder not.
#pragma once

#include "control/fixtures.hpp"
#include "dpctl/top/top_state.hpp"

#include <string>

namespace dpslave::test {

/// `seconds` after the first look, at 04:15:10 UTC of 2026-11-25 and later.
inline dpctl::Sighting sighting(double seconds)
{
    return {
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>{1000 + seconds}),
        1'795'580'110 + seconds, report::read<report::GetStatusReply>(fixture("GetStatus")),
        report::read<report::GetCountersReply>(fixture("GetCounters")),
        report::read<report::GetIoReply>(fixture("GetIo"))};
}

/// The counter of this name of the bus (group 0) or of the unwinder (group 1).
inline report::Counter& counter(dpctl::Sighting& of, std::size_t group, const std::string& name)
{
    for (report::Counter& one : of.counters.groups.at(group).counters)
        if (one.name == name) return one;
    throw std::out_of_range(name);
}

inline report::GetEventsReply past_events()
{
    return report::read<report::GetEventsReply>(fixture("GetEvents"));
}

/// One look.
inline dpctl::TopState one_look()
{
    dpctl::TopState state;
    state.add(sighting(0), past_events());
    return state;
}

/// A second look two seconds later: 420 telegrams and 200 exchanges more, 5 more octets that are no telegram,
/// the speed is 51.00 and the rewinder is in exchange.
inline dpctl::TopState two_looks()
{
    dpctl::TopState state = one_look();
    dpctl::Sighting later = sighting(2);
    counter(later, 0, "telegrams").value += 420;
    counter(later, 0, "octets").value += 9000;
    counter(later, 0, "flaw: checksum").value += 5;
    counter(later, 1, "data_exchange").value += 200;
    counter(later, 1, "drive_reads").value += 16;
    later.counters.turnaround[1].classes[0].count += 190;
    later.counters.turnaround[1].classes[1].count += 10;
    later.io.stations[0].words[0].value = "51.00";
    later.io.stations[0].words[0].raw = 5100;
    later.status.stations[1].state = "Data_Exch";
    state.add(later, {});
    return state;
}

/// `count` stations "station 0" and so on instead of the two, each with `words` words "tag 0" and so on.
inline dpctl::TopState many_stations(std::size_t count, std::size_t words)
{
    dpctl::Sighting one = sighting(0);
    const report::Station station = one.status.stations[0];
    const report::StationIo io = one.io.stations[0];
    one.status.stations.clear();
    one.io.stations.clear();
    for (std::size_t i = 0; i < count; ++i) {
        one.status.stations.push_back(station);
        one.io.stations.push_back(io);
        one.status.stations[i].name = one.io.stations[i].name = "station " + std::to_string(i);
        one.status.stations[i].address = one.io.stations[i].address = static_cast<std::int64_t>(i);
        one.io.stations[i].words.assign(words, io.words[0]);
        for (std::size_t w = 0; w < words; ++w) {
            one.io.stations[i].words[w].name = "tag " + std::to_string(w);
            one.io.stations[i].words[w].octet = static_cast<std::int64_t>(2 * w);
        }
    }
    dpctl::TopState state;
    state.add(one, past_events());
    return state;
}

} // namespace dpslave::test
