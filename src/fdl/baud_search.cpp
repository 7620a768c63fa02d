// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/baud_search.hpp"

#include <algorithm>
#include <array>

namespace dpslave::fdl {
namespace {

/// The rates that are searched, in the order of the search (wire reference 7.2): 45.45 kbit/s belongs to PA
/// links and is fixed by hand, everything above 1.5 Mbit/s is out of a tty's reach.
constexpr std::array kSearched{Baud::k1500, Baud::k500, Baud::k187_5, Baud::k93_75, Baud::k19_2, Baud::k9_6};

/// A rate is given up early when at least this many characters were seen and this share of them was bad.
constexpr std::uint32_t kEnoughCharacters = 20;
constexpr std::uint32_t kBadPercent = 30;

bool is_searched(const BaudSearchSettings& settings, Baud baud)
{
    return settings.rates[index_of(baud)] &&
           std::find(kSearched.begin(), kSearched.end(), baud) != kSearched.end();
}

/// The highest rate that is searched.
Baud first_rate(const BaudSearchSettings& settings)
{
    for (const Baud baud : kSearched)
        if (is_searched(settings, baud)) return baud;
    return kSearched.front();
}

} // namespace

std::string_view text(BaudState state) noexcept
{
    switch (state) {
        case BaudState::fixed: return "fixed";
        case BaudState::baud_search: return "Baud_Search";
        case BaudState::baud_control: return "Baud_Control";
        case BaudState::dp_control: return "DP_Control";
    }
    return "?";
}

BaudSearch::BaudSearch(const BaudSearchSettings& settings, Baud begin_with)
    : settings_(settings), baud_(is_searched(settings, begin_with) ? begin_with : first_rate(settings))
{}

void BaudSearch::set_rates(const std::bitset<kBauds.size()>& rates)
{
    settings_.rates = rates;
    if (is_searched(settings_, baud_)) return;
    state_ = BaudState::baud_search;
    in_doubt_ = false;
    baud_ = next_rate();
    begun_ = false; // the dwell begins with the first call that has the time
    deadline_ = {};
}

void BaudSearch::on_characters(std::size_t good, std::size_t bad, Instant at)
{
    begin_if_new(at);
    if (state_ != BaudState::baud_search && !in_doubt_) return;
    characters_ += static_cast<std::uint32_t>(good + bad);
    bad_ += static_cast<std::uint32_t>(bad);
    const auto many_bad = std::uint64_t{bad_} * 100 > std::uint64_t{characters_} * kBadPercent;
    if (characters_ >= kEnoughCharacters && many_bad) search(next_rate(), at);
}

void BaudSearch::on_telegram(bool to_us, Instant at)
{
    begin_if_new(at);
    switch (state_) {
        case BaudState::baud_search: control(at); break;
        case BaudState::baud_control:
            // Before a master has parameterised a slave, we are polled only now and then, so the traffic of
            // all stations counts; during a search it counts as well.
            if (to_us || !any_owned_ || in_doubt_) control(at);
            break;
        case BaudState::dp_control:
        case BaudState::fixed: break;
    }
}

void BaudSearch::on_supervision(bool any_owned, bool any_supervised, Instant at)
{
    begin_if_new(at);
    any_owned_ = any_owned;
    any_supervised_ = any_supervised;
    const bool was_supervised = state_ == BaudState::dp_control;
    if (state_ != BaudState::baud_search && any_supervised != was_supervised) control(at);
}

void BaudSearch::on_time(Instant now)
{
    begin_if_new(now);
    if (now < deadline_) return;
    if (state_ == BaudState::baud_control && !in_doubt_)
        doubt(now);
    else
        search(next_rate(), now);
}

void BaudSearch::begin_if_new(Instant at)
{
    if (begun_) return;
    begun_ = true;
    search(baud_, at);
}

void BaudSearch::search(Baud baud, Instant at)
{
    state_ = BaudState::baud_search;
    in_doubt_ = false;
    baud_ = baud;
    listen(at);
}

/// A master that was switched off comes back with its rate, and one that polls seldom has never gone: listen
/// at the rate that was found before it is left (wire reference 7.2).
void BaudSearch::doubt(Instant at)
{
    in_doubt_ = true;
    listen(at);
}

/// Begins a dwell.
void BaudSearch::listen(Instant at)
{
    characters_ = 0;
    bad_ = 0;
    deadline_ = at + dwell_at(baud_, settings_);
}

/// The rate is right: watch it, or leave that to the watchdogs of the slaves.
void BaudSearch::control(Instant at)
{
    state_ = any_supervised_ ? BaudState::dp_control : BaudState::baud_control;
    in_doubt_ = false;
    deadline_ = any_supervised_ ? kNever : at + settings_.baud_control;
}

/// The next lower rate; after the lowest the highest again.
Baud BaudSearch::next_rate() const
{
    for (const Baud baud : kSearched)
        if (baud < baud_ && is_searched(settings_, baud)) return baud;
    return first_rate(settings_);
}

} // namespace dpslave::fdl
