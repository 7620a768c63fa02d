// SPDX-License-Identifier: Apache-2.0
/// The outputs of layouts that have ended and that no layout writes any more: each is written 0 when its ride
/// through the loss of the master is over (RIDE THROUGH of HA463561U002, X-46). If the answer to a write
/// names nothing (EI-ASCII), a read-back has to show the 0; all zeros are written before the first is read.
#pragma once

#include "read_plan.hpp"
#include "transactions.hpp"

#include <optional>
#include <vector>

namespace dpslave::drive {

class SafeState {
public:
    explicit SafeState(ZeroAfter after) : after_(after) {}

    /// Also for rides that are under way: they count from the loss, whenever that was.
    void set_zero_after(ZeroAfter after) { after_ = after; }
    /// Outputs that would be zeroed later are zeroed now; those that never would be stay as they are.
    void cancel_ride_through() { rides_ = false; }
    /// The same of those that are here now.
    void end_ride()
    {
        for (Zero& zero : zeros_) zero.rides = false;
    }

    /// The drive has gone, and its station with it: nothing rides. All outputs, also those added later, are
    /// zeroed each time the drive is back (`zeroes`; it may have been without power), even those that were 0
    /// before; else they are zeroed as zero_after says, until the drive is used again. A row that says `once`
    /// gets one zero, sent or not known.
    void drive_gone(bool zeroes);
    void drive_is_used(); ///< by a new layout
    /// The first tag that is not zeroed since the drive was gone, or that refused it; 0 = none.
    std::uint16_t not_zeroed() const;

    /// The layout that wrote it has ended. The next set_now() gives the moment of the loss.
    void add(const Tag* row);
    /// The present layout writes it.
    void remove(const Tag* row);
    /// Takes the result of a zero or of its read-back. `proven_by_reading`: the answer to the write is no
    /// proof. Returns true if something else goes before the next zero.
    bool done(const Transaction& transaction, const Outcome& outcome, bool proven_by_reading, int retries,
              Instant now);
    void set_now(Instant now); ///< before every decision
    /// Each of them is now the row that `row_of` makes of it.
    template <class RowOf>
    void exchange(RowOf row_of)
    {
        for (Zero& zero : zeros_) zero.row = row_of(zero.row);
    }
    /// The port is another one: what is not zeroed yet rides on, and is tried there at once when it is due.
    void ride_again()
    {
        rides_ = true;
        drive_returned();
    }

    const Tag* next(Instant now) const;       ///< the tag to be zeroed now; nullptr = none
    const Tag* next_proof(Instant now) const; ///< the tag to be read back now; nullptr = none
    void drive_returned();                    ///< what was postponed is tried at once
    bool needs_now() const;                   ///< set_now() is due, whatever comes next
    Instant next_due() const;
    /// Returns when the last ride through the loss of the master is over; kNever = never. It is nullopt if
    /// none rides, or all are zeroed at once.
    std::optional<Instant> ride_ends() const;
    bool pending() const; ///< one of them waits for its zero, now or after its ride
    /// Those, in the order of their layouts. Precondition: pending().
    std::vector<ZeroLeft> zeros_left() const;

private:
    struct Zero {
        const Tag* row = nullptr;
        std::optional<Instant> lost_at; ///< none: until the next set_now()
        bool rides = true;              ///< through the loss of the master
        Instant not_before = kAtOnce;
        bool is_done = false;    ///< it is 0, or was refused: of interest when the drive was gone
        bool is_refused = false; ///< the last one
        Knowledge knowledge = Knowledge::unknown; ///< of the 0
        void on(KnowledgeEvent event) { knowledge = known_after(event, knowledge); }
    };

    bool is_at_once() const { return zeroes_now_ || (after_ && (!rides_ || after_->count() == 0)); }
    bool is_at_once(const Zero& zero) const { return is_at_once() || (after_ && !zero.rides); }
    Instant due_at(const Zero& zero) const;
    void again();
    const Tag* due(Instant now, bool acknowledged) const;

    ZeroAfter after_;
    RetryAfterGarble retry_;
    bool rides_ = true;
    bool is_gone_ = false;      ///< the drive was, and is not used again
    bool zeroes_now_ = false;   ///< for that
    bool was_back_ = false;     ///< since then
    std::uint16_t refused_ = 0; ///< the first tag that refused its zero since then
    std::vector<Zero> zeros_;   ///< with "never" they stay: the time may be set to another one later
};

} // namespace dpslave::drive
