// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/receiver.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace dpslave::fdl {
namespace {

/// The largest receive FIFO in use. A UART may hold so many characters back before it hands them on (OMAP: 48
/// of 64), and what looks like silence until then may have been a telegram that goes on.
constexpr Tbit kFifo{64 * kCharacter.count};

/// So much silence ends a piece that is no telegram: T_SYN and the idle time-out of a FIFO, which holds the
/// last octets back for four characters. A master repeats a request after a slot time of 100 T_bit at the
/// least.
constexpr Tbit kPause = kTsyn + Tbit{4 * kCharacter.count};

/// When an unfinished telegram is given up although nothing came behind it that shows its end.
Instant given_up_at(Instant read_at, Baud baud)
{
    return read_at + silence_limit(baud) + duration_of(kFifo, baud);
}

/// Whether these octets are no telegram: the beginning of one that was cut off may be what makes one fail so.
/// A telegram with a good checksum that says what is not understood is one.
bool is_damage(Flaw flaw)
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
        const Tbit on_wire{static_cast<std::uint32_t>(octets) * kCharacter.count};
        const Instant began = read_at - duration_of(on_wire, baud_);
        if (began >= gap_ends_ - duration_of(kFifo, baud_))
            give_up();
        else if (used_ != 0 && read_at - heard_at_ >= duration_of(kTsyn, baud_))
            boundaries_[used_] = true;
        if (damaged_ && began - heard_at_ >= duration_of(kPause, baud_)) {
            damaged_ = false;
            counted_ = used_;
        }
    }
    heard_at_ = read_at;
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
    if (!std::exchange(damaged_, true)) pending_flaw_ = Flaw::character;
    const auto length = frame_length(Bytes{rx_}.first(used_));
    if (!length || *length == 0) {
        forget_all(); // no telegram has begun, or its end cannot be known any more
        ++forgotten_;
        return;
    }
    rx_[used_++] = 0; // keeps the place of the octet, so that the end of the telegram is found
    spoilt_ = used_;
    more_follows_ = false;
    reading_ = true;
}

bool Receiver::on_time(Instant now)
{
    if (now >= hunt_at_ && hunt_behind_stump()) return true;
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

/// Goes over rx_; what is left at the end is the beginning of a telegram. True: heard_ is the next one.
bool Receiver::next_in_buffer()
{
    heard_.at = heard_at_;
    heard_.newest = false;
    while (at_ < used_) {
        const Bytes rest = Bytes{rx_}.first(used_).subspan(at_);
        const auto length = frame_length(rest);
        if (!length) {
            heard_.begin = heard_.end = forgotten_ + at_;
            const bool is_new = begins_flaw();
            // Hunt on; silence is never waited for: a busy bus has none. What has failed is searched only
            // where something may have begun in it.
            const std::size_t boundary = boundary_within(at_, failed_);
            at_ = boundary < failed_ ? boundary : at_ + 1;
            if (!is_new) continue;
            heard_.telegram = Failure{length.error()};
            return true;
        }
        if (*length == 0 || rest.size() < *length) break;
        const std::size_t end = at_ + *length;
        heard_.begin = forgotten_ + at_;
        heard_.end = forgotten_ + end;
        const std::size_t boundary = boundary_within(at_, end);
        heard_.telegram = telegram_at(at_, *length, boundary != end);
        if (heard_.telegram) {
            at_ = end;
            if (heard_.telegram->has_fc()) damaged_ = false; // SC and tokens are in noise by chance
            heard_.newest = input_.empty() && !more_follows_ && end == used_;
            return true;
        }
        const Flaw flaw = heard_.telegram.error();
        if (!is_damage(flaw)) {
            at_ = end;
            damaged_ = false;
            return true;
        }
        const bool is_new = begins_flaw();
        failed_ = std::max(failed_, end);
        at_ = boundary;
        if (is_new) return true;
    }
    return false;
}

/// What is at at_ is no telegram. True: it is the first of its piece, and counts.
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

/// The first boundary behind `begin` and before `end`; `end` if there is none.
std::size_t Receiver::boundary_within(std::size_t begin, std::size_t end) const
{
    if (boundaries_.none()) return end;
    do ++begin;
    while (begin < end && !boundaries_[begin]);
    return begin;
}

/// The line has fallen silent within a telegram. Where whole telegrams follow a boundary in it and nothing is
/// left over, it was a stump, and they came after it.
bool Receiver::hunt_behind_stump()
{
    hunt_at_ = kNever;
    for (std::size_t at = boundary_within(0, used_); at < used_; at = boundary_within(at, used_)) {
        if (spoilt_ > at || !are_telegrams(Bytes{rx_}.first(used_).subspan(at))) continue;
        report_unfinished();
        forget(at);
        more_follows_ = false;
        reading_ = true;
        return true;
    }
    return false;
}

/// Until when more is waited for, if a telegram is unfinished.
void Receiver::await_rest()
{
    gap_ends_ = used_ == 0 ? kNever : given_up_at(heard_at_, baud_);
    hunt_at_ = boundaries_.none() ? kNever : heard_at_ + duration_of(kTsyn, baud_);
}

void Receiver::give_up()
{
    report_unfinished();
    forget_all();
}

/// The line has fallen silent behind the stump that rx_ begins with.
void Receiver::report_unfinished()
{
    if (!std::exchange(damaged_, false) && counted_ == 0) pending_flaw_ = Flaw::unfinished;
}

/// Takes the first `count` octets off rx_.
void Receiver::forget(std::size_t count)
{
    std::memmove(rx_.data(), rx_.data() + count, used_ - count);
    used_ -= count;
    forgotten_ += count;
    spoilt_ -= std::min(spoilt_, count);
    counted_ -= std::min(counted_, count);
    if (boundaries_.none()) return;
    boundaries_ >>= count;
    boundaries_[0] = false;
}

void Receiver::forget_all()
{
    forgotten_ += used_;
    used_ = spoilt_ = counted_ = 0;
    boundaries_.reset();
    gap_ends_ = hunt_at_ = kNever;
}

void Receiver::restart(Baud baud)
{
    baud_ = baud;
    forget_all();
    at_ = failed_ = 0;
    forgotten_ += input_.size();
    input_ = {};
    reading_ = damaged_ = false;
    pending_flaw_.reset();
}

} // namespace dpslave::fdl
