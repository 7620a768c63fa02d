// SPDX-License-Identifier: Apache-2.0
/// One drive of a Poller: joins reads, outputs and orders into "what next", and keeps the state of the link.
#pragma once

#include "demand_queue.hpp"
#include "output_plan.hpp"
#include "read_plan.hpp"
#include "safe_state.hpp"
#include "survey_slot.hpp"
#include "unit_tags.hpp"

#include "dpslave/drive/poller.hpp"

#include <array>
#include <deque>

namespace dpslave::drive {

class Poller::Unit {
public:
    Unit(const UnitSettings& settings, BlockRule rule, std::size_t index);

    void set_outputs(const OutputImage& image);
    void left_data_exchange(Generation generation);
    void set_demand(const DemandOrder& order);
    bool operate(const OperateOrder& order);
    bool survey(std::uint32_t number, std::uint16_t tag);

    void set_zero_after(ZeroAfter after) { safe_state_.set_zero_after(after); }
    void ride_no_longer() { safe_state_.ride_no_longer(); }
    void leave_port();
    void port_changed();
    void go_on_as(std::size_t index, const UnitSettings& settings);

    void tell_time(Instant now) ///< before next(), of this drive or another
    {
        safe_state_.tell_time(now);
        snapshot_.ride_ends = safe_state_.ride_ends();
    }
    std::optional<Transaction> next(Instant now); ///< precondition: not lost
    Transaction probe() const;
    std::optional<Transaction> next_survey(Instant now) const;
    void done(const Transaction& transaction, const Outcome& outcome, Instant now);
    Instant next_deadline() const;

    bool is_lost() const { return lost_; }
    /// Is its next transaction likely to time out?
    bool is_in_doubt() const { return lost_ || silences_ > 0; }
    /// When it may be probed next, as far as it alone is concerned. Of a lost drive.
    Instant probe_due() const { return asked_at_ + settings_.probe_interval; }
    std::chrono::nanoseconds probe_interval() const { return settings_.probe_interval; }
    Instant asked_at() const { return asked_at_; }
    /// A transaction has timed out: this drive has its round before one that may do so again.
    void owe_round() { owes_round_ = true; }
    bool owes_round() const { return owes_round_ && !is_in_doubt(); }

    std::optional<InputImage> take_inputs();
    std::optional<DemandAnswer> take_demand_answer() { return demand_.take_answer(); }
    std::optional<OperateAnswer> take_operate_answer();
    bool safe_state_pending() const { return safe_state_.pending() && !(leaves_port_ && lost_); }
    const UnitSnapshot& snapshot() const { return snapshot_; }

private:
    struct WaitingOperate {
        OperateOrder order;
        const Tag* row = nullptr;
        int attempts = 0;
        bool written = false; ///< the drive has said so: now it is read back
    };
    /// What the transaction under way is for.
    struct Job {
        std::uint32_t layout = 0; ///< serial_ when it was given
        ReadPlan::Block block{};
        Instant began{};
        std::uint32_t order = 0;
    };

    bool has_ended(Generation generation) const;

    void new_layout(const OutputImage& image);
    void begin_writing();
    void end_layout();
    void zero_outputs();

    std::optional<Transaction> asked(Instant now);
    std::optional<Transaction> ordered();
    std::optional<Transaction> cyclic(Instant now);
    std::optional<Transaction> cyclic_read(Instant now);
    std::optional<Transaction> idle_probe(Instant now) const;
    Transaction make_read(Purpose purpose, const Tag* row) const;
    Transaction make_write(Purpose purpose, const Tag* row, std::span<const std::uint16_t> words) const;
    Transaction make_write(Purpose purpose, const Tag* row, std::uint16_t word);
    void begin_round(Instant now);

    AccessError judged(const Transaction& transaction, const Outcome& outcome);
    bool is_repeated(AccessError error, int& not_understood) const;
    void defer(const Transaction& transaction, Instant now);
    bool proven_by_reading(const Transaction& transaction) const;
    void link(bool answered, Instant now);
    void lose();
    void done_read(const Outcome& outcome, Instant now);
    void compare(const Outcome& outcome);
    void done_output(AccessError error, Instant now);
    void done_zero(const Transaction& transaction, const Outcome& outcome, Instant now);
    void done_demand(const Transaction& transaction, const Outcome& outcome);
    void done_operate(const Transaction& transaction, const Outcome& outcome);
    void count(const Transaction& transaction, AccessError error);
    void show();
    bool is_only_repeated(WordState state, int failures) const;
    void show_form(const OutputPlan::Item& output);
    void show_inputs();
    void show_watched();

    UnitSettings settings_;
    std::size_t index_;
    UnitTags tags_;

    OutputImage image_;         ///< as told last
    std::uint32_t serial_ = 0;  ///< counts layouts: a result for an older one is dropped
    Generation ended_ = 0;      ///< the newest that has ended
    bool master_wrote_ = false; ///< the present layout had may_write
    bool writing_ = false;      ///< the outputs of the present layout are written
    bool zeroed_ = false;       ///< the outputs of the present layout were sent to their safe state
    bool leaves_port_ = false;  ///< between leave_port() and port_changed()
    ReadPlan reads_;
    OutputPlan outputs_;
    SafeState safe_state_;
    DemandQueue demand_;
    std::deque<WaitingOperate> operates_;
    std::deque<OperateAnswer> operate_answers_;
    SurveySlot survey_;
    Job job_;
    std::array<std::uint16_t, 1> word_{}; ///< of a single write under way

    int orders_in_round_ = 0;     ///< transactions of Demand Data in this round
    bool order_was_last_ = false; ///< of Demand Data or dpctl: now a cyclic one first
    bool zero_waits_ = false;     ///< the last zero was not answered or not held: something else first
    bool in_round_ = false;       ///< something was read for the master since the round began
    std::optional<Instant> round_began_;

    int inputs_not_understood_ = 0; ///< in a row; the same for the others
    int outputs_not_understood_ = 0;
    int zeros_not_understood_ = 0;
    int silences_ = 0; ///< in a row
    bool lost_ = false;
    bool ever_asked_ = false;
    Instant asked_at_{};      ///< end of the last transaction
    bool wrote_last_ = false; ///< the last transaction was a write: now a read first
    bool owes_round_ = false;
    int deferred_ = 0;      ///< transactions in a row
    Instant rests_until_{}; ///< nothing can be asked before, as far as is known
    bool inputs_changed_ = false;
    UnitSnapshot snapshot_;
};

} // namespace dpslave::drive
