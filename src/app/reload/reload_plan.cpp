// SPDX-License-Identifier: Apache-2.0
#include "reload_station.hpp"

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

/// The one of `present` that `line` continues: of its name, else of its port, if its name has gone.
std::optional<std::size_t> index_of(const config::LineConfig& line, const config::Config& present,
                                    const config::Config& wanted)
{
    if (const auto same = index_of_name(present.lines, line.name)) return same;
    for (std::size_t i = 0; i < present.lines.size(); ++i)
        if (present.lines[i].port == line.port && !index_of_name(wanted.lines, present.lines[i].name))
            return i;
    return std::nullopt;
}

/// The place of a key in the file is no setting.
bool is_same(config::LineConfig a, const config::LineConfig& b)
{
    a.port_line = b.port_line;
    return a == b;
}

/// Its port can stay open: what is different does not concern it.
bool has_same_port(config::LineConfig a, const config::LineConfig& b)
{
    a.name = b.name;
    a.retries = b.retries;
    return is_same(std::move(a), b);
}

/// The device whose address counts from the next start only.
bool is_option_board(const config::StationConfig& station)
{
    return station.profile->leds == led::Language::option_board ||
           station.profile->leds == led::Language::option_board_620;
}

void set_address(config::StationConfig& station, std::uint8_t address)
{
    station.address = address;
    if (station.tec) station.tec->start.address = address;
}

std::string bus_differences(const config::BusConfig& a, const config::BusConfig& b)
{
    Differences keys;
    keys.compare(a.port, b.port, "port");
    keys.compare(a.baud, b.baud, "baud");
    keys.compare(a.max_tsdr, b.max_tsdr, "max_tsdr");
    keys.compare(a.driver_enable.direction, b.driver_enable.direction, "direction");
    keys.compare(a.driver_enable.gpio_chip, b.driver_enable.gpio_chip, "gpio_chip");
    keys.compare(a.driver_enable.gpio_line, b.driver_enable.gpio_line, "gpio_line");
    keys.compare(a.driver_enable.active_low, b.driver_enable.active_low, "gpio_active_low");
    keys.compare(a.echo, b.echo, "echo");
    keys.compare(a.listen, b.listen, "listen");
    config::BusConfig rest = a;
    rest.port_line = b.port_line;
    return keys.names().empty() && !(rest == b) ? "another key" : keys.names();
}

std::string realtime_differences(const config::RealtimeConfig& a, const config::RealtimeConfig& b)
{
    Differences keys;
    keys.compare(a.priority, b.priority, "priority");
    keys.compare(a.cpu, b.cpu, "cpu");
    keys.compare(a.lock_memory, b.lock_memory, "lock_memory");
    return keys.names();
}

std::string trace_differences(const config::TraceConfig& a, const config::TraceConfig& b)
{
    Differences keys;
    keys.compare(a.bus_kib, b.bus_kib, "bus_kib");
    keys.compare(a.samples_kib, b.samples_kib, "samples_kib");
    keys.compare(a.drive_kib, b.drive_kib, "drive_kib");
    return keys.names();
}

void refuse_what_needs_a_restart(const config::Config& present, Plan& plan)
{
    const auto refuse = [&plan](std::string_view table, const std::string& keys) {
        if (keys.empty()) return;
        plan.refusals.push_back(fmt::format(
            "{} {} cannot change while the bus is served: restore the old value and reload, or restart the service (systemctl restart dpslaved), which silences every station for a moment",
            table, keys));
    };
    refuse("[bus]", bus_differences(present.bus, plan.config.bus));
    refuse("[realtime]", realtime_differences(present.realtime, plan.config.realtime));
    refuse("[trace]", trace_differences(present.trace, plan.config.trace));
    refuse("[control]", present.control.socket == plan.config.control.socket ? "" : "socket");
}

void plan_lines(const config::Config& present, Plan& plan)
{
    for (const config::LineConfig& line : plan.config.lines) {
        Plan::Line& planned = plan.lines.emplace_back();
        planned.before = index_of(line, present, plan.config);
        if (!planned.before) {
            plan.changes.push_back(fmt::format("line {} added ({})", line.name, line.port));
            continue;
        }
        const config::LineConfig& old = present.lines[*planned.before];
        planned.is_changed = !is_same(old, line);
        planned.is_opened_anew = !has_same_port(old, line);
        if (old.port != line.port)
            plan.changes.push_back(
                fmt::format("line {} moves from {} to {}", line.name, old.port, line.port));
        else if (planned.is_opened_anew)
            plan.changes.push_back(fmt::format("line {} changed: {} is opened again", line.name, line.port));
        if (old.name != line.name)
            plan.changes.push_back(fmt::format("line {}: its name, which was {}", line.name, old.name));
        if (old.retries != line.retries) plan.changes.push_back(fmt::format("line {}: retries", line.name));
    }
    for (std::size_t i = 0; i < present.lines.size(); ++i)
        if (std::none_of(plan.lines.begin(), plan.lines.end(),
                         [i](const Plan::Line& line) { return line.before == i; }))
            plan.changes.push_back(fmt::format("line {} removed", present.lines[i].name));
}

/// Keeps the address of an option board that has another one in the new file.
void hold_address(const config::StationConfig& before, config::StationConfig& station, Plan& plan)
{
    if (before.address == station.address || !is_option_board(before) || !is_option_board(station)) return;
    plan.pending.push_back(fmt::format(
        "station {}: address {} takes effect at the next start, as on an option board; until then it is {}: restart the service (systemctl restart dpslaved) when the master may lose it for a moment",
        station.name, station.address, before.address));
    set_address(station, before.address);
}

bool is_on_line(const config::StationConfig& old, const config::StationConfig& station, const Plan& plan)
{
    return plan.lines[station.line].before == old.line;
}

/// The one of `present` that `station` continues: of its name, else the same device, if its name has gone.
std::optional<std::size_t> index_of(const config::StationConfig& station, const config::Config& present,
                                    const Plan& plan)
{
    if (const auto same = index_of_name(present.stations, station.name)) return same;
    for (std::size_t i = 0; i < present.stations.size(); ++i) {
        const config::StationConfig& old = present.stations[i];
        if (old.address == station.address && old.unit == station.unit && is_on_line(old, station, plan) &&
            old.profile->name == station.profile->name && !index_of_name(plan.config.stations, old.name))
            return i;
    }
    return std::nullopt;
}

void plan_station(const config::Config& present, const std::vector<InForce>& in_force, std::size_t index,
                  Plan& plan)
{
    config::StationConfig& station = plan.config.stations[index];
    Plan::Station& planned = plan.stations.emplace_back();
    const auto before = index_of(station, present, plan);
    if (!before) {
        plan.changes.push_back(fmt::format("station {} added at address {}", station.name, station.address));
        return;
    }
    const config::StationConfig& old = present.stations[*before];
    hold_address(old, station, plan);
    StationChange change = change_of(old, station, in_force[*before]);
    if (!is_on_line(old, station, plan))
        change.leaves.add("line");
    else if (present.lines[old.line].protocol != plan.config.lines[station.line].protocol)
        change.leaves.add("protocol of its line");
    if (change.leaves.empty()) {
        planned.stays = before;
        planned.is_changed = !change.applied.empty();
        if (planned.is_changed)
            plan.changes.push_back(fmt::format("station {}: {}", station.name, change.applied.names()));
        return;
    }
    const std::string& reason = change.leaves.names();
    plan.leaving.push_back({old.name, reason});
    plan.changes.push_back(
        fmt::format("station {} changed: it leaves the bus and starts again at address {} ({})", station.name,
                    station.address, reason));
}

void plan_stations(const config::Config& present, const std::vector<InForce>& in_force, Plan& plan)
{
    std::vector<bool> goes_on(present.stations.size());
    for (std::size_t i = 0; i < plan.config.stations.size(); ++i) {
        if (const auto before = index_of(plan.config.stations[i], present, plan)) goes_on[*before] = true;
        plan_station(present, in_force, i, plan);
    }
    for (std::size_t i = 0; i < present.stations.size(); ++i) {
        if (goes_on[i]) continue;
        plan.leaving.push_back({present.stations[i].name, "removed"});
        plan.changes.push_back(fmt::format("station {} removed", present.stations[i].name));
    }
}

/// The file alone has no address twice; but one may still be, or by hand have become, that of another
/// station.
void refuse_addresses_in_use(const config::Config& present, const std::vector<InForce>& in_force, Plan& plan)
{
    const auto& stations = plan.config.stations;
    const auto refuse = [&](std::size_t added, std::size_t other, std::uint8_t address,
                            std::string_view since) {
        plan.refusals.push_back(fmt::format(
            "station {}: address {} is that of station {} {}: choose another address, or restart the service",
            stations[added].name, address, stations[other].name, since));
    };
    for (std::size_t i = 0; i < stations.size(); ++i) {
        if (plan.stations[i].stays) continue;
        for (std::size_t k = 0; k < stations.size(); ++k) {
            const auto stays = plan.stations[k].stays;
            const std::uint8_t taken = stays ? in_force[*stays].address : stations[k].address;
            if (k == i || taken != stations[i].address) continue;
            const bool by_hand = stays && taken != present.stations[*stays].address;
            if (by_hand)
                refuse(i, k, taken, "now, to which it was set by hand");
            else if (stays || k < i) // of two that are both new one sentence is enough
                refuse(i, k, taken, "until the next start");
        }
    }
}

void plan_rest(const config::Config& present, Plan& plan)
{
    if (present.sysfs != plan.config.sysfs)
        plan.changes.push_back(fmt::format("lamps are now taken from {}", plan.config.sysfs.string()));
    if (present.control.operator_group != plan.config.control.operator_group)
        plan.changes.push_back(
            fmt::format("group {} may operate, from the next call on", plan.config.control.operator_group));
    if (present.control.read_only != plan.config.control.read_only)
        plan.changes.emplace_back(
            plan.config.control.read_only
                ? "nothing can be written over the control socket, from the next call on"
                : "operators may write over the control socket, from the next call on");
}

/// The order alone changes no function, but the index of a line or station.
void plan_order(Plan& plan)
{
    bool moved = false;
    for (std::size_t i = 0; i < plan.lines.size(); ++i) moved = moved || plan.lines[i].before != i;
    for (std::size_t i = 0; i < plan.stations.size(); ++i) moved = moved || plan.stations[i].stays != i;
    if (moved && plan.changes.empty()) plan.changes.emplace_back("lines or stations are in another order");
}

} // namespace

Plan plan_reload(const config::Config& present, const std::vector<InForce>& in_force, config::Config wanted)
{
    Plan plan;
    plan.config = std::move(wanted);
    refuse_what_needs_a_restart(present, plan);
    plan_lines(present, plan);
    plan_stations(present, in_force, plan);
    refuse_addresses_in_use(present, in_force, plan);
    plan_rest(present, plan);
    plan_order(plan);
    return plan;
}

} // namespace dpslave::app
