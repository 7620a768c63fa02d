// SPDX-License-Identifier: Apache-2.0
#include "watchers.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace dpslave::app {

using control::Json;

Json Watchers::reply(const Station* station, Instant now) const
{
    report::WatchReply result{bus_report(monitor_.view(), now)};
    for (const Station& one : monitor_.view().stations) {
        if (station != nullptr && station != &one) continue;
        result.stations.push_back(station_report(one, now));
        result.words.push_back({one.config->name, words_report(one, now)});
    }
    return json_of(result);
}

/// What counts as a change: states, links and values, and what the bus is at, but no age and no counter.
std::string Watchers::fingerprint(const Station* station) const
{
    const auto& bus = monitor_.view().bus;
    const bool searches = bus.baud_state == fdl::BaudState::baud_search; // its rates go by
    std::string all =
        fmt::format("{}/{}/{}/{}:", static_cast<int>(bus.baud_state),
                    searches ? 0 : static_cast<std::uint32_t>(bus.baud), bus.port_open, bus.driver_works);
    for (const Station& one : monitor_.view().stations) {
        if (station != nullptr && station != &one) continue;
        all += fmt::format("{}/{}/{}/{}/{}/{}/{}/{}/{}/{}/{}:", one.address, static_cast<int>(one.bus.state),
                           one.bus.master, one.bus.clear, one.bus.sync, one.bus.freeze,
                           static_cast<int>(one.bus.hold), one.drive.known, one.drive.answers, one.line_open,
                           one.drive.ride_ends.has_value());
        for (std::size_t k = 0; k < one.bus.layout.count; ++k)
            all += fmt::format("{}.{}.{}.{};", one.bus.layout.parameters[k].tag, one.bus.inputs[k],
                               one.bus.outputs[k], static_cast<int>(one.drive.states[k]));
    }
    return all;
}

control::Reply Watchers::add(const Station* station, const control::Caller& caller)
{
    Watcher watcher{.station = {}, .sent = fingerprint(station)};
    if (station != nullptr) watcher.station = station->config->name;
    return watchers_.open(caller.reply_to, std::move(watcher), reply(station, io::monotonic_now()));
}

void Watchers::push(Instant now)
{
    struct Picture {
        std::string print;
        Json reply;
    };
    std::map<const Station*, Picture> pictures; // many watchers cost no more than a few
    watchers_.each([&](const control::ReplyTo& to, Watcher& watcher) {
        const Station* const station = watcher.station ? monitor_.find(*watcher.station) : nullptr;
        if (watcher.station && station == nullptr) {
            to.end(monitor_.no_such_station(*watcher.station));
            return;
        }
        Picture& picture = pictures[station];
        if (picture.print.empty()) picture.print = fingerprint(station);
        if (picture.print == watcher.sent) return;
        watcher.sent = picture.print;
        if (picture.reply.is_null()) picture.reply = reply(station, now);
        to.send(picture.reply);
    });
}

} // namespace dpslave::app
