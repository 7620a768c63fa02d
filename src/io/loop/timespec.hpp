// SPDX-License-Identifier: Apache-2.0
/// A waiting time as the system calls want it.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace dpslave::io {

/// A time that has already passed is none.
inline timespec to_timespec(std::chrono::nanoseconds time)
{
    const auto left = std::max(time, std::chrono::nanoseconds{0});
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(left);
    timespec spec{};
    spec.tv_sec = static_cast<std::time_t>(whole.count());
    spec.tv_nsec = static_cast<long>((left - whole).count());
    return spec;
}

} // namespace dpslave::io
