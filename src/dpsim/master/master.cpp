// SPDX-License-Identifier: Apache-2.0
#include "master.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

/// A slave that refuses is asked again after this time: fast enough to be seen healing, slow enough to be
/// read.
constexpr auto kRefusalPause = std::chrono::milliseconds{500};

} // namespace

Master::Master(MasterSettings settings) : settings_(std::move(settings))
{
    if (const auto lengths = cfg_lengths(settings_.cfg)) lengths_ = *lengths;
    outputs_.assign(lengths_.outputs, 0);
}

// ---- time and octets ----

void Master::on_bytes(Bytes octets, Instant now)
{
    const auto outcome = requester_.on_bytes(octets, now);
    for (std::string& words : requester_.take_violations()) report_violation(std::move(words));
    if (outcome) take(*outcome, now);
}

void Master::on_time(Instant now)
{
    const auto outcome = requester_.on_time(now);
    for (std::string& words : requester_.take_violations()) report_violation(std::move(words));
    if (outcome) take(*outcome, now);
    if (!requester_.ready(now) || (outcome && !outcome->was_sent_only)) return;
    if (!orders_.empty()) {
        Order order = std::move(orders_.front());
        orders_.pop_front();
        requester_.begin(std::move(order), true);
    } else if (now >= next_cycle_) {
        if (auto order = cyclic_order()) requester_.begin(std::move(*order), false);
        next_cycle_ = now + settings_.cycle;
    }
}

Instant Master::next_deadline() const
{
    if (requester_.busy()) return requester_.next_deadline();
    if (!orders_.empty()) return requester_.idle_until();
    return state_ == MasterState::stopped ? kNever : std::max(requester_.idle_until(), next_cycle_);
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
    requester_.give_up_cyclic();
    if (state_ != MasterState::stopped) enter(MasterState::stopped);
}

void Master::clear(bool on)
{
    clear_ = on;
    order(mode_order());
}

/// Global_Control with Clear_Data, or without it: Operate.
Order Master::mode_order() const
{
    return {Service::global_control, {static_cast<std::uint8_t>(clear_ ? 0x02 : 0x00), 0x00}};
}

std::optional<Order> Master::cyclic_order() const
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

// ---- what comes of a request ----

void Master::take(const Requester::Outcome& outcome, Instant now)
{
    const Service service = outcome.order.service;
    if (outcome.was_sent_only) {
        if (outcome.one_shot) report({service, {}, {}, "sent"});
        return;
    }
    if (service == Service::raw && outcome.is_whole)
        return report({service, outcome.answer, outcome.heard,
                       outcome.answer ? describe(*outcome.answer) : "invalid: " + outcome.flaw});
    if (!outcome.answer) return lost(outcome);
    const Frame& frame = *outcome.answer;
    if (outcome.one_shot) report({service, frame, outcome.heard, describe(frame)});
    const bool negative =
        frame.kind == FrameKind::no_data && (frame.fc & 0x0F) >= 1 && (frame.fc & 0x0F) <= 3;
    if (negative) return on_negative(outcome, now);
    switch (service) {
        case Service::fdl_status:
            if (state_ == MasterState::searching && !outcome.one_shot && frame.kind == FrameKind::no_data) {
                requester_.begin_sequence();
                enter(MasterState::asking);
            }
            return;
        case Service::slave_diag: return on_slave_diag(outcome, now);
        case Service::set_prm:
        case Service::chk_cfg:
            if (frame.kind != FrameKind::short_ack)
                report_violation(
                    fmt::format("{} is answered with {} instead of SC", text(service), describe(frame)));
            else if (!outcome.one_shot && state_ == MasterState::parameterising)
                enter(MasterState::configuring);
            else if (!outcome.one_shot && state_ == MasterState::configuring)
                enter(MasterState::awaiting_ready);
            return;
        case Service::data_exchange: return on_data_exchange(outcome);
        case Service::get_cfg:
        case Service::global_control:
        case Service::raw: return;
    }
}

void Master::lost(const Requester::Outcome& outcome)
{
    const Service service = outcome.order.service;
    if (outcome.one_shot)
        return report({service,
                       {},
                       outcome.heard,
                       outcome.flaw.empty() ? "no answer" : "invalid answer: " + outcome.flaw});
    if (state_ != MasterState::searching && state_ != MasterState::stopped)
        leave_exchange(fmt::format("station {} no longer answers (no answer to {} after {} attempts)",
                                   settings_.slave, text(service), outcome.tries + 1),
                       MasterState::searching);
}

void Master::on_negative(const Requester::Outcome& outcome, Instant now)
{
    ++counters_.refused;
    if (outcome.one_shot || state_ == MasterState::stopped) return;
    auto words =
        fmt::format("{} is answered with {}", text(outcome.order.service), describe(*outcome.answer));
    if (state_ == MasterState::data_exchange)
        return leave_exchange(words + ": the slave is not in data exchange any more", MasterState::asking);
    if (state_ != MasterState::configuring) return refuse(std::move(words), now);
    cfg_refusal_ = std::move(words); // the reason is in the diagnosis
    enter(MasterState::awaiting_ready);
}

void Master::on_slave_diag(const Requester::Outcome& outcome, Instant now)
{
    const Frame& frame = *outcome.answer;
    ++counters_.diagnosis_reads;
    if (frame.kind == FrameKind::short_ack || frame.kind == FrameKind::no_data || (frame.fc & 0x0F) != 0x08)
        return report_violation("Slave_Diag is answered with " + describe(frame) + " instead of DL");
    auto diagnosis = parse_diagnosis(frame.data);
    if (!diagnosis) return report_violation(diagnosis.error());
    diagnosis_ = std::move(*diagnosis);
    if (outcome.one_shot && state_ != MasterState::data_exchange) return;
    if (state_ == MasterState::data_exchange && reported_diagnosis_ != diagnosis_->octets) {
        reported_diagnosis_ = diagnosis_->octets;
        if (!outcome.one_shot) events_.push_back({MasterEvent::Kind::diagnosis, {}});
    }
    judge_start_up(*diagnosis_, now);
}

void Master::judge_start_up(const Diagnosis& d, Instant now)
{
    const bool foreign = d.master != 0xFF && d.master != settings_.address;
    switch (state_) {
        case MasterState::asking:
            if (foreign) return refuse(fmt::format("the slave belongs to master {}", d.master), now);
            cfg_refusal_.clear();
            return enter(MasterState::parameterising);
        case MasterState::awaiting_ready:
            if (d.has(kPrmFault) && d.ident != settings_.ident)
                return refuse(
                    fmt::format(
                        "Set_Prm was refused: its ident is 0x{:04X}, the slave's is 0x{:04X} (--ident, or another file for --gsd)",
                        settings_.ident, d.ident),
                    now);
            if (d.has(kPrmFault))
                return refuse(
                    fmt::format("Set_Prm was refused: the slave does not take User_Prm_Data ({} octets: {})",
                                settings_.user_prm.size(), hex(settings_.user_prm)),
                    now);
            if (d.has(kNotSupported))
                return refuse("Set_Prm was refused: Sync or Freeze is not supported (--no-sync-freeze)", now);
            if (d.has(kCfgFault))
                return refuse("Chk_Cfg was refused: Cfg_Data " + hex(settings_.cfg) + " does not fit", now);
            if (foreign) return refuse(fmt::format("the slave now belongs to master {}", d.master), now);
            if (d.has(kPrmRequired)) return refuse("the slave has dropped its parameters again", now);
            if (!cfg_refusal_.empty()) return refuse(cfg_refusal_, now);
            if (d.has(kNotReady) || d.has(kStatDiag)) return;
            enter(MasterState::data_exchange);
            orders_.push_front(mode_order());
            return;
        case MasterState::data_exchange:
            diagnosis_due_ = d.has(kStatDiag);
            if (d.has(kNotReady) || d.has(kPrmRequired) || foreign)
                leave_exchange("diagnosis says that the slave is not in data exchange any more",
                               MasterState::asking);
            return;
        default: return;
    }
}

void Master::on_data_exchange(const Requester::Outcome& outcome)
{
    const Frame& frame = *outcome.answer;
    const unsigned function = frame.fc & 0x0FU;
    const bool high_priority = frame.kind != FrameKind::short_ack && function == 0x0A;
    const bool data = frame.kind == FrameKind::variable || frame.kind == FrameKind::fixed;
    const bool fits = lengths_.inputs == 0 ? !data : data && frame.data.size() == lengths_.inputs;
    if (state_ != MasterState::data_exchange) return;
    if (!fits || (data && function != 0x08 && !high_priority))
        return leave_exchange(
            fmt::format("Data_Exchange should bring {} octets, but {}", lengths_.inputs, describe(frame)),
            MasterState::asking);
    inputs_ = frame.data;
    if (high_priority) {
        ++counters_.diagnosis_pending;
        diagnosis_due_ = true;
    }
    counters_.answer_min =
        counters_.cycles == 0 ? outcome.took : std::min(counters_.answer_min, outcome.took);
    counters_.answer_max = std::max(counters_.answer_max, outcome.took);
    counters_.answer_sum += outcome.took;
    ++counters_.cycles;
}

void Master::refuse(std::string why, Instant now)
{
    if (why != last_refusal_) events_.push_back({MasterEvent::Kind::refused, why});
    last_refusal_ = std::move(why);
    next_cycle_ = now + kRefusalPause;
    state_ = MasterState::asking;
}

void Master::leave_exchange(std::string why, MasterState to)
{
    if (state_ == MasterState::data_exchange) ++counters_.exchanges_lost;
    events_.push_back({MasterEvent::Kind::lost, std::move(why)});
    enter(to);
}

void Master::enter(MasterState state)
{
    if (state == state_) return;
    if (state_ == MasterState::data_exchange) inputs_.clear(); // old values must not pass for present ones
    state_ = state;
    if (state == MasterState::data_exchange) {
        diagnosis_due_ = false;
        reported_diagnosis_.clear();
        last_refusal_.clear();
    }
    events_.push_back({MasterEvent::Kind::state, std::string{text(state)}});
}

void Master::report_violation(std::string words)
{
    events_.push_back({MasterEvent::Kind::violation, std::move(words)});
}

void Master::report(Answer answer)
{
    std::string words = answer.words;
    events_.push_back({MasterEvent::Kind::answer, std::move(words), std::move(answer)});
}

} // namespace dpslave::sim
