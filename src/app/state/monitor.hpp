// SPDX-License-Identifier: Apache-2.0
/// What the main thread knows of the bus and the stations: it fetches their newest snapshots, and hands on
/// what follows from them to the bus and the drive lines. Main thread only.
#pragma once

#include "report.hpp"

#include "dpslave/control/server.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace dpslave::app {

class Monitor {
public:
    /// `stations`: those of `config`, which the plant makes and exchanges. Both they and `bus` outlive this
    /// object.
    Monitor(config::Config config, std::vector<Station>& stations, BusLink& bus);
    Monitor(const Monitor&) = delete;

    /// The configuration in force.
    const config::Config& config() const { return config_; }
    /// Valid until the next set_config().
    const View& view() const { return view_; }
    /// Null: there is none, or no longer.
    const Station* find(std::uint32_t number) const;
    const Station* find(std::string_view name) const;
    /// Which station a call is about: its parameter `station`, a name or an address.
    struct Choice {
        const Station* station = nullptr;    ///< null without an error: all of them
        std::optional<control::Error> error; ///< it names none, or one is needed and it names nothing
    };
    Choice choose(const control::Json& parameters, bool one_is_needed) const;
    /// The error NoSuchStation, with the names that exist.
    control::Error no_such_station(const std::string& wanted) const;

    /// Fetches the newest snapshots and publishes the orders that follow from them.
    void refresh();
    /// Why the port of the bus is closed, a sentence; it stands until the port is open.
    void set_port_settings(std::string changed) { view_.port_settings = std::move(changed); }
    void set_driver_raised(std::uint64_t times) { view_.driver_raised = times; }
    void set_bus_trouble(std::string why) { view_.bus_trouble = std::move(why); }
    /// What the control socket has counted up to now.
    void set_calls(const control::ServerCounters& calls) { view_.calls = calls; }
    /// The same for the device of one station, after a setting of it has changed.
    void update_device(const Station& station);
    /// Counts for the last minute; does nothing more often than once a second.
    void sample(Instant now);
    /// `config` is in force from now on, with the stations that there are now.
    void set_config(config::Config config);
    /// Adds events that a station that has left could not deliver.
    void add_lost_events(std::uint64_t count) { lost_before_ += count; }

private:
    void look_at_line(Station& station);
    void update(Station& station);

    config::Config config_;
    std::vector<Station>& stations_;
    BusLink& bus_;
    View view_;
    std::uint64_t lost_before_ = 0; ///< of stations that have left
    Instant next_sample_{};
};

} // namespace dpslave::app
