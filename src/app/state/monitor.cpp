// SPDX-License-Identifier: Apache-2.0
#include "monitor.hpp"

#include "app/line/drive_line.hpp"
#include "device_news.hpp"
#include "old_words.hpp"

#include "dpslave/base/number.hpp"
#include "dpslave/io/clock.hpp"

#include <algorithm>

namespace dpslave::app {

using control::Error;
using control::Json;

namespace {

constexpr std::chrono::seconds kSampleInterval{1}; // of CounterHistory

Json known_stations(const View& view)
{
    Json names = Json::array();
    for (const Station& station : view.stations) names.push_back(station.config->name);
    return names;
}

void refresh_troubles(Station& station)
{
    station.troubles.clear();
    const TroubleList& troubles = station.drive_line->link.troubles.latest();
    for (std::size_t k = 0; k < troubles.count; ++k)
        if (troubles.troubles[k].station == station.number) station.troubles.push_back(troubles.troubles[k]);
}

} // namespace

Monitor::Monitor(config::Config config, std::vector<Station>& stations, BusLink& bus)
    : stations_(stations), bus_(bus)
{
    set_config(std::move(config));
}

void Monitor::set_config(config::Config config)
{
    config_ = std::move(config);
    view_.config = &config_;
    view_.stations = stations_;
}

const Station* Monitor::find(std::uint32_t number) const
{
    for (const Station& station : view_.stations)
        if (station.number == number) return &station;
    return nullptr;
}

const Station* Monitor::find(std::string_view name) const
{
    for (const Station& station : view_.stations)
        if (station.config->name == name) return &station;
    return nullptr;
}

Error Monitor::no_such_station(const std::string& wanted) const
{
    return Error{"NoSuchStation", {{"station", wanted}, {"known", known_stations(view_)}}};
}

Monitor::Choice Monitor::choose(const Json& parameters, bool one_is_needed) const
{
    if (config_.bus.listen && (one_is_needed || parameters.contains("station")))
        return {.station = nullptr, .error = Error{"OnlyListens", Json::object()}};
    if (!parameters.contains("station")) {
        if (view_.stations.size() == 1) return {.station = view_.stations.data(), .error = {}};
        if (!one_is_needed) return {};
        return {.station = nullptr, .error = Error{"StationRequired", {{"known", known_stations(view_)}}}};
    }
    const std::string wanted = parameters["station"].get<std::string>();
    const auto number = read_number(wanted);
    for (const Station& station : view_.stations)
        if (wanted == station.config->name || number == station.address)
            return {.station = &station, .error = {}};
    return {.station = nullptr, .error = no_such_station(wanted)};
}

void Monitor::refresh()
{
    view_.bus = bus_.snapshot.latest();
    if (view_.bus.port_open) view_.bus_trouble.clear();
    if (bus_.members.fresh()) view_.members = bus_.members.latest();
    view_.lost_events = lost_before_;
    for (Station& station : stations_) {
        StationLink& link = *station.link;
        if (link.bus_snapshot.fresh()) station.bus = link.bus_snapshot.latest();
        if (link.drive_snapshot.fresh()) station.drive = link.drive_snapshot.latest();
        station.ever_answered = station.ever_answered || station.drive.answers;
        look_at_line(station);
        LineLink& line = station.drive_line->link;
        station.line_open = line.port_open.load(std::memory_order_relaxed);
        station.late_releases = line.transceiver.late.load(std::memory_order_relaxed);
        station.guarded_releases = line.transceiver.guarded.load(std::memory_order_relaxed);
        station.driver_raised = line.transceiver.raised.load(std::memory_order_relaxed);
        station.driver_errors = line.transceiver.errors.load(std::memory_order_relaxed);
        station.settings_changed = line.settings_changed.load(std::memory_order_relaxed);
        static_cast<void>(line.changed_settings.fresh());
        station.port_settings = line.changed_settings.latest().words.data();
        station.orders_dropped = link.orders_dropped.load(std::memory_order_relaxed);
        view_.lost_events += link.events.refused();
        refresh_troubles(station);
        update(station);
    }
}

/// What a line said before it stalled is old, as a drive's words are that does not answer.
void Monitor::look_at_line(Station& station)
{
    const auto& loss = station.config->loss;
    const auto silent_for = station.drive_line->look(io::monotonic_now());
    station.line_stalled = silent_for >= loss.after ? silent_for : std::chrono::nanoseconds{};
    station.stalled_in = station.drive_line->link.sign->call();
    if (station.line_stalled.count() != 0) make_old(station.drive, loss.when);
}

void Monitor::update_device(const Station& station)
{
    update(stations_[static_cast<std::size_t>(&station - view_.stations.data())]);
}

void Monitor::update(Station& station)
{
    StationLink& link = *station.link;
    EmulatedDevice& device = *station.device;
    device.update(station, view_.bus);
    station.news->update(station, device, view_.bus);
    station.address = device.address();
    station.silent_because = device.silent_because();
    link.zero_after_ms.store(device.zero_after_ms(), std::memory_order_relaxed);
    const BusOrders orders = device.bus_orders();
    if (orders == station.ordered) return;
    station.ordered = orders;
    link.bus_orders.publish(orders);
}

void Monitor::sample(Instant now)
{
    if (now < next_sample_) return;
    next_sample_ = now + kSampleInterval;
    view_.history.sample(view_, now);
}

} // namespace dpslave::app
