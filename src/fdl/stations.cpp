// SPDX-License-Identifier: Apache-2.0
#include "dpslave/fdl/stations.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::fdl {
namespace {

/// No station may answer sooner, whatever was parameterised: min T_SDR of a slave after power-on.
constexpr Tbit kLeastTsdr{11};
/// A slave must not fall silent because a master asked for a long min T_SDR (wire reference 1.5). With a min
/// T_SDR of 11 it ends at 60, the smallest MaxTsdr of the classes: it never outlasts what such a GSD
/// promises.
constexpr Tbit kWindow{49};

/// SRD, SDA and MSRD in a sequence: the frame count bit guards them (wire reference 2.6).
bool is_counted(const Telegram& request)
{
    switch (request.function()) {
        case Function::fdl_status:
        case Function::ident:
        case Function::lsap_status: return false;
        default: return request.fcv() || request.fcb();
    }
}

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

bool Stations::attach(std::uint8_t address, SapUser& user, const MaxTsdr& max_tsdr)
{
    if (address >= kAddresses) return false;
    Station& station = stations_[address];
    if (station.user == nullptr) attached_[attached_count_++] = address;
    station.user = &user;
    station.max_tsdr = max_tsdr;
    station.stored = false;
    users_due_ = Instant{}; // whatever the user waits for already: the next on_time() asks
    return true;
}

void Stations::detach(std::uint8_t address)
{
    if (!has(address)) return;
    Station& station = stations_[address];
    count_supervision(station, Supervision::unowned);
    station.user = nullptr; // station.reply stays: the edge may be writing it

    const auto end = attached_.begin() + static_cast<std::ptrdiff_t>(attached_count_);
    const auto its_place = std::find(attached_.begin(), end, address);
    std::copy(its_place + 1, end, its_place);
    --attached_count_;
    touched_[address] = false;
    users_due_ = Instant{}; // the next on_time() says that users were called: this owner is gone
}

Stations::Reply Stations::on_request(const Telegram& request, Instant at, Baud baud)
{
    Station& station = stations_[request.da];
    // Asked before the request is executed: a Set_Prm changes the pause after its own acknowledgement.
    const Tbit min_tsdr = std::max(station.user->min_tsdr(), kLeastTsdr);
    const bool is_counted_one = is_counted(request);
    Encoded& encoded = is_counted_one ? station.reply : unstored_;
    Reply reply{.octets = {},
                .telegram = &encoded.telegram,
                .not_before = min_tsdr,
                .not_after = std::max(station.max_tsdr[index_of(baud)], min_tsdr + kWindow)};
    if (is_retry(station, request)) {
        station.user->heard(request.sa, at);
        reply.repeated = true;
    } else {
        answer(station, request, at, encoded);
        if (is_counted_one) {
            station.stored = true;
            station.fcb = request.fcb();
            station.sa = request.sa;
            station.function = request.function();
            station.dsap = request.dsap;
        }
    }
    reply.octets = encoded.octets;
    called(request.da);
    return reply;
}

/// Asks the user and encodes the answer; what no DP slave offers is refused here.
void Stations::answer(Station& station, const Telegram& request, Instant at, Encoded& reply)
{
    Telegram& said = reply.telegram;
    said.da = request.sa;
    said.sa = request.da;
    said.dsap = said.ssap = std::nullopt;
    said.data = {};
    const auto without_data = [&](std::uint8_t fc) {
        said.delimiter = kSD1;
        reply.octets = encode_sd1(said.da, said.sa, said.fc = fc);
    };
    const bool srd = request.function() == Function::srd_low || request.function() == Function::srd_high;
    const bool half_extended = request.dsap.has_value() != request.ssap.has_value();
    if (!srd || half_extended) {
        station.user->heard(request.sa, at);
        return without_data(request.function() == Function::fdl_status ? kFcOk : kFcRs);
    }

    scratch_.clear();
    const Answer answer = station.user->srd(
        {.sa = request.sa, .dsap = request.dsap, .ssap = request.ssap, .data = request.data, .at = at},
        scratch_);
    const bool data = answer == Answer::low || answer == Answer::high;
    if (answer == Answer::sc || (answer == Answer::low && scratch_.empty())) {
        said.delimiter = kSC;
        reply.octets = encode_sc();
        return;
    }
    const std::uint8_t fc = fc_of(answer);
    if (!data || scratch_.empty()) return without_data(fc); // also DH without data (wire reference 4.7)
    said.delimiter = kSD2;
    said.fc = fc;
    said.dsap = request.ssap; // the roles swap: the requester's SAP first
    said.ssap = request.dsap;
    said.data = scratch_;
    encode_sd2(reply.octets, said);
    // Before FCS and ED.
    said.data = reply.octets.bytes().subspan(reply.octets.size() - scratch_.size() - 2, scratch_.size());
}

/// Repeats the last request instead of following it. A master that changes function or SAP without a new
/// frame count bit is confused rather than repeating: to execute is the safe side, because the services of DP
/// are idempotent.
bool Stations::is_retry(const Station& station, const Telegram& request)
{
    return request.fcv() && station.stored && request.sa == station.sa && request.fcb() == station.fcb &&
           request.function() == station.function && request.dsap == station.dsap;
}

void Stations::on_sdn(const Telegram& telegram, Instant at)
{
    const Indication indication{
        .sa = telegram.sa, .dsap = telegram.dsap, .ssap = telegram.ssap, .data = telegram.data, .at = at};
    if (telegram.da != kBroadcast) {
        stations_[telegram.da].user->sdn(indication);
        called(telegram.da);
        return;
    }
    for (std::size_t i = 0; i < attached_count_; ++i) {
        stations_[attached_[i]].user->sdn(indication);
        called(attached_[i]);
    }
}

void Stations::forget_requests()
{
    for (std::size_t i = 0; i < attached_count_; ++i) stations_[attached_[i]].stored = false;
}

/// The lower bound is reached: users that are due are called, and the bound is made exact again.
bool Stations::on_time(Instant now)
{
    if (now < users_due_) return false;
    users_due_ = kNever;
    for (std::size_t i = 0; i < attached_count_; ++i) {
        Station& station = stations_[attached_[i]];
        if (station.user->next_deadline() <= now) {
            station.user->on_time(now);
            touched_[attached_[i]] = true;
        }
        sample(station);
    }
    return true;
}

std::bitset<128> Stations::take_touched()
{
    return std::exchange(touched_, {});
}

void Stations::called(std::uint8_t address)
{
    touched_[address] = true;
    sample(stations_[address]);
}

/// Reads after a call of a user what it waits for, and how a master watches it.
void Stations::sample(Station& station)
{
    users_due_ = std::min(users_due_, station.user->next_deadline());
    count_supervision(station, station.user->supervision());
}

void Stations::count_supervision(Station& station, Supervision now)
{
    if (now == station.supervision) return;
    owned_ += now != Supervision::unowned ? 1u : 0u;
    owned_ -= station.supervision != Supervision::unowned ? 1u : 0u;
    supervised_ += now == Supervision::supervised ? 1u : 0u;
    supervised_ -= station.supervision == Supervision::supervised ? 1u : 0u;
    station.supervision = now;
}

} // namespace dpslave::fdl
