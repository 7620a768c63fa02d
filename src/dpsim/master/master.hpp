// SPDX-License-Identifier: Apache-2.0
/// A DP master (class 1) for one slave, and a check of what the slave answers. It is pure: octets and times
/// go in, telegrams, deadlines and events come out (wire reference, sections 2.6, 4 and 5).
#pragma once

#include "diagnosis.hpp"
#include "requester.hpp"

#include <deque>

namespace dpslave::sim {

struct MasterEvent {
    enum class Kind : std::uint8_t {
        state,     ///< the state has changed
        refused,   ///< start-up failed: the slave refuses; the master tries again later
        lost,      ///< no answer any more
        violation, ///< the slave did what a slave must not do
        diagnosis, ///< it was read in data exchange, and is another one than before
        answer,    ///< an order is done
    };
    Kind kind = Kind::state;
    std::string words{};
    std::optional<Answer> answer{};
};

/// Call after every on_*: take_transmit(), then take_event() until empty, then next_deadline().
class Master {
public:
    explicit Master(MasterSettings settings);
    Master(const Master&) = delete; // its requester knows its settings by their place
    Master& operator=(const Master&) = delete;

    void on_bytes(Bytes octets, Instant now);
    void on_time(Instant now);
    /// A telegram to be written now; the slot time runs from `now` plus its length on the wire.
    std::optional<Octets> take_transmit(Instant now) { return requester_.take_transmit(now); }
    Instant next_deadline() const;
    std::optional<MasterEvent> take_event();

    void start(); ///< begins the start-up; does nothing if it is running
    void stop();  ///< sends nothing more, from now on
    void order(Order order) { orders_.push_back(std::move(order)); }
    void clear(bool on); ///< Clear: zeros go out and a Global_Control says so; false = Operate

    Octets& outputs() { return outputs_; }   ///< what is sent while not in Clear
    Bytes inputs() const { return inputs_; } ///< last good answer; empty before the first
    MasterState state() const { return state_; }
    const std::optional<Diagnosis>& diagnosis() const { return diagnosis_; }
    const MasterCounters& counters() const { return counters_; }
    const MasterSettings& settings() const { return settings_; }
    CfgLengths lengths() const { return lengths_; }

private:
    std::optional<Order> cyclic_order() const;
    Order mode_order() const;
    void take(const Requester::Outcome& outcome, Instant now);
    void lost(const Requester::Outcome& outcome);
    void report(Answer answer);

    void on_slave_diag(const Requester::Outcome& outcome, Instant now);
    void on_data_exchange(const Requester::Outcome& outcome);
    void on_negative(const Requester::Outcome& outcome, Instant now);
    void judge_start_up(const Diagnosis& diagnosis, Instant now);
    void refuse(std::string why, Instant now);
    void leave_exchange(std::string why, MasterState to);
    void enter(MasterState state);
    void report_violation(std::string words);

    MasterSettings settings_;
    CfgLengths lengths_;
    MasterState state_ = MasterState::stopped;
    Octets outputs_, inputs_;
    bool clear_ = false;
    bool diagnosis_due_ = false;
    std::optional<Diagnosis> diagnosis_;
    Octets reported_diagnosis_; ///< reported once, not at every reading

    Instant next_cycle_{};
    std::deque<Order> orders_;
    std::deque<MasterEvent> events_;
    std::string last_refusal_; ///< reported once, not at every attempt
    std::string cfg_refusal_;  ///< Chk_Cfg was answered with RS, RR or UE
    MasterCounters counters_;
    Requester requester_{settings_, counters_};
};

} // namespace dpslave::sim
