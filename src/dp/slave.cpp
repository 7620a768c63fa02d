// SPDX-License-Identifier: Apache-2.0
/// The doors of the slave: to layer 2, to time, and to the world.
#include "dpslave/dp/slave.hpp"

#include "global_control.hpp"
#include "state_table.hpp"

#include <algorithm>
#include <type_traits>

namespace dpslave::dp {
namespace {

// What crosses between threads.
static_assert(std::is_trivially_copyable_v<Snapshot> && std::is_trivially_copyable_v<Event>);

// Service access points of a slave, and the one that every master's requests come from (wire reference 4.1).
constexpr std::uint8_t kSetSlaveAdd = 55;
constexpr std::uint8_t kRdInp = 56;
constexpr std::uint8_t kRdOutp = 57;
constexpr std::uint8_t kGlobalControl = 58;
constexpr std::uint8_t kGetCfg = 59;
constexpr std::uint8_t kSlaveDiag = 60;
constexpr std::uint8_t kSetPrm = 61;
constexpr std::uint8_t kChkCfg = 62;
constexpr std::uint8_t kMasterSap = 62;

} // namespace

Slave::Slave(const Personality& personality, std::uint8_t address)
    : personality_(personality), address_(address), demand_(personality)
{
    take_ext_diag({}, false); // no event: it is what the device says when there is nothing to say
}

bool Slave::set_address(std::uint8_t address)
{
    if (state_ != State::power_on) return false;
    address_ = address;
    return true;
}

void Slave::start(Instant now)
{
    act(Trigger::start, now);
}

void Slave::stop(Instant now)
{
    act(Trigger::stop, now);
}

fdl::Answer Slave::srd(const fdl::Indication& request, fdl::ReplyData& reply)
{
    tick(request.at); // a request that comes after the watchdog's expiry finds the slave in Wait_Prm
    const fdl::Answer answer = act(judge(request), request, reply);
    if (request.sa == master_) watchdog_.retrigger(request.at);
    counters_.not_activated += answer == fdl::Answer::not_activated ? 1u : 0u;
    counters_.no_resource += answer == fdl::Answer::no_resource ? 1u : 0u;
    return answer;
}

void Slave::sdn(const fdl::Indication& request)
{
    tick(request.at);
    if (request.dsap != kGlobalControl || request.ssap != kMasterSap) return;
    ++counters_.global_control;
    fdl::ReplyData no_reply;
    act(judge_control(request), request, no_reply); // no sign of life for the watchdog: wire reference 7.1
}

void Slave::heard(std::uint8_t sa, Instant at)
{
    tick(at);
    if (sa == master_) watchdog_.retrigger(at);
}

Tbit Slave::min_tsdr() const
{
    return min_tsdr_;
}

fdl::Supervision Slave::supervision() const
{
    if (master_ == kNoMaster) return fdl::Supervision::unowned;
    return watchdog_.on() ? fdl::Supervision::supervised : fdl::Supervision::owned;
}

void Slave::on_time(Instant now)
{
    tick(now);
}

Instant Slave::next_deadline() const
{
    return std::min(watchdog_.deadline(), ready_by_);
}

void Slave::tick(Instant at)
{
    if (watchdog_.expired(at)) {
        ++counters_.watchdog_expired;
        act(Trigger::watchdog_expired, at);
    }
    if (at < ready_by_) return;
    ready_by_ = kNever;
    if (!holds()) act(Trigger::inputs_ready, at);
}

Trigger Slave::judge(const fdl::Indication& request)
{
    if (!request.dsap) return request.ssap ? Trigger::other_sap : judge_data(request);
    if (request.ssap != kMasterSap) return Trigger::other_sap;
    const bool with_data = !request.data.empty();
    switch (*request.dsap) {
        case kSetSlaveAdd: return Trigger::set_slave_add;
        case kRdInp:
            ++counters_.rd_inp;
            return with_data ? Trigger::read_back_with_data : Trigger::read_inputs;
        case kRdOutp:
            ++counters_.rd_outp;
            return with_data ? Trigger::read_back_with_data : Trigger::read_outputs;
        case kGetCfg: ++counters_.get_cfg; return with_data ? Trigger::get_cfg_with_data : Trigger::get_cfg;
        case kSlaveDiag:
            ++counters_.slave_diag;
            return with_data ? Trigger::slave_diag_with_data : Trigger::slave_diag;
        case kSetPrm: ++counters_.set_prm; return judge_set_prm(request);
        case kChkCfg: ++counters_.chk_cfg; return judge_chk_cfg(request);
        default: return Trigger::other_sap; // Global_Control too: it knows only SDN
    }
}

Trigger Slave::judge_data(const fdl::Indication& request) const
{
    if (request.sa != master_) return Trigger::data_not_owner;
    if (request.data.size() == config_.out_length) return Trigger::data_ok;
    return request.data.empty() && personality_.fail_safe ? Trigger::data_empty : Trigger::data_length;
}

/// In the order of wire reference 4.4.
Trigger Slave::judge_set_prm(const fdl::Indication& request)
{
    if (request.data.size() < kPrmHeader) return Trigger::prm_short;
    if (is_foreign(request.sa)) {
        tell_once({.kind = Event::Kind::foreign_set_prm, .state = state_, .master = request.sa});
        return Trigger::prm_foreign;
    }
    prm_seen_.assign(request.data);
    switch (lock_of(request.data)) {
        case Lock::neither: return Trigger::prm_min_tsdr;
        case Lock::unlock: return Trigger::prm_unlock;
        case Lock::lock: break;
    }
    offered_refusal_ = check_set_prm(personality_, request.data, offered_prm_);
    switch (offered_refusal_.why) {
        case Refusal::none: break;
        case Refusal::prm_not_supported: return Trigger::prm_unsupported;
        default: return Trigger::prm_bad;
    }
    const bool same = std::ranges::equal(offered_prm_.user.bytes(), prm_.user.bytes());
    return same ? Trigger::prm_ok : Trigger::prm_other_tags;
}

Trigger Slave::judge_chk_cfg(const fdl::Indication& request)
{
    if (!is_foreign(request.sa)) cfg_seen_.assign(request.data);
    if (request.sa != master_) return Trigger::cfg_not_owner;
    if (state_ == State::data_exch) {
        if (std::ranges::equal(request.data, cfg_accepted_.bytes())) return Trigger::cfg_ok;
        offered_refusal_ = check_chk_cfg(personality_, prm_.tags(), request.data, offered_config_);
        if (offered_refusal_.why == Refusal::none) // it would do, but it is another one
            offered_refusal_ = cfg_difference(cfg_accepted_, request.data);
        return Trigger::cfg_bad;
    }
    offered_refusal_ = check_chk_cfg(personality_, prm_.tags(), request.data, offered_config_);
    return offered_refusal_.why == Refusal::none ? Trigger::cfg_ok : Trigger::cfg_bad;
}

Trigger Slave::judge_control(const fdl::Indication& request) const
{
    const bool ours = request.sa == master_ && request.data.size() == 2 &&
                      global_command(request.data).selects(prm_.groups);
    return ours ? Trigger::control : Trigger::control_not_ours;
}

void Slave::set_inputs(const InputImage& inputs)
{
    if (inputs.generation == 0 || inputs.generation != config_.layout.generation) return;
    inputs_ = inputs;
    const bool time_is_over = ready_by_ == kNever;
    if (stat_diag_ && !holds() && (inputs.every_input_tried || time_is_over))
        act(Trigger::inputs_ready, Instant{});
}

void Slave::set_demand_answer(const DemandAnswer& answer)
{
    demand_.answer(answer);
}

bool Slave::set_ext_diag(Bytes blocks, bool fault)
{
    const auto outcome = take_ext_diag(blocks, fault);
    if (outcome.changed) act(Trigger::diagnosis_changed, Instant{});
    return outcome.well_formed;
}

ExtendedDiagnosis::Outcome Slave::take_ext_diag(Bytes blocks, bool fault)
{
    const std::size_t room = std::max(personality_.max_diag_length, kStandardDiagnosis) - kStandardDiagnosis;
    std::array<std::uint8_t, kLongestBlock> zeros{};
    if (blocks.empty() && personality_.diag_octets != 0) {
        const std::size_t length = std::min<std::size_t>(personality_.diag_octets + 1u, zeros.size());
        zeros[0] = static_cast<std::uint8_t>(length); // bits 7 and 6 clear: device-related
        blocks = Bytes{zeros}.first(length);
    }
    return ext_diag_.set(blocks, fault, room);
}

std::optional<OutputImage> Slave::take_outputs()
{
    if (!outputs_changed_) return std::nullopt;
    outputs_changed_ = false;
    return OutputImage{.layout = config_.layout, .may_write = may_write_, .words = active_.words};
}

std::optional<DemandOrder> Slave::take_demand_order()
{
    return demand_.take_order();
}

std::optional<LeftDataExchange> Slave::take_left()
{
    return left_.pop();
}

std::optional<Event> Slave::take_event()
{
    if (events_.empty() && events_lost_) {
        events_lost_ = false;
        return Event{.kind = Event::Kind::overflow, .state = state_, .master = master_};
    }
    return events_.pop();
}

void Slave::tell(Event event)
{
    last_event_ = event;
    // Once one is lost, the following are too until the gap was told: else it would be told in the wrong
    // place.
    if (events_lost_ || !events_.push(event)) events_lost_ = true;
}

void Slave::tell_once(Event event)
{
    if (event != last_event_) tell(event);
}

Snapshot Slave::snapshot() const
{
    Snapshot seen{.state = state_,
                  .address = address_,
                  .master = master_,
                  .watchdog_on = watchdog_.on(),
                  .watchdog = watchdog_.period(),
                  .min_tsdr = min_tsdr_,
                  .groups = prm_.groups,
                  .sync = sync_,
                  .freeze = freeze_,
                  .clear = clear_told_,
                  .stat_diag = stat_diag_,
                  .holds = holds(),
                  .diag_pending = diag_pending_,
                  .diagnosis = {},
                  .prm = prm_seen_,
                  .cfg = cfg_seen_,
                  .left_because = left_because_,
                  .refusal = refusal_,
                  .layout = config_.layout,
                  .demand_data = config_.demand,
                  .may_write = may_write_,
                  .inputs = freeze_ ? frozen_.words : inputs_.words,
                  .outputs = active_.words,
                  .demand_request = received_.demand,
                  .demand_reply = freeze_ ? frozen_.demand : demand_.reply(),
                  .demand_order = demand_.standing(),
                  .counters = counters_};
    tell_diagnosis(seen.diagnosis);
    seen.counters.demand_orders = demand_.orders();
    seen.counters.demand_rejects = demand_.rejects();
    seen.counters.orders_lost += demand_.lost();
    return seen;
}

} // namespace dpslave::dp
