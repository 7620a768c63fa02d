// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/telegrams.hpp"

#include "begin.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::trace {
namespace {

std::chrono::nanoseconds wire_time(std::size_t characters, Baud baud)
{
    return duration_of(Tbit{static_cast<std::uint32_t>(characters) * kCharacter.count}, baud);
}

} // namespace

/// Octets are held until it is known where they begin.
void Telegrams::add(const Record& record)
{
    is_at_begin_ ? add_at_begin(record) : go_on(record);
}

void Telegrams::add_at_begin(const Record& record)
{
    if (record.head.kind == Kind::asked || record.head.kind == Kind::answered ||
        record.head.kind == Kind::no_answer || record.head.kind == Kind::line)
        return;
    const bool is_more =
        record.head.kind == Kind::heard && (held_.empty() || held_.front().head.rate == record.head.rate);
    if (!is_more) {
        begin(*cut_off(held_octets_, Behind::silence));
        return go_on(record);
    }
    held_.push_back(record);
    const Bytes octets = record.octets;
    held_octets_.insert(held_octets_.end(), octets.begin(), octets.end());
    if (const auto cut = cut_off(held_octets_, Behind::more)) begin(*cut);
}

/// The first `cut` octets of what is held are the end of a telegram. The octets after them are heard as ever.
void Telegrams::begin(std::size_t cut)
{
    is_at_begin_ = false;
    held_octets_.clear();
    Entry entry;
    for (Record& record : std::exchange(held_, {})) {
        const std::size_t of_it = std::min(cut, record.octets.size());
        if (of_it != 0) {
            emit_cut(record, of_it, entry);
            cut -= of_it;
            if (cut == 0) done_.push_back(std::move(entry));
            const Bytes rest = Bytes{record.octets}.subspan(of_it);
            if (rest.empty()) continue;
            record.octets.assign(std::vector<std::uint8_t>(rest.begin(), rest.end()));
        }
        go_on(record);
    }
}

/// The first `count` octets of the record belong to `entry`, which goes on in it.
void Telegrams::emit_cut(const Record& record, std::size_t count, Entry& entry)
{
    if (entry.octets.empty()) {
        entry = simple(Entry::What::cut, {});
        entry.baud = kBauds[std::min<std::size_t>(record.head.rate, kBauds.size() - 1)];
    }
    const std::size_t all = record.octets.size();
    const Bytes of_it = Bytes{record.octets}.first(count);
    entry.octets.insert(entry.octets.end(), of_it.begin(), of_it.end());
    entry.at = record.head.at;
    entry.last = record.head.at - wire_time(all - count, entry.baud);
    const Instant begun = entry.last - wire_time(entry.octets.size(), entry.baud);
    entry.first = entry.octets.size() == count ? begun : std::min(entry.first, begun);
    entry.uncertainty = uncertainty_of(all, record.head.at);
    read_before_ = count == all ? record.head.at : read_before_ + wire_time(count, entry.baud);
}

void Telegrams::go_on(const Record& record)
{
    const Baud baud = kBauds[std::min<std::size_t>(record.head.rate, kBauds.size() - 1)];
    if (baud != baud_ || !knows_rate_) {
        emit_rest(Entry::What::piece);
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
    if (is_at_begin_) begin(*cut_off(held_octets_, Behind::gap));
    emit_rest(flaw_ ? Entry::What::piece : Entry::What::cut);
    receiver_.restart(baud_);
    is_at_begin_ = true;
    Entry entry = simple(Entry::What::lost, at);
    entry.count = count;
    done_.push_back(std::move(entry));
}

void Telegrams::pass_time(Instant now)
{
    if (is_at_begin_) {
        if (held_.empty() || now - held_.back().head.at < fdl::silence_limit(Baud::k9_6)) return;
        begin(*cut_off(held_octets_, Behind::silence));
    }
    while (receiver_.on_time(now)) take_heard();
}

std::optional<Entry> Telegrams::take()
{
    if (done_.empty()) return std::nullopt;
    Entry next = std::move(done_.front());
    done_.pop_front();
    return next;
}

/// The octets are judged as Layer2 does it. A record of its own says when Layer2 looked at the time: a bus
/// thread that read late has not looked.
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

/// Ends the octets that can become no telegram any more: because of another rate, or a gap in the records.
void Telegrams::emit_rest(Entry::What what)
{
    const std::uint64_t all = emitted_ + characters_.size();
    emit(what, all);
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
