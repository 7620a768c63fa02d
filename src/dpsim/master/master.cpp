// SPDX-License-Identifier: Apache-2.0
#include "master.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace dpslave::sim {
namespace {

constexpr Tbit kTid1{37}; ///< pause after an answer: T_SYN 33 and the safety margin 4 (wire reference 1.3)
constexpr Tbit kTsyn{33};
/// A station that never stops talking is heard no longer than this.
constexpr std::size_t kLongestBabble = 1024;

constexpr std::uint8_t kFcFdlStatus = 0x49, kFcSdnHigh = 0x46, kFcSrdHigh = 0x4D, kFcb = 0x20, kFcv = 0x10;

/// Default slot time (wire reference 1.3).
Tbit slot_time(Baud baud)
{
    if (baud == Baud::k1500) return Tbit{300};
    return baud == Baud::k500 ? Tbit{200} : Tbit{100};
}

/// Pause after a request that nobody answers: the largest T_SDR of the class.
Tbit pause_after_sdn(Baud baud)
{
    if (baud == Baud::k1500) return Tbit{150};
    return baud == Baud::k500 ? Tbit{100} : Tbit{60};
}

Tbit characters(std::size_t count)
{
    return Tbit{static_cast<std::uint32_t>(count) * kCharacter.count};
}

} // namespace

Master::Master(MasterSettings settings) : settings_(std::move(settings))
{
    if (const auto lengths = cfg_lengths(settings_.cfg)) lengths_ = *lengths;
    outputs_.assign(lengths_.outputs, 0);
}

// ---- time and octets ----

void Master::on_bytes(Bytes octets, Instant now)
{
    if (!pending_ || to_send_ || !pending_->answered) {
        counters_.unasked_octets += octets.size();
        if (unasked_at_ == Instant::min() || now - unasked_at_ > std::chrono::seconds{1})
            complain("octets that nobody asked for, or that came too late: " + hex(octets));
        unasked_at_ = now;
        return;
    }
    if (rx_.size() > kLongestBabble) return;
    rx_.insert(rx_.end(), octets.begin(), octets.end());
    pending_->give_up = now + duration_of(characters(1) + kTsyn, settings_.baud) + settings_.allowance;
    if (!rx_flaw_.empty()) return;

    const auto length = frame_length(rx_);
    if (!length) {
        rx_flaw_ = length.error();
    } else if (*length != 0 && rx_.size() >= *length) {
        const Octets whole(rx_.begin(), rx_.begin() + static_cast<std::ptrdiff_t>(*length));
        const std::size_t more = rx_.size() - whole.size();
        heard_ = rx_;
        rx_.clear();
        if (more > 0) {
            counters_.unasked_octets += more;
            complain("octets after the answer: " + hex(Bytes{heard_}.subspan(whole.size())));
        }
        whole_answer(whole, now);
    }
}

void Master::on_time(Instant now)
{
    if (to_send_) return;
    if (pending_) {
        if (now < pending_->give_up) return;
        if (pending_->answered) return no_answer(now);
        if (pending_->one_shot) report({pending_->order.service, {}, {}, "sent"});
        pending_.reset();
    }
    if (now < idle_until_) return;
    if (!orders_.empty()) {
        Order order = std::move(orders_.front());
        orders_.pop_front();
        begin(std::move(order), true);
    } else if (now >= next_cycle_) {
        if (auto order = cyclic_order()) begin(std::move(*order), false);
        next_cycle_ = now + settings_.cycle;
    }
}

std::optional<Octets> Master::take_transmit(Instant now)
{
    if (!to_send_) return std::nullopt;
    to_send_ = false;
    rx_.clear();
    rx_flaw_.clear();
    pending_->sent = now;
    const Instant end = now + duration_of(characters(pending_->wire.size()), settings_.baud);
    pending_->give_up =
        pending_->answered
            ? end + duration_of(slot_time(settings_.baud) + kCharacter, settings_.baud) + settings_.allowance
            : end + duration_of(pause_after_sdn(settings_.baud), settings_.baud);
    return pending_->wire;
}

Instant Master::next_deadline() const
{
    if (to_send_) return Instant::min();
    if (pending_) return pending_->give_up;
    if (!orders_.empty()) return idle_until_;
    return state_ == MasterState::stopped ? kNever : std::max(idle_until_, next_cycle_);
}

std::optional<MasterEvent> Master::take_event()
{
    if (events_.empty()) return std::nullopt;
    MasterEvent event = std::move(events_.front());
    events_.pop_front();
    return event;
}

// ---- what is wanted ----

void Master::start()
{
    if (state_ != MasterState::stopped) return;
    last_refusal_.clear();
    next_cycle_ = Instant{};
    enter(MasterState::searching);
}

void Master::stop()
{
    if (pending_ && !pending_->one_shot && to_send_) {
        pending_.reset();
        to_send_ = false;
    }
    first_ = true;
    if (state_ != MasterState::stopped) enter(MasterState::stopped);
}

void Master::clear(bool on)
{
    clear_ = on;
    order({Service::global_control, {static_cast<std::uint8_t>(on ? 0x02 : 0x00), 0x00}});
}

// ---- requests ----

std::optional<Order> Master::cyclic_order()
{
    switch (state_) {
        case MasterState::stopped: return std::nullopt;
        case MasterState::searching: return Order{Service::fdl_status, {}};
        case MasterState::asking:
        case MasterState::awaiting_ready: return Order{Service::slave_diag, {}};
        case MasterState::parameterising: return Order{Service::set_prm, set_prm_unit(settings_)};
        case MasterState::configuring: return Order{Service::chk_cfg, settings_.cfg};
        case MasterState::data_exchange: break;
    }
    if (diagnosis_due_) return Order{Service::slave_diag, {}};
    return Order{Service::data_exchange, clear_ ? Octets(outputs_.size(), 0) : outputs_};
}

Frame Master::frame_of(const Order& order)
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

void Master::begin(Order order, bool one_shot)
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

void Master::no_answer(Instant now)
{
    heard_ = rx_;
    if (rx_.empty()) return bad_answer({}, now);
    bad_answer(rx_flaw_.empty() ? std::string{"it ends too early"} : rx_flaw_, now);
}

/// No answer (`why` empty) or one that is no telegram: the same request again, then give up.
void Master::bad_answer(std::string why, Instant now)
{
    if (!why.empty()) {
        ++counters_.invalid;
        complain(
            fmt::format("answer to {} is invalid, {}: {}", text(pending_->order.service), why, hex(heard_)));
    }
    const bool wanted = pending_->one_shot || state_ != MasterState::stopped;
    if (wanted && pending_->counted && pending_->tries < settings_.retries) {
        ++pending_->tries;
        ++counters_.retries;
        to_send_ = true;
        return;
    }
    const Pending lost = std::move(*pending_);
    pending_.reset();
    rx_.clear();
    idle_until_ = now;
    if (lost.counted) {
        ++counters_.missing;
        first_ = true;
    }
    if (lost.one_shot) {
        report({lost.order.service,
                {},
                why.empty() ? Octets{} : heard_,
                why.empty() ? "no answer" : "invalid answer: " + why});
    } else if (state_ != MasterState::searching && state_ != MasterState::stopped) {
        leave_exchange(fmt::format("station {} no longer answers (no answer to {} after {} attempts)",
                                   settings_.slave, text(lost.order.service), lost.tries + 1),
                       MasterState::searching);
    }
}

void Master::whole_answer(Bytes octets, Instant now)
{
    const auto frame = decode(octets);
    if (pending_->order.service == Service::raw) {
        report({Service::raw, frame ? std::optional{*frame} : std::nullopt, heard_,
                frame ? describe(*frame) : "invalid: " + frame.error()});
        return finished(now);
    }
    const std::string flaw = frame ? flaw_of(*frame) : frame.error();
    if (!flaw.empty()) { // once the line has fallen idle, the request is repeated
        rx_flaw_ = flaw;
        rx_ = heard_;
        return;
    }
    if (pending_->counted) { // confirmed: the next one carries the other frame count bit
        fcb_ = first_ ? false : !fcb_;
        first_ = false;
    }
    if (pending_->one_shot) report({pending_->order.service, *frame, heard_, describe(*frame)});
    handle(*frame, now);
    finished(now);
}

void Master::finished(Instant now)
{
    pending_.reset();
    rx_.clear();
    idle_until_ = now + duration_of(kTid1, settings_.baud);
}

} // namespace dpslave::sim
