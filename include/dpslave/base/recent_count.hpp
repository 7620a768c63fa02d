// SPDX-License-Identifier: Apache-2.0
/// Tells how a counter that only grows has grown lately: by how much within the last minute, when last, and
/// since when it grows without a quiet minute. It is given the total now and then; pure.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <vector>

namespace dpslave {

class RecentCount {
public:
    /// The time that counts as lately. A count is forgotten when this time has passed, on the second.
    static constexpr std::chrono::seconds kSpan{60};

    /// `total` is the present value of the counter. A total below the last one means that the counter has
    /// started anew. Growth is dated to the sample that shows it: call it about once a second.
    void sample(std::uint64_t total, Instant now);

    /// Returns the growth within kSpan before the last sample.
    std::uint64_t in_span() const;
    /// Returns when it grew last; Instant{} = never.
    Instant last() const { return last_; }
    /// Returns when the present growth began: since then there was no pause of kSpan. It is Instant{} if
    /// last() is older than kSpan.
    Instant since() const { return in_span() != 0 ? since_ : Instant{}; }

private:
    static constexpr std::size_t kSeconds = static_cast<std::size_t>(kSpan.count());

    std::vector<std::uint32_t> seconds_; ///< growth by second, a ring; empty before it has grown
    std::int64_t second_ = 0;            ///< of the last sample
    std::uint64_t total_ = 0;
    Instant last_{}, since_{};
};

} // namespace dpslave
