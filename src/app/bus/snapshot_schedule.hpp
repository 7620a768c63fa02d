// SPDX-License-Identifier: Apache-2.0
/// Which station publishes its state next: each at most once in 50 ms, and one at a time, so that what a
/// telegram costs does not grow with their number. Slots and times in, slots out.
#pragma once

#include "dpslave/base/units.hpp"

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <optional>

namespace dpslave::app {

class SnapshotSchedule {
public:
    static constexpr std::chrono::nanoseconds kInterval = std::chrono::milliseconds{50};
    static constexpr std::size_t kSlots = 128;

    /// What was published of this slot (below kSlots) is older than its state.
    void changed(std::size_t slot);
    /// The station has left: nothing is to be published.
    void forget(std::size_t slot);
    /// Nothing is due before this; kNever = all is published.
    Instant next() const { return next_; }
    /// The slot that is to be published now, if one is.
    std::optional<std::size_t> take(Instant now);

private:
    void find_next();

    std::bitset<kSlots> changed_;
    std::array<Instant, kSlots> rests_until_{}; ///< each slot after it was published
    Instant next_ = kNever;
    std::size_t last_ = kSlots - 1; ///< the slot that was published last
};

} // namespace dpslave::app
