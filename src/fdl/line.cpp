// SPDX-License-Identifier: Apache-2.0
/// The receiving half of a station: from octets to telegrams, and which of them concern us.
#include "dpslave/fdl/station.hpp"

#include <algorithm>
#include <cstring>

namespace dpslave::fdl {
namespace {

/// How long the line may be silent within a telegram before it counts as unfinished: T_SYN and an allowance
/// for the scheduler, because reads say little about the times on the wire (wire reference 1.5).
std::chrono::nanoseconds silence_limit(Baud baud)
{
    using std::chrono::milliseconds;
    return duration_of(kTsyn, baud) + (baud >= Baud::k93_75 ? milliseconds{5} : milliseconds{20});
}

/// The largest receive FIFO in use. A UART may hold so many characters back before it hands them on (OMAP: 48
/// of 64), and what looks like silence until then may have been a telegram that goes on.
constexpr Tbit kFifo{64 * kCharacter.count};

/// When an unfinished telegram is given up although nothing came behind it that tells its end.
Instant given_up_at(Instant read_at, Baud baud)
{
    return read_at + silence_limit(baud) + duration_of(kFifo, baud);
}

bool is_sdn(const Telegram& telegram)
{
    return telegram.function() == Function::sdn_low || telegram.function() == Function::sdn_high;
}

/// Whether the beginning of a telegram that was cut off may be what makes one fail so. A telegram with a good
/// checksum that says what nobody understands is one.
bool may_be_stump(Flaw flaw)
{
    return flaw == Flaw::checksum || flaw == Flaw::end_delimiter || flaw == Flaw::character ||
           flaw == Flaw::unfinished;
}

/// Whether these octets are whole telegrams, the last of them one with a checksum.
bool are_telegrams(Bytes octets)
{
    bool has_checksum = false;
    while (!octets.empty()) {
        const auto length = frame_length(octets);
        if (!length || *length == 0 || octets.size() < *length) return false;
        const auto telegram = decode(octets.first(*length));
        if (!telegram) return false;
        has_checksum = telegram->has_fc();
        octets = octets.subspan(*length);
    }
    return has_checksum;
}

/// Whether a slave answers this function at all. Time_Event and the reserved codes are met with silence.
bool is_answered(Function function)
{
    switch (function) {
        case Function::sda_low:
        case Function::sda_high:
        case Function::msrd:
        case Function::fdl_status:
        case Function::srd_low:
        case Function::srd_high:
        case Function::ident:
        case Function::lsap_status: return true;
        case Function::time_event:
        case Function::sdn_low:
        case Function::sdn_high: break;
    }
    return false;
}

} // namespace

void Station::on_bytes(Bytes bytes, Instant read_at, bool more_follows)
{
    if (bytes.empty()) return;
    cancel_reply();
    counters_.octets += bytes.size();
    begin_read(bytes.size(), read_at);
    if (!rate_is_kept(bytes.size(), 0, read_at)) return;

    while (!bytes.empty()) {
        const std::size_t taken = std::min(bytes.size(), rx_.size() - used_);
        std::memcpy(rx_.data() + used_, bytes.data(), taken);
        used_ += taken;
        bytes = bytes.subspan(taken);
        consume(read_at, bytes.empty() && !more_follows);
    }
    await_rest();
}

void Station::on_character_error(Instant read_at)
{
    cancel_reply();
    ++counters_.octets;
    count(Flaw::character);
    begin_read(1, read_at);
    if (!rate_is_kept(0, 1, read_at)) return;
    if (used_ == 0) return; // no telegram has begun: it is skipped like any octet that cannot begin one

    const auto length = frame_length(Bytes{rx_}.first(used_));
    if (!length || *length == 0) {
        forget_all(); // the end of this telegram cannot be known any more
        return;
    }
    rx_[used_++] = 0; // keeps the place of the octet, so that the end of the telegram is found
    spoilt_ = used_;
    consume(read_at, true);
    await_rest();
}

/// What the pause before these octets tells about the unfinished telegram.
void Station::begin_read(std::size_t octets, Instant read_at)
{
    end_silence(octets, read_at);
    if (used_ != 0 && read_at - heard_at_ >= duration_of(kTsyn, baud_)) boundaries_[used_] = true;
    heard_at_ = read_at;
}

/// Until when more is waited for, if a telegram is unfinished.
void Station::await_rest()
{
    gap_ends_ = used_ == 0 ? kNever : given_up_at(heard_at_, baud_);
    hunt_at_ = boundaries_.none() ? kNever : heard_at_ + duration_of(kTsyn, baud_);
}

/// A silence within a telegram ended when the first of these octets began, not when they were read: what a
/// FIFO held back is no silence.
void Station::end_silence(std::size_t octets, Instant read_at)
{
    const Tbit on_wire{static_cast<std::uint32_t>(octets) * kCharacter.count};
    const Instant began = read_at - duration_of(on_wire, baud_);
    if (used_ != 0 && began >= gap_ends_ - duration_of(kFifo, baud_)) drop_unfinished();
}

/// Tells the search what was heard. False: the rate has been given up, and what was heard at it means
/// nothing.
bool Station::rate_is_kept(std::size_t good, std::size_t bad, Instant at)
{
    if (!search_) return true;
    if (!baud_change_) {
        search_->on_characters(good, bad, at);
        follow_search();
    }
    return !baud_change_;
}

void Station::count(Flaw flaw)
{
    if (baud_state_ == BaudState::baud_search || (search_ && search_->in_doubt()))
        ++counters_.search_flaws;
    else
        ++counters_.flaws[static_cast<std::size_t>(flaw)];
}

/// Takes the telegrams off the front of rx_; what is left at the end is the beginning of one.
void Station::consume(Instant read_at, bool all_read)
{
    std::size_t at = 0;
    std::size_t failed = 0; // up to here a telegram was counted that has failed: not each octet again
    while (at < used_) {
        const Bytes rest = Bytes{rx_}.first(used_).subspan(at);
        const auto length = frame_length(rest);
        if (!length) {
            if (at >= failed) count(length.error());
            // Hunt on; silence is never waited for: a busy bus has none. What has failed is searched only
            // where something may have begun in it.
            const std::size_t boundary = boundary_within(at, failed);
            at = boundary < failed ? boundary : at + 1;
            continue;
        }
        if (*length == 0 || rest.size() < *length) break;
        const std::size_t end = at + *length;
        const std::size_t boundary = boundary_within(at, end);
        const auto telegram = telegram_at(at, *length, boundary != end);
        if (telegram) {
            on_telegram(*telegram, read_at, all_read && end == used_);
            at = end;
            continue;
        }
        if (at >= failed && telegram.error() != Flaw::character) count(telegram.error());
        failed = std::max(failed, end);
        at = may_be_stump(telegram.error()) ? boundary : end;
    }
    forget(at);
}

/// The telegram of `length` octets at `at` in rx_. `is_cut`: a pause lies within it.
Result<Telegram, Flaw> Station::telegram_at(std::size_t at, std::size_t length, bool is_cut) const
{
    if (spoilt_ > at) return Failure{Flaw::character}; // counted when it came
    // A token has no checksum to tell that the last octet of a request and the first of the next are none.
    if (is_cut && rx_[at] == kSD4) return Failure{Flaw::unfinished};
    return decode(Bytes{rx_}.subspan(at, length));
}

/// The first boundary behind `begin` and before `end`; `end` if there is none.
std::size_t Station::boundary_within(std::size_t begin, std::size_t end) const
{
    if (boundaries_.none()) return end;
    do ++begin;
    while (begin < end && !boundaries_[begin]);
    return begin;
}

/// The line has fallen silent within a telegram. Where whole telegrams follow a boundary in it and nothing is
/// left over, it was a stump, and they came after it.
void Station::hunt_behind_stump()
{
    hunt_at_ = kNever;
    for (std::size_t at = boundary_within(0, used_); at < used_; at = boundary_within(at, used_)) {
        if (spoilt_ > at || !are_telegrams(Bytes{rx_}.first(used_).subspan(at))) continue;
        count(Flaw::unfinished);
        forget(at);
        consume(heard_at_, true);
        await_rest();
        return;
    }
}

/// Takes the first `count` octets off rx_.
void Station::forget(std::size_t count)
{
    std::memmove(rx_.data(), rx_.data() + count, used_ - count);
    used_ -= count;
    spoilt_ -= std::min(spoilt_, count);
    if (boundaries_.none()) return;
    boundaries_ >>= count;
    boundaries_[0] = false;
}

void Station::forget_all()
{
    used_ = spoilt_ = 0;
    boundaries_.reset();
    gap_ends_ = hunt_at_ = kNever;
}

/// `newest`: nothing was heard behind this telegram.
void Station::on_telegram(const Telegram& telegram, Instant read_at, bool newest)
{
    ++counters_.telegrams;
    const bool ours = telegram.has_fc() && telegram.da < kAddresses && places_[telegram.da].user != nullptr;
    if (!ours) asked_.on_telegram(telegram, read_at);
    if (!telegram.has_fc()) return; // SC and token: no checksum, no evidence, nobody asked
    ++counters_.checked;
    last_telegram_ = read_at;

    if (search_) {
        const bool silent = search_->state() == BaudState::baud_search;
        search_->on_telegram(ours, read_at);
        follow_search();
        if (silent) return; // the telegram that ends the search is still heard in it
    }
    if (places_[telegram.sa].user != nullptr) {
        ++counters_.own_address;
        return;
    }
    const bool known_code = (telegram.fc & 0x80) == 0; // bit 7 is a second code table with nothing for us
    if (!telegram.is_request() || !known_code) return;

    if (is_sdn(telegram)) {
        if (!ours && telegram.da != kBroadcast) return;
        ++counters_.requests;
        on_sdn(telegram, read_at);
    } else if (ours && is_answered(telegram.function())) {
        ++counters_.requests;
        if (newest)
            on_request(telegram.da, telegram, read_at);
        else
            ++counters_.overtaken; // dropped whole, FCB included: the master's retry still looks new
    }
}

void Station::on_sdn(const Telegram& telegram, Instant at)
{
    const Indication indication{
        .sa = telegram.sa, .dsap = telegram.dsap, .ssap = telegram.ssap, .data = telegram.data, .at = at};
    if (telegram.da != kBroadcast) {
        places_[telegram.da].user->sdn(indication);
        called(telegram.da, at);
        return;
    }
    for (std::size_t i = 0; i < attached_count_; ++i) {
        places_[attached_[i]].user->sdn(indication);
        called(attached_[i], at);
    }
}

void Station::drop_unfinished()
{
    count(Flaw::unfinished);
    forget_all();
}

/// Somebody speaks: the moment for the reply is over. What the request did and its stored reply stay.
void Station::cancel_reply()
{
    if (!pending_) return;
    pending_.reset();
    ++counters_.overtaken;
}

} // namespace dpslave::fdl
