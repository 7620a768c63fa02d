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

/// Groups 1 to 8 of Global_Control from the octet Group_Ident.
std::string groups(std::int64_t octet)
{
    std::string result;
    for (int i = 0; i < 8; ++i)
        if (((octet >> i) & 1) != 0) result += fmt::format("{}{}", result.empty() ? "" : ", ", i + 1);
    return result.empty() ? "none" : result;
}

std::string diagnosis(const Json& station)
{
    std::string result;
    if (flag(station, "stat_diag")) result = "static diagnosis: not ready for data yet";
    if (flag(station, "diag_pending"))
        result += std::string{result.empty() ? "" : "; "} + "new, the master has yet to read it";
    return result.empty() ? "nothing new" : result;
}

std::string drive(const Json& d)
{
    std::string result = fmt::format("unit {} on {} ({}, {}): {}\n", text(d, "unit"), text(d, "line"),
                                     text(d, "port"), text(d, "protocol"), text(d, "link"));
    if (const auto cycle = real(d, "cycle_ms")) result += fmt::format("a round takes {}; ", age(cycle));
    result += fmt::format("{}, {}, {} unanswered, {} refused, lost {}",
                          plural(integer(d, "reads").value_or(0), "read"),
                          plural(integer(d, "writes").value_or(0), "write"), number(d, "silences"),
                          number(d, "refusals"), plural(integer(d, "losses").value_or(0), "time"));
    if (const std::string trouble = text(d, "last_trouble", ""); !trouble.empty())
        result += "\nlast trouble: " + trouble;
    return result;
}

/// "Data_Exch", "Data_Exch in Clear", "Power_On": in one cell.
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

std::string link_of(const Json& d)
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

/// What looks normal in a table and is not, a sentence a line.
std::string remarks(const Json& s, Look look)
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

std::string station_block(const Json& s, Look look)
{
    const auto master = integer(s, "master");
    const auto watchdog = integer(s, "watchdog_ms");
    const std::string state = text(s, "state");
    Block block;
    block.add("device", fmt::format("{} (profile {})", text(s, "device"), text(s, "profile")));
    block.add("state", state + (master ? fmt::format(", master {}", *master) : ", no master"),
              tone_of_state(state));
    if (flag(s, "held"))
        block.add("held", "the scale of a tag is not known, and no data are exchanged: dpctl diag",
                  Tone::bad);
    if (flag(s, "clear")) block.add("Clear", "the master is in Clear: 0 goes to every output", Tone::bad);
    if (!part(s, "ride").empty()) block.add("RIDE THROUGH", ride_text(s), Tone::bad);
    if (const std::string why = text(s, "silent_because", ""); !why.empty()) block.add("silent", why);
    block.add("watchdog", watchdog ? age(static_cast<double>(*watchdog)) : "off");
    block.add("min T_SDR", number(s, "min_tsdr") + " T_bit");
    block.add("groups", groups(integer(s, "groups").value_or(0)));
    block.add("Sync, Freeze",
              fmt::format("{}, {}", flag(s, "sync") ? "on" : "off", flag(s, "freeze") ? "on" : "off"));
    block.add("diagnosis", diagnosis(s));
    block.add("parameters", number(s, "parameters") + (flag(s, "demand_data") ? " and Demand Data" : ""));
    const std::int64_t left = integer(s, "left_count").value_or(0);
    const std::string because = text(s, "left_because", "");
    block.add("left Data_Exch",
              left == 0 ? "never"
                        : plural(left, "time") + (because.empty() ? "" : ", the last time: " + because));
    block.add("drive", drive(part(s, "drive")));
    return fmt::format("{}, address {}\n{}", painted(text(s, "name"), Tone::strong, look),
                       number(s, "address"), block.str(2, look));
}

} // namespace

std::string bus_line(const Json& bus)
{
    const std::string state = text(bus, "baud_state");
    const std::int64_t baud = integer(bus, "baud").value_or(0);
    std::string speed = rate(baud);
    if (state == "Baud_Search")
        speed = "searching the rate" + (baud > 0 ? ", now at " + speed : std::string{});
    const auto heard = real(bus, "last_telegram_age_ms");
    if (bus.contains("port_open") && !flag(bus, "port_open"))
        return text(bus, "port") + " has vanished; it is opened again as soon as it returns";
    return fmt::format("{}, {}{}, {}", text(bus, "port"), speed,
                       state == "Baud_Search" ? "" : " (" + state + ")",
                       heard ? "last telegram " + age(heard) + " ago" : "no telegram heard yet");
}

Table station_table(const Json& stations)
{
    Table table({"STATION", ">ADDRESS", "PROFILE", "STATE", ">MASTER", "DRIVE", "LINE"});
    for (const Json& s : stations) {
        const std::string state = text(s, "state"), link = link_of(part(s, "drive"));
        table.add(
            {text(s, "name"), number(s, "address"), text(s, "profile"),
             Cell{state_text(s), flag(s, "clear") || flag(s, "held") ? Tone::bad : tone_of_state(state)},
             number(s, "master"), Cell{link, tone_of_link(link)}, text(part(s, "drive"), "line")});
    }
    return table;
}

std::string render_status(const Json& reply, Look look)
{
    const Json& bus = part(reply, "bus");
    Block block;
    block.add("bus", bus_line(bus));
    block.add("stations",
              fmt::format("{}, {} in Data_Exch", number(bus, "stations"), number(bus, "exchanging")));
    block.add("daemon",
              fmt::format("process {}, running for {}", number(reply, "pid"), age(real(reply, "uptime_ms"))));
    std::string said;
    for (const Json& station : list(reply, "stations")) said += remarks(station, look);
    return block.str(0, look) + '\n' + station_table(list(reply, "stations")).str(look) +
           (said.empty() ? "" : "\n" + said);
}

std::string render_stations(const Json& reply, Look look)
{
    std::string out;
    for (const Json& station : list(reply, "stations"))
        out += (out.empty() ? "" : "\n") + station_block(station, look);
    return out;
}

} // namespace dpslave::dpctl
