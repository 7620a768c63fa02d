// SPDX-License-Identifier: Apache-2.0
/// The orders of Demand Data for one drive. A read stands until the next order and is repeated; a write is
/// done once, also when the next order came before its turn - unless the drive is lost by then.
#pragma once

#include "dpslave/drive/backend.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace dpslave::drive {

class DemandQueue {
public:
    struct Entry {
        DemandOrder order;
        const Tag* row = nullptr;
        bool answered = false;  ///< a standing read that gave its first answer
        int not_understood = 0; ///< so often
        bool written = false;   ///< the drive has said so: now it is read back
    };

    /// The order that stands now; `verdict` other than none answers it without the drive.
    void set(const DemandOrder& order, const Tag* row, AccessError verdict);
    /// The row of each order is now the one that `row_of` makes of it.
    template <class RowOf>
    void exchange(RowOf row_of)
    {
        for (Entry& entry : entries_) entry.row = row_of(entry.row);
    }
    /// The layouts up to this one have ended, and their orders with them.
    void end(Generation generation);

    /// What to do next: a new order, else the standing read.
    const Entry* front() const { return entries_.empty() ? nullptr : &entries_.front(); }
    /// The drive did not understand it: the order waits on as long as it stands; else it is dropped after
    /// `retries`, for others wait behind it.
    void not_understood(std::uint32_t number, int retries);
    /// The drive has acknowledged the write: it is proven by what it holds then.
    void written(std::uint32_t number);
    /// It does not hold what was written: written again, `retries` times at most. Then the order is answered
    /// with not_kept.
    void not_held(std::uint32_t number, int retries);
    /// The drive is lost: what no longer stands is not to be done when it returns, maybe minutes later.
    void drop_superseded();
    /// Writes that were dropped though their layout stands.
    std::uint64_t dropped() const { return dropped_; }
    /// Neither for no_answer nor for not_understood: then the order waits on.
    void done(std::uint32_t number, AccessError error, std::uint16_t value);
    /// Answers to the order that stands, and to no other.
    std::optional<DemandAnswer> take_answer();

private:
    void answer(const DemandAnswer& what);
    bool stands(const Entry& entry) const { return entry.order.number == standing_; }

    std::deque<Entry> entries_; ///< writes that wait, then at most one read
    std::optional<std::uint32_t> standing_;
    std::uint64_t dropped_ = 0;
    std::deque<DemandAnswer> answers_;
};

} // namespace dpslave::drive
