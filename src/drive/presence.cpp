// SPDX-License-Identifier: Apache-2.0
#include "presence.hpp"

#include <algorithm>

namespace dpslave::drive {

void Presence::heard(Instant at)
{
    if (heard_at_ && at <= *heard_at_) return;
    heard_at_ = at;
    unanswered_ = 0;
    if (lost_since_) lost_since_ = std::max(*lost_since_, at);
    if (state_ == DrivePresence::awaited) state_ = DrivePresence::here;
}

void Presence::answered(Instant now)
{
    lost_since_.reset();
    unanswered_ = 0;
    if (state_ == DrivePresence::awaited) state_ = DrivePresence::here;
    answered_at_ = now;
    if (state_ != DrivePresence::gone) return;
    state_ = rule_.when == WhenLost::silent ? DrivePresence::returning : DrivePresence::here;
    answers_since_ = now;
}

void Presence::lost(Instant now)
{
    lost_since_ = now;
    unanswered_ = 0;
    if (state_ == DrivePresence::returning) state_ = DrivePresence::gone;
}

void Presence::not_asked(Instant now)
{
    lost(now - rule_.after);
    unanswered_ = kFurtherQuestions;
}

/// A valid answer to an older question is an answer as well.
void Presence::not_answered(Instant began)
{
    if (lost_since_ && (!heard_at_ || *heard_at_ < began)) ++unanswered_;
}

Instant Presence::gone_at() const
{
    const bool may_go = is_doubtful() && unanswered_ >= kFurtherQuestions;
    return may_go ? *lost_since_ + rule_.after : kNever;
}

/// Returns how long the drive has to answer before the station appears: a drive that comes and goes must not
/// take the master through a start each time.
std::chrono::seconds Presence::answers_for() const
{
    const auto& oldest = left_at_.back();
    const bool are_many = oldest && *left_at_.front() - *oldest <= kManyLeavesWithin;
    return are_many ? kAppearsAfterMany : kAppearsAfter;
}

bool Presence::on_time(Instant now, bool zeros_pending)
{
    waits_for_zeros_ = is_returning() && zeros_pending && now < answers_since_ + kZerosLimit;
    if (is_returning() && answered_at_ >= answers_since_ + answers_for() && !waits_for_zeros_)
        state_ = DrivePresence::here;
    if (now < gone_at()) return false;
    if (state_ == DrivePresence::here) {
        std::move_backward(left_at_.begin(), left_at_.end() - 1, left_at_.end());
        left_at_.front() = now;
    }
    state_ = DrivePresence::gone;
    return true;
}

Instant Presence::next_deadline() const
{
    if (is_returning()) return waits_for_zeros_ ? answers_since_ + kZerosLimit : kNever;
    return gone_at();
}

} // namespace dpslave::drive
