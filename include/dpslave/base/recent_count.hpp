// SPDX-License-Identifier: Apache-2.0
/// How a counter that only grows has grown lately: how much within the last minute, when last, and since when
/// it grows without a quiet minute. It is given the total now and then; pure.
#pragma once

#include "dpslave/base/units.hpp"

#include <array>
#include <chrono>
#include <cstdint>

namespace dpslave {

class RecentCount {
public:
    /// What counts as lately. A count is forgotten when this time has passed, on the second.
    static constexpr std::chrono::seconds kSpan{60};

    /// The counter stands at `total` now. A total below the last one is that of a counter that began anew.
    /// Growth is dated to the sample that shows it: call it about once a second.
    void sample(std::uint64_t total, Instant now);

    /// How much it grew within kSpan before the last sample.
    std::uint64_t in_span() const;
    /// When it grew last; Instant{} = never.
    Instant last() const { return last_; }
    /// When the growth began that has gone on without a pause of kSpan; Instant{} where last() is older.
    Instant since() const { return in_span() != 0 ? since_ : Instant{}; }

private:
    static constexpr std::size_t kSeconds = static_cast<std::size_t>(kSpan.count());

    std::array<std::uint32_t, kSeconds> seconds_{}; ///< growth by second, a ring
    std::int64_t second_ = 0;                       ///< of the last sample
    std::uint64_t total_ = 0;
    Instant last_{}, since_{};
};

} // namespace dpslave
