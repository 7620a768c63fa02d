// SPDX-License-Identifier: Apache-2.0
#include "safe_state.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// Also a value that does not fit: then it is not 0.
bool shows_another_word(const Outcome& outcome)
{
    if (outcome.error == AccessError::none) return outcome.words.front() != 0;
    return outcome.error == AccessError::out_of_range || outcome.error == AccessError::value_not_encoded;
}

} // namespace

void SafeState::add(const Tag* row)
{
    remove(row);
    zeros_.push_back({.row = row, .lost_at = std::nullopt});
}

void SafeState::remove(const Tag* row)
{
    zeros_.erase(
        std::remove_if(zeros_.begin(), zeros_.end(), [row](const Zero& zero) { return zero.row == row; }),
        zeros_.end());
}

/// Only the newest can be without their time: it is set before every decision.
void SafeState::set_now(Instant now)
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

const Tag* SafeState::due(Instant now, bool acknowledged) const
{
    if (!after_) return nullptr;
    const auto at = std::find_if(zeros_.begin(), zeros_.end(), [&](const Zero& zero) {
        return zero.lost_at && (zero.knowledge == Knowledge::acknowledged) == acknowledged &&
               due_at(zero) <= now;
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

/// A zero that the drive does not hold is treated like one that it has not understood.
bool SafeState::done(const Transaction& transaction, const Outcome& outcome, bool proven_by_reading,
                     int retries, Instant now)
{
    const auto zero = std::find_if(zeros_.begin(), zeros_.end(),
                                   [&](const Zero& one) { return one.row == transaction.tag; });
    AccessError error = outcome.error;
    if (is_write(transaction) && error == AccessError::none && proven_by_reading) {
        if (zero != zeros_.end()) zero->on(KnowledgeEvent::acknowledged);
        return false;
    }
    if (!is_write(transaction) && shows_another_word(outcome)) {
        if (zero != zeros_.end()) zero->on(KnowledgeEvent::another_seen);
        error = AccessError::not_understood;
    }
    const bool not_understood = error == AccessError::not_understood;
    if (error == AccessError::no_answer || not_understood_.is_repeated(error, retries)) return true;
    if (!not_understood)
        remove(transaction.tag); // zeroed, or refused for good
    else if (zero != zeros_.end())
        zero->not_before = now + kInvalidRetry;
    return not_understood;
}

void SafeState::drive_returned()
{
    for (Zero& zero : zeros_) {
        zero.not_before = kAtOnce;
        zero.on(KnowledgeEvent::back); // it may have been without power
    }
}

bool SafeState::needs_now() const
{
    return !zeros_.empty() && !zeros_.back().lost_at;
}

Instant SafeState::next_due() const
{
    Instant at = needs_now() ? kAtOnce : kNever;
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
