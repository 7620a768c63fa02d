// SPDX-License-Identifier: Apache-2.0
#include "safe_state.hpp"

#include <algorithm>

namespace dpslave::drive {

void SafeState::add(const Tag* row)
{
    remove(row);
    zeros_.push_back({.row = row, .lost_at = std::nullopt});
}

void SafeState::written(const Tag* row)
{
    for (Zero& zero : zeros_)
        if (zero.row == row) zero.written = true;
}

void SafeState::not_held(const Tag* row)
{
    for (Zero& zero : zeros_)
        if (zero.row == row) zero.written = false;
}

void SafeState::remove(const Tag* row)
{
    zeros_.erase(
        std::remove_if(zeros_.begin(), zeros_.end(), [row](const Zero& zero) { return zero.row == row; }),
        zeros_.end());
}

/// Only the newest can be without their time: it is told before every decision.
void SafeState::tell_time(Instant now)
{
    for (auto zero = zeros_.rbegin(); zero != zeros_.rend() && !zero->lost_at; ++zero) zero->lost_at = now;
}

Instant SafeState::due_at(const Zero& zero) const
{
    if (!after_) return kNever;
    const bool at_once = !rides_ || *after_ == std::chrono::nanoseconds{0};
    if (at_once || !zero.lost_at) return zero.not_before;
    return std::max(*zero.lost_at + *after_, zero.not_before);
}

const Tag* SafeState::due(Instant now, bool written) const
{
    if (!after_) return nullptr;
    const auto at = std::find_if(zeros_.begin(), zeros_.end(), [&](const Zero& zero) {
        return zero.lost_at && zero.written == written && due_at(zero) <= now;
    });
    return at == zeros_.end() ? nullptr : at->row;
}

const Tag* SafeState::next(Instant now) const
{
    return due(now, false);
}

const Tag* SafeState::next_proof(Instant now) const
{
    return due(now, true);
}

void SafeState::postpone(const Tag* row, Instant now)
{
    for (Zero& zero : zeros_)
        if (zero.row == row) zero.not_before = now + kInvalidRetry;
}

void SafeState::drive_returned()
{
    for (Zero& zero : zeros_) {
        zero.not_before = kAtOnce;
        zero.written = false; // it may have been without power
    }
}

bool SafeState::untold() const
{
    return !zeros_.empty() && !zeros_.back().lost_at;
}

Instant SafeState::next_due() const
{
    Instant at = untold() ? kAtOnce : kNever;
    for (const Zero& zero : zeros_) at = std::min(at, due_at(zero));
    return at;
}

std::optional<Instant> SafeState::ride_ends() const
{
    const bool at_once = after_ && (!rides_ || *after_ == std::chrono::nanoseconds{0});
    std::optional<Instant> ends;
    for (const Zero& zero : zeros_) {
        if (at_once || !zero.lost_at) continue;
        const Instant end = after_ ? *zero.lost_at + *after_ : kNever;
        ends = std::max(end, ends.value_or(end));
    }
    return ends;
}

bool SafeState::pending() const
{
    return after_ && !zeros_.empty();
}

} // namespace dpslave::drive
