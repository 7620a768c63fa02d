// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/receiver.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace dpslave::fdl {
namespace {

/// The largest receive FIFO in use. A UART may hold that many characters back before it hands them on (OMAP:
/// 48 of 64), and what looks like silence until then may have been a telegram that goes on.
constexpr Tbit kFifo{64 * kCharacter.count};

/// A silence of this length ends octets that are no telegram: T_SYN and the idle timeout of a FIFO, which
/// holds the last octets back for four characters. A master repeats a request after a slot time of 100 T_bit
/// at the least.
constexpr Tbit kPause = kTsyn + Tbit{4 * kCharacter.count};

/// A silence of this length before the first octet of a read cannot be inside a telegram, whose characters
/// follow each other at once. It is less than T_SYN, because the reads before and after it are late by
/// different times. With the first character it is longer than T_SYN, so each silence is a boundary.
constexpr Tbit kSilence{kTsyn.count - kCharacter.count + 1};

/// Returns when an unfinished telegram is given up if nothing follows that shows its end.
Instant given_up_at(Instant read_at, Baud baud)
{
    return read_at + silence_limit(baud) + duration_of(kFifo, baud);
}

/// Returns whether these octets are damaged: the beginning of a telegram that was cut off may be the reason.
/// A telegram with a good checksum and an unknown meaning is not damaged.
bool is_damage(const Result<Telegram, Flaw>& heard)
{
    if (heard) return false;
    const Flaw flaw = heard.error();
    return flaw == Flaw::checksum || flaw == Flaw::end_delimiter || flaw == Flaw::character ||
           flaw == Flaw::unfinished;
}

/// Returns the first of the places after `begin` and before `end`; `end` if there is none.
template <std::size_t Size>
std::size_t first_of(const std::bitset<Size>& places, std::size_t begin, std::size_t end)
{
    do ++begin;
    while (begin < end && !places[begin]);
    return begin;
}

} // namespace

std::chrono::nanoseconds silence_limit(Baud baud)
{
    using std::chrono::milliseconds;
    return duration_of(kTsyn, baud) + (is_slow(baud) ? milliseconds{20} : milliseconds{5});
}

/// A silence within a telegram ended when the first of these octets began, not when they were read: what a
/// FIFO held back is no silence.
void Receiver::begin_read(std::size_t octets, Instant read_at)
{
    if (used_ != 0 || damaged_) {
        const Instant began = read_at - on_wire(octets);
        if (began >= gap_ends_ - duration_of(kFifo, baud_) && !in_doubt_) give_up();
        note_pause(octets, read_at);
        if (damaged_ && began - heard_at_ >= duration_of(kPause, baud_)) {
            damaged_ = false;
            counted_ = used_;
        }
    }
    heard_at_ = read_at;
}

std::chrono::nanoseconds Receiver::on_wire(std::size_t octets) const
{
    return duration_of(Tbit{static_cast<std::uint32_t>(octets) * kCharacter.count}, baud_);
}

/// The pause before the read, if it goes on within a telegram. Its beginning is known with its last piece.
void Receiver::note_pause(std::size_t octets, Instant read_at)
{
    const bool goes_on = more_follows_;
    if (!goes_on) {
        read_ = forgotten_ + used_;
        octets_of_read_ = 0;
        quiet_since_ = heard_at_;
    }
    octets_of_read_ += octets;
    if (read_ <= forgotten_) return;
    const auto at = static_cast<std::size_t>(read_ - forgotten_);
    const Instant began = read_at - on_wire(octets_of_read_);
    const bool is_silence = began - quiet_since_ >= duration_of(kSilence, baud_);
    silences_[at] = is_silence && (!goes_on || silences_[at]); // a later piece may have been read late
    if (goes_on) return;
    boundaries_[at] = read_at - quiet_since_ >= duration_of(kTsyn, baud_);
    has_boundary_ = has_boundary_ || boundaries_[at];
}

void Receiver::on_bytes(Bytes bytes, bool more_follows)
{
    input_ = bytes;
    more_follows_ = more_follows;
    reading_ = true;
    refill();
}

void Receiver::on_character_error()
{
    more_follows_ = false;
    if (!std::exchange(damaged_, true)) pending_flaw_ = Flaw::character;
    const auto length = frame_length(Bytes{rx_}.first(used_));
    if (!length || *length == 0) {
        forget_all(); // no telegram has begun, or its end cannot be known any more
        ++forgotten_;
        return;
    }
    rx_[used_++] = 0; // keeps the place of the octet, so that the end of the telegram is found
    spoilt_ = used_;
    reading_ = true;
}

bool Receiver::on_time(Instant now)
{
    more_follows_ = false; // it would have come by now
    if (now >= hunt_at_) {
        hunt_at_ = kNever;
        boundaries_[used_] = silences_[used_] = true; // until the next read tells that it was none
        if (in_doubt_ || hunt_after_cut()) {
            reading_ = true;
            return true;
        }
    }
    if (used_ == 0 || now < gap_ends_) return false;
    give_up();
    return true;
}

const Receiver::Heard* Receiver::next()
{
    if (pending_flaw_) {
        heard_ = {.telegram = Failure{*pending_flaw_},
                  .at = heard_at_,
                  .begin = forgotten_,
                  .end = forgotten_,
                  .newest = false};
        pending_flaw_.reset();
        return &heard_;
    }
    while (reading_) {
        if (next_in_buffer()) return &heard_;
        forget(at_);
        at_ = failed_ = 0;
        if (!input_.empty()) {
            refill();
        } else {
            reading_ = false;
            await_rest();
        }
    }
    return nullptr;
}

/// Goes over rx_; what is left at the end is the beginning of a telegram. Returns true if heard_ is the next
/// one.
bool Receiver::next_in_buffer()
{
    heard_.at = heard_at_;
    heard_.newest = false;
    in_doubt_ = false;
    while (at_ < used_) {
        const Bytes rest = Bytes{rx_}.first(used_).subspan(at_);
        const auto length = frame_length(rest);
        if (!length) {
            heard_.begin = heard_.end = forgotten_ + at_;
            const bool is_new = begins_flaw();
            // Hunt on; silence is never waited for: a busy bus has none. A failed telegram is searched only
            // where something may have begun in it.
            at_ = std::max(at_ + 1, boundary_within(at_, searched_));
            if (!is_new) continue;
            heard_.telegram = Failure{length.error()};
            return true;
        }
        if (*length == 0 || rest.size() < *length) break;
        const std::size_t end = at_ + *length;
        heard_.begin = forgotten_ + at_;
        heard_.end = forgotten_ + end;
        std::size_t boundary = boundary_within(at_, end);
        heard_.telegram = telegram_at(at_, *length, boundary != end);
        if (boundary != end && !is_damage(heard_.telegram)) {
            const Doubt doubt = doubt_about(end);
            in_doubt_ = doubt.tail == Tail::open;
            if (in_doubt_) break;
            if (doubt.tail == Tail::telegrams) {
                heard_.telegram = Failure{Flaw::unfinished};
                boundary = doubt.at;
            }
        }
        if (heard_.telegram) {
            at_ = end;
            if (heard_.telegram->has_fc()) damaged_ = false; // SC and tokens are in noise by chance
            heard_.newest = input_.empty() && !more_follows_ && end == used_;
            return true;
        }
        if (!is_damage(heard_.telegram)) {
            at_ = end;
            damaged_ = false;
            return true;
        }
        const bool is_new = begins_flaw();
        failed_ = std::max(failed_, end);
        searched_ = std::max(searched_, failed_);
        at_ = boundary;
        if (is_new) return true;
    }
    return false;
}

/// There is no telegram at at_. Returns true if this is the first flaw of its piece, which counts.
bool Receiver::begins_flaw()
{
    return at_ >= failed_ && at_ >= counted_ && !std::exchange(damaged_, true);
}

void Receiver::refill()
{
    const std::size_t taken = std::min(input_.size(), rx_.size() - used_);
    std::memcpy(rx_.data() + used_, input_.data(), taken);
    used_ += taken;
    input_ = input_.subspan(taken);
}

/// The telegram of `length` octets at `at` in rx_. `is_cut`: a pause lies within it.
Result<Telegram, Flaw> Receiver::telegram_at(std::size_t at, std::size_t length, bool is_cut) const
{
    if (spoilt_ > at) return Failure{Flaw::character};
    // A token has no checksum: the last octet of a request and the first of the next could look like one.
    if (is_cut && rx_[at] == kSD4) return Failure{Flaw::unfinished};
    return decode(Bytes{rx_}.subspan(at, length));
}

/// Returns the first boundary after `begin` and before `end`; `end` if there is none.
std::size_t Receiver::boundary_within(std::size_t begin, std::size_t end) const
{
    return has_boundary_ ? first_of(boundaries_, begin, end) : end;
}

/// Says whether complete telegrams lie from the first of the octets up to `least` of them or beyond.
Receiver::Tail Receiver::tail_of(Bytes octets, std::size_t least)
{
    bool has_checksum = false;
    for (std::size_t at = 0; at < least;) {
        const Bytes rest = octets.subspan(at);
        const auto length = frame_length(rest);
        if (!length) return Tail::none;
        if (*length == 0 || rest.size() < *length) return Tail::open;
        const auto telegram = decode(rest.first(*length));
        if (!telegram) return Tail::none;
        has_checksum = telegram->has_fc();
        at += *length;
    }
    return has_checksum ? Tail::telegrams : Tail::none;
}

/// A good telegram lies from at_ to `end`, and a pause within it. A cut telegram and the octets after it can
/// look like a good one by chance: then telegrams begin after a silence. No telegram is completed across the
/// next silence.
Receiver::Doubt Receiver::doubt_about(std::size_t end) const
{
    const std::size_t falls_silent = first_of(silences_, end - 1, used_ + 1);
    const Bytes heard = Bytes{rx_}.first(std::min(falls_silent, used_));
    bool is_open = false;
    for (std::size_t at = first_of(silences_, at_, end); at < end; at = first_of(silences_, at, end)) {
        const Tail tail = tail_of(heard.subspan(at), end - at);
        if (tail == Tail::telegrams) {
            const bool is_sure = !more_follows_ || used_ == rx_.size(); // the silence may turn out to be none
            return {.tail = is_sure ? tail : Tail::open, .at = at};
        }
        is_open = is_open || tail == Tail::open;
    }
    return {.tail = is_open && falls_silent > used_ ? Tail::open : Tail::none, .at = end};
}

/// The line has fallen silent within a telegram. If complete telegrams follow a boundary in it and nothing is
/// left over, the part before the boundary was cut off, and they came after it.
bool Receiver::hunt_after_cut()
{
    for (std::size_t at = boundary_within(0, used_); at < used_; at = boundary_within(at, used_)) {
        if (spoilt_ > at || tail_of(Bytes{rx_}.first(used_).subspan(at), used_ - at) != Tail::telegrams)
            continue;
        report_unfinished();
        forget(at);
        return true;
    }
    return false;
}

/// Sets how long to wait for the rest of an unfinished telegram.
void Receiver::await_rest()
{
    gap_ends_ = used_ == 0 ? kNever : given_up_at(heard_at_, baud_);
    hunt_at_ = has_boundary_ && !silences_[used_] ? heard_at_ + duration_of(kTsyn, baud_) : kNever;
}

void Receiver::give_up()
{
    report_unfinished();
    forget_all();
}

/// The line has fallen silent after the cut telegram that rx_ begins with.
void Receiver::report_unfinished()
{
    if (!std::exchange(damaged_, false) && counted_ == 0) pending_flaw_ = Flaw::unfinished;
}

/// Takes the first `count` octets off rx_.
void Receiver::forget(std::size_t count)
{
    if (count == used_) return forget_all();
    std::memmove(rx_.data(), rx_.data() + count, used_ - count);
    used_ -= count;
    forgotten_ += count;
    spoilt_ -= std::min(spoilt_, count);
    counted_ -= std::min(counted_, count);
    searched_ -=
        std::min(searched_, count); // the rest of it is searched as if it had come with the beginning
    if (!has_boundary_) return;
    boundaries_ >>= count;
    silences_ >>= count;
    boundaries_[0] = false;
    has_boundary_ = boundaries_.any();
}

void Receiver::forget_all()
{
    forgotten_ += used_;
    used_ = spoilt_ = counted_ = searched_ = 0;
    gap_ends_ = hunt_at_ = kNever;
    if (!std::exchange(has_boundary_, false)) return;
    boundaries_.reset();
    silences_.reset();
}

void Receiver::restart(Baud baud)
{
    baud_ = baud;
    forget_all();
    at_ = failed_ = 0;
    forgotten_ += input_.size();
    input_ = {};
    reading_ = damaged_ = in_doubt_ = false;
    pending_flaw_.reset();
}

} // namespace dpslave::fdl
