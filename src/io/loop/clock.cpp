// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/clock.hpp"

#include <ctime>

namespace dpslave::io {

Instant monotonic_now() noexcept
{
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now); // cannot fail: the clock exists and the address is valid
    return Instant{std::chrono::seconds{now.tv_sec} + std::chrono::nanoseconds{now.tv_nsec}};
}

} // namespace dpslave::io
