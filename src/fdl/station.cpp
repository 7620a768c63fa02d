// SPDX-License-Identifier: Apache-2.0
/// The answering half of a station: addresses, frame count bit, replies and their window.
#include "dpslave/fdl/station.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::fdl {
namespace {

/// No station may answer sooner, whatever was parameterised: min T_SDR of a slave after power-on.
constexpr Tbit kLeastTsdr{11};
/// A slave must not fall silent because a master asked for a long min T_SDR (wire reference 1.5).
constexpr Tbit kWindow{50};

std::uint8_t fc_of(Answer answer)
{
    switch (answer) {
        case Answer::low: return kFcDl;
        case Answer::high: return kFcDh;
        case Answer::user_error: return kFcUe;
        case Answer::no_resource: return kFcRr;
        case Answer::not_activated: return kFcRs;
        case Answer::sc: break;
    }
    return kFcOk;
}

} // namespace

Station::Station(const StationSettings& settings) : settings_(settings), baud_(settings.baud)
{
    if (!settings.search) return;
    search_.emplace(*settings.search, settings.baud);
    baud_ = search_->baud();
    baud_state_ = search_->state();
    baud_change_ = baud_; // the edge knows only now where the search begins
}

bool Station::attach(std::uint8_t address, SapUser& user, const std::array<Tbit, kBauds.size()>& max_tsdr)
{
    if (address >= kAddresses) return false;
    Place& place = places_[address];
    if (place.user == nullptr) attached_[attached_count_++] = address;
    place.user = &user;
    place.max_tsdr = max_tsdr;
    place.stored = false;
    users_due_ = Instant{}; // whatever the user waits for already: the next on_time() asks
    return true;
}

void Station::detach(std::uint8_t address)
{
    if (address >= kAddresses || places_[address].user == nullptr) return;
    Place& place = places_[address];
    count_supervision(place, Supervision::unowned);
    place.user = nullptr; // place.reply stays: the edge may be writing it

    const auto end = attached_.begin() + static_cast<std::ptrdiff_t>(attached_count_);
    const auto its_place = std::find(attached_.begin(), end, address);
    std::copy(its_place + 1, end, its_place);
    --attached_count_;
    touched_[address] = false;
    if (pending_ && pending_->address == address) pending_.reset();
    users_due_ = Instant{}; // the next on_time() tells the search that this owner is gone
}

void Station::on_request(std::uint8_t address, const Telegram& request, Instant at)
{
    Place& place = places_[address];
    const Pending window = window_of(address, at);
    switch (request.function()) {
        case Function::fdl_status: unstored_ = encode_sd1(request.sa, address, kFcOk); break;
        case Function::ident:
        case Function::lsap_status: unstored_ = encode_sd1(request.sa, address, kFcRs); break;
        default: on_counted_request(address, request, at, window); return;
    }
    place.user->heard(request.sa, at);
    called(address, at);
    reply_with(unstored_, window);
}

/// SRD, SDA, MSRD: those that the frame count bit guards (wire reference 2.6).
void Station::on_counted_request(std::uint8_t address, const Telegram& request, Instant at,
                                 const Pending& window)
{
    Place& place = places_[address];
    if (is_retry(place, request)) {
        ++counters_.retries;
        place.user->heard(request.sa, at);
        called(address, at);
        reply_with(place.reply, window);
        return;
    }
    if (!request.fcv() && !request.fcb()) { // in no sequence: the memory stays as it is
        unstored_ = execute(address, request, at);
        reply_with(unstored_, window);
        return;
    }
    place.reply = execute(address, request, at);
    place.stored = true;
    place.fcb = request.fcb();
    place.sa = request.sa;
    place.function = request.function();
    place.dsap = request.dsap;
    reply_with(place.reply, window);
}

/// Asks the user and puts the answer on the wire form; what no DP slave offers is refused here.
Frame Station::execute(std::uint8_t address, const Telegram& request, Instant at)
{
    SapUser& user = *places_[address].user;
    const bool srd = request.function() == Function::srd_low || request.function() == Function::srd_high;
    const bool half_extended = request.dsap.has_value() != request.ssap.has_value();
    if (!srd || half_extended) {
        user.heard(request.sa, at);
        called(address, at);
        return encode_sd1(request.sa, address, kFcRs);
    }

    scratch_.clear();
    const Answer answer = user.srd(
        {.sa = request.sa, .dsap = request.dsap, .ssap = request.ssap, .data = request.data, .at = at},
        scratch_);
    called(address, at);

    const bool data = answer == Answer::low || answer == Answer::high;
    if (answer == Answer::sc || (answer == Answer::low && scratch_.empty())) return encode_sc();
    if (data && !scratch_.empty()) // the roles swap: the requester's SAP first
        return encode_sd2(request.sa, address, fc_of(answer), request.ssap, request.dsap, scratch_);
    return encode_sd1(request.sa, address, fc_of(answer)); // also DH without data (wire reference 4.7)
}

/// Repeats the last request instead of following it. Whoever changes function or SAP without a new frame
/// count bit is confused rather than repeating: to execute is the safe side, because the services of DP are
/// idempotent.
bool Station::is_retry(const Place& place, const Telegram& request)
{
    return request.fcv() && place.stored && request.sa == place.sa && request.fcb() == place.fcb &&
           request.function() == place.function && request.dsap == place.dsap;
}

/// Asked before the request is executed: a Set_Prm changes the pause after its own acknowledgement.
Station::Pending Station::window_of(std::uint8_t address, Instant at) const
{
    const Place& place = places_[address];
    const Tbit min_tsdr = std::max(place.user->min_tsdr(), kLeastTsdr);
    const Tbit deadline = std::max(place.max_tsdr[index_of(baud_)], min_tsdr + kWindow);
    return {.address = address,
            .octets = {},
            .not_before = at + duration_of(min_tsdr, baud_),
            .not_after = at + duration_of(deadline, baud_) - settings_.start_up_latency};
}

void Station::reply_with(const Frame& frame, const Pending& window)
{
    pending_ = window;
    pending_->octets = frame.bytes();
}

void Station::on_time(Instant now)
{
    if (now >= hunt_at_) hunt_behind_stump();
    if (pending_ && now > pending_->not_after) { // the master has given up: a late reply would meet its retry
        pending_.reset();
        ++counters_.late;
    }
    if (pending_ && now >= pending_->not_before) pending_->open = true;
    if (used_ != 0 && now >= gap_ends_) drop_unfinished();
    if (now >= users_due_) wake_users(now);
    if (search_) {
        search_->on_time(now);
        follow_search();
    }
}

std::optional<Bytes> Station::take_transmit()
{
    if (!pending_ || !pending_->open) return std::nullopt;
    const Bytes octets = pending_->octets;
    window_ended_ = pending_->not_after;
    pending_.reset();
    ++counters_.replies;
    return octets;
}

Instant Station::next_deadline() const
{
    Instant next = std::min({users_due_, gap_ends_, hunt_at_});
    if (pending_) next = std::min(next, pending_->not_before);
    if (search_) next = std::min(next, search_->next_deadline());
    return next;
}

std::bitset<128> Station::take_touched()
{
    return std::exchange(touched_, {});
}

std::optional<Baud> Station::take_baud_change()
{
    return std::exchange(baud_change_, std::nullopt);
}

void Station::called(std::uint8_t address, Instant at)
{
    touched_[address] = true;
    sample(places_[address], at);
}

/// Keeps a lower bound of all deadlines and the number of supervised users, so that no telegram has to ask
/// everybody.
void Station::sample(Place& place, Instant at)
{
    users_due_ = std::min(users_due_, place.user->next_deadline());
    const Supervision now = place.user->supervision();
    if (now == place.supervision) return;
    count_supervision(place, now);
    tell_search(at);
}

void Station::count_supervision(Place& place, Supervision now)
{
    owned_ += now != Supervision::unowned ? 1u : 0u;
    owned_ -= place.supervision != Supervision::unowned ? 1u : 0u;
    supervised_ += now == Supervision::supervised ? 1u : 0u;
    supervised_ -= place.supervision == Supervision::supervised ? 1u : 0u;
    place.supervision = now;
}

void Station::tell_search(Instant at)
{
    if (!search_) return;
    search_->on_supervision(owned_ != 0, supervised_ != 0, at);
    follow_search();
}

/// The lower bound is reached: who is due is called, and the bound is made exact again.
void Station::wake_users(Instant now)
{
    users_due_ = kNever;
    for (std::size_t i = 0; i < attached_count_; ++i) {
        Place& place = places_[attached_[i]];
        if (place.user->next_deadline() <= now) {
            place.user->on_time(now);
            touched_[attached_[i]] = true;
        }
        sample(place, now);
    }
    tell_search(now); // also of those that were detached
}

/// Takes over what the search decided.
void Station::follow_search()
{
    if (search_->baud() != baud_) {
        baud_ = search_->baud();
        baud_change_ = baud_;
    } else if (search_->state() == baud_state_) {
        return;
    }
    if (search_->state() ==
        BaudState::baud_search) { // silent from now on, and what was heard is no telegram any more
        pending_.reset();
        forget_all();
        for (std::size_t i = 0; i < attached_count_; ++i) places_[attached_[i]].stored = false;
    }
    baud_state_ = search_->state();
}

Baud Station::baud() const
{
    return baud_;
}

BaudState Station::baud_state() const
{
    return baud_state_;
}

const Counters& Station::counters() const
{
    return counters_;
}

} // namespace dpslave::fdl
