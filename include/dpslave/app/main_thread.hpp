// SPDX-License-Identifier: Apache-2.0
/// The main thread: control socket, signals, lamps, log and sd_notify in one epoll. It answers from the
/// snapshots that it already holds and never asks the bus thread anything.
#pragma once

#include "dpslave/app/config.hpp"
#include "dpslave/app/device_state.hpp"
#include "dpslave/app/lamps.hpp"
#include "dpslave/app/links.hpp"
#include "dpslave/app/report.hpp"
#include "dpslave/control/server.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/notify.hpp"
#include "dpslave/io/signals.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

/// The other threads, as the main thread reaches them.
struct Links {
    std::vector<std::unique_ptr<StationLink>> stations; ///< in the order of config.stations
    std::vector<std::unique_ptr<LineLink>> lines;       ///< in the order of config.lines
    BusLink bus;
};

class MainThread {
public:
    /// `profiles`: where the configuration was read from, to read it again when somebody asks for a pending
    /// address.
    MainThread(const Config& config, std::filesystem::path profiles, Links& links, Lamps& lamps,
               io::Signals& signals);

    /// Opens the control socket. The reason of a failure is a sentence.
    std::optional<std::string> open_socket();

    /// Serves until SIGTERM or SIGINT (true), or until another thread had to give up (false).
    bool run();

private:
    static constexpr std::chrono::milliseconds kTick{100};
    static constexpr std::chrono::milliseconds kTickWithDiagnosis{20}; ///< a trip is told the master soon
    static constexpr std::chrono::milliseconds kTickWhileAsked{5};     ///< while somebody waits for a drive

    struct Asked {
        std::size_t station = 0;
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool is_write = false;
    };
    struct Watcher {
        std::optional<std::size_t> station;
        std::string seen; ///< what it was shown last, without the ages
    };

    control::Handlers handlers();
    control::Reply on_status();
    control::Reply on_each_station(const control::Json& parameters,
                                   control::Json (MainThread::*one)(std::size_t));
    control::Reply on_watch(const control::Json& parameters);
    control::Reply on_tag(const control::Json& parameters, bool is_write);
    control::Reply on_info(const control::Json& parameters);
    control::Reply on_tec(const control::Json& parameters);
    control::Reply on_set_tec(const control::Json& parameters);
    control::Json info_of(std::size_t station);
    void read_file_again();
    control::Json io_of(std::size_t station);
    control::Json diagnosis_of(std::size_t station);
    control::Json leds_of(std::size_t station);
    control::Json watch_reply(std::optional<std::size_t> station, Instant now) const;
    std::string fingerprint(std::optional<std::size_t> station) const;

    /// Which station `parameters` name: by name or address. An error when there is none, or none was named
    /// and several are there.
    struct Choice {
        std::optional<std::size_t> station;
        std::optional<control::Error> error;
    };
    Choice choose(const control::Json& parameters, bool one_is_needed) const;
    control::Json known_stations() const;
    /// Index of a station among those on its line.
    std::size_t unit_of(std::size_t station) const;

    void refresh();
    void follow_device(std::size_t station);
    void log_events();
    void log_devices();
    std::chrono::milliseconds tick_length() const;
    void show_lamps(Instant now);
    void answer_asked();
    void push_watchers(Instant now);
    void feed_watchdog(Instant now);
    void tick(Instant now);
    bool on_signals();

    const Config& config_;
    std::filesystem::path profiles_;
    Links& links_;
    Lamps& lamps_;
    io::Signals& signals_;
    io::Epoll epoll_;
    io::Notifier notifier_;
    std::optional<control::Server> server_;

    View view_;
    std::vector<DeviceState> devices_; ///< in the order of config.stations
    std::vector<BusOrders> ordered_;   ///< of each, as published last
    std::chrono::milliseconds usual_tick_ = kTick;
    Instant started_{};
    std::map<std::uint32_t, Asked> asked_; ///< by the number of the order
    std::uint32_t next_order_ = 1;
    std::map<std::uint64_t, Watcher> watchers_;
    std::uint64_t next_stream_ = 1;
    std::string status_said_;
    std::uint64_t heartbeat_seen_ = 0;
    Instant next_watchdog_{};
    bool bus_open_ = true;
    std::filesystem::file_time_type file_read_{}; ///< when the configuration file was changed last
    std::map<std::string, std::uint8_t, std::less<>> in_file_{}; ///< addresses in it, by the station's name
    static constexpr std::size_t kMaxAsked = 16;                 ///< what the rings of a line can hold
};

} // namespace dpslave::app
