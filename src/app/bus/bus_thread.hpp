// SPDX-License-Identifier: Apache-2.0
/// The loop of the bus thread: octets from the port to layer 2, replies back in their window, then what the
/// stations pass on, then snapshots. Nothing is decided here, nothing is allocated after start while the port
/// is open, nothing blocks but the wait for octets.
#pragma once

#include "app/links/links.hpp"
#include "bus_monitor.hpp"
#include "bus_port.hpp"
#include "station_set.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/fdl/layer2.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/ticker.hpp"

#include <memory>
#include <optional>
#include <stop_token>

namespace dpslave::app {

class BusThread {
public:
    /// `opener` lends the port, with `driver` attached to it, now or later. Both outlive the object. More and
    /// other stations come through BusLink::stations.
    BusThread(const config::BusConfig& config, BusPortOpener& opener, io::DriverEnable& driver,
              std::unique_ptr<BusStations> stations, BusLink& link);

    /// Serves the bus until `stop`; then every slave leaves it, with all that leaving means.
    void run(const std::stop_token& stop, io::EventFd& wake);

private:
    /// The longest wait: so often a sign of life is given, and deadlines that are further away are looked at.
    static constexpr std::chrono::milliseconds kTick{10};
    static constexpr std::uint64_t kManyTicks = kBusThreadMayStall / kTick / 2;
    static constexpr std::chrono::microseconds kSpin = BusSender::kSpin;
    static constexpr std::chrono::microseconds kLastLook{1};
    /// While a driver is to be switched off within this time nothing longer is begun.
    static constexpr std::chrono::microseconds kDriverMargin{200};
    /// How often the view of the whole bus is passed on.
    static constexpr std::chrono::milliseconds kMembersInterval{500};
    /// What is ready, in the epoll.
    static constexpr std::uint64_t kPortKey = 0, kWakeKey = 1, kTickKey = 2;

    Instant next_wake() const;
    bool octets_before(Instant when);
    void process(bool octets);
    void wait_for_window();
    void send();
    void count_turnaround(Instant written, Baud baud);
    void follow_rate();
    bool may_publish(Instant now) const;
    void publish(Instant now);
    void follow_memory();
    void publish_bus(Instant now);
    void update();
    void forward();
    void look_at_settings(Instant now);
    void set_again(const io::ChangedSettings& changed, Instant now);
    void leave_bus();

    io::Epoll epoll_;
    BusPort port_;
    fdl::Layer2 layer2_;
    StationSet stations_;
    BusMonitor monitor_;
    BusLink& link_;
    io::Ticker ticker_{kTick};
    bool update_due_ = true; ///< the stations are updated with each tick
    Histogram turnaround_us_;
    Histogram turnaround_tbit_;
    std::uint64_t too_late_ = 0;
    Instant processed_at_{}; ///< when layer 2 had the time last: right before a reply
    Instant next_bus_snapshot_{}, next_members_{};
    bool memory_is_ready_ = false;
    Instant published_until_{}; ///< what was due by then was looked at, one station at a time
    std::uint64_t faults_at_start_ = 0;
};

} // namespace dpslave::app
