// SPDX-License-Identifier: Apache-2.0
/// The main thread: control socket, signals, lamps, log and sd_notify in one epoll. It answers from the
/// snapshots that it already holds and never asks the bus thread anything.
#pragma once

#include "app/bus/driver_guard.hpp"
#include "app/limited_log.hpp"
#include "app/watch/drive_news.hpp"
#include "control_methods.hpp"

#include "dpslave/io/epoll.hpp"
#include "dpslave/io/signals.hpp"

namespace dpslave::app {

class MainThread {
public:
    /// `config`: what `runtime` was opened with; `profiles`: where its profiles were read from; `state`: the
    /// folder for incidents, empty: none. What `guard` had to do is logged.
    MainThread(config::Config config, const std::filesystem::path& profiles,
               const std::filesystem::path& state, Runtime& runtime, BusLink& bus, const DriverGuard& guard,
               io::Signals& signals);

    /// For an end without the destructor: switches the lamps off and removes the socket.
    void release();
    /// The last incident is written. False: the disk hangs, and this object cannot be destroyed.
    bool end_incidents() { return incidents_.end(std::chrono::seconds{2}); }

    /// Opens the control socket. The reason of a failure is a sentence.
    std::optional<std::string> open_socket();

    /// Serves until SIGTERM or SIGINT (true), or until another thread had to end early (false).
    bool run();

private:
    void admit_operators();
    std::chrono::milliseconds tick_length() const;
    void tick(Instant now);
    void log_news();
    void log_events(const Station& station);
    void log_port_events();
    void let_log_level_end(Instant now);
    void feed_watchdog(Instant now);
    bool is_end_signalled();

    Runtime& runtime_;
    BusLink& bus_;
    const DriverGuard& guard_;
    io::Signals& signals_;
    io::Epoll epoll_;
    io::Notifier notifier_;
    Lamps lamps_;
    LimitedLog log_;

    Monitor monitor_;
    ConfigFile file_;
    Replies replies_; ///< its server uses methods_, and serves in run() only
    EventHistory events_;
    EventStreams event_streams_{monitor_, events_, replies_};
    DriveNews drive_news_;
    LogLevel log_level_;
    PendingAccesses accesses_{monitor_, runtime_, replies_, events_};
    PendingProbes probes_{monitor_, runtime_, replies_};
    Watchers watchers_{monitor_, replies_};
    Traces traces_;
    Incidents incidents_;
    Reload reload_{{file_, monitor_, runtime_, bus_, lamps_, accesses_, replies_, notifier_, events_}};
    ControlMethods methods_;

    std::string status_sent_;        ///< to systemd
    std::uint64_t dropped_seen_ = 0; ///< of the guard, as logged
    std::uint64_t heartbeat_seen_ = 0;
    Instant next_watchdog_{};
};

} // namespace dpslave::app
