// SPDX-License-Identifier: Apache-2.0
/// The main thread: control socket, signals, lamps, log and sd_notify in one epoll. It answers from the
/// snapshots that it already holds and never asks the bus thread anything.
#pragma once

#include "app/bus/driver_guard.hpp"
#include "app/limited_log.hpp"
#include "app/links.hpp"
#include "device_state.hpp"
#include "lamps.hpp"
#include "plant.hpp"
#include "report.hpp"

#include "dpslave/config/config.hpp"
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

class MainThread {
public:
    /// `config`: what `plant` was opened with; `profiles`: where its profiles were read from. What
    /// `guard` had to do is said in the log.
    MainThread(config::Config config, std::filesystem::path profiles, Plant& plant, BusLink& bus,
               const DriverGuard& guard, io::Signals& signals);

    /// For an end without the end of this object: no lamp is lit and no socket is there any more.
    void go_dark();

    /// Opens the control socket. The reason of a failure is a sentence.
    std::optional<std::string> open_socket();

    /// Serves until SIGTERM or SIGINT (true), or until another thread had to give up (false).
    bool run();

private:
    static constexpr std::chrono::milliseconds kTick{100};
    static constexpr std::chrono::milliseconds kTickWithDiagnosis{20}; ///< a trip is told the master soon
    static constexpr std::chrono::seconds kCountInterval{1};           ///< of CounterHistory
    static constexpr std::chrono::milliseconds kTickWhileAsked{
        5}; ///< while somebody waits for a drive or a reload

    /// One station, as this thread follows it; what is shown of it is in view_ at the same index.
    struct Post {
        Post(const Station& at_work, bool self_test_passed)
            : station(at_work), device(*station.config, self_test_passed)
        {}
        Station station;
        DeviceState device;
        BusOrders ordered; ///< as published last
    };
    struct Asked {
        std::uint32_t station = 0; ///< its number
        std::shared_ptr<const config::StationConfig> config;
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool is_write = false;
        bool is_survey = false;
        bool has_text = false; ///< of a survey: the protocol carries texts, not words
        control::Caller who;
        std::optional<std::string> before; ///< the value of the tag when it was asked, if it was known
    };
    /// Somebody waits for the search for a drive.
    struct Probing {
        std::shared_ptr<const config::StationConfig> config;
        std::string line, port;
        ProbeLength length;
        std::optional<std::uint64_t> stream; ///< none: he waits for the end only
        std::uint32_t told = 0;              ///< questions, as the stream was told last
    };
    struct Watcher {
        std::optional<std::string> station; ///< its name
        std::string seen;                   ///< what it was shown last, without the ages
    };

    // main_control.cpp, main_survey.cpp, main_tec.cpp
    control::Handlers handlers();
    control::Reply on_status();
    control::Reply on_each_station(const control::Json& parameters,
                                   control::Json (MainThread::*one)(std::size_t));
    control::Reply on_watch(const control::Json& parameters);
    control::Reply on_tag(const control::Json& parameters, const control::Caller& who, bool is_write);
    control::Reply on_survey_scope(const control::Json& parameters);
    control::Reply on_survey(const control::Json& parameters, const control::Caller& who);
    control::Reply answer_of(const Asked& asked, const drive::OperateAnswer& answer) const;
    control::Reply survey_answer_of(const Asked& asked, const drive::OperateAnswer& answer) const;
    control::Reply on_tec(const control::Json& parameters);
    control::Reply on_set_tec(const control::Json& parameters, const control::Caller& who);
    control::Json info_of(std::size_t station);
    bool has_place_for(const control::Caller& who) const;
    std::optional<std::string> known_value(std::size_t station, std::uint16_t tag) const;
    static void log_write(const Asked& asked, std::string_view outcome);
    void log_unanswered() const;
    control::Json io_of(std::size_t station);
    control::Json diagnosis_of(std::size_t station);
    control::Json leds_of(std::size_t station);
    control::Json watch_reply(std::optional<std::size_t> station, Instant now) const;
    std::string fingerprint(std::optional<std::size_t> station) const;
    std::optional<std::uint8_t> master_that_writes(std::uint32_t station, std::uint16_t tag) const;
    void answer_asked();
    // main_probe.cpp
    control::Reply on_probe(const control::Json& parameters, const control::Caller& who);
    void answer_probes();
    void push_watchers(Instant now);

    /// Which station `parameters` name: by name or address. An error when there is none, or none was named
    /// and several are there.
    struct Choice {
        std::optional<std::size_t> station;
        std::optional<control::Error> error;
    };
    Choice choose(const control::Json& parameters, bool one_is_needed) const;
    control::Error no_such_station(const std::string& wanted) const;
    control::Json known_stations() const;
    std::optional<std::size_t> index_of(const std::string& name) const;
    const config::StationConfig& config_of(std::size_t station) const
    {
        return *posts_[station].station.config;
    }

    // main_thread.cpp
    Post make_post(const Station& station);
    void show_posts();
    void refresh();
    void count_recent(Instant now);
    void refresh_troubles(std::size_t station);
    void follow_device(std::size_t station);
    void log_events(const Station& station);
    void log_news();
    void log_port_news();
    std::chrono::milliseconds tick_length() const;
    void show_lamps(Instant now);
    void feed_watchdog(Instant now);
    void tick(Instant now);
    bool on_signals();
    void look_at_file(Instant now);
    void remember_file(const config::Config* config);

    // main_reload.cpp
    /// What a reload came to, as the method Reload tells it.
    struct Reloaded {
        bool applied = false;
        std::vector<std::string> changes, pending, warnings, faults;
        std::vector<Plan::Leaving> leaving;
    };
    /// What it would come to, and the plan; none where there are faults.
    struct Judged {
        Reloaded result;
        std::optional<Plan> plan;
    };
    /// Where a reload stands. Another one begins when it is idle again.
    enum class Reloading : std::uint8_t {
        idle,
        bus,   ///< the bus is to take its new set of stations
        drives ///< the drives of those who left get their safe state
    };
    control::Reply on_reload(const control::Json& parameters);
    static control::Json reply_of(const Reloaded& reloaded);
    void mind_reload();
    void reload();
    Judged judge_file();
    std::vector<InForce> in_force() const;
    Reloaded try_reload();
    std::optional<std::string> apply(Plan plan);
    void repost();
    void answer_those_who_asked();
    void answer_reload();
    bool bus_has_let_go();

    config::Config config_; ///< as it is in force
    std::filesystem::path profiles_;
    Plant& plant_;
    BusLink& bus_;
    const DriverGuard& guard_;
    std::uint64_t dropped_seen_ = 0; ///< of the guard, as said in the log
    io::Signals& signals_;
    Lamps lamps_;
    io::Epoll epoll_;
    io::Notifier notifier_;
    std::optional<control::Server> server_;

    View view_;
    std::vector<Post> posts_; ///< in the order of config_.stations
    bool self_test_passed_;
    std::chrono::milliseconds usual_tick_ = kTick;
    Instant started_{};
    Instant next_count_{};
    std::map<std::uint32_t, Asked> asked_;     ///< by the number of the order
    std::uint32_t next_order_ = 1;             ///< of an order or of another answer that is given later
    std::map<std::uint32_t, Probing> probing_; ///< by the number of the order
    static constexpr std::size_t kMaxProbes = 2;
    std::map<std::uint64_t, Watcher> watchers_;
    std::uint64_t next_stream_ = 1;
    std::string status_said_;
    std::uint64_t heartbeat_seen_ = 0;
    Instant next_watchdog_{};
    Instant next_look_{};                                        ///< at the configuration file
    std::filesystem::file_time_type file_read_{};                ///< its time when it was read last
    std::map<std::string, std::uint8_t, std::less<>> in_file_{}; ///< addresses in it, by the station's name
    LimitedLog log_;
    static constexpr std::size_t kMaxAsked = 16;         ///< what the rings of a line can hold
    static constexpr std::size_t kMaxAskedByOthers = 12; ///< of those who are no operators, all together
    static constexpr std::size_t kMaxAskedByOne = 4;     ///< of one user id that is not root
    static constexpr std::chrono::seconds kFileTick{1};

    Reloading reloading_ = Reloading::idle;
    bool reload_wanted_ = false;
    Reloaded reloaded_;                       ///< of the last one
    std::vector<std::uint32_t> reload_asked_; ///< who waits for the next one
    std::vector<std::uint32_t> reload_told_;  ///< who waits for the one that is under way
    std::vector<Station> leaving_;            ///< kept until bus and drives are done with them
    std::uint64_t lost_before_ = 0;           ///< events that stations which left could not tell
    std::unique_ptr<BusStations> bus_set_;    ///< to be offered to the bus
};

} // namespace dpslave::app
