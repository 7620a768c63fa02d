// SPDX-License-Identifier: Apache-2.0
/// The main thread: control socket, signals, lamps, log and sd_notify in one epoll. It answers from the
/// snapshots that it already holds and never asks the bus thread anything.
#pragma once

#include "app/bus/driver_guard.hpp"
#include "app/calls/control_methods.hpp"
#include "app/state/happenings.hpp"
#include "stalled_lines.hpp"

#include "dpslave/control/server.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/signals.hpp"

namespace dpslave::app {

class MainThread {
public:
    /// `config`: what `plant` was opened with; `profiles`: where its profiles were read from; `state`: the
    /// folder for incidents, empty: none. What `guard` had to do is logged.
    MainThread(config::Config config, const std::filesystem::path& profiles,
               const std::filesystem::path& state, Plant& plant, BusLink& bus, const DriverGuard& guard,
               io::Signals& signals);

    /// The last incident is written, and the lamps are off, by `limit` at the latest. `hanging`: what else
    /// does not end, a sentence each. False: something does not, as the log and the service manager are told.
    /// The socket is removed then, and this object cannot be destroyed.
    bool end(std::vector<std::string> hanging, Instant limit);
    /// The stations as they were seen last.
    std::span<const Station> stations() const { return monitor_.view().stations; }

    /// Opens the control socket. The reason of a failure is a sentence.
    std::optional<std::string> open_socket();

    /// Serves until SIGTERM or SIGINT (true), or until another thread had to end early (false). `begin`: the
    /// sentence that it has begun.
    bool run(const std::string& begin);
    /// What was told since run() returned, and what the log holds back. The threads have ended.
    void tell_rest();

private:
    void admit(std::optional<gid_t> operators);
    void serve_calls_if_due(Instant now);
    void on_applied(const std::vector<Station>& left, std::optional<gid_t> operators);
    std::chrono::milliseconds tick_length() const;
    void tick(Instant now);
    void tell_lines();
    void tell_stalls();
    void tell_news();
    void tell_device(const Station& station, const Sentence& news);
    void tell_bus_events(const Station& station);
    void tell_line(const DriveLine& line, const LineHappening& happening);
    void tell(Happened kind, Severity severity, std::string text);
    void tell_port_events();
    void let_log_level_end(Instant now);
    void feed_watchdog(Instant now);
    bool bus_has_stalled(Instant now);
    bool is_end_signalled();

    Plant& plant_;
    BusLink& bus_;
    const DriverGuard& guard_;
    io::Signals& signals_;
    io::Epoll epoll_;
    io::Notifier notifier_;
    Lamps lamps_;

    Monitor monitor_;
    ConfigFile file_;
    std::optional<control::Server> server_; ///< it uses methods_, and serves in run() only
    RecentEvents events_;
    EventStreams event_streams_{monitor_, events_};
    LogLevel log_level_;
    Happenings happenings_{events_,
                           [this](const Happening& one, Instant now) { incidents_.on_happening(one, now); }};
    std::vector<std::pair<std::shared_ptr<DriveLine>, LineHappening>>
        of_masters_; ///< told behind the bus events
    PendingAccesses accesses_{monitor_, plant_.lines(), happenings_};
    PendingProbes probes_{monitor_, plant_.lines()};
    Watchers watchers_{monitor_};
    Traces traces_;
    Incidents incidents_;
    Reload reload_{{file_, monitor_, plant_, bus_, lamps_, notifier_, happenings_,
                    [this](const std::vector<Station>& left, std::optional<gid_t> operators) {
                        on_applied(left, operators);
                    }}};
    ControlMethods methods_;

    Instant began_{};             ///< run()
    bool is_group_known_ = false; ///< of the operators
    bool serves_calls_ = false;
    std::string status_sent_;                          ///< to systemd
    std::uint64_t dropped_seen_ = 0, raised_seen_ = 0; ///< of the guard, as logged
    StalledLines stalled_lines_;
    Silence bus_silence_;
    bool bus_stall_told_ = false;
    Instant bus_seen_{}; ///< its sign, when the watchdog was fed
    Instant next_watchdog_{};
};

} // namespace dpslave::app
