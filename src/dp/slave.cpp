// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/slave.hpp"

#include "global_control.hpp"
#include "state_table.hpp"

#include "dpslave/dp/sap.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace dpslave::dp {

// These types cross between threads.
static_assert(std::is_trivially_copyable_v<Snapshot> && std::is_trivially_copyable_v<Event>);

Slave::Slave(const Personality& personality, std::uint8_t address)
    : personality_(personality), address_(address), data_(personality), machine_(personality, data_, log_)
{}

bool Slave::set_address(std::uint8_t address)
{
    if (state() != State::power_on) return false;
    address_ = address;
    return true;
}

void Slave::start(Instant now)
{
    if (state() == State::power_on) {
        prm_seen_.clear();
        cfg_seen_.clear();
    }
    machine_.apply(Trigger::start, now);
}

void Slave::stop(Instant now)
{
    machine_.apply(Trigger::stop, now);
}

fdl::Answer Slave::srd(const fdl::Indication& request, fdl::ReplyData& reply)
{
    machine_.on_time(request.at);
    const fdl::Answer answer = machine_.apply(judge(request), request, reply);
    machine_.retrigger(request.sa, request.at);
    counters_.not_activated += answer == fdl::Answer::not_activated ? 1u : 0u;
    counters_.no_resource += answer == fdl::Answer::no_resource ? 1u : 0u;
    return answer;
}

void Slave::sdn(const fdl::Indication& request)
{
    machine_.on_time(request.at);
    if (request.dsap != sap::kGlobalControl || request.ssap != sap::kMaster) return;
    ++counters_.global_control;
    fdl::ReplyData no_reply;
    machine_.apply(judge_control(request), request, no_reply); // no sign of life: wire reference 7.1
}

void Slave::heard(std::uint8_t sa, Instant at)
{
    machine_.on_time(at);
    machine_.retrigger(sa, at);
}

Judgement Slave::judge(const fdl::Indication& request)
{
    if (!request.dsap) return request.ssap ? Judgement{Trigger::other_sap} : judge_data(request);
    if (request.ssap != sap::kMaster) return {Trigger::other_sap};
    const bool with_data = !request.data.empty();
    switch (*request.dsap) {
        case sap::kSetSlaveAdd: return {Trigger::set_slave_add};
        case sap::kRdInp:
            ++counters_.rd_inp;
            return {with_data ? Trigger::read_back_with_data : Trigger::read_inputs};
        case sap::kRdOutp:
            ++counters_.rd_outp;
            return {with_data ? Trigger::read_back_with_data : Trigger::read_outputs};
        case sap::kGetCfg:
            ++counters_.get_cfg;
            return {with_data ? Trigger::get_cfg_with_data : Trigger::get_cfg};
        case sap::kSlaveDiag:
            ++counters_.slave_diag;
            return {with_data ? Trigger::slave_diag_with_data : Trigger::slave_diag};
        case sap::kSetPrm: return judge_set_prm(request);
        case sap::kChkCfg: return judge_chk_cfg(request);
        default: return {Trigger::other_sap}; // Global_Control too: it knows only SDN
    }
}

Judgement Slave::judge_data(const fdl::Indication& request) const
{
    if (request.sa != machine_.master()) return {Trigger::data_not_owner};
    if (request.data.size() == data_.configuration().out_length) return {Trigger::data_ok};
    return {request.data.empty() && personality_.fail_safe ? Trigger::data_empty : Trigger::data_length};
}

/// The checks are made in the order of wire reference 4.4.
Judgement Slave::judge_set_prm(const fdl::Indication& request)
{
    ++counters_.set_prm;
    if (request.data.size() < kPrmHeader) return {Trigger::prm_short};
    if (machine_.is_foreign(request.sa)) {
        ++counters_.foreign_prm;
        return {Trigger::prm_foreign};
    }
    prm_seen_.assign(request.data);
    switch (lock_of(request.data)) {
        case Lock::neither: return {Trigger::prm_min_tsdr};
        case Lock::unlock: return {Trigger::prm_unlock};
        case Lock::lock: break;
    }
    const auto offered = check_set_prm(personality_, request.data);
    if (!offered) {
        const bool unsupported = offered.error().why == Refusal::prm_not_supported;
        return {unsupported ? Trigger::prm_unsupported : Trigger::prm_bad, offered.error()};
    }
    return {offered->user == machine_.parameters().user ? Trigger::prm_ok : Trigger::prm_other_tags,
            *offered};
}

Judgement Slave::judge_chk_cfg(const fdl::Indication& request)
{
    ++counters_.chk_cfg;
    if (!machine_.is_foreign(request.sa)) cfg_seen_.assign(request.data);
    if (request.sa != machine_.master()) return {Trigger::cfg_not_owner};
    const bool exchanging = state() == State::data_exch;
    const Bytes accepted = machine_.accepted_configuration();
    if (exchanging && std::ranges::equal(request.data, accepted)) return {Trigger::cfg_ok};
    const auto offered = check_chk_cfg(personality_, machine_.parameters().tags(), request.data);
    if (!offered) return {Trigger::cfg_bad, offered.error()};
    if (exchanging) // it would do, but it is another one
        return {Trigger::cfg_bad, cfg_difference(accepted, request.data)};
    return {Trigger::cfg_ok, *offered};
}

Judgement Slave::judge_control(const fdl::Indication& request) const
{
    const bool ours = request.sa == machine_.master() && request.data.size() == 2 &&
                      global_command(request.data).selects(machine_.parameters().groups);
    return {ours ? Trigger::control : Trigger::control_not_ours};
}

void Slave::set_inputs(const InputImage& inputs)
{
    switch (data_.set_inputs(inputs)) {
        case ProcessData::Readiness::as_before: return;
        case ProcessData::Readiness::ready: machine_.apply(Trigger::inputs_ready); return;
        case ProcessData::Readiness::drive_gone: machine_.apply(Trigger::drive_gone); return;
    }
}

Snapshot Slave::snapshot() const
{
    Snapshot seen;
    seen.address = address_;
    seen.prm = prm_seen_;
    seen.cfg = cfg_seen_;
    seen.counters = counters_;
    data_.fill(seen);
    machine_.fill(seen);
    return seen;
}

} // namespace dpslave::dp
