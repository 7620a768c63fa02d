// SPDX-License-Identifier: Apache-2.0
/// Keeps what is known of a drive itself: whether it answers, whether it is gone, and when it may be asked
/// next.
#pragma once

#include "drive_link.hpp"
#include "presence.hpp"

#include "dpslave/drive/poller.hpp"

#include <chrono>

namespace dpslave::drive {

class DriveContact {
public:
    explicit DriveContact(const DriveSettings& settings) : presence_(settings.loss) { set(settings); }
    /// From now on these times, retries and rule of a loss.
    void set(const DriveSettings& settings);

    DriveLink& link() { return link_; }
    const DriveLink& link() const { return link_; }
    Presence& presence() { return presence_; }
    const Presence& presence() const { return presence_; }

    /// Lost, and nothing is decided by further questions: its probe is the line's business.
    bool is_given_up() const { return link_.is_lost() && !presence_.is_doubtful(); }
    /// Lost, and whether it is gone is to be found out.
    bool is_doubtful() const { return link_.is_lost() && presence_.is_doubtful(); }
    /// Its next silence is the loss of the drive.
    bool is_last_try() const { return link_.is_last_try(retries_); }

    /// When the next question of those is due; not one that would be under way when the drive is gone.
    Instant decides_at() const;
    /// When it may be probed next, as far as it alone is concerned.
    Instant probe_due() const;
    std::chrono::nanoseconds probe_interval() const { return probe_interval_; }
    /// End of the last question; of one that is asked at once, before all others.
    Instant asked_at() const { return is_asked_at_once_ ? Instant{} : asked_at_; }
    /// Nothing can be asked before, as far as is known.
    Instant rests_until() const { return rests_until_; }

    /// Something was asked, unless `began` is `now`.
    void began(Instant began, Instant now)
    {
        if (began != now) began_at_ = began;
    }
    /// It was asked, whatever the answer was.
    void asked(Instant began, Instant now)
    {
        deferred_ = 0;
        if (began == now) return;
        asked_at_ = now;
        is_asked_at_once_ = false;
    }
    /// One that is lost, and may answer: once it need not wait for its turn among those that do not.
    void ask_at_once() { is_asked_at_once_ = link_.is_lost(); }
    bool is_asked_at_once() const { return is_asked_at_once_; }
    /// A question had no answer. It counts with the next silence.
    void note_unanswered(const Outcome& outcome, Instant began)
    {
        link_.note_unanswered(outcome.questions, presence_.was_heard_since(began));
    }
    /// It could not be asked. True: another question is due, which shows whether it answers at all.
    bool defer(Instant now);

private:
    int retries_ = 0;
    std::chrono::nanoseconds decides_every_{}, probe_interval_{};
    DriveLink link_;
    Presence presence_;
    Instant began_at_{}; ///< the last question
    Instant asked_at_{}; ///< its end
    bool is_asked_at_once_ = false;
    int deferred_ = 0; ///< transactions in a row
    Instant rests_until_{};
};

} // namespace dpslave::drive
