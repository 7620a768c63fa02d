// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace test {

using dpslave::Instant;
using dpslave::Tbit;

Bus::Bus(dpslave::fdl::Layer2& station, const BusSettings& settings) : station_(station), settings_(settings)
{
    pump();
}

Bus::duration Bus::bits(std::uint32_t count) const
{
    return dpslave::duration_of(Tbit{count}, settings_.baud);
}

Bus::duration Bus::deadline() const
{
    const Tbit max_tsdr = settings_.max_tsdr.value_or(kClassMaxTsdr[dpslave::index_of(settings_.baud)]);
    return bits(std::max(max_tsdr.count, settings_.min_tsdr.count + 49));
}

void Bus::master_sends(const Octets& telegram)
{
    settle();
    wait_for_syn();
    speak(telegram);
    deliver(telegram);
    ended(telegram);
}

void Bus::send(const Octets& telegram)
{
    master_sends(telegram);
    if (const auto answer = reply()) ADD_FAILURE() << show(telegram) << " is answered: " << show(*answer);
}

void Bus::arrives_octet_by_octet(const Octets& telegram)
{
    arrives_in_bunches(telegram, 1);
}

void Bus::arrives_in_bunches(const Octets& telegram, std::size_t size)
{
    settle();
    wait_for_syn();
    for (std::size_t at = 0; at < telegram.size(); at += size) {
        const auto begin = telegram.begin() + static_cast<std::ptrdiff_t>(at);
        const Octets bunch(begin, begin + static_cast<std::ptrdiff_t>(std::min(size, telegram.size() - at)));
        speak(bunch);
        deliver(bunch);
    }
    ended(telegram);
}

void Bus::arrives_in_one_read(const std::vector<Octets>& telegrams)
{
    settle();
    for (const Octets& telegram : telegrams) {
        now_ =
            std::max(now_, busy_until_ + bits(33)); // the reader sleeps: the station is not called meanwhile
        speak(telegram);
    }
    deliver(joined(telegrams));
    ended(joined(telegrams));
}

void Bus::arrives_with_bad_character(const Octets& telegram, std::size_t bad)
{
    settle();
    wait_for_syn();
    speak(telegram);
    const auto at = telegram.begin() + static_cast<std::ptrdiff_t>(bad);
    deliver({telegram.begin(), at});
    deliver_bad();
    asked_.clear();
    deliver({at + 1, telegram.end()});
    ended({at + 1, telegram.end()});
}

void Bus::arrives_as(const Octets& telegram, const std::vector<Character>& received)
{
    settle();
    wait_for_syn();
    speak(telegram);
    Octets good; // since the last bad one
    const auto hand_over = [&] {
        deliver(good);
        asked_.insert(asked_.end(), good.begin(), good.end());
        good.clear();
    };
    for (const Character& one : received) {
        if (one.good) {
            good.push_back(one.octet);
            continue;
        }
        hand_over();
        deliver_bad();
        asked_.clear();
    }
    hand_over();
    ended({});
}

void Bus::master_sends_after(duration pause, const Octets& telegram)
{
    if (pause < bits(33)) ADD_FAILURE() << "the master asks before T_SYN: " << show(telegram);
    breaks_in_after(pause, telegram);
}

void Bus::breaks_in_after(duration pause, const Octets& octets)
{
    advance_to(std::max(now_, busy_until_ + pause));
    speak(octets);
    deliver(octets);
    ended(octets);
}

std::optional<Octets> Bus::reply()
{
    settle();
    if (!unread_) return std::nullopt;
    Octets octets = std::move(unread_->octets);
    unread_.reset();
    return octets;
}

Bus::duration Bus::turnaround() const
{
    return turnaround_;
}

std::vector<dpslave::Baud> Bus::take_baud_changes()
{
    return std::exchange(baud_changes_, {});
}

void Bus::advance(duration by)
{
    advance_to(now_ + by);
}

void Bus::line_is_idle_for(duration silence)
{
    settle();
    advance_to(std::max(now_, busy_until_) + silence);
}

/// The cycle ends with the reply, or with the slot time in which none came.
void Bus::settle()
{
    if (in_cycle_) advance_to(request_end_ + deadline() + bits(1));
    in_cycle_ = false;
    now_ = std::max(now_, busy_until_);
}

void Bus::wait_for_syn()
{
    advance_to(busy_until_ + bits(33));
}

/// A master's octets pass over the line. The station hears of them when they are delivered.
Instant Bus::speak(const Octets& octets)
{
    if (now_ < busy_until_) ADD_FAILURE() << "two talk at once: a master begins with " << show(octets);
    unread_.reset();
    now_ += static_cast<std::int64_t>(octets.size()) * bits(11);
    busy_until_ = now_;
    request_end_ = now_;
    return now_;
}

void Bus::deliver(const Octets& octets)
{
    if (octets.empty()) return;
    if (station_.baud() == settings_.baud) {
        station_.on_bytes(octets, now_);
        pump();
    } else {
        for (std::size_t i = 0; i < octets.size(); ++i)
            deliver_bad(); // at a wrong rate there are no characters
    }
}

void Bus::deliver_bad()
{
    station_.on_character_error(now_);
    pump();
}

void Bus::ended(const Octets& octets)
{
    asked_.insert(asked_.end(), octets.begin(), octets.end());
    if (asked_.size() > 255) asked_.erase(asked_.begin(), asked_.end() - 255); // the longest telegram
    in_cycle_ = true;
}

/// What an edge does after every read and at every deadline.
void Bus::pump()
{
    station_.on_time(now_);
    if (const auto transmit = station_.take_transmit()) {
        const Octets octets(transmit->begin(), transmit->end());
        judge(octets);
        turnaround_ = now_ - request_end_;
        unread_ = Reply{octets, now_};
        busy_until_ = now_ + static_cast<std::int64_t>(octets.size()) * bits(11);
        in_cycle_ = false;
        asked_.clear();
    }
    if (const auto baud = station_.take_baud_change()) baud_changes_.push_back(*baud);
}

void Bus::judge(const Octets& octets)
{
    if (now_ < busy_until_) ADD_FAILURE() << "two talk at once: the slave begins with " << show(octets);
    if (now_ < request_end_ + bits(settings_.min_tsdr.count))
        ADD_FAILURE() << "reply before min T_SDR: " << show(octets);
    if (now_ > request_end_ + deadline()) ADD_FAILURE() << "reply after the deadline: " << show(octets);
    const std::optional<Heard> telegram = heard(octets);
    if (!telegram || telegram->is_request() || telegram->delimiter == 0xDC)
        ADD_FAILURE() << "the slave sends what is no reply: " << show(octets);
    if (!in_cycle_ || !ends_with_answerable_request(asked_))
        ADD_FAILURE() << "the slave answers what is no request: " << show(octets)
                      << "\n  to: " << show(asked_);
}

void Bus::advance_to(Instant target)
{
    int standing = 0;
    while (true) {
        const Instant due = station_.next_deadline();
        if (due > target || due + edge_latency_ > target) break;
        const Instant wake = std::max(now_, due + edge_latency_);
        standing = wake == now_ ? standing + 1 : 0;
        if (standing > 3) {
            ADD_FAILURE() << "next_deadline() does not move on";
            break;
        }
        now_ = wake;
        pump();
    }
    now_ = std::max(now_, target);
}

} // namespace test
