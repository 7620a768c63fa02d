// SPDX-License-Identifier: Apache-2.0
/// One drive of a Poller: joins reads, outputs and orders into "what next", and carries results to them.
#pragma once

#include "cyclic_work.hpp"
#include "demand_queue.hpp"
#include "drive_link.hpp"
#include "operate_queue.hpp"
#include "order_turn.hpp"
#include "safe_state.hpp"
#include "survey_slot.hpp"
#include "unit_tags.hpp"

#include "dpslave/drive/poller.hpp"

#include <array>

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
    void cancel_ride_through() { safe_state_.cancel_ride_through(); }
    void leave_port();
    void port_changed();
    void go_on_as(std::size_t index, const UnitSettings& settings);

    void set_now(Instant now);                    ///< before next(), of this drive or another
    std::optional<Transaction> next(Instant now); ///< precondition: not lost
    Transaction probe() const;
    std::optional<Transaction> next_survey(Instant now) const;
    void done(const Transaction& transaction, const Outcome& outcome, Instant now);
    Instant next_deadline() const;

    const DriveLink& link() const { return link_; }
    /// When it may be probed next, as far as it alone is concerned. Of a lost drive.
    Instant probe_due() const { return asked_at_ + settings_.probe_interval; }
    std::chrono::nanoseconds probe_interval() const { return settings_.probe_interval; }
    Instant asked_at() const { return asked_at_; }
    /// A transaction has timed out: this drive has its round before one that may do so again.
    void owe_round() { owes_round_ = true; }
    bool owes_round() const { return owes_round_ && !link_.is_in_doubt(); }

    std::optional<InputImage> take_inputs();
    std::optional<DemandAnswer> take_demand_answer() { return demand_.take_answer(); }
    std::optional<OperateAnswer> take_operate_answer();
    bool safe_state_pending() const
    {
        return safe_state_.pending() && !(cyclic_.outputs().leaves_port() && link_.is_lost());
    }
    const UnitSnapshot& snapshot() const { return snapshot_; }

private:
    /// How far the outputs of the present layout have come.
    enum class Phase : std::uint8_t {
        before_data_exchange, ///< the layout had no may_write yet
        waits,                ///< the master wants them written, but not now: the port is changed
        writing,
        safe, ///< sent to their safe state
    };
    bool has_ended(Generation generation) const;
    void new_layout(const OutputImage& image);
    void begin_writing();
    void end_layout();
    void zero_outputs();

    std::optional<Transaction> asked(Instant now);
    std::optional<Transaction> ordered();
    Transaction write(Purpose purpose, const Tag* row, std::uint16_t word);
    void begin_round(Instant now);

    AccessError judge(const Transaction& transaction, const Outcome& outcome);
    void defer(const Transaction& transaction, Instant now);
    bool proven_by_reading(const Transaction& transaction) const;
    void note_answer(Instant now);
    void note_silence();
    void show();

    UnitSettings settings_;
    std::size_t index_;
    UnitTags tags_;

    OutputImage image_;    ///< of the last set_outputs()
    Generation ended_ = 0; ///< the newest that has ended
    Phase phase_ = Phase::before_data_exchange;
    CyclicWork cyclic_;
    SafeState safe_state_;
    DemandQueue demand_;
    OperateQueue operates_;
    SurveySlot survey_;
    std::uint32_t order_ = 0;             ///< of Demand Data, under way
    std::array<std::uint16_t, 1> word_{}; ///< of a single write under way

    OrderTurn turn_;
    bool zero_waits_ = false; ///< the last zero was not answered or not held: something else first
    bool wrote_last_ = false; ///< since the last cyclic read: now a cyclic read first
    bool owes_round_ = false;

    DriveLink link_;
    Instant asked_at_{};    ///< end of the last transaction
    int deferred_ = 0;      ///< transactions in a row
    Instant rests_until_{}; ///< nothing can be asked before, as far as is known
    bool inputs_changed_ = false;
    UnitSnapshot snapshot_;
};

} // namespace dpslave::drive
