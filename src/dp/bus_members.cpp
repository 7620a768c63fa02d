// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/bus_members.hpp"

#include "dpslave/dp/sap.hpp"
#include "dpslave/dp/slave_diag.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::dp {
namespace {

using fdl::Function;
using fdl::Telegram;
using std::chrono::nanoseconds;

/// Returns how many octets the telegram has on the wire (wire reference 2.1).
std::size_t octets_of(const Telegram& telegram)
{
    switch (telegram.delimiter) {
        case fdl::kSC: return 1;
        case fdl::kSD4: return 3;
        case fdl::kSD1: return 6;
        case fdl::kSD3: return 14;
        default: break;
    }
    return 9 + (telegram.dsap ? 1U : 0U) + (telegram.ssap ? 1U : 0U) + telegram.data.size();
}

bool wants_data(Function function)
{
    return function == Function::srd_low || function == Function::srd_high || function == Function::sda_low ||
           function == Function::sda_high;
}

/// Station type in the FC of a reply, bits 5 and 4: 00 is a slave (wire reference 2.4).
bool is_of_a_slave(const Telegram& answer)
{
    return (answer.fc & 0x30) == 0;
}

/// The first two octets of Slave_Diag (wire reference 5.1).
Member::State state_of(Bytes diagnosis)
{
    if ((diagnosis[0] & 0x40) != 0) return Member::State::prm_fault;
    if ((diagnosis[0] & 0x04) != 0) return Member::State::cfg_fault;
    if ((diagnosis[1] & 0x01) != 0) return Member::State::prm_required;
    return (diagnosis[0] & 0x02) != 0 ? Member::State::not_ready : Member::State::ready;
}

} // namespace

void Recurrence::roll(Instant at)
{
    const nanoseconds took = at - current_.begin;
    if (took < kWindow) return;
    complete_ = took < 2 * kWindow ? current_ : Window{};
    complete_took_ = took;
    current_ = {.begin = at};
}

void Recurrence::event(Instant at)
{
    roll(at);
    const Instant before = std::exchange(last_event_, at);
    const nanoseconds interval = at - before;
    if (before == Instant{} || interval >= kWindow) return; // the first one, or a new beginning
    current_.min = current_.intervals == 0 ? interval : std::min(current_.min, interval);
    current_.max = std::max(current_.max, interval);
    current_.sum += interval;
    ++current_.intervals;
}

void Recurrence::octets(std::size_t count, Instant at)
{
    roll(at);
    current_.octets += static_cast<std::uint32_t>(count);
}

Recurrence::Figures Recurrence::figures(Instant now) const
{
    const nanoseconds age = now - current_.begin;
    if (age >= 2 * kWindow) return {};
    const bool is_whole = complete_.octets != 0 || complete_.intervals != 0;
    const Window& window = is_whole ? complete_ : current_;
    const nanoseconds took = is_whole ? complete_took_ : age;
    Figures figures{.intervals = window.intervals, .min = window.min, .max = window.max};
    if (window.intervals != 0) figures.mean = window.sum / window.intervals;
    if (took > nanoseconds{0})
        figures.octets_per_second = window.octets / std::chrono::duration<double>{took}.count();
    return figures;
}

void BusMembers::on_telegram(const Telegram& telegram, Instant at)
{
    const auto asked = std::exchange(asked_, std::nullopt);
    if (telegram.delimiter == fdl::kSC) {
        if (!asked) return;
        Member& member = members_[asked->address];
        on_answer(member, telegram, at);
        if (asked->for_data_exchange) member.state = Member::State::exchange;
        return;
    }
    if (telegram.sa >= kAddresses) return;
    Member& sender = members_[telegram.sa];
    if (telegram.delimiter != fdl::kSD4 && !telegram.is_request()) {
        on_answer(sender, telegram, at);
        const std::uint8_t code = telegram.fc & 0x0F;
        const bool has_data = code == fdl::kFcDl || code == fdl::kFcDh;
        if (asked && asked->address == telegram.sa && asked->for_data_exchange && has_data)
            sender.state = Member::State::exchange;
        return;
    }
    sender.is_master = true;
    sender.last_heard = at;
    sender.recurrence.octets(octets_of(telegram), at);
    if (telegram.delimiter == fdl::kSD4) {
        if (telegram.da < kAddresses) members_[telegram.da].recurrence.event(at);
        return;
    }
    on_request(telegram, at);
}

void BusMembers::on_request(const Telegram& request, Instant at)
{
    if (request.da >= kAddresses) return;
    const bool is_for_data = wants_data(request.function());
    if (!is_for_data && request.function() != Function::fdl_status) return; // nothing is to be answered
    const bool is_exchange = is_for_data && !request.dsap;
    asked_ = Asked{.address = request.da, .for_data_exchange = is_exchange};
    if (!is_for_data) return;

    Member& member = members_[request.da];
    const bool repeats = request.fcv() && last_fc_[request.da] == request.fc && member.asked_by == request.sa;
    last_fc_[request.da] = request.fcv() ? request.fc : std::uint8_t{0};
    member.asked_by = request.sa;
    member.last_asked = at;
    ++member.unanswered;
    if (repeats) {
        ++member.retries;
        return;
    }
    ++member.asked;
    if (is_exchange) member.recurrence.event(at);
    if (request.dsap == sap::kSetPrm && request.data.size() >= 7) member.ident = be16(request.data, 4);
}

/// An SC says only that it was an answer.
void BusMembers::on_answer(Member& member, const Telegram& answer, Instant at)
{
    (answer.has_fc() && !is_of_a_slave(answer) ? member.is_master : member.is_slave) = true;
    member.last_heard = at;
    member.unanswered = 0;
    ++member.answers;
    member.recurrence.octets(octets_of(answer), at);
    last_fc_[static_cast<std::size_t>(&member - members_.data())] = 0;
    if (answer.ssap != sap::kSlaveDiag || answer.data.size() < kStandardDiagnosis) return;
    member.ident = be16(answer.data, 4);
    member.state = state_of(answer.data);
}

BusMembers::UnansweredList BusMembers::unanswered() const
{
    UnansweredList list{};
    for (std::size_t address = 0; address < members_.size(); ++address) {
        const Member& one = members_[address];
        if (one.unanswered <= list.back().requests) continue;
        list.back() = {.address = static_cast<std::uint8_t>(address),
                       .master = one.asked_by,
                       .requests = one.unanswered,
                       .last = one.last_asked};
        for (std::size_t i = list.size() - 1; i > 0 && list[i - 1].requests < list[i].requests; --i)
            std::swap(list[i - 1], list[i]);
    }
    return list;
}

} // namespace dpslave::dp
