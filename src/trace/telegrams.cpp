// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/telegrams.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::trace {
namespace {

std::chrono::nanoseconds wire_time(std::size_t characters, Baud baud)
{
    return duration_of(Tbit{static_cast<std::uint32_t>(characters) * kCharacter.count}, baud);
}

} // namespace

void Telegrams::add(const Record& record)
{
    const Baud baud = kBauds[std::min<std::size_t>(record.head.rate, kBauds.size() - 1)];
    if (baud != baud_ || !knows_rate_) {
        emit_rest();
        baud_ = baud;
        receiver_.restart(baud);
        knows_rate_ = true;
    }
    switch (record.head.kind) {
        case Kind::heard: hear(record.octets, false, record); break;
        case Kind::bad_character: hear(std::array<std::uint8_t, 1>{}, true, record); break;
        case Kind::sent: {
            Entry reply = simple(Entry::What::reply, record.head.at);
            reply.octets.assign(record.octets.bytes().begin(), record.octets.bytes().end());
            reply.first = record.head.begun;
            reply.last = record.head.begun + wire_time(reply.octets.size(), baud_);
            reply.uncertainty = record.head.at - record.head.begun;
            done_.push_back(std::move(reply));
            break;
        }
        case Kind::unanswered: {
            Entry entry = simple(Entry::What::unanswered, record.head.at);
            entry.why = static_cast<fdl::Unanswered::Why>(record.head.detail);
            entry.address = record.head.address;
            done_.push_back(std::move(entry));
            break;
        }
        case Kind::silence: pass_time(record.head.at); break;
        case Kind::rate: done_.push_back(simple(Entry::What::rate, record.head.at)); break;
        case Kind::asked:
        case Kind::answered:
        case Kind::no_answer:
        case Kind::line: break; // of a drive line: they are no telegrams
    }
}

void Telegrams::lost(std::uint64_t count, Instant at)
{
    emit_rest();
    receiver_.restart(baud_);
    Entry entry = simple(Entry::What::lost, at);
    entry.count = count;
    done_.push_back(std::move(entry));
}

void Telegrams::pass_time(Instant now)
{
    while (receiver_.on_time(now)) take_heard();
}

std::optional<Entry> Telegrams::take()
{
    if (done_.empty()) return std::nullopt;
    Entry next = std::move(done_.front());
    done_.pop_front();
    return next;
}

/// As Layer2 does it. When it looked at the time is a record of its own: a bus thread that read late has not.
void Telegrams::hear(Bytes octets, bool is_bad, const Record& record)
{
    if (octets.empty()) return;
    receiver_.begin_read(octets.size(), record.head.at);
    take_heard();
    const auto uncertainty = uncertainty_of(octets.size(), record.head.at);
    for (std::size_t i = 0; i < octets.size(); ++i)
        characters_.push_back({.octet = octets[i],
                               .is_bad = is_bad,
                               .read_at = record.head.at,
                               .behind = static_cast<std::uint32_t>(octets.size() - 1 - i),
                               .uncertainty = uncertainty});
    read_before_ = record.head.at;
    if (is_bad)
        receiver_.on_character_error();
    else
        receiver_.on_bytes(octets, record.head.more_follows);
    take_heard();
}

void Telegrams::take_heard()
{
    while (const auto* heard = receiver_.next()) {
        if (!heard->telegram) {
            if (!flaw_) flaw_ = heard->telegram.error();
            continue;
        }
        emit(Entry::What::piece, heard->begin);
        emit(Entry::What::telegram, heard->end);
    }
    emit(Entry::What::piece, receiver_.judged());
}

/// The characters up to `end`, of all heard, are one entry.
void Telegrams::emit(Entry::What what, std::uint64_t end)
{
    if (end <= emitted_ || characters_.empty()) return;
    Entry entry = simple(what, {});
    const Character first = characters_.front();
    Character last = first;
    for (; emitted_ != end && !characters_.empty(); ++emitted_) {
        last = characters_.front();
        characters_.pop_front();
        entry.octets.push_back(last.octet);
        entry.bad_characters += last.is_bad ? 1 : 0;
    }
    entry.at = last.read_at;
    entry.last = last.read_at - wire_time(last.behind, baud_);
    // On a pty octets may come faster than the rate lets them.
    entry.first = std::min(first.read_at - wire_time(first.behind + 1, baud_),
                           entry.last - wire_time(entry.octets.size(), baud_));
    entry.uncertainty = last.uncertainty;
    if (what == Entry::What::piece) entry.flaw = std::exchange(flaw_, std::nullopt);
    done_.push_back(std::move(entry));
}

/// What no telegram can become of any more: another rate, a gap in the records, or a reply of ours.
void Telegrams::emit_rest()
{
    const std::uint64_t all = emitted_ + characters_.size();
    emit(Entry::What::piece, all);
}

/// A read gives characters that came since the one before: no sooner than they fit on the line, and no longer
/// ago than the port holds them back.
std::chrono::nanoseconds Telegrams::uncertainty_of(std::size_t characters, Instant read_at) const
{
    const auto since = read_at - read_before_ - wire_time(characters, baud_);
    return std::clamp<std::chrono::nanoseconds>(since, std::chrono::nanoseconds{0}, hold_back_);
}

Entry Telegrams::simple(Entry::What what, Instant at) const
{
    Entry entry;
    entry.what = what;
    entry.baud = baud_;
    entry.at = entry.first = entry.last = at;
    return entry;
}

} // namespace dpslave::trace
