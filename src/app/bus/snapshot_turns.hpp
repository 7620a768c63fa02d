// SPDX-License-Identifier: Apache-2.0
/// Which station shows its state next: each at most once in 50 ms, and one at a time, so that what a telegram
/// costs does not grow with their number. Places and times in, places out.
#pragma once

#include "dpslave/base/units.hpp"

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <optional>

namespace dpslave::app {

class SnapshotTurns {
public:
    static constexpr std::chrono::nanoseconds kInterval = std::chrono::milliseconds{50};
    static constexpr std::size_t kPlaces = 128;

    /// What was shown of this place (below kPlaces) is older than its state.
    void changed(std::size_t place);
    /// It has gone: there is nothing to show.
    void forget(std::size_t place);
    /// Nothing is due before this; kNever = everything was shown.
    Instant next() const { return next_; }
    /// The place that is to be shown now, if one is. The next one follows kInterval / `stations` later at the
    /// earliest.
    std::optional<std::size_t> take(Instant now, std::size_t stations);

private:
    void find_next();

    std::bitset<kPlaces> changed_;
    std::array<Instant, kPlaces> rests_until_{}; ///< each place after it was shown
    Instant all_rest_until_{};                   ///< after any was shown
    Instant next_ = kNever;
    std::size_t last_ = kPlaces - 1; ///< the place that was shown last
};

} // namespace dpslave::app
