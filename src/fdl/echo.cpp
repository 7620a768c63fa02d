// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/echo.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::fdl {
namespace {

/// This number of consecutive telegrams with an echo, or without, decides the question; the same number of
/// the other kind decides it anew.
constexpr std::uint8_t kConvincing = 3;

} // namespace

void Echo::sent(Bytes telegram, Instant quiet_until, Instant until) noexcept
{
    if (mode_ == EchoMode::off) return;
    if (length_ != 0) conclude(matched_ == 0 ? Outcome::missing : Outcome::broken);
    length_ = std::min(telegram.size(), expected_.size());
    std::copy_n(telegram.begin(), length_, expected_.begin());
    quiet_until_ = quiet_until;
    until_ = until;
}

Echo::Foreign Echo::remove(Bytes octets, Instant at) noexcept
{
    if (!is_expected(at)) return {.withheld = {}, .octets = octets};
    const std::size_t compared = std::min(octets.size(), length_ - matched_);
    if (std::equal(octets.begin(), octets.begin() + static_cast<std::ptrdiff_t>(compared),
                   expected_.begin() + static_cast<std::ptrdiff_t>(matched_))) {
        matched_ += compared;
        if (matched_ == length_) conclude(Outcome::whole);
        return {.withheld = {}, .octets = octets.subspan(compared)};
    }
    const Bytes withheld = Bytes{expected_}.first(matched_);
    conclude(at < quiet_until_ ? Outcome::broken : Outcome::missing);
    return {.withheld = withheld, .octets = octets};
}

Bytes Echo::on_character_error(Instant at) noexcept
{
    if (!is_expected(at)) return {};
    const Bytes withheld = Bytes{expected_}.first(matched_);
    conclude(Outcome::broken);
    return withheld;
}

/// The time of an echo that was not complete by now is over; a piece of it that was withheld was ours.
bool Echo::is_expected(Instant at) noexcept
{
    if (length_ != 0 && at > until_) conclude(matched_ == 0 ? Outcome::missing : Outcome::broken);
    return length_ != 0;
}

void Echo::conclude(Outcome outcome) noexcept
{
    length_ = matched_ = 0;
    std::uint8_t& row = outcome == Outcome::whole ? heard_in_row_ : unheard_in_row_;
    std::uint8_t& other = outcome == Outcome::whole ? unheard_in_row_ : heard_in_row_;
    other = 0;
    if (row < kConvincing) ++row;
    if (row == kConvincing) finding_ = outcome == Outcome::whole ? Finding::heard : Finding::unheard;

    if (outcome == Outcome::whole) ++removed_;
    if (!is_heard()) return; // without an echo there is none to be broken
    if (outcome == Outcome::broken) ++broken_;
    if (outcome == Outcome::missing) ++missing_;
}

bool Echo::is_heard() const noexcept
{
    return mode_ == EchoMode::on || (mode_ == EchoMode::automatic && finding_ == Finding::heard);
}

bool Echo::is_open() const noexcept
{
    return mode_ == EchoMode::automatic && finding_ == Finding::open;
}

} // namespace dpslave::fdl
