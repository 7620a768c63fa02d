// SPDX-License-Identifier: Apache-2.0
#include "drive_contact.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// After this many transactions in a row that could not be asked the drive rests: what is owed to it needs
/// time.
constexpr int kDeferredAtOnce = 4;
constexpr std::chrono::milliseconds kDeferredRest{5};
/// A drive whose loss has consequences is asked so often while nothing else is asked of it.
constexpr std::chrono::milliseconds kSupervisedEvery{250};

} // namespace

void DriveContact::set(const DriveSettings& settings)
{
    retries_ = settings.retries;
    decides_every_ = settings.decides_every;
    probe_interval_ = settings.probe_interval;
    presence_.set_rule(settings.loss);
}

Instant DriveContact::decides_at() const
{
    const Instant next = std::max(began_at_ + decides_every_, rests_until_);
    const Instant gone = presence_.is_doubtful() ? presence_.next_deadline() : kNever;
    return gone < next + decides_every_ ? gone : next;
}

Instant DriveContact::probe_due() const
{
    if (presence_.is_returning()) return decides_at();
    if (is_asked_at_once_) return Instant{};
    const bool is_watched = presence_.is_supervised() && link_.is_certain();
    return asked_at_ + (is_watched ? std::min<std::chrono::nanoseconds>(probe_interval_, kSupervisedEvery)
                                   : probe_interval_);
}

bool DriveContact::defer(Instant now)
{
    is_asked_at_once_ = false; // it has had its turn
    if (++deferred_ >= kDeferredAtOnce) rests_until_ = now + kDeferredRest;
    return link_.is_in_doubt() || (presence_.is_supervised() && now >= probe_due());
}

} // namespace dpslave::drive
