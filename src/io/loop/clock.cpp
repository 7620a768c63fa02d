// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/clock.hpp"

#include "timespec.hpp"

#include <cerrno>
#include <ctime>

namespace dpslave::io {
namespace {

std::chrono::nanoseconds read(clockid_t clock) noexcept
{
    timespec now{};
    ::clock_gettime(clock, &now); // cannot fail: the clock exists and the address is valid
    return std::chrono::seconds{now.tv_sec} + std::chrono::nanoseconds{now.tv_nsec};
}

} // namespace

Instant monotonic_now() noexcept
{
    return Instant{read(CLOCK_MONOTONIC)};
}

void sleep_until(Instant when) noexcept
{
    const timespec end = to_timespec(when.time_since_epoch());
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &end, nullptr) == EINTR) {
    }
}

std::chrono::nanoseconds unix_now() noexcept
{
    return read(CLOCK_REALTIME);
}

} // namespace dpslave::io
