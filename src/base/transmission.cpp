// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/transmission.hpp"

#include <algorithm>

namespace dpslave {

void Transmission::begin(std::chrono::nanoseconds on_line, Instant at, const Times& times) noexcept
{
    const Instant starts = is_running() ? std::max(ends_, at) : at;
    if (!is_running()) guard_ = at + times.guard;
    ends_ = busy_until_ = std::min(starts + on_line, guard_);
    ask_again_ = times.character / 4;
}

bool Transmission::is_over(Instant now, std::optional<bool> empty) noexcept
{
    if (!is_running() || now < ends_) return false;
    const bool has_left = empty.value_or(ends_ < guard_); // arithmetic that the guard cut short says nothing
    if (!has_left) {
        busy_until_ = now;
        if (now < guard_) {
            ends_ = std::min(now + ask_again_, guard_);
            return false;
        }
        ++guarded_;
    }
    stop();
    return true;
}

} // namespace dpslave
