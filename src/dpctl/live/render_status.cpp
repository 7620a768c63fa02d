// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

Tone tone_of_state(const std::string& state)
{
    return state == "Data_Exch" ? Tone::good : Tone::bad;
}
Tone tone_of_link(const std::string& link)
{
    return link == "answers" ? Tone::good : link == "unknown" ? Tone::plain : Tone::bad;
}

/// What looks normal in a table and is not, a sentence a line.
std::string remarks_of(const Json& s, Look look)
{
    const std::string name = text(s, "name");
    std::string out;
    const auto add = [&](const std::string& what) { out += paragraph(name + ": ", what, look.width); };
    if (flag(s, "held"))
        add("held at the start: the scale of a tag is not known; dpctl diag names tag and answer");
    if (flag(s, "clear")) add("the master is in Clear: 0 goes to every output of the drive");
    if (flag(s, "sync")) add("Sync holds the outputs: new values wait for the next Sync or Unsync");
    if (flag(s, "freeze"))
        add("Freeze holds the inputs: the master gets old values until the next Freeze or Unfreeze");
    if (!part(s, "ride").empty()) add("RIDE THROUGH: " + ride_text(s));
    if (const std::string why = text(s, "silent_because", ""); !why.empty()) add(why);
    const Json& d = part(s, "drive");
    if (d.contains("port_open") && !flag(d, "port_open"))
        add(fmt::format("the port of the drive line, {}, is gone or cannot be opened; it is tried again",
                        text(d, "port")));
    return out;
}

} // namespace

std::string state_text(const Json& s)
{
    std::string result = text(s, "state");
    if (flag(s, "held")) result += ", held";
    if (flag(s, "clear")) result += " in Clear";
    if (flag(s, "sync")) result += ", Sync";
    if (flag(s, "freeze")) result += ", Freeze";
    if (!part(s, "ride").empty()) result += ", RIDE THROUGH";
    return result;
}

std::string link_text(const Json& d)
{
    return d.contains("port_open") && !flag(d, "port_open") ? "port gone" : text(d, "link");
}

std::string ride_text(const Json& s)
{
    const auto ends = real(part(s, "ride"), "ends_in_ms");
    if (!ends) return "the master is lost; its outputs stand until it returns";
    return *ends <= 0 ? "over: 0 is written to the outputs as soon as the drive answers"
                      : fmt::format("the master is lost; its outputs stand for {} more", age(ends));
}

std::string bus_line(const report::Bus& bus)
{
    if (!bus.port_open) return bus.port + " has vanished; it is opened again as soon as it returns";
    const bool is_search = bus.baud_state == "Baud_Search";
    std::string speed = rate(bus.baud);
    if (is_search) speed = "searching the rate" + (bus.baud > 0 ? ", now at " + speed : std::string{});
    const auto heard = bus.last_telegram_age_ms;
    return fmt::format("{}, {}{}, {}", bus.port, speed, is_search ? "" : " (" + bus.baud_state + ")",
                       heard ? "last telegram " + age(heard) + " ago" : "no telegram heard yet");
}

namespace {

Table station_table(const Json& stations)
{
    Table table({"STATION", ">ADDRESS", "PROFILE", "STATE", ">MASTER", "DRIVE", "LINE"});
    for (const Json& s : stations) {
        const std::string state = text(s, "state"), link = link_text(part(s, "drive"));
        table.add(
            {text(s, "name"), number(s, "address"), text(s, "profile"),
             Cell{state_text(s), flag(s, "clear") || flag(s, "held") ? Tone::bad : tone_of_state(state)},
             number(s, "master"), Cell{link, tone_of_link(link)}, text(part(s, "drive"), "line")});
    }
    return table;
}

/// A table, and below it what looks normal there and is not.
std::string stations_text(const Json& stations, Look look)
{
    std::string said;
    for (const Json& station : stations) said += remarks_of(station, look);
    return station_table(stations).str(look) + (said.empty() ? "" : "\n" + said);
}

} // namespace

std::string render_status(const Json& reply, Look look)
{
    const Json& bus = part(reply, "bus");
    Block block;
    block.add("bus", bus_line(report::read<report::Bus>(bus)));
    block.add("stations",
              fmt::format("{}, {} in Data_Exch", number(bus, "stations"), number(bus, "exchanging")));
    block.add("daemon",
              fmt::format("process {}, running for {}", number(reply, "pid"), age(real(reply, "uptime_ms"))));
    return block.str(0, look) + '\n' + stations_text(list(reply, "stations"), look);
}

std::string render_followed_status(const Json& reply, Look look)
{
    return bus_line(report::read<report::Bus>(part(reply, "bus"))) + "\n\n" +
           stations_text(list(reply, "stations"), look);
}

} // namespace dpslave::dpctl
