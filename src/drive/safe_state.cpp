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
    if (is_at_once(zero)) return zero.not_before;
    if (!after_) return kNever;
    if (!zero.lost_at) return zero.not_before;
    return std::max(*zero.lost_at + *after_, zero.not_before);
}

const Tag* SafeState::due(Instant now, bool acknowledged) const
{
    const auto at = std::find_if(zeros_.begin(), zeros_.end(), [&](const Zero& zero) {
        return zero.lost_at && !zero.is_done && (zero.knowledge == Knowledge::acknowledged) == acknowledged &&
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
        error = transaction.tag->once ? AccessError::not_kept : AccessError::not_understood;
    }
    const bool not_understood = error == AccessError::not_understood;
    if (error == AccessError::no_answer || retry_.is_repeated(error, retries)) return true;
    if (is_gone_ && error != AccessError::none && !not_understood && refused_ == 0)
        refused_ = transaction.tag->number;
    if (zero != zeros_.end()) {
        zero->is_done = !not_understood; // zeroed, or refused for good
        zero->is_refused = error != AccessError::none;
        if (not_understood) zero->not_before = now + kInvalidRetry;
    }
    return not_understood;
}

void SafeState::drive_gone(bool zeroes)
{
    is_gone_ = true;
    zeroes_now_ = zeroes;
    was_back_ = false;
    again();
}

void SafeState::again()
{
    refused_ = 0;
    for (Zero& zero : zeros_) {
        zero.is_done = zero.is_done && (!zeroes_now_ || zero.row->once);
        if (zero.is_done && zero.is_refused && refused_ == 0) refused_ = zero.row->number;
    }
}

void SafeState::drive_is_used()
{
    is_gone_ = zeroes_now_ = false;
    std::erase_if(zeros_, [](const Zero& zero) { return zero.is_done; });
}

std::uint16_t SafeState::not_zeroed() const
{
    if (!is_gone_ || !was_back_) return 0;
    const auto zero = std::ranges::find(zeros_, false, &Zero::is_done);
    return zero != zeros_.end() && pending() ? zero->row->number : refused_;
}

void SafeState::drive_returned()
{
    was_back_ = true;
    if (is_gone_) again();
    for (Zero& zero : zeros_) {
        zero.not_before = kAtOnce;
        // It may have been without power.
        if (!zero.row->once) zero.on(KnowledgeEvent::back);
    }
}

bool SafeState::needs_now() const
{
    return !zeros_.empty() && !zeros_.back().lost_at;
}

Instant SafeState::next_due() const
{
    Instant at = needs_now() ? kAtOnce : kNever;
    for (const Zero& zero : zeros_)
        if (!zero.is_done) at = std::min(at, due_at(zero));
    return at;
}

std::optional<Instant> SafeState::ride_ends() const
{
    if (is_gone_) return std::nullopt;
    std::optional<Instant> ends;
    for (const Zero& zero : zeros_) {
        if (is_at_once(zero) || !zero.lost_at || zero.is_done) continue;
        const Instant end = after_ ? *zero.lost_at + *after_ : kNever;
        ends = std::max(end, ends.value_or(end));
    }
    return ends;
}

bool SafeState::pending() const
{
    return (after_ || zeroes_now_) && std::ranges::find(zeros_, false, &Zero::is_done) != zeros_.end();
}

std::vector<ZeroLeft> SafeState::zeros_left() const
{
    std::vector<ZeroLeft> left;
    for (const Zero& zero : zeros_)
        if (!zero.is_done)
            left.push_back(
                {.tag = zero.row->number, .is_written = zero.knowledge == Knowledge::acknowledged});
    return left;
}

} // namespace dpslave::drive
