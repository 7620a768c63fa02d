// SPDX-License-Identifier: Apache-2.0
#include "drive_news.hpp"

#include <fmt/format.h>

#include <utility>

namespace dpslave::app {

DriveNews::Link DriveNews::link_of(const Station& station)
{
    if (!station.line_open) return Link::port_gone;
    if (!station.drive.known) return Link::unknown;
    return station.drive.answers ? Link::answers : Link::silent;
}

void DriveNews::look(std::span<const Station> stations, EventHistory& events, Instant now)
{
    std::map<std::uint32_t, Link> next;
    for (const Station& station : stations) {
        const auto before = known_.find(station.number);
        const Link link = link_of(station), was = before == known_.end() ? Link::unknown : before->second;
        next[station.number] = was == Link::unknown && link == Link::port_gone ? was : link;
        if (link == was || next[station.number] == Link::unknown) continue;
        const std::string& name = station.config->name;
        const std::string& port = station.line->port;
        std::string text = name + ": the drive answers";
        if (link == Link::silent) text = name + ": the drive does not answer";
        if (link == Link::port_gone)
            text = fmt::format("{}: the port of the drive line, {}, is gone or not open", name, port);
        events.add(Happened::drive, name, text, now);
    }
    known_ = std::move(next); // a station that has left is forgotten
}

} // namespace dpslave::app
