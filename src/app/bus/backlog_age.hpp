// SPDX-License-Identifier: Apache-2.0
/// How long what is read from the bus port may have lain there, because the bus thread was delayed. Nothing
/// in Linux says when octets came to a tty, but the thread looks at it with each tick (10 ms) at the latest:
/// if it did not, what it finds may have come at any moment since the look before. Pure.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <utility>

namespace dpslave::app {

class BacklogAge {
public:
    /// So long a busy machine may keep the thread from its work: what is read then counts as fresh.
    static constexpr std::chrono::milliseconds kStandstill{50};
    /// The kernel's worker that brings octets to the tty may have been delayed as well. It is taken to go on
    /// within this time; where it alone stands still for long, nothing shows it.
    static constexpr std::chrono::milliseconds kSettles{10};

    /// `empty`: when nothing lay in the port, before it was opened.
    explicit BacklogAge(Instant empty) : looked_(empty) {}

    /// Nothing is left in the port, as far as the kernel says.
    void emptied(Instant now) noexcept
    {
        if (std::exchange(has_looked_, true) && now - looked_ >= kStandstill) {
            before_ = looked_;
            settled_ = now + kSettles;
        }
        looked_ = now;
    }
    /// The age of what is read at `read_at`, at most; 0: it is fresh.
    std::chrono::nanoseconds age_of(Instant read_at) const noexcept
    {
        const auto age = read_at - (read_at < settled_ ? before_ : looked_);
        return age < kStandstill ? std::chrono::nanoseconds{0} : age;
    }

private:
    Instant looked_;
    bool has_looked_ = false; ///< else a slow start is over with the first look: nothing was delayed
    Instant before_{};        ///< the last look before the thread was delayed
    Instant settled_{};       ///< until then what is read may have come since that look
};

} // namespace dpslave::app
