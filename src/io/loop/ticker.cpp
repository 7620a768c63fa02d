// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/ticker.hpp"

#include "timespec.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace dpslave::io {

Ticker::Ticker(std::chrono::nanoseconds period)
    : fd_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC))
{
    const itimerspec pace{.it_interval = to_timespec(period), .it_value = to_timespec(period)};
    if (!fd_ || ::timerfd_settime(fd_.get(), 0, &pace, nullptr) < 0)
        throw std::system_error{errno, std::system_category(), "timerfd"};
}

std::uint64_t Ticker::clear() noexcept
{
    std::uint64_t ticks = 0;
    [[maybe_unused]] const ssize_t taken = ::read(fd_.get(), &ticks, sizeof ticks);
    return ticks;
}

} // namespace dpslave::io
