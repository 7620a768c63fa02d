// SPDX-License-Identifier: Apache-2.0
/// The orders of Demand Data for one drive. A read stands until the next order and is repeated; a write is
/// done once, also when the next order came before its turn.
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
        bool answered = false; ///< a standing read that gave its first answer
    };

    /// The order that stands now; `verdict` other than none answers it without the drive.
    void set(const DemandOrder& order, const Tag* row, AccessError verdict);
    /// The layouts up to this one have ended, and their orders with them.
    void end(Generation generation);

    /// What to do next: a new order, else the standing read.
    const Entry* front() const { return entries_.empty() ? nullptr : &entries_.front(); }
    /// Not for no_answer: then the order waits on.
    void done(std::uint32_t number, AccessError error, std::uint16_t value);
    std::optional<DemandAnswer> take_answer();

private:
    void answer(const DemandAnswer& what);

    std::deque<Entry> entries_; ///< writes that wait, then at most one read
    std::deque<DemandAnswer> answers_;
};

} // namespace dpslave::drive
