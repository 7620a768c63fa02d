// SPDX-License-Identifier: Apache-2.0
/// The state machine at work: the table says what is to be done, here it is done.
#include "global_control.hpp"
#include "state_table.hpp"

#include "dpslave/dp/slave.hpp"

namespace dpslave::dp {
namespace {

/// Every input was tried at the latest after this time; then the master need not wait any longer. A drive
/// that is not there must not keep the slave out of the exchange (wire reference 6.4, C2).
constexpr std::chrono::seconds kReadyAfter{1};

constexpr bool concerns_prm(Refusal why)
{
    return why < Refusal::cfg_empty;
}

constexpr State state_of(To to, State same)
{
    switch (to) {
        case To::same: return same;
        case To::power_on: return State::power_on;
        case To::wait_prm: return State::wait_prm;
        case To::wait_cfg: return State::wait_cfg;
        case To::data_exch: return State::data_exch;
    }
    return same;
}

} // namespace

void Slave::act(Trigger on, Instant at)
{
    fdl::Indication nothing_asked;
    nothing_asked.at = at;
    fdl::ReplyData no_reply;
    act(on, nothing_asked, no_reply);
}

fdl::Answer Slave::act(Trigger on, const fdl::Indication& request, fdl::ReplyData& reply)
{
    const Row& row = row_of(state_, on);
    const std::uint8_t owner_before = master_;
    const LeaveReason left = carry_out(row.effect, request, reply);
    enter(state_of(row.to, state_), left, owner_before);

    switch (row.reply) {
        case Reply::none: // an SDN, or nothing from the bus: nobody looks at the answer
        case Reply::sc: return fdl::Answer::sc;
        case Reply::rs: return fdl::Answer::not_activated;
        case Reply::rr: return fdl::Answer::no_resource;
        case Reply::data: break;
    }
    const bool exchanges = row.effect == Effect::exchange || row.effect == Effect::exchange_empty;
    if (exchanges && diag_pending_) return fdl::Answer::high; // even without inputs: wire reference 4.7
    return reply.empty() ? fdl::Answer::sc : fdl::Answer::low;
}

LeaveReason Slave::carry_out(Effect effect, const fdl::Indication& request, fdl::ReplyData& reply)
{
    switch (effect) {
        case Effect::none: break;
        case Effect::power_on: power_on(); break;
        case Effect::tell_diagnosis:
            tell_diagnosis(reply);
            if (request.sa == master_ && !stat_diag_) diag_pending_ = false;
            break;
        case Effect::tell_configuration: reply.assign(cfg_accepted_); break;
        case Effect::take_min_tsdr: min_tsdr_ = min_tsdr_of(request.data, min_tsdr_); break;
        case Effect::take_parameters: take_parameters(request); break;
        case Effect::start_exchange: start_exchange(request); break;
        case Effect::exchange:
            receive_outputs(request.data);
            tell_inputs(reply);
            break;
        case Effect::exchange_empty:
            ++counters_.data_exchange;
            clear_outputs();
            tell_inputs(reply);
            break;
        case Effect::tell_inputs: tell_inputs(reply); break;
        case Effect::tell_outputs: tell_outputs(reply); break;
        case Effect::obey_control: obey(global_command(request.data)); break;
        case Effect::tell_owner: diag_pending_ = true; break;
        case Effect::make_ready: make_ready(); break;
        case Effect::fail_parameters:
        case Effect::fail_supported:
            refuse(request.sa);
            (effect == Effect::fail_parameters ? prm_fault_ : not_supported_) = true;
            break;
        default: return leave_by(effect, request);
    }
    return LeaveReason::none;
}

/// The effects that are ways out of Wait_Cfg and Data_Exch: L(reason) with the fault bit that belongs to it.
LeaveReason Slave::leave_by(Effect effect, const fdl::Indication& request)
{
    LeaveReason reason = LeaveReason::stop;
    switch (effect) {
        case Effect::leave_parameters:
            reason = LeaveReason::prm_fault;
            prm_fault_ = true;
            refuse(request.sa);
            break;
        case Effect::leave_supported:
            reason = LeaveReason::not_supported;
            not_supported_ = true;
            refuse(request.sa);
            break;
        case Effect::leave_configuration:
            reason = LeaveReason::cfg_fault;
            cfg_fault_ = true;
            refuse(request.sa);
            break;
        case Effect::leave_unlock: reason = LeaveReason::unlock; break;
        case Effect::leave_length: reason = LeaveReason::output_length; break;
        case Effect::leave_watchdog: reason = LeaveReason::watchdog; break;
        case Effect::renew_parameters: reason = LeaveReason::new_parameters; break;
        default: break; // leave_stop
    }
    leave(reason);
    if (effect == Effect::renew_parameters) take_parameters(request);
    return reason;
}

void Slave::enter(State to, LeaveReason reason, std::uint8_t owner_before)
{
    if (to == state_) return;
    state_ = to;
    tell({.kind = Event::Kind::state,
          .state = to,
          .reason = reason,
          .master = master_ == kNoMaster ? owner_before : master_});
}

/// As after a reset. What others have given (extended diagnosis) and what counts for ever (generations,
/// counters, orders not fetched yet) stays.
void Slave::power_on()
{
    min_tsdr_ = kSmallestMinTsdr;
    prm_fault_ = not_supported_ = cfg_fault_ = false;
    cfg_accepted_.clear();
    prm_seen_.clear();
    cfg_seen_.clear();
    refusal_ = {};
    left_because_ = LeaveReason::none;
}

/// The leave procedure L of wire reference 6.3. The state itself is the table's business.
void Slave::leave(LeaveReason reason)
{
    left_because_ = reason;
    master_ = kNoMaster;
    watchdog_.stop();
    prm_ = {};
    stat_diag_ = false;
    ready_by_ = kNever;
    diag_pending_ = false;
    if (state_ == State::data_exch) end_exchange();
}

void Slave::refuse(std::uint8_t master)
{
    refusal_ = offered_refusal_;
    tell_once({.kind = Event::Kind::refused, .state = state_, .master = master, .refusal = refusal_});
}

void Slave::take_parameters(const fdl::Indication& request)
{
    prm_ = offered_prm_;
    master_ = request.sa;
    min_tsdr_ = min_tsdr_of(request.data, min_tsdr_);
    prm_fault_ = not_supported_ = false;
    if (concerns_prm(refusal_.why)) refusal_ = {};

    // In Data_Exch (row P11): who gives Sync or Freeze up can end it no more, for then Unsync is ignored as
    // well.
    if (!prm_.sync_requested) set_sync(Switch::off);
    if (!prm_.freeze_requested) set_freeze(Switch::off);

    if (prm_.watchdog_on) {
        watchdog_.start(prm_.watchdog, request.at);
    } else {
        watchdog_.stop();
        tell_once({.kind = Event::Kind::watchdog_of_master, .state = state_, .master = master_});
    }
}

void Slave::start_exchange(const fdl::Indication& request)
{
    config_ = offered_config_;
    if (++generations_ == 0) ++generations_; // 0 means that there is no layout
    config_.layout.generation = generations_;
    cfg_accepted_.assign(request.data);
    cfg_fault_ = false;
    if (!concerns_prm(refusal_.why)) refusal_ = {};
    outputs_changed_ = true;
    if (config_.demand) demand_.begin(generations_);
    if (config_.reads || (personality_.tries_outputs && config_.layout.count > 0)) {
        stat_diag_ = diag_pending_ = true;
        ready_by_ = request.at + kReadyAfter;
    }
}

void Slave::make_ready()
{
    stat_diag_ = false;
    ready_by_ = kNever;
    diag_pending_ = true;
}

/// The outputs go to their safe state, and the drive side is told: by the order, which no later start-up can
/// overwrite, and by an image without a layout.
void Slave::end_exchange()
{
    ++counters_.left_data_exchange;
    if (left_.full()) {
        // Nobody has fetched eight of them: the oldest layout's outputs are the ones that later orders cover
        // too.
        left_.pop();
        ++counters_.orders_lost;
    }
    left_.push({.generation = config_.layout.generation});
    demand_.end();
    config_ = {};
    received_ = active_ = frozen_ = {};
    inputs_ = {};
    may_write_ = sync_ = freeze_ = clear_told_ = false;
    outputs_changed_ = true;
}

} // namespace dpslave::dp
