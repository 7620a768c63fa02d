// SPDX-License-Identifier: Apache-2.0
#include "requester.hpp"

#include "dpsim/common/bus_times.hpp"

#include <fmt/format.h>

namespace dpslave::sim {
namespace {

/// No more octets are kept of a station that never stops sending.
constexpr std::size_t kMostOctets = 1024;

constexpr std::uint8_t kFcFdlStatus = 0x49, kFcSdnHigh = 0x46, kFcSrdHigh = 0x4D, kFcb = 0x20, kFcv = 0x10;

} // namespace

void Requester::begin(Order order, bool one_shot)
{
    Pending next{.order = std::move(order), .one_shot = one_shot};
    const Service service = next.order.service;
    if (service == Service::raw) {
        next.wire = next.order.data;
    } else {
        next.wire = encode(frame_of(next.order), settings_.fixed);
        next.counted = service != Service::fdl_status && service != Service::global_control;
        next.answered = service != Service::global_control;
    }
    pending_ = std::move(next);
    to_send_ = true;
}

Frame Requester::frame_of(const Order& order) const
{
    Frame frame{.da = settings_.slave, .sa = settings_.address, .data = order.data};
    if (order.service == Service::fdl_status) {
        frame.fc = kFcFdlStatus;
        return frame;
    }
    if (order.service != Service::data_exchange) {
        frame.dsap = sap_of(order.service);
        frame.ssap = kSapMaster;
    }
    if (order.service == Service::global_control) {
        frame.da = kBroadcast;
        frame.fc = kFcSdnHigh;
        return frame;
    }
    frame.fc = static_cast<std::uint8_t>(first_ ? kFcSrdHigh | kFcb : kFcSrdHigh | kFcv | (fcb_ ? kFcb : 0));
    return frame;
}

std::optional<Octets> Requester::take_transmit(Instant now)
{
    if (!to_send_) return std::nullopt;
    to_send_ = false;
    rx_.clear();
    rx_flaw_.clear();
    Octets octets = others_.exchanges(settings_.address, settings_.others);
    counters_.others += settings_.others;
    pending_->sent = now + duration_of(characters(octets.size()), settings_.baud);
    const Instant end = pending_->sent + duration_of(characters(pending_->wire.size()), settings_.baud);
    pending_->give_up =
        pending_->answered
            ? end + duration_of(slot_time(settings_.baud) + kCharacter, settings_.baud) + settings_.allowance
            : end + duration_of(pause_after_sdn(settings_.baud), settings_.baud);
    octets.insert(octets.end(), pending_->wire.begin(), pending_->wire.end());
    return octets;
}

std::optional<Requester::Outcome> Requester::on_bytes(Bytes octets, Instant now)
{
    if (!pending_ || to_send_ || !pending_->answered) {
        counters_.unasked_octets += octets.size();
        if (unasked_at_ == Instant::min() || now - unasked_at_ > std::chrono::seconds{1})
            violations_.push_back("octets that were not asked for, or that came too late: " + hex(octets));
        unasked_at_ = now;
        return std::nullopt;
    }
    if (rx_.size() > kMostOctets) return std::nullopt;
    rx_.insert(rx_.end(), octets.begin(), octets.end());
    pending_->give_up = now + duration_of(characters(1) + kTsyn, settings_.baud) + settings_.allowance;
    if (!rx_flaw_.empty()) return std::nullopt;

    const auto length = frame_length(rx_);
    if (!length) rx_flaw_ = length.error();
    if (!length || *length == 0 || rx_.size() < *length) return std::nullopt;
    const Octets whole(rx_.begin(), rx_.begin() + static_cast<std::ptrdiff_t>(*length));
    const std::size_t more = rx_.size() - whole.size();
    heard_ = std::exchange(rx_, {});
    if (more > 0) {
        counters_.unasked_octets += more;
        violations_.push_back("octets after the answer: " + hex(Bytes{heard_}.subspan(whole.size())));
    }
    return whole_answer(whole, now);
}

std::optional<Requester::Outcome> Requester::on_time(Instant now)
{
    if (to_send_ || !pending_ || now < pending_->give_up) return std::nullopt;
    if (!pending_->answered) {
        Outcome outcome{
            .order = std::move(pending_->order), .one_shot = pending_->one_shot, .was_sent_only = true};
        pending_.reset();
        return outcome;
    }
    heard_ = rx_;
    if (rx_.empty()) return bad_answer({}, now);
    return bad_answer(rx_flaw_.empty() ? std::string{"it ends too early"} : rx_flaw_, now);
}

void Requester::give_up_cyclic()
{
    first_ = true;
    if (!pending_ || pending_->one_shot) return;
    pending_->repeated = false;
    if (!to_send_) return;
    pending_.reset();
    to_send_ = false;
}

/// No answer (`why` empty) or one that is no telegram: the same request again, then give up.
std::optional<Requester::Outcome> Requester::bad_answer(std::string why, Instant now)
{
    if (!why.empty()) {
        ++counters_.invalid;
        violations_.push_back(
            fmt::format("answer to {} is invalid, {}: {}", text(pending_->order.service), why, hex(heard_)));
    }
    if (pending_->repeated && pending_->counted && pending_->tries < settings_.retries) {
        ++pending_->tries;
        ++counters_.retries;
        to_send_ = true;
        return std::nullopt;
    }
    if (pending_->counted) {
        ++counters_.missing;
        first_ = true;
    }
    Outcome outcome = finished(now);
    if (why.empty()) outcome.heard.clear();
    outcome.flaw = std::move(why);
    idle_until_ = now;
    return outcome;
}

std::optional<Requester::Outcome> Requester::whole_answer(Bytes octets, Instant now)
{
    const auto frame = decode(octets);
    if (pending_->order.service == Service::raw) {
        Outcome outcome = finished(now);
        outcome.is_whole = true;
        if (frame)
            outcome.answer = *frame;
        else
            outcome.flaw = frame.error();
        return outcome;
    }
    const std::string flaw = frame ? flaw_of(*frame) : frame.error();
    if (!flaw.empty()) { // once the line has fallen idle, the request is repeated
        rx_flaw_ = flaw;
        rx_ = heard_;
        return std::nullopt;
    }
    if (pending_->counted) { // confirmed: the next one carries the other frame count bit
        fcb_ = first_ ? false : !fcb_;
        first_ = false;
    }
    Outcome outcome = finished(now);
    outcome.answer = *frame;
    return outcome;
}

Requester::Outcome Requester::finished(Instant now)
{
    Outcome outcome{.order = std::move(pending_->order),
                    .one_shot = pending_->one_shot,
                    .heard = heard_,
                    .tries = pending_->tries,
                    .took = now - pending_->sent};
    pending_.reset();
    rx_.clear();
    idle_until_ = now + duration_of(kTid1, settings_.baud);
    return outcome;
}

/// Returns what a slave must not do in an answer (wire reference 2.2, 2.4, 2.5).
std::string Requester::flaw_of(const Frame& frame) const
{
    if (frame.kind == FrameKind::short_ack) return {};
    if (frame.kind == FrameKind::token) return "a token, but a slave has none";
    if ((frame.fc & 0x40) != 0) return "it has the form of a request";
    if (frame.sa != settings_.slave) return fmt::format("it comes from station {}", frame.sa);
    if (frame.da != settings_.address) return fmt::format("it goes to station {}", frame.da);
    if ((frame.fc & 0xB0) != 0) return fmt::format("FC {:02X}: a slave's station type is 00", frame.fc);
    if (frame.kind == FrameKind::no_data) return {};
    const bool expects_sap = pending_->order.service != Service::data_exchange;
    if (expects_sap && (frame.ssap != sap_of(pending_->order.service) || frame.dsap != kSapMaster))
        return "the SAPs are not those of the request, exchanged";
    if (!expects_sap && (frame.ssap || frame.dsap)) return "SAPs in an answer of the default SAP";
    return {};
}

} // namespace dpslave::sim
