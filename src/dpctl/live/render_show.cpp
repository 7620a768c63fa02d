// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

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

void add_state(Block& block, const Json& s)
{
    const auto master = integer(s, "master");
    const auto watchdog = integer(s, "watchdog_ms");
    const std::string state = text(s, "state");
    block.add("device", fmt::format("{} (profile {})", text(s, "device"), text(s, "profile")));
    block.add("state", state + (master ? fmt::format(", master {}", *master) : ", no master"),
              state == "Data_Exch" ? Tone::good : Tone::bad);
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
}

std::string lamp_table(const Json& leds, Look look)
{
    Table table({"LED", "NOW", "PATTERN", "SINK"});
    for (const Json& led : list(leds, "leds"))
        table.add({text(led, "name"), flag(led, "lit") ? "lit" : "dark", text(led, "pattern"),
                   text(led, "sink") == "none" ? "no lamp is configured" : text(led, "sink")});
    return table.empty() ? "" : table.str(look, 2);
}

} // namespace

std::string render_show(const Json& document, Look look)
{
    const std::string version = text(document, "version");
    std::string out;
    for (const Json& one : list(document, "stations")) {
        const Json& station = part(one, "station");
        const Json& leds = part(one, "leds");
        Block block;
        add_state(block, station);
        block.add_blank_line();
        add_info(block, part(one, "info"), version);
        block.add_blank_line();
        block.add("lamps", text(leds, "meaning"));
        out += out.empty() ? "" : "\n";
        out += headline(text(station, "name"), ", address " + number(station, "address"), look);
        out += block.str(2, look) + lamp_table(leds, look);
        if (const Json& tec = part(one, "tec"); !tec.empty()) out += '\n' + render_tec(tec, look);
    }
    return out;
}

} // namespace dpslave::dpctl
