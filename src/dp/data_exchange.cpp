// SPDX-License-Identifier: Apache-2.0
/// The cyclic exchange: outputs D (received) and N (in force), inputs live and frozen, and Global_Control
/// over them. Demand Data is part of both strings: under Sync its orders come from N as all outputs do, under
/// Freeze its reply stands still as all inputs do.
#include "global_control.hpp"

#include "dpslave/dp/slave.hpp"

namespace dpslave::dp {
namespace {

void push_registers(ByteBuffer<244>& into, const DemandRegisters& registers)
{
    for (const std::uint16_t word : registers) into.push16(word);
}

} // namespace

/// Precondition: data has the configured length.
void Slave::receive_outputs(Bytes data)
{
    ++counters_.data_exchange;
    std::size_t at = 0;
    const auto next = [&] {
        at += 2;
        return be16(data, at - 2);
    };
    if (config_.demand)
        for (std::uint16_t& word : received_.demand) word = next();
    for (std::size_t i = 0; i < config_.layout.count; ++i)
        if (config_.layout.parameters[i].writes) received_.words[i] = next();
    allow_writing();
    if (!sync_) activate_received();
}

/// Clear_Data, or a Data_Exchange without data: D and N become 0 at once, also under Sync.
void Slave::clear_outputs()
{
    received_ = {};
    allow_writing();
    activate_received();
}

/// D -> N.
void Slave::activate_received()
{
    for (std::size_t i = 0; i < config_.layout.count; ++i) {
        if (active_.words[i] == received_.words[i]) continue;
        active_.words[i] = received_.words[i];
        outputs_changed_ = true;
    }
    active_.demand = received_.demand;
    if (config_.demand && !finds_scales()) demand_.request(active_.demand);
}

/// From the first Data_Exchange or Clear_Data of this layout on; but a master that exchanges although
/// Stat_Diag holds it off writes nothing to a drive whose scales are not known yet.
void Slave::allow_writing()
{
    if (finds_scales()) return;
    outputs_changed_ = outputs_changed_ || !may_write_;
    may_write_ = true;
}

/// Clear first, then Sync and Freeze. Those count only if Set_Prm asked for them, which it can only where the
/// device has them.
void Slave::obey(const GlobalCommand& command)
{
    if (command.clear) {
        clear_outputs();
        if (!clear_told_) tell({.kind = Event::Kind::clear_data, .state = state_, .master = master_});
    }
    clear_told_ = command.clear;
    if (prm_.sync_requested) set_sync(command.sync);
    if (prm_.freeze_requested) set_freeze(command.freeze);
}

void Slave::set_sync(Switch to)
{
    if (to == Switch::keep || (to == Switch::off && !sync_)) return;
    const bool on = to == Switch::on;
    if (on != sync_)
        tell({.kind = on ? Event::Kind::sync : Event::Kind::unsync, .state = state_, .master = master_});
    sync_ = on;
    activate_received(); // Sync lets through what came until now, Unsync what came since
}

void Slave::set_freeze(Switch to)
{
    if (to == Switch::keep || (to == Switch::off && !freeze_)) return;
    const bool on = to == Switch::on;
    if (on != freeze_)
        tell({.kind = on ? Event::Kind::freeze : Event::Kind::unfreeze, .state = state_, .master = master_});
    freeze_ = on;
    frozen_ = {.words = inputs_.words, .demand = demand_.reply()};
}

void Slave::tell_inputs(ByteBuffer<244>& into) const
{
    if (config_.demand) push_registers(into, freeze_ ? frozen_.demand : demand_.reply());
    const auto& words = freeze_ ? frozen_.words : inputs_.words;
    for (std::size_t i = 0; i < config_.layout.count; ++i)
        if (config_.layout.parameters[i].reads) into.push16(words[i]);
}

/// The outputs in force: after Sync and Clear.
void Slave::tell_outputs(ByteBuffer<244>& into) const
{
    if (config_.demand) push_registers(into, active_.demand);
    for (std::size_t i = 0; i < config_.layout.count; ++i)
        if (config_.layout.parameters[i].writes) into.push16(active_.words[i]);
}

void Slave::tell_diagnosis(ByteBuffer<244>& into) const
{
    const bool exchanging = state_ == State::data_exch;
    encode({.station_not_ready = !exchanging,
            .cfg_fault = cfg_fault_,
            .ext_diag = ext_diag_.fault(),
            .not_supported = not_supported_,
            .prm_fault = prm_fault_,
            .prm_req = master_ == kNoMaster,
            .stat_diag = stat_diag_,
            .watchdog_on = watchdog_.on(),
            .freeze = freeze_,
            .sync = sync_,
            .overflow = ext_diag_.overflow(),
            .master = master_,
            .ident = personality_.ident},
           into);
    into.append(ext_diag_.blocks());
}

} // namespace dpslave::dp
