// SPDX-License-Identifier: Apache-2.0
/// A part of the program gives signs while it goes round: times, never verdicts. Who needs it judges
/// the newest one by its own clock. Pure: the times come in.
#pragma once

#include "dpslave/base/units.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace dpslave {

/// The newest sign. One thread gives it, any thread reads it.
class SignOfLife {
public:
    void give(Instant now) { at_.store(now.time_since_epoch().count(), std::memory_order_release); }
    /// Instant{}: there was none yet.
    Instant last() const { return Instant{BusClock::duration{at_.load(std::memory_order_acquire)}}; }

private:
    std::atomic<BusClock::rep> at_{0};
};

/// For how long no new sign has come, as one observer has lived it.
class Silence {
public:
    /// An observer that looks more seldom than this has stalled itself: the rest of that time does not
    /// count.
    static constexpr std::chrono::milliseconds kLongestLook{100};

    /// Returns it, with `last` the newest sign. 0 at the first call, and while there was no sign yet.
    std::chrono::nanoseconds look(Instant last, Instant now)
    {
        const bool is_new = !looks_ || last != last_ || last == Instant{};
        length_ = is_new ? std::chrono::nanoseconds{}
                         : length_ + std::min<std::chrono::nanoseconds>(now - looked_at_, kLongestLook);
        looks_ = true;
        last_ = last;
        looked_at_ = now;
        return length_;
    }

private:
    bool looks_ = false;
    Instant last_{}, looked_at_{};
    std::chrono::nanoseconds length_{};
};

} // namespace dpslave
