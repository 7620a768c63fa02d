// SPDX-License-Identifier: Apache-2.0
/// Decides whether the drive of a station is there, by what is heard of it: when it counts as gone, and when
/// as back (X-51, docs/internals/drive-answers.md). It is pure: events come in with their time.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace dpslave::drive {

class Presence {
public:
    explicit Presence(const LossRule& rule) : rule_(rule) {}

    void set_rule(const LossRule& rule) { rule_ = rule; }

    /// A frame with its checksum that can only be of this drive has come, in time or late; may come again.
    void heard(Instant at);
    /// A question was answered in time.
    void answered(Instant now);
    /// The retries are used up.
    void lost(Instant now);
    /// It is asked nothing for as long as nobody knows: it counts as gone at once.
    void not_asked(Instant now);
    /// A question to the lost drive, asked at `began`, had no answer in time.
    void not_answered(Instant began);
    /// Call it before every decision. `zeros_pending`: an output has still to be set to 0 before the station
    /// appears. Returns true if the drive counts as gone from now on.
    bool on_time(Instant now, bool zeros_pending);

    /// A valid frame has come since then.
    bool was_heard_since(Instant at) const { return heard_at_ && *heard_at_ >= at; }
    DrivePresence state() const { return state_; }
    /// The station is not on the bus.
    bool is_away() const { return rule_.when == WhenLost::silent && state_ != DrivePresence::here; }
    /// The master is told by Stat_Diag.
    bool is_reported() const { return rule_.when == WhenLost::diagnosis && state_ == DrivePresence::gone; }
    /// It does not answer, and whether it is gone is not decided: it is asked once a round.
    bool is_doubtful() const { return is_supervised() && lost_since_ && state_ != DrivePresence::gone; }
    /// It has answered, and whether it stays is not decided: it is asked as well.
    bool is_returning() const { return state_ == DrivePresence::returning; }
    bool is_supervised() const { return rule_.when != WhenLost::hold; }
    /// Returns when on_time() decides something if nothing else happens; kNever = not by time alone.
    Instant next_deadline() const;

private:
    /// Questions to a lost drive that have to stay without an answer.
    static constexpr int kFurtherQuestions = 4;
    static constexpr std::size_t kManyLeaves = 3;
    static constexpr std::chrono::seconds kManyLeavesWithin{60};
    static constexpr std::chrono::seconds kAppearsAfter{1}, kAppearsAfterMany{10};
    static constexpr std::chrono::seconds kZerosLimit{2};

    Instant gone_at() const;
    std::chrono::seconds answers_for() const;

    LossRule rule_;
    DrivePresence state_ = DrivePresence::awaited;
    std::optional<Instant> lost_since_; ///< or since the last valid answer of a lost drive
    std::optional<Instant> heard_at_;
    int unanswered_ = 0; ///< further questions in a row
    Instant answers_since_{}, answered_at_{};
    bool waits_for_zeros_ = false;                              ///< to appear
    std::array<std::optional<Instant>, kManyLeaves> left_at_{}; ///< the newest first
};

} // namespace dpslave::drive
