// SPDX-License-Identifier: Apache-2.0
/// The configuration is read again while the program runs: SIGHUP, or the method Reload. The file is judged
/// as a whole; then all of it is done, or nothing. Main thread only.
#pragma once

#include "config_file.hpp"
#include "lamps.hpp"
#include "pending_accesses.hpp"

#include "dpslave/io/notify.hpp"

namespace dpslave::app {

class Reload {
public:
    /// All outlive this object.
    struct Parts {
        ConfigFile& file;
        Monitor& monitor;
        Runtime& runtime;
        BusLink& bus;
        Lamps& lamps;
        PendingAccesses& accesses;
        Replies& replies;
        io::Notifier& notifier;
        EventHistory& events;
    };
    explicit Reload(const Parts& parts) : parts_(parts) {}

    /// The method Reload. While one is in progress the next one waits; all calls that wait then share it.
    control::Reply request(bool dry_run);
    /// SIGHUP.
    void request() { wanted_ = true; }
    /// True: none is in progress and none is wanted.
    bool is_idle() const { return step_ == Step::idle && !wanted_; }
    /// Does what can be done now.
    void advance();

private:
    /// The bus removes the stations that leave before their drives get the safe state, and only then stations
    /// and drives that are new take their places.
    enum class Step : std::uint8_t {
        idle,
        bus,   ///< the bus has not yet taken its new stations
        drives ///< the drives of stations that left get the safe state
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
    std::optional<std::string> apply(Plan plan);
    std::vector<InForce> in_force() const;
    bool bus_has_taken();
    void record() const;
    void answer();

    Parts parts_;
    Step step_ = Step::idle;
    bool wanted_ = false;
    Outcome outcome_;                       ///< of the last one
    std::vector<std::uint32_t> waiting_;    ///< tokens of calls that wait for the next one
    std::vector<std::uint32_t> current_;    ///< and for the one in progress
    std::unique_ptr<BusStations> stations_; ///< to be offered to the bus
};

} // namespace dpslave::app
