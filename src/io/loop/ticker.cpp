// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/ticker.hpp"

#include "timespec.hpp"

#include "dpslave/io/clock.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace dpslave::io {

Ticker::Ticker(std::chrono::nanoseconds period)
    : fd_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)),
      period_(period),
      due_(monotonic_now() + period)
{
    const itimerspec pace{.it_interval = to_timespec(period),
                          .it_value = to_timespec(due_.time_since_epoch())};
    if (!fd_ || ::timerfd_settime(fd_.get(), TFD_TIMER_ABSTIME, &pace, nullptr) < 0)
        throw std::system_error{errno, std::system_category(), "timerfd"};
}

std::chrono::nanoseconds Ticker::clear(Instant now) noexcept
{
    std::uint64_t ticks = 0;
    if (::read(fd_.get(), &ticks, sizeof ticks) != sizeof ticks) return std::chrono::nanoseconds{0};
    const auto late = now - due_;
    due_ += static_cast<std::int64_t>(ticks) * period_;
    return std::max(late, std::chrono::nanoseconds{0});
}

} // namespace dpslave::io
