// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/process_data.hpp"

#include "dpslave/dp/snapshot.hpp"

#include <utility>

namespace dpslave::dp {
namespace {

/// A drive that has not answered at all within this time must not keep the slave out of the exchange (wire
/// reference 6.4, C2).
constexpr std::chrono::seconds kReadyAfter{1};

/// Outputs that the master sent while Stat_Diag held the start are written at its end, if the last
/// Data_Exchange is not older than this [DEC].
constexpr std::chrono::nanoseconds kWaitingOutputs = std::chrono::seconds{2} + std::chrono::nanoseconds{1};

void append_registers(ByteBuffer<244>& into, const DemandRegisters& registers)
{
    for (const std::uint16_t word : registers) into.push16(word);
}

} // namespace

void ProcessData::begin(const Configuration& configuration, Instant at)
{
    config_ = configuration;
    if (++generations_ == 0) ++generations_; // 0 means that there is no layout
    config_.layout.generation = generations_;
    outputs_changed_ = true;
    if (config_.demand) demand_.begin(generations_);
    if (config_.reads || (personality_.tries_outputs && config_.layout.count > 0)) {
        stat_diag_ = starts_ = true;
        ready_by_ = personality_.waits_for_drive ? kNever : at + kReadyAfter;
    }
}

/// The end is told by the order, which no later start-up can overwrite, and by an image without a layout.
void ProcessData::end()
{
    ++ended_;
    if (left_.full()) { // the oldest layout's outputs are the ones that later orders cover too
        left_.pop();
        ++left_lost_;
    }
    left_.push({.generation = config_.layout.generation});
    demand_.end();
    config_ = {};
    received_ = active_ = frozen_ = {};
    inputs_ = {};
    has_outputs_ = may_write_ = in_force_ = sync_ = freeze_ = clear_ = false;
    set_stat_diag(false);
    outputs_changed_ = true;
}

void ProcessData::receive(Bytes data, Instant when)
{
    ++exchanges_;
    outputs_old_at_ = when + kWaitingOutputs;
    std::size_t at = 0;
    const auto next = [&] {
        at += 2;
        return be16(data, at - 2);
    };
    if (config_.demand)
        for (std::uint16_t& word : received_.demand) word = next();
    for (std::size_t i = 0; i < config_.layout.count; ++i)
        if (config_.layout.parameters[i].writes) received_.words[i] = next();
    has_outputs_ = true;
    if (!sync_) activate_received();
}

void ProcessData::receive_nothing(Instant at)
{
    ++exchanges_;
    outputs_old_at_ = at + kWaitingOutputs;
    clear_outputs();
}

/// D and N become 0 at once, also under Sync.
void ProcessData::clear_outputs()
{
    received_ = {};
    has_outputs_ = true;
    activate_received();
}

/// D -> N.
void ProcessData::activate_received()
{
    for (std::size_t i = 0; i < config_.layout.count; ++i) {
        if (active_.words[i] == received_.words[i]) continue;
        active_.words[i] = received_.words[i];
        outputs_changed_ = true;
    }
    active_.demand = received_.demand;
    in_force_ = in_force_ || has_outputs_;
    allow_writing();
}

/// Writing is allowed from the first outputs of the master that are in force: under Sync those of a
/// Data_Exchange are not. But a master that exchanges although Stat_Diag holds it off writes nothing to a
/// drive of which it is not known yet that it has the tags, and their scales.
void ProcessData::allow_writing()
{
    if (may_be_held()) return;
    if (config_.demand) demand_.request(active_.demand);
    if (!in_force_) return;
    outputs_changed_ = outputs_changed_ || !may_write_;
    may_write_ = true;
}

bool ProcessData::set_clear(bool clear)
{
    if (clear) clear_outputs();
    const bool first = clear && !clear_;
    clear_ = clear;
    return first;
}

bool ProcessData::set_sync(Switch to)
{
    if (to == Switch::keep || (to == Switch::off && !sync_)) return false;
    const bool before = sync_;
    sync_ = to == Switch::on;
    activate_received(); // Sync lets through what came until now, Unsync what came since
    return sync_ != before;
}

bool ProcessData::set_freeze(Switch to)
{
    if (to == Switch::keep) return false;
    const bool before = freeze_;
    freeze_ = to == Switch::on;
    frozen_ = {.words = inputs_.words, .demand = demand_.reply()};
    return freeze_ != before;
}

void ProcessData::append_inputs(ByteBuffer<244>& reply) const
{
    if (config_.demand) append_registers(reply, freeze_ ? frozen_.demand : demand_.reply());
    const auto& words = freeze_ ? frozen_.words : inputs_.words;
    for (std::size_t i = 0; i < config_.layout.count; ++i)
        if (config_.layout.parameters[i].reads) reply.push16(words[i]);
}

void ProcessData::append_outputs(ByteBuffer<244>& reply) const
{
    if (config_.demand) append_registers(reply, active_.demand);
    for (std::size_t i = 0; i < config_.layout.count; ++i)
        if (config_.layout.parameters[i].writes) reply.push16(active_.words[i]);
}

bool ProcessData::set_stat_diag(bool on)
{
    stat_diag_ = on;
    if (on) return std::exchange(freeze_, false);
    starts_ = false;
    ready_by_ = kNever;
    if (std::exchange(outputs_old_at_, kNever) != kNever && in_force_) allow_writing();
    return false;
}

bool ProcessData::give_up_waiting()
{
    ready_by_ = kNever;
    return hold() == StartHold::none && !drive_answers_;
}

ProcessData::Readiness ProcessData::set_inputs(const InputImage& inputs)
{
    drive_answers_ = inputs.drive_answers;
    if (inputs.generation == 0 || inputs.generation != config_.layout.generation) return Readiness::as_before;
    inputs_ = inputs;
    if (inputs.drive_gone) return stat_diag_ ? Readiness::as_before : Readiness::drive_gone;
    const bool waits_no_more = ready_by_ == kNever && !inputs.drive_answers && !personality_.waits_for_drive;
    const bool is_ready =
        stat_diag_ && hold() == StartHold::none && (inputs.every_input_tried || waits_no_more);
    return is_ready ? Readiness::ready : Readiness::as_before;
}

std::optional<OutputImage> ProcessData::take_outputs()
{
    if (!outputs_changed_) return std::nullopt;
    outputs_changed_ = false;
    return OutputImage{.layout = config_.layout, .may_write = may_write_, .words = active_.words};
}

void ProcessData::fill(Snapshot& seen) const
{
    seen.sync = sync_;
    seen.freeze = freeze_;
    seen.clear = clear_;
    seen.stat_diag = stat_diag_;
    seen.hold = hold();
    seen.layout = config_.layout;
    seen.demand_data = config_.demand;
    seen.may_write = may_write_;
    seen.inputs = freeze_ ? frozen_.words : inputs_.words;
    seen.outputs = active_.words;
    seen.demand_request = received_.demand;
    seen.demand_reply = freeze_ ? frozen_.demand : demand_.reply();
    seen.demand_order = demand_.standing();
    seen.counters.data_exchange = exchanges_;
    seen.counters.left_data_exchange = ended_;
    seen.counters.demand_orders = demand_.orders();
    seen.counters.demand_rejects = demand_.rejects();
    seen.counters.orders_lost = left_lost_ + demand_.lost();
}

} // namespace dpslave::dp
