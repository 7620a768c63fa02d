// SPDX-License-Identifier: Apache-2.0
/// The watchdog of DP_Control: supervises the master in Wait_Cfg and Data_Exch. Judged by the
/// receive times of requests, never by when they were processed. Source: wire reference 7.1.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>

namespace dpslave::dp {

class Watchdog {
public:
    /// T_WD begins anew at `at`.
    void start(std::chrono::milliseconds period, Instant at)
    {
        on_ = true;
        period_ = period;
        last_ = at;
    }
    void stop() { on_ = false; }

    /// A request of the owner, received at `at`.
    void retrigger(Instant at)
    {
        if (at > last_) last_ = at;
    }

    bool on() const { return on_; }
    std::chrono::milliseconds period() const { return on_ ? period_ : std::chrono::milliseconds{0}; }
    /// The moment of expiry; kNever while off.
    Instant deadline() const { return on_ ? last_ + period_ : kNever; }
    bool expired(Instant at) const { return on_ && at >= deadline(); }

private:
    bool on_ = false;
    std::chrono::milliseconds period_{0};
    Instant last_{};
};

} // namespace dpslave::dp
