// SPDX-License-Identifier: Apache-2.0
/// One drive of a Poller: joins reads, outputs and orders into "what next", and carries results to them.
#pragma once

#include "cyclic_work.hpp"
#include "drive_contact.hpp"
#include "drive_orders.hpp"
#include "drive_tags.hpp"
#include "safe_state.hpp"

#include "dpslave/drive/poller.hpp"

#include <optional>

namespace dpslave::drive {

class Poller::Unit {
public:
    Unit(const DriveSettings& settings, BlockRule rule, std::size_t index);

    void heard(Instant valid_at) { contact_.presence().heard(valid_at); }
    void set_outputs(const OutputImage& image);
    void left_data_exchange(Generation generation);
    void set_demand(const DemandOrder& order);
    bool operate(const OperateOrder& order);
    void not_asked(Instant now);
    void withdraw(std::uint32_t number) { orders_.withdraw(number); }
    bool survey(std::uint32_t number, std::uint16_t tag, std::optional<MnemonicRule> rule);

    void set_zero_after(ZeroAfter after) { safe_state_.set_zero_after(after); }
    void cancel_ride_through()
    {
        safe_state_.cancel_ride_through();
        contact_.ask_at_once();
    }
    void end_ride() { safe_state_.end_ride(); }
    void leave_port();
    void port_changed();
    void go_on_as(std::size_t index, const DriveSettings& settings);

    /// Before next(), of this drive or another. True: it is gone, or appears, since now.
    bool set_now(Instant now);
    std::optional<Transaction> next(Instant now); ///< precondition: not lost
    Transaction probe() const;
    std::optional<Transaction> next_survey(Instant now) const;
    void done(const Transaction& transaction, const Outcome& outcome, Instant began, Instant now);
    Instant next_deadline() const;

    const DriveContact& contact() const { return contact_; }
    /// A transaction has timed out: this drive has its round before one that may do so again.
    void owe_round() { owes_round_ = true; }
    bool owes_round() const { return owes_round_ && !link().is_in_doubt(); }

    std::optional<InputImage> take_inputs();
    std::optional<DemandAnswer> take_demand_answer() { return orders_.take_demand_answer(); }
    std::optional<OperateAnswer> take_operate_answer() { return orders_.take_operate_answer(); }
    bool safe_state_pending() const
    {
        return safe_state_.pending() && !(cyclic_.outputs().leaves_port() && link().is_lost());
    }
    std::vector<ZeroLeft> safe_state_left() const
    {
        return safe_state_pending() ? safe_state_.zeros_left() : std::vector<ZeroLeft>{};
    }
    const DriveSnapshot& snapshot() const { return snapshot_; }

private:
    /// How far the outputs of the present layout have come.
    enum class Phase : std::uint8_t {
        before_data_exchange, ///< the layout had no may_write yet
        waits,                ///< the master wants them written, but not now: the port is changed
        writing,
        safe, ///< sent to their safe state
    };
    DriveLink& link() { return contact_.link(); }
    const DriveLink& link() const { return contact_.link(); }
    Presence& presence() { return contact_.presence(); }
    const Presence& presence() const { return contact_.presence(); }

    bool has_ended(Generation generation) const;
    void new_layout(const OutputImage& image);
    void begin_writing();
    void end_layout();
    void zero_outputs();

    std::optional<Transaction> asked(Instant now);
    void begin_round(Instant now);

    void note_sent(const Transaction& transaction, const Outcome& outcome, Instant now);
    void note_scale(const Transaction& transaction, const Outcome& outcome, Instant now);
    AccessError judge(const Transaction& transaction, const Outcome& outcome);
    void defer(const Transaction& transaction, Instant now);
    bool must_be_new(Purpose purpose) const;
    bool proven_by_reading(const Transaction& transaction) const;
    void note_answer(Instant now);
    void note_silence(Instant began, Instant now);
    void lose(Instant now);
    bool note_presence(Instant now);
    void show();

    DriveSettings settings_;
    std::size_t index_;
    DriveTags tags_;

    OutputImage image_;    ///< of the last set_outputs()
    Generation ended_ = 0; ///< the newest that has ended
    Phase phase_ = Phase::before_data_exchange;
    CyclicWork cyclic_;
    SafeState safe_state_;
    DriveOrders orders_;
    bool probes_next_ = false; ///< what was to be asked is deferred, and the drive may be lost
    bool zero_waits_ = false;  ///< the last zero was not answered or not held: something else first
    bool wrote_last_ = false;  ///< since the last cyclic read: now a cyclic read first
    bool owes_round_ = false;

    DriveContact contact_;
    bool inputs_changed_ = false;
    DriveSnapshot snapshot_;
};

} // namespace dpslave::drive
