// SPDX-License-Identifier: Apache-2.0
/// The orders of `dpctl read` and `dpctl write` for one drive, each done once, in order.
#pragma once

#include "transactions.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace dpslave::drive {

class OperateQueue {
public:
    struct Entry {
        OperateOrder order;
        const Tag* row = nullptr;
        int attempts = 0;
        bool acknowledged = false; ///< a write that the drive has answered: now it is read back
        bool writes_next() const { return order.is_write && !acknowledged; }
        /// The end without an answer: of a write that was made and counts nobody is to think that it was not.
        AccessError silence() const
        {
            return acknowledged && row->once ? AccessError::not_known : AccessError::no_answer;
        }
    };

    /// `verdict` other than none answers it without the drive. Returns false if too many wait.
    bool add(const OperateOrder& order, const Tag* row, AccessError verdict);
    /// The row of each order is now the one that `row_of` makes of it.
    template <class RowOf>
    void exchange(RowOf row_of)
    {
        for (Entry& entry : entries_) entry.row = row_of(entry.row);
    }

    const Entry* front() const { return entries_.empty() ? nullptr : &entries_.front(); }
    /// Takes the result of the transaction for the first order. It is repeated `retries` times after silence
    /// or if the drive did not understand; so is a write that is proven by reading and not held, unless its
    /// row says `once`.
    void done(const Transaction& transaction, const Outcome& outcome, bool proven_by_reading, int retries);
    void drive_lost(); ///< each is answered
    /// Drops what is left of this order, without an answer.
    void withdraw(std::uint32_t number)
    {
        std::erase_if(entries_, [number](const Entry& entry) { return entry.order.number == number; });
    }
    std::optional<OperateAnswer> take_answer();

private:
    std::deque<Entry> entries_;
    std::deque<OperateAnswer> answers_;
};

} // namespace dpslave::drive
