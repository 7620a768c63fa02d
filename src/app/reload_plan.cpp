// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/reload_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace dpslave::app {

namespace {

template <class Named>
std::optional<std::size_t> index_of_name(const std::vector<Named>& all, const std::string& name)
{
    const auto found =
        std::find_if(all.begin(), all.end(), [&name](const Named& one) { return one.name == name; });
    if (found == all.end()) return std::nullopt;
    return static_cast<std::size_t>(found - all.begin());
}

/// The place of a key in the file is no setting.
bool is_same(LineConfig a, const LineConfig& b)
{
    a.port_line = b.port_line;
    return a == b;
}

/// The device whose address counts from the next start only.
bool is_option_board(const StationConfig& station)
{
    return station.profile->leds == led::Language::option_board ||
           station.profile->leds == led::Language::option_board_620;
}

void set_address(StationConfig& station, std::uint8_t address)
{
    station.address = address;
    if (station.tec) station.tec->start.address = address;
}

/// Names of keys that differ: "port, baud".
class Differences {
public:
    template <class T>
    void look(const T& a, const T& b, std::string_view key)
    {
        if (a == b) return;
        names_.append(names_.empty() ? "" : ", ").append(key);
    }
    const std::string& names() const { return names_; }

private:
    std::string names_;
};

std::string bus_differences(const BusConfig& a, const BusConfig& b)
{
    Differences keys;
    keys.look(a.port, b.port, "port");
    keys.look(a.baud, b.baud, "baud");
    keys.look(a.max_tsdr, b.max_tsdr, "max_tsdr");
    keys.look(a.driver_enable.direction, b.driver_enable.direction, "direction");
    keys.look(a.driver_enable.gpio_chip, b.driver_enable.gpio_chip, "gpio_chip");
    keys.look(a.driver_enable.gpio_line, b.driver_enable.gpio_line, "gpio_line");
    keys.look(a.driver_enable.active_low, b.driver_enable.active_low, "gpio_active_low");
    keys.look(a.echo, b.echo, "echo");
    BusConfig rest = a;
    rest.port_line = b.port_line;
    return keys.names().empty() && !(rest == b) ? "another key" : keys.names();
}

std::string realtime_differences(const RealtimeConfig& a, const RealtimeConfig& b)
{
    Differences keys;
    keys.look(a.priority, b.priority, "priority");
    keys.look(a.cpu, b.cpu, "cpu");
    keys.look(a.lock_memory, b.lock_memory, "lock_memory");
    return keys.names();
}

void refuse_what_needs_a_restart(const Config& present, Plan& plan)
{
    const auto refuse = [&plan](std::string_view table, const std::string& keys) {
        if (keys.empty()) return;
        plan.refusals.push_back(
            fmt::format("{} {} cannot change while the bus is served: put the old value back and "
                        "reload, or restart the service (systemctl restart dpslaved), which "
                        "silences every station for a moment",
                        table, keys));
    };
    refuse("[bus]", bus_differences(present.bus, plan.config.bus));
    refuse("[realtime]", realtime_differences(present.realtime, plan.config.realtime));
    refuse("[control]", present.control.socket == plan.config.control.socket ? "" : "socket");
}

void plan_lines(const Config& present, Plan& plan)
{
    for (const LineConfig& line : plan.config.lines) {
        Plan::Line& planned = plan.lines.emplace_back();
        planned.before = index_of_name(present.lines, line.name);
        planned.is_changed = planned.before && !is_same(present.lines[*planned.before], line);
        if (!planned.before)
            plan.changes.push_back(fmt::format("line {} added ({})", line.name, line.port));
        else if (planned.is_changed)
            plan.changes.push_back(fmt::format("line {} changed: {} is opened anew", line.name, line.port));
    }
    for (const LineConfig& line : present.lines)
        if (!index_of_name(plan.config.lines, line.name))
            plan.changes.push_back(fmt::format("line {} removed", line.name));
}

/// Keeps the address of an option board that has another one in the new file.
void hold_address(const StationConfig& before, StationConfig& station, Plan& plan)
{
    if (before.address == station.address || !is_option_board(before) || !is_option_board(station)) return;
    plan.pending.push_back(fmt::format(
        "station {}: address {} counts from the next start on, as it does on an option board; until then it "
        "is {}: "
        "restart the service (systemctl restart dpslaved) when the master may lose it for a moment",
        station.name, station.address, before.address));
    set_address(station, before.address);
}

void plan_station(const Config& present, std::size_t index, Plan& plan)
{
    StationConfig& station = plan.config.stations[index];
    Plan::Station& planned = plan.stations.emplace_back();
    const auto before = index_of_name(present.stations, station.name);
    if (!before) {
        plan.changes.push_back(fmt::format("station {} added at address {}", station.name, station.address));
        return;
    }
    const StationConfig& old = present.stations[*before];
    hold_address(old, station, plan);
    const LineConfig& old_line = present.lines[old.line];
    const LineConfig& line = plan.config.lines[station.line];
    if (!is_same(old, station) || old_line.name != line.name || old_line.protocol != line.protocol) {
        plan.changes.push_back(
            fmt::format("station {} changed: it leaves the bus and starts anew at address {}", station.name,
                        station.address));
        return;
    }
    planned.stays = before;
    if (old.leds != station.leds)
        plan.changes.push_back(fmt::format("station {}: other lamps", station.name));
}

void plan_stations(const Config& present, Plan& plan)
{
    for (std::size_t i = 0; i < plan.config.stations.size(); ++i) plan_station(present, i, plan);
    for (const StationConfig& station : present.stations)
        if (!index_of_name(plan.config.stations, station.name))
            plan.changes.push_back(fmt::format("station {} removed", station.name));
}

/// The file alone has no address twice; but one may still be, or by hand have become, that of another
/// station.
void refuse_addresses_in_use(const Config& present, const std::vector<std::uint8_t>& in_force, Plan& plan)
{
    const auto& stations = plan.config.stations;
    const auto refuse = [&](std::size_t newcomer, std::size_t other, std::uint8_t address,
                            std::string_view since) {
        plan.refusals.push_back(fmt::format(
            "station {}: address {} is that of station {} {}: choose another address, or restart the service",
            stations[newcomer].name, address, stations[other].name, since));
    };
    for (std::size_t i = 0; i < stations.size(); ++i) {
        if (plan.stations[i].stays) continue;
        for (std::size_t k = 0; k < stations.size(); ++k) {
            const auto stays = plan.stations[k].stays;
            const std::uint8_t taken = stays ? in_force[*stays] : stations[k].address;
            if (k == i || taken != stations[i].address) continue;
            const bool by_hand = stays && taken != present.stations[*stays].address;
            if (by_hand)
                refuse(i, k, taken, "now, to which it was set by hand");
            else if (stays || k < i) // of two that are both new one sentence is enough
                refuse(i, k, taken, "until the next start");
        }
    }
}

void plan_rest(const Config& present, Plan& plan)
{
    if (present.sysfs != plan.config.sysfs)
        plan.changes.push_back(fmt::format("lamps are looked for in {}", plan.config.sysfs.string()));
    if (present.control.operator_group != plan.config.control.operator_group)
        plan.changes.push_back(
            fmt::format("group {} may operate, for callers from now on", plan.config.control.operator_group));
}

/// The order alone makes no difference to anybody, but whoever counts lines and stations has to learn it.
void plan_order(Plan& plan)
{
    bool moved = false;
    for (std::size_t i = 0; i < plan.lines.size(); ++i) moved = moved || plan.lines[i].before != i;
    for (std::size_t i = 0; i < plan.stations.size(); ++i) moved = moved || plan.stations[i].stays != i;
    if (moved && plan.changes.empty()) plan.changes.emplace_back("lines or stations stand in another order");
}

} // namespace

/// Their members are compared as they stand, so that none can be forgotten; only what they point to by
/// itself.
bool is_same(const StationConfig& a, const StationConfig& b)
{
    StationConfig like = a;
    like.line = b.line;
    like.leds = b.leds;
    like.profile = b.profile;
    like.personality = b.personality;
    like.tags = b.tags;
    return like == b && *a.profile == *b.profile && *a.personality == *b.personality && *a.tags == *b.tags;
}

Plan plan_reload(const Config& present, const std::vector<std::uint8_t>& in_force, Config wanted)
{
    Plan plan;
    plan.config = std::move(wanted);
    refuse_what_needs_a_restart(present, plan);
    plan_lines(present, plan);
    plan_stations(present, plan);
    refuse_addresses_in_use(present, in_force, plan);
    plan_rest(present, plan);
    plan_order(plan);
    return plan;
}

} // namespace dpslave::app
