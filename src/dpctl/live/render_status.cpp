// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// What looks normal in a table and is not, a sentence a line.
std::string remarks_of(const report::Station& s, Look look)
{
    std::string out;
    const auto add = [&](const std::string& what) { out += paragraph(s.name + ": ", what, look.width); };
    if (s.held)
        add("held at the start: " + s.held_because.value_or("") + "; dpctl diag names tag and answer");
    if (s.clear) add("the master is in Clear: 0 goes to every output of the drive");
    if (s.sync) add("Sync holds the outputs: new values wait for the next Sync or Unsync");
    if (s.freeze)
        add("Freeze holds the inputs: the master gets old values until the next Freeze or Unfreeze");
    if (s.ride) add("RIDE THROUGH: " + ride_text(*s.ride));
    if (s.silent_because) add(*s.silent_because);
    if (s.drive.stalled_ms) add(stall_text(s.drive) + "; what it read last is old");
    if (!s.drive.port_open)
        add(fmt::format("the port of the drive line, {}, is gone or cannot be opened; it is tried again",
                        s.drive.port));
    return out;
}

} // namespace

std::string state_text(const report::Station& s)
{
    std::string result = s.state;
    if (s.held) result += ", held";
    if (s.clear) result += " in Clear";
    if (s.sync) result += ", Sync";
    if (s.freeze) result += ", Freeze";
    if (s.ride) result += ", RIDE THROUGH";
    return result;
}

Tone state_tone(const report::Station& s)
{
    return s.state == "Data_Exch" && !s.clear && !s.held ? Tone::good : Tone::bad;
}

std::string link_text(const report::Drive& d)
{
    if (d.stalled_ms) return "line stalled";
    return d.port_open ? d.link : "port missing";
}

std::string stall_text(const report::Drive& d)
{
    return fmt::format("line {} has stalled{} for {}", d.line, d.stalled_in ? " in " + *d.stalled_in : "",
                       age(d.stalled_ms));
}

Tone link_tone(const report::Drive& d)
{
    const std::string link = link_text(d);
    return link == "answers" ? Tone::good : link == "unknown" ? Tone::plain : Tone::bad;
}

std::string ride_text(const report::Ride& ride)
{
    const auto ends = ride.ends_in_ms;
    if (!ends) return "the master is lost; its outputs keep their values until it returns";
    return *ends <= 0
               ? "over: 0 is written to the outputs as soon as the drive answers"
               : fmt::format("the master is lost; its outputs keep their values for {} more", age(ends));
}

std::string bus_line(const report::Bus& bus)
{
    if (!bus.port_open)
        return bus.trouble.value_or(bus.port + " is missing; it is opened again as soon as it returns");
    const bool is_search = bus.baud_state == "Baud_Search";
    std::string speed = rate(bus.baud);
    if (is_search) speed = "searching the rate" + (bus.baud > 0 ? ", now at " + speed : std::string{});
    const auto heard = bus.last_telegram_age_ms;
    return fmt::format("{}, {}{}, {}{}", bus.port, speed, is_search ? "" : " (" + bus.baud_state + ")",
                       heard ? "last telegram " + age(heard) + " ago" : "no telegram received yet",
                       bus.listens ? "; only listens" : "");
}

namespace {

Table station_table(const std::vector<report::Station>& stations)
{
    Table table({"STATION", ">ADDRESS", "PROFILE", "STATE", ">MASTER", "DRIVE", "LINE"});
    for (const report::Station& s : stations) {
        table.add({s.name, std::to_string(s.address), s.profile, Cell{state_text(s), state_tone(s)},
                   number(s.master), Cell{link_text(s.drive), link_tone(s.drive)}, s.drive.line});
    }
    return table;
}

/// A table, and below it what looks normal there and is not.
std::string stations_text(const std::vector<report::Station>& stations, Look look)
{
    if (stations.empty()) return {};
    std::string said;
    for (const report::Station& station : stations) said += remarks_of(station, look);
    return station_table(stations).str(look) + (said.empty() ? "" : "\n" + said);
}

} // namespace

std::string render_status(const Json& json, Look look)
{
    const auto reply = report::read<report::GetStatusReply>(json);
    const report::Bus& bus = reply.bus;
    Block block;
    block.add("bus", bus_line(bus));
    block.add("stations", bus.listens ? std::string{"none, nothing is sent (listen = true under [bus])"}
                                      : fmt::format("{}, {} in Data_Exch", bus.stations, bus.exchanging));
    block.add("daemon", fmt::format("process {}, running for {}", reply.pid,
                                    age(static_cast<double>(reply.uptime_ms))));
    if (reply.log.level == "debug") block.add("log", log_level_text(reply.log));
    const std::string stations = stations_text(reply.stations, look);
    return block.str(0, look) + (stations.empty() ? "" : '\n' + stations);
}

std::string log_level_text(const report::Log& log)
{
    if (log.level != "debug") return log.level;
    return log.level + (log.ends_in_ms ? ", for " + age(log.ends_in_ms) + " more" : std::string{});
}

std::string render_followed_status(const Json& json, Look look)
{
    const auto reply = report::read<report::WatchReply>(json);
    return bus_line(reply.bus) + "\n\n" + stations_text(reply.stations, look);
}

} // namespace dpslave::dpctl
