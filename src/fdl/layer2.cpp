// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/layer2.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::fdl {
namespace {

bool is_sdn(const Telegram& telegram)
{
    return telegram.function() == Function::sdn_low || telegram.function() == Function::sdn_high;
}

template <class Requests>
void leave_unanswered(Requests& requests, Unanswered::Why why, std::uint8_t address, Instant at)
{
    static_cast<void>(requests.push({.why = why, .address = address, .at = at}));
}

/// Returns whether a slave answers this function at all. Time_Event and the reserved codes are not answered.
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

bool is_same(const Telegram& one, const Telegram& other)
{
    return one.delimiter == other.delimiter && one.da == other.da && one.sa == other.sa &&
           one.fc == other.fc && one.dsap == other.dsap && one.ssap == other.ssap &&
           std::equal(one.data.begin(), one.data.end(), other.data.begin(), other.data.end());
}

} // namespace

std::string_view text(Unanswered::Why why) noexcept
{
    switch (why) {
        case Unanswered::Why::overtaken: return "overtaken";
        case Unanswered::Why::late: return "late";
        case Unanswered::Why::own_address: return "own_address";
        case Unanswered::Why::no_service: return "no_service";
        case Unanswered::Why::searching: return "searching";
        case Unanswered::Why::unsent: return "unsent";
    }
    return "?";
}

Layer2::Layer2(const Layer2Settings& settings)
    : settings_(settings), baud_(settings.baud), receiver_(settings.baud)
{
    if (!settings.search) return;
    search_.emplace(*settings.search, settings.baud);
    baud_ = search_->baud();
    baud_state_ = search_->state();
    baud_change_ = baud_; // the edge knows only now where the search begins
    receiver_.restart(baud_);
}

bool Layer2::attach(std::uint8_t address, SapUser& user, const MaxTsdr& max_tsdr)
{
    return stations_.attach(address, user, max_tsdr);
}

void Layer2::detach(std::uint8_t address)
{
    stations_.detach(address);
    if (pending_ && pending_->address == address) pending_.reset();
}

void Layer2::set_port(const std::bitset<kBauds.size()>& rates, std::chrono::nanoseconds start_up_latency)
{
    settings_.start_up_latency = start_up_latency;
    if (!search_) return;
    search_->set_rates(rates);
    follow_search();
}

void Layer2::on_bytes(Bytes bytes, Instant read_at, bool more_follows)
{
    if (bytes.empty()) return;
    cancel_reply(read_at);
    counters_.octets += bytes.size();
    receiver_.begin_read(bytes.size(), read_at);
    take_heard();
    if (!rate_is_kept(bytes.size(), 0, read_at)) return;
    receiver_.on_bytes(bytes, more_follows);
    take_heard();
}

void Layer2::on_character_error(Instant read_at)
{
    cancel_reply(read_at);
    ++counters_.octets;
    receiver_.begin_read(1, read_at);
    take_heard();
    if (!rate_is_kept(0, 1, read_at)) return;
    receiver_.on_character_error();
    take_heard();
}

void Layer2::on_time(Instant now)
{
    while (receiver_.on_time(now)) {
        silence_ = now;
        take_heard();
    }
    if (pending_ && now > pending_->not_after) { // the master has given up: a late reply would meet its retry
        leave_unanswered(unanswered_, Unanswered::Why::late, pending_->address, now);
        pending_.reset();
        ++counters_.late;
    }
    if (pending_ && now >= pending_->not_before) pending_->open = true;
    if (stations_.on_time(now)) report_supervision(now);
    if (search_) {
        search_->on_time(now);
        follow_search();
    }
}

std::optional<Bytes> Layer2::take_transmit()
{
    if (!pending_ || !pending_->open) return std::nullopt;
    const Bytes octets = pending_->octets;
    window_ended_ = pending_->not_after;
    sent_ = pending_->telegram;
    pending_.reset();
    ++counters_.replies;
    return octets;
}

Instant Layer2::next_deadline() const
{
    Instant next = std::min(stations_.next_deadline(), receiver_.next_deadline());
    if (pending_) next = std::min(next, pending_->not_before);
    if (search_) next = std::min(next, search_->next_deadline());
    return next;
}

std::optional<Baud> Layer2::take_baud_change()
{
    return std::exchange(baud_change_, std::nullopt);
}

void Layer2::take_heard()
{
    while (const auto* heard = receiver_.next()) {
        if (heard->telegram)
            on_telegram(*heard->telegram, heard->at, heard->newest);
        else if (baud_state_ == BaudState::baud_search || (search_ && search_->in_doubt()))
            ++counters_.search_flaws;
        else
            ++counters_.flaws[static_cast<std::size_t>(heard->telegram.error())];
    }
}

/// `newest` means that nothing was heard after this telegram.
void Layer2::on_telegram(const Telegram& telegram, Instant read_at, bool newest)
{
    ++counters_.telegrams;
    if (listener_ != nullptr) listener_->on_telegram(telegram, read_at);
    if (!telegram.has_fc()) return; // SC and token: no checksum, no evidence, no request
    const bool ours = stations_.has(telegram.da);
    ++counters_.checked;
    last_telegram_ = read_at;

    if (search_) {
        const bool silent = search_->state() == BaudState::baud_search;
        search_->on_telegram(ours, read_at);
        follow_search();
        if (silent) { // the telegram that ends the search is still heard in it
            if (ours && telegram.is_request())
                leave_unanswered(unanswered_, Unanswered::Why::searching, telegram.da, read_at);
            return;
        }
    }
    if (stations_.has(telegram.sa)) return on_own_address(telegram, read_at);
    const bool known_code = (telegram.fc & 0x80) == 0; // bit 7 is a second code table with nothing for us
    if (!telegram.is_request()) return;
    if (!known_code) {
        if (ours) leave_unanswered(unanswered_, Unanswered::Why::no_service, telegram.da, read_at);
        return;
    }

    if (is_sdn(telegram)) {
        if (!ours && telegram.da != kBroadcast) return;
        ++counters_.requests;
        stations_.on_sdn(telegram, read_at);
        report_supervision(read_at);
    } else if (ours && is_answered(telegram.function())) {
        ++counters_.requests;
        sent_ = nullptr;
        if (newest) {
            on_request(telegram, read_at);
        } else { // dropped completely, FCB included: the master's retry still looks new
            ++counters_.overtaken;
            leave_unanswered(unanswered_, Unanswered::Why::overtaken, telegram.da, read_at);
        }
    } else if (ours) {
        leave_unanswered(unanswered_, Unanswered::Why::no_service, telegram.da, read_at);
    }
}

/// Either another device has the address, or the transceiver hears what it sends. Then it is what was sent,
/// and comes once.
void Layer2::on_own_address(const Telegram& telegram, Instant at)
{
    ++counters_.own_address;
    const Telegram* const sent = std::exchange(sent_, nullptr);
    if (sent != nullptr && is_same(*sent, telegram)) {
        ++counters_.came_back;
        return;
    }
    leave_unanswered(unanswered_, Unanswered::Why::own_address, telegram.sa, at);
}

void Layer2::on_request(const Telegram& request, Instant at)
{
    const Stations::Reply reply = stations_.on_request(request, at, baud_);
    if (reply.repeated) ++counters_.retries;
    report_supervision(at);
    pending_ = {.address = request.da,
                .octets = reply.octets,
                .telegram = reply.telegram,
                .not_before = at + duration_of(reply.not_before, baud_),
                .not_after = at + duration_of(reply.not_after, baud_) - settings_.start_up_latency - unread_};
}

/// The line is in use: the moment for the reply is over. The effect of the request and its stored reply stay.
void Layer2::cancel_reply(Instant at)
{
    if (!pending_) return;
    leave_unanswered(unanswered_, Unanswered::Why::overtaken, pending_->address, at);
    pending_.reset();
    ++counters_.overtaken;
}

/// Gives the search what was heard. Returns false if the rate has been given up: octets heard at it have no
/// meaning.
bool Layer2::rate_is_kept(std::size_t good, std::size_t bad, Instant at)
{
    if (!search_) return true;
    if (!baud_change_) {
        search_->on_characters(good, bad, at);
        follow_search();
    }
    return !baud_change_;
}

void Layer2::report_supervision(Instant at)
{
    if (!search_) return;
    search_->on_supervision(stations_.any_owned(), stations_.any_supervised(), at);
    follow_search();
}

/// Takes over what the search decided.
void Layer2::follow_search()
{
    if (search_->baud() != baud_) {
        baud_ = search_->baud();
        baud_change_ = baud_;
    } else if (search_->state() == baud_state_) {
        return;
    }
    // Silent from now on, and what was heard is no telegram any more.
    if (search_->state() == BaudState::baud_search) {
        pending_.reset();
        receiver_.restart(baud_);
        stations_.forget_requests();
    }
    baud_state_ = search_->state();
}

} // namespace dpslave::fdl
