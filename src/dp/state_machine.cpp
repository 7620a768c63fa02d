// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/state_machine.hpp"

#include "global_control.hpp"
#include "state_table.hpp"

#include "dpslave/dp/snapshot.hpp"

#include <algorithm>

namespace dpslave::dp {

StateMachine::StateMachine(const Personality& personality, ProcessData& data, PendingEvents& log)
    : personality_(personality), data_(data), log_(log), ext_diag_(personality)
{}

void StateMachine::apply(Trigger trigger, Instant at)
{
    fdl::Indication no_request;
    no_request.at = at;
    fdl::ReplyData no_reply;
    apply({.trigger = trigger}, no_request, no_reply);
}

fdl::Answer StateMachine::apply(const Judgement& judged, const fdl::Indication& request,
                                fdl::ReplyData& reply)
{
    const Row& row = row_of(state_, judged.trigger);
    const std::uint8_t owner_before = master_;
    if (row.fault != Fault::none) set_fault(row.fault, judged, request.sa);
    if (row.leave != LeaveReason::none) leave(row.leave);
    carry_out(row.effect, judged, request, reply);
    if (row.to) enter(*row.to, row.leave, owner_before);

    switch (row.reply) {
        case Reply::none: // an SDN, or no telegram: the answer is not looked at
        case Reply::sc: return fdl::Answer::sc;
        case Reply::rs: return fdl::Answer::not_activated;
        case Reply::rr: return fdl::Answer::no_resource;
        case Reply::exchange:
            if (diag_pending_) return fdl::Answer::high; // even without inputs: wire reference 4.7
            break;
        case Reply::data: break;
    }
    return reply.empty() ? fdl::Answer::sc : fdl::Answer::low;
}

void StateMachine::carry_out(Effect effect, const Judgement& judged, const fdl::Indication& request,
                             fdl::ReplyData& reply)
{
    switch (effect) {
        case Effect::none: return;
        case Effect::power_on: power_on(); return;
        case Effect::read_diagnosis: read_diagnosis(request.sa, reply); return;
        case Effect::read_configuration: reply.assign(cfg_accepted_); return;
        case Effect::take_min_tsdr: min_tsdr_ = min_tsdr_of(request.data, min_tsdr_); return;
        case Effect::take_parameters: take_parameters(judged, request); return;
        case Effect::log_foreign_prm: {
            Event tried = event(Event::Kind::foreign_set_prm);
            tried.master = request.sa;
            log_.add_once(tried);
            return;
        }
        case Effect::start_exchange: start_exchange(judged, request); return;
        case Effect::exchange:
            data_.receive(request.data, request.at);
            data_.append_inputs(reply);
            return;
        case Effect::exchange_nothing:
            data_.receive_nothing(request.at);
            data_.append_inputs(reply);
            return;
        case Effect::read_inputs: data_.append_inputs(reply); return;
        case Effect::read_outputs: data_.append_outputs(reply); return;
        case Effect::control: control(request.data); return;
        case Effect::set_diag_pending: diag_pending_ = true; return;
        case Effect::end_stat_diag:
            data_.set_stat_diag(false);
            diag_pending_ = true;
            return;
        case Effect::begin_stat_diag:
            if (data_.set_stat_diag(true)) log_.add(event(Event::Kind::unfreeze));
            diag_pending_ = true;
            return;
    }
}

void StateMachine::set_fault(Fault fault, const Judgement& judged, std::uint8_t master)
{
    const auto* refusal = std::get_if<RefusalDetail>(&judged.brings);
    refusal_ = refusal != nullptr ? *refusal : RefusalDetail{};
    Event refused = event(Event::Kind::refused);
    refused.master = master;
    refused.refusal = refusal_;
    log_.add_once(refused);
    switch (fault) {
        case Fault::none: break;
        case Fault::prm: prm_fault_ = true; break;
        case Fault::not_supported: not_supported_ = true; break;
        case Fault::cfg: cfg_fault_ = true; break;
    }
}

/// The leave procedure L of wire reference 6.3. The state itself is the table's.
void StateMachine::leave(LeaveReason reason)
{
    left_because_ = reason;
    master_ = kNoMaster;
    watchdog_.stop();
    parameters_ = {};
    diag_pending_ = false;
    if (state_ == State::data_exch) data_.end();
}

void StateMachine::enter(State to, LeaveReason reason, std::uint8_t owner_before)
{
    state_ = to;
    Event entered = event(Event::Kind::state);
    entered.reason = reason;
    if (master_ == kNoMaster) entered.master = owner_before;
    log_.add(entered);
}

/// The slave is as after a reset. But values that others have given (extended diagnosis) or that count for
/// ever (generations, counters, orders not fetched yet) stay.
void StateMachine::power_on()
{
    min_tsdr_ = kSmallestMinTsdr;
    prm_fault_ = not_supported_ = cfg_fault_ = false;
    cfg_accepted_.clear();
    refusal_ = {};
    left_because_ = LeaveReason::none;
}

void StateMachine::read_diagnosis(std::uint8_t sa, fdl::ReplyData& reply)
{
    append_diagnosis(reply);
    if (sa == master_ && !data_.stat_diag()) diag_pending_ = false;
}

void StateMachine::take_parameters(const Judgement& judged, const fdl::Indication& request)
{
    const auto* offered = std::get_if<SetPrm>(&judged.brings);
    if (offered == nullptr) return; // the trigger always comes with them
    parameters_ = *offered;
    master_ = request.sa;
    min_tsdr_ = min_tsdr_of(request.data, min_tsdr_);
    prm_fault_ = not_supported_ = false;
    if (service_of(refusal_.why) == Service::set_prm) refusal_ = {};

    // In Data_Exch (row P11): a master that gives up Sync or Freeze cannot end it any more, for then Unsync
    // is ignored as well.
    if (!parameters_.sync_requested) set_sync(Switch::off);
    if (!parameters_.freeze_requested) set_freeze(Switch::off);

    if (parameters_.watchdog_on) {
        watchdog_.start(parameters_.watchdog, request.at);
    } else {
        watchdog_.stop();
        log_.add_once(event(Event::Kind::watchdog_of_master));
    }
}

void StateMachine::start_exchange(const Judgement& judged, const fdl::Indication& request)
{
    const auto* offered = std::get_if<Configuration>(&judged.brings);
    if (offered == nullptr) return; // the trigger always comes with it
    data_.begin(*offered, request.at);
    if (data_.stat_diag()) diag_pending_ = true;
    cfg_accepted_.assign(request.data);
    cfg_fault_ = false;
    refusal_ = {}; // of a Chk_Cfg: one of Set_Prm has ended when the parameters were taken
}

/// Clear first, then Sync and Freeze. Those count only if Set_Prm asked for them, which it can only where the
/// device has them.
void StateMachine::control(Bytes data)
{
    const GlobalCommand command = global_command(data);
    if (data_.set_clear(command.clear)) log_.add(event(Event::Kind::clear_data));
    if (parameters_.sync_requested) set_sync(command.sync);
    if (parameters_.freeze_requested) set_freeze(command.freeze);
}

void StateMachine::set_sync(Switch to)
{
    if (data_.set_sync(to)) log_.add(event(data_.sync() ? Event::Kind::sync : Event::Kind::unsync));
}

void StateMachine::set_freeze(Switch to)
{
    if (data_.set_freeze(to)) log_.add(event(data_.freeze() ? Event::Kind::freeze : Event::Kind::unfreeze));
}

void StateMachine::on_time(Instant at)
{
    if (watchdog_.expired(at)) {
        ++expirations_;
        apply(Trigger::watchdog_expired, at);
    }
    if (at >= data_.outputs_old_at()) data_.forget_waiting_outputs();
    if (at >= data_.ready_by() && data_.give_up_waiting()) apply(Trigger::inputs_ready, at);
}

void StateMachine::retrigger(std::uint8_t sa, Instant at)
{
    if (sa == master_) watchdog_.retrigger(at);
}

Instant StateMachine::next_deadline() const
{
    return std::min({watchdog_.deadline(), data_.ready_by(), data_.outputs_old_at()});
}

bool StateMachine::set_ext_diag(Bytes blocks, bool fault)
{
    const auto outcome = ext_diag_.set(blocks, fault);
    if (outcome.changed) apply(Trigger::diagnosis_changed);
    return outcome.well_formed;
}

fdl::Supervision StateMachine::supervision() const
{
    if (master_ == kNoMaster) return fdl::Supervision::unowned;
    return watchdog_.on() ? fdl::Supervision::supervised : fdl::Supervision::owned;
}

Event StateMachine::event(Event::Kind kind) const
{
    return {.kind = kind, .state = state_, .master = master_};
}

void StateMachine::append_diagnosis(ByteBuffer<244>& into) const
{
    encode({.station_not_ready = state_ != State::data_exch,
            .cfg_fault = cfg_fault_,
            .ext_diag = ext_diag_.fault(),
            .not_supported = not_supported_,
            .prm_fault = prm_fault_,
            .prm_req = master_ == kNoMaster,
            .stat_diag = data_.stat_diag(),
            .watchdog_on = watchdog_.on(),
            .freeze = data_.freeze(),
            .sync = data_.sync(),
            .overflow = ext_diag_.overflow(),
            .master = master_,
            .ident = personality_.ident},
           into);
    into.append(ext_diag_.blocks());
}

void StateMachine::fill(Snapshot& seen) const
{
    seen.state = state_;
    seen.master = master_;
    seen.watchdog_on = watchdog_.on();
    seen.watchdog = watchdog_.period();
    seen.min_tsdr = min_tsdr_;
    seen.groups = parameters_.groups;
    seen.diag_pending = diag_pending_;
    append_diagnosis(seen.diagnosis);
    seen.left_because = left_because_;
    seen.refusal = refusal_;
    seen.counters.watchdog_expired = expirations_;
}

} // namespace dpslave::dp
