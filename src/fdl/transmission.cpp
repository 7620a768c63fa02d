// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/transmission.hpp"

#include "dpslave/fdl/telegram.hpp"

#include <algorithm>

namespace dpslave::fdl {
namespace {

std::chrono::nanoseconds on_line(std::size_t octets, Baud baud)
{
    return duration_of(Tbit{static_cast<std::uint32_t>(octets) * kCharacter.count}, baud);
}

} // namespace

std::chrono::nanoseconds transmission_guard(Baud baud) noexcept
{
    return on_line(2 * kMaxTelegram, baud);
}

void Transmission::begin(std::size_t octets, Instant at, Baud baud) noexcept
{
    const Instant starts = is_running() ? std::max(ends_, at) : at;
    if (!is_running()) guard_ = at + transmission_guard(baud);
    ends_ = std::min(starts + on_line(octets, baud), guard_);
    ask_again_ = on_line(1, baud) / 4;
}

bool Transmission::is_over(Instant now, std::optional<bool> empty) noexcept
{
    if (!is_running() || now < ends_) return false;
    const bool has_left = empty.value_or(ends_ < guard_); // arithmetic that the guard cut short says nothing
    if (!has_left) {
        if (now < guard_) {
            ends_ = std::min(now + ask_again_, guard_);
            return false;
        }
        ++guarded_;
    }
    stop();
    return true;
}

} // namespace dpslave::fdl
