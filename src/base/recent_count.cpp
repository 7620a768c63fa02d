// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/recent_count.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace dpslave {

void RecentCount::sample(std::uint64_t total, Instant now)
{
    const auto second = std::chrono::floor<std::chrono::seconds>(now.time_since_epoch()).count();
    const auto passed = std::clamp<std::int64_t>(second - second_, 0, kSpan.count());
    if (passed == kSpan.count())
        std::fill(seconds_.begin(), seconds_.end(), 0U);
    else if (!seconds_.empty())
        for (std::int64_t i = 1; i <= passed; ++i)
            seconds_[static_cast<std::size_t>(second_ + i) % kSeconds] = 0;
    second_ = std::max(second, second_);

    const std::uint64_t grown = total >= total_ ? total - total_ : total;
    total_ = total;
    if (grown == 0) return;
    if (seconds_.empty()) seconds_.resize(kSeconds); // most counters never grow
    if (in_span() == 0) since_ = now;
    last_ = now;
    std::uint32_t& here = seconds_[static_cast<std::size_t>(second_) % kSeconds];
    const std::uint64_t sum = here + grown;
    here =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, std::numeric_limits<std::uint32_t>::max()));
}

std::uint64_t RecentCount::in_span() const
{
    return std::accumulate(seconds_.begin(), seconds_.end(), std::uint64_t{0});
}

} // namespace dpslave
