// SPDX-License-Identifier: Apache-2.0
#include "snapshot_turns.hpp"

#include <algorithm>

namespace dpslave::app {

void SnapshotTurns::changed(std::size_t place)
{
    changed_.set(place);
    next_ = std::min(next_, std::max(all_rest_until_, rests_until_[place]));
}

void SnapshotTurns::forget(std::size_t place)
{
    changed_.reset(place);
    rests_until_[place] = {};
    find_next();
}

std::optional<std::size_t> SnapshotTurns::take(Instant now, std::size_t stations)
{
    if (now < next_) return std::nullopt;
    std::size_t place = last_;
    do place = (place + 1) % kPlaces;
    while (!changed_.test(place) || now < rests_until_[place]);
    last_ = place;
    changed_.reset(place);
    rests_until_[place] = now + kInterval;
    all_rest_until_ = now + kInterval / std::max<std::size_t>(stations, 1);
    find_next();
    return place;
}

void SnapshotTurns::find_next()
{
    next_ = kNever;
    for (std::size_t place = 0; place < kPlaces; ++place)
        if (changed_.test(place)) next_ = std::min(next_, std::max(all_rest_until_, rests_until_[place]));
}

} // namespace dpslave::app
