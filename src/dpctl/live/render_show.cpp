// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

struct ShownStation {
    report::Station station{};
    report::Info info{};
    report::StationLeds leds{};
    std::optional<report::Tec> tec{};
    DPSLAVE_FIELDS(station, info, leds, tec)
};
struct Shown {
    std::string version{};
    std::vector<ShownStation> stations{};
    DPSLAVE_FIELDS(version, stations)
};

/// Groups 1 to 8 of Global_Control from the octet Group_Ident.
std::string groups(std::int64_t octet)
{
    std::string result;
    for (int i = 0; i < 8; ++i)
        if (((octet >> i) & 1) != 0) result += fmt::format("{}{}", result.empty() ? "" : ", ", i + 1);
    return result.empty() ? "none" : result;
}

std::string diagnosis(const report::Station& station)
{
    std::string result;
    if (station.stat_diag) result = "static diagnosis: not ready for data yet";
    if (station.diag_pending)
        result += std::string{result.empty() ? "" : "; "} + "new, not yet read by the master";
    return result.empty() ? "nothing new" : result;
}

std::string drive(const report::Drive& d)
{
    std::string result = fmt::format("unit {} on {} ({}, {}, direction {}): {}\n", d.unit, d.line, d.port,
                                     d.protocol, d.direction, d.stalled_ms ? stall_text(d) : d.link);
    if (d.cycle_ms) result += fmt::format("a round takes {}; ", age(d.cycle_ms));
    result += fmt::format("{}, {}, {} unanswered, {} refused, lost {}", plural(d.reads, "read"),
                          plural(d.writes, "write"), d.silences, d.refusals, plural(d.losses, "time"));
    if (d.last_trouble) result += "\nlast trouble: " + *d.last_trouble;
    return result;
}

void add_state(Block& block, const report::Station& s)
{
    block.add("device", fmt::format("{} (profile {})", s.device, s.profile));
    block.add("state", s.state + (s.master ? fmt::format(", master {}", *s.master) : ", no master"),
              s.state == "Data_Exch" ? Tone::good : Tone::bad);
    if (s.held)
        block.add("held", s.held_because.value_or("") + ", and no data are exchanged: dpctl diag", Tone::bad);
    if (s.clear) block.add("Clear", "the master is in Clear: 0 goes to every output", Tone::bad);
    if (s.ride) block.add("RIDE THROUGH", ride_text(*s.ride), Tone::bad);
    if (s.silent_because) block.add("silent", *s.silent_because);
    block.add("watchdog", s.watchdog_ms ? age(static_cast<double>(*s.watchdog_ms)) : "off");
    block.add("min T_SDR", std::to_string(s.min_tsdr) + " T_bit");
    block.add("groups", groups(s.groups));
    block.add("Sync, Freeze", fmt::format("{}, {}", s.sync ? "on" : "off", s.freeze ? "on" : "off"));
    block.add("diagnosis", diagnosis(s));
    block.add("parameters", std::to_string(s.parameters) + (s.demand_data ? " and Demand Data" : ""));
    block.add("left Data_Exch", s.left_count == 0
                                    ? "never"
                                    : plural(s.left_count, "time") +
                                          (s.left_because ? ", the last time: " + *s.left_because : ""));
    block.add("drive", drive(s.drive));
}

std::string lamp_table(const report::StationLeds& leds, Look look)
{
    Table table({"LED", "NOW", "PATTERN", "SINK"});
    for (const report::Led& led : leds.leds)
        table.add({led.name,
                   led.trouble ? "cannot be switched"
                   : led.lit   ? "lit"
                               : "dark",
                   led.pattern, led.sink == "none" ? "no lamp is configured" : led.sink});
    return table.empty() ? "" : table.str(look, 2);
}

} // namespace

std::string render_show(const Json& json, Look look)
{
    const auto document = report::read<Shown>(json);
    std::string out;
    for (const ShownStation& one : document.stations) {
        Block block;
        add_state(block, one.station);
        block.add_blank_line();
        add_info(block, one.info, document.version);
        block.add_blank_line();
        block.add("lamps", one.leds.meaning);
        out += out.empty() ? "" : "\n";
        out += headline(one.station.name, ", address " + std::to_string(one.station.address), look);
        out += block.str(2, look) + lamp_table(one.leds, look);
        if (one.tec) out += '\n' + render_tec(*one.tec, look);
    }
    return out;
}

} // namespace dpslave::dpctl
