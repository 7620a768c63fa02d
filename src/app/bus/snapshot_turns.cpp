// SPDX-License-Identifier: Apache-2.0
#include "snapshot_turns.hpp"

#include <algorithm>

namespace dpslave::app {

void SnapshotTurns::changed(std::size_t slot)
{
    changed_.set(slot);
    next_ = std::min(next_, std::max(all_rest_until_, rests_until_[slot]));
}

void SnapshotTurns::forget(std::size_t slot)
{
    changed_.reset(slot);
    rests_until_[slot] = {};
    find_next();
}

std::optional<std::size_t> SnapshotTurns::take(Instant now, std::size_t stations)
{
    if (now < next_) return std::nullopt;
    std::size_t slot = last_;
    do slot = (slot + 1) % kSlots;
    while (!changed_.test(slot) || now < rests_until_[slot]);
    last_ = slot;
    changed_.reset(slot);
    rests_until_[slot] = now + kInterval;
    all_rest_until_ = now + kInterval / std::max<std::size_t>(stations, 1);
    find_next();
    return slot;
}

void SnapshotTurns::find_next()
{
    next_ = kNever;
    for (std::size_t slot = 0; slot < kSlots; ++slot)
        if (changed_.test(slot)) next_ = std::min(next_, std::max(all_rest_until_, rests_until_[slot]));
}

} // namespace dpslave::app
