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
        /// refused, and who may operate and write is as it says. `group`: that of the operators.
        std::function<void(const std::vector<Station>& left, std::optional<gid_t> group)> applied;
    };
    explicit Reload(Parts parts) : parts_(std::move(parts)) {}

    /// The method Reload. While one is in progress the next one waits; all calls that wait then share it.
    /// What cannot be read within kLongestReading is refused, and not done later.
    control::Reply request(bool dry_run, const control::Caller& caller);
    /// SIGHUP.
    void request() { wanted_ = true; }
    /// True: none is in progress and none is wanted, no trial either.
    bool is_idle() const { return step_ == Step::idle && !wanted_ && trials_.empty() && !is_trial_; }
    /// Does what can be done now, and answers a call that has waited too long.
    void advance(Instant now);

    static constexpr std::chrono::seconds kLongestReading{4}; ///< dpctl waits 5 s for an answer
    /// How long the answer waits for lines that are busy, and the next reload for drives that leave. Lines
    /// that stall are not waited for.
    static constexpr std::chrono::milliseconds kLongestTaking{500}, kLongestLeaving{3000};

private:
    /// The bus removes the stations that leave before their drives get the safe state, and only then stations
    /// and drives that are new take their places.
    enum class Step : std::uint8_t {
        idle,
        reading, ///< the file, the name service and the ports
        bus,     ///< the bus has not yet taken its new stations
        lines,   ///< the lines have not yet taken what is new for them
        drives,  ///< the drives of stations that left get the safe state
        told     ///< what happened to them is told
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
    void start(Instant now);
    void start_trial(Instant now);
    void carry_out(ReadConfig& read);
    Judged judge(ReadConfig& read);
    Outcome attempt(ReadConfig& read);
    void apply(Plan plan, std::optional<gid_t> group);
    void keep_drivers(const config::Config& before, const config::Config& now);
    std::vector<InForce> in_force() const;
    bool bus_has_taken();
    void tell(const std::string& before, Severity severity, const std::vector<std::string>& sentences) const;
    void answer();
    void answer_trials(const Outcome& outcome);
    void give_up_reading(Instant now);
    void answer_late(Instant now);

    Parts parts_;
    Step step_ = Step::idle;
    bool wanted_ = false;
    Outcome outcome_;                       ///< of the last one
    std::vector<control::ReplyTo> waiting_; ///< callers that wait for the next one
    std::vector<control::ReplyTo> current_; ///< and for the one in progress
    Instant waits_since_{};                 ///< the first of those that wait for the next one
    Instant began_{};                       ///< the one in progress
    Instant offered_{};                     ///< when its lines were told what is new for them
    Instant now_{};                         ///< of the last advance()
    std::vector<control::ReplyTo> trials_;  ///< callers of a dry run that wait for the next one
    std::vector<control::ReplyTo> tried_;   ///< and for the one in progress
    bool is_trial_ = false;                 ///< one is read for
    Instant trial_began_{};
    std::unique_ptr<BusStations> stations_; ///< to be offered to the bus
};

} // namespace dpslave::app
