// SPDX-License-Identifier: Apache-2.0
/// The configuration is read again while the program runs: SIGHUP, or the method Reload. The file is judged
/// as a whole; then all of it is done, or nothing. Main thread only.
#pragma once

#include "app/state/happenings.hpp"
#include "app/state/lamps.hpp"
#include "app/state/monitor.hpp"
#include "config_file.hpp"
#include "plant.hpp"

#include "dpslave/io/notify.hpp"

namespace dpslave::app {

class Reload {
public:
    /// All outlive this object.
    struct Parts {
        ConfigFile& file;
        Monitor& monitor;
        Plant& plant;
        BusLink& bus;
        Lamps& lamps;
        io::Notifier& notifier;
        Happenings& happenings;
        /// A new configuration is in force: the calls that wait for one of the stations that have left are
        /// refused, and who may operate and write is as it says.
        std::function<void(const std::vector<Station>& left)> applied;
    };
    explicit Reload(Parts parts) : parts_(std::move(parts)) {}

    /// The method Reload. While one is in progress the next one waits; all calls that wait then share it.
    control::Reply request(bool dry_run, const control::Caller& caller);
    /// SIGHUP.
    void request() { wanted_ = true; }
    /// True: none is in progress and none is wanted.
    bool is_idle() const { return step_ == Step::idle && !wanted_; }
    /// Does what can be done now, and answers a call that has waited too long.
    void advance();

private:
    /// The bus removes the stations that leave before their drives get the safe state, and only then stations
    /// and drives that are new take their places.
    enum class Step : std::uint8_t {
        idle,
        bus,    ///< the bus has not yet taken its new stations
        drives, ///< the drives of stations that left get the safe state
        told    ///< what happened to them is told
    };
    /// The reply of the method.
    struct Outcome {
        bool applied = false;
        std::vector<std::string> changes, pending, warnings, faults;
        std::vector<Plan::Leaving> leaving;
    };
    /// What it would come to, and the plan; no plan where there are faults.
    struct Judged {
        Outcome outcome;
        std::optional<Plan> plan;
    };

    static control::Json reply_of(const Outcome& outcome);
    void start();
    Judged judge();
    Outcome attempt();
    void apply(Plan plan);
    std::vector<InForce> in_force() const;
    bool bus_has_taken();
    void tell(const std::string& before, Severity severity, const std::vector<std::string>& sentences) const;
    void answer();
    void answer_late();

    Parts parts_;
    Step step_ = Step::idle;
    bool wanted_ = false;
    Outcome outcome_;                       ///< of the last one
    std::vector<control::ReplyTo> waiting_; ///< callers that wait for the next one
    std::vector<control::ReplyTo> current_; ///< and for the one in progress
    Instant waits_since_{};                 ///< the first of those that wait for the next one
    Instant began_{};                       ///< the one in progress
    std::unique_ptr<BusStations> stations_; ///< to be offered to the bus
};

} // namespace dpslave::app
