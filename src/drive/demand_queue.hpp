// SPDX-License-Identifier: Apache-2.0
/// The orders of Demand Data for one drive. A read stays in force until the next order and is repeated; a
/// write is done once, also when the next order came before its turn - unless the drive is lost by then.
#pragma once

#include "transactions.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace dpslave::drive {

class DemandQueue {
public:
    enum class Stage : std::uint8_t {
        ordered,
        acknowledged, ///< a write that the drive has answered: now it is read back
        answered,     ///< a standing read that gave its first answer
    };
    struct Entry {
        DemandOrder order;
        const Tag* row = nullptr;
        Stage stage = Stage::ordered;
        int attempts = 0; ///< that were not understood, or taken and not held
        bool is_again() const { return stage == Stage::answered || attempts > 0; }
        bool writes_next() const
        {
            return order.kind == DemandOrder::Kind::write && stage != Stage::acknowledged;
        }
    };

    /// The order in force now; `verdict` other than none answers it without the drive.
    void set(const DemandOrder& order, const Tag* row, AccessError verdict);
    /// The row of each order is now the one that `row_of` makes of it.
    template <class RowOf>
    void exchange(RowOf row_of)
    {
        for (Entry& entry : entries_) entry.row = row_of(entry.row);
    }
    /// The layouts up to this one have ended, and their orders with them.
    void end(Generation generation);

    /// Returns what to do next: a new order, else the standing read.
    const Entry* front() const { return entries_.empty() ? nullptr : &entries_.front(); }
    /// Takes the result of the transaction for the order `number`; nothing happens if that order is gone. If
    /// the drive does not answer, the order keeps waiting. If the drive did not understand, a standing order
    /// keeps waiting; any other is repeated `retries` times, because others wait for it. `proven_by_reading`:
    /// an acknowledged write is read back; if the drive holds another word it is written again, `retries`
    /// times, unless its row says `once`. Then the
    /// answer is not_kept.
    void done(std::uint32_t number, const Transaction& transaction, const Outcome& outcome,
              bool proven_by_reading, int retries);
    /// The drive is lost: orders no longer in force are not carried out when it returns, maybe minutes later.
    void drop_superseded();
    /// Writes that were dropped though their layout is in force.
    std::uint64_t dropped() const { return dropped_; }
    /// Answers to the order in force, and to no other.
    std::optional<DemandAnswer> take_answer();

private:
    void answer(const DemandAnswer& what);
    void finish(AccessError error, std::uint16_t value);
    bool stands(const Entry& entry) const { return entry.order.number == standing_; }

    std::deque<Entry> entries_; ///< writes that wait, then at most one read
    std::optional<std::uint32_t> standing_;
    std::uint64_t dropped_ = 0;
    std::deque<DemandAnswer> answers_;
};

} // namespace dpslave::drive
