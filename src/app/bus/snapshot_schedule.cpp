// SPDX-License-Identifier: Apache-2.0
#include "snapshot_schedule.hpp"

#include "set_bits.hpp"

#include <algorithm>

namespace dpslave::app {

void SnapshotSchedule::changed(std::size_t slot)
{
    changed_.set(slot);
    next_ = std::min(next_, rests_until_[slot]);
}

void SnapshotSchedule::forget(std::size_t slot)
{
    changed_.reset(slot);
    rests_until_[slot] = {};
    find_next();
}

std::optional<std::size_t> SnapshotSchedule::take(Instant now)
{
    if (now < next_) return std::nullopt;
    std::size_t slot = last_;
    do slot = (slot + 1) % kSlots;
    while (!changed_.test(slot) || now < rests_until_[slot]);
    last_ = slot;
    changed_.reset(slot);
    rests_until_[slot] = now + kInterval;
    find_next();
    return slot;
}

void SnapshotSchedule::find_next()
{
    next_ = kNever;
    for_each(changed_, [this](std::size_t slot) { next_ = std::min(next_, rests_until_[slot]); });
}

} // namespace dpslave::app
