// SPDX-License-Identifier: Apache-2.0
#include "line_unit.hpp"

#include "dpslave/io/clock.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

namespace dpslave::app {

namespace {

drive::UnitSettings unit_settings(const config::StationConfig& station, const config::LineConfig& line)
{
    drive::UnitSettings unit;
    unit.address = station.unit;
    unit.tags = station.tags.get();
    unit.tags_only_from_table = station.profile->tags_only_from_table;
    unit.scale_from_table = line.protocol == config::kEiAscii;
    unit.unlisted_decimals = station.unlisted_decimals;
    unit.unscaled_holds = station.unscaled_holds;
    unit.output_refresh = station.output_refresh;
    unit.zero_after = station.zero_after;
    // Modbus instruments store each write in a memory that wears: only what differs is written.
    unit.compare_outputs = line.protocol == config::kModbusRtu;
    unit.never_written = station.profile->never_written;
    unit.watched = station.watched;
    unit.retries = line.retries;
    // Ten time-outs, as the clients have it: a late answer to a probe is then over.
    unit.probe_interval = line.settle.count() != 0 ? line.settle : 10 * line.timeout;
    return unit;
}

} // namespace

std::vector<drive::UnitSettings> poller_settings(const std::vector<DriveUnit>& units,
                                                 const config::LineConfig& line)
{
    std::vector<drive::UnitSettings> settings;
    for (const DriveUnit& unit : units) settings.push_back(unit_settings(*unit.config, line));
    return settings;
}

LineUnit::LineUnit(const DriveUnit& made_of)
    : DriveUnit(made_of), zero_after_ms_(to_ms(made_of.config->zero_after))
{}

void LineUnit::fetch(drive::Poller& poller, std::size_t index)
{
    // First the outputs, then the end of layouts (links.hpp says why), which the poller gets first.
    const OutputImage* outputs = link->outputs.fresh() ? &link->outputs.latest() : nullptr;
    const Generation ended = link->ended.load(std::memory_order_acquire);
    // Before the end of a layout: the time that counts for it may just have been set.
    const std::int64_t zero_after_ms = link->zero_after_ms.load(std::memory_order_relaxed);
    if (std::exchange(zero_after_ms_, zero_after_ms) != zero_after_ms)
        poller.set_zero_after(index, from_ms(zero_after_ms));
    if (std::exchange(ended_, ended) != ended) poller.left_data_exchange(index, {.generation = ended});
    if (outputs != nullptr) {
        poller.set_outputs(index, *outputs);
        sampler_.set_layout(outputs->layout);
        layout_ = outputs->layout.generation;
    }
    while (const auto order = link->demand_orders.pop()) poller.set_demand(index, *order);
}

void LineUnit::publish(drive::Poller& poller, std::size_t index,
                       const std::optional<drive::AnswerCounts>& heard)
{
    if (const auto inputs = poller.take_inputs(index)) link->inputs.publish(*inputs);
    while (const auto answer = poller.take_demand_answer(index)) link->demand_answer.publish(*answer);
    drive::UnitSnapshot snapshot = poller.snapshot(index);
    if (heard) snapshot.heard = *heard;
    link->drive_snapshot.publish(snapshot);
    log_ride_through(snapshot.ride_ends);
}

void LineUnit::sample(const drive::UnitSnapshot& now, trace::Ring& ring)
{
    sampler_.look(number, now, ended_, ring, io::monotonic_now());
}

void LineUnit::log_link(const drive::UnitSnapshot& now, LimitedLog& log)
{
    if (!now.known || (was_known_ && answered_ == now.answers)) return;
    log.say(now.answers ? LimitedLog::Level::info : LimitedLog::Level::warning,
            config->name + (now.answers ? ": the drive answers"
                                        : ": the drive does not answer; inputs are held, outputs are written "
                                          "again when it returns"),
            io::monotonic_now());
    was_known_ = true;
    answered_ = now.answers;
}

/// The outputs of a lost master stand for a while: the operator has to know that it begins and how it ends.
void LineUnit::log_ride_through(const std::optional<Instant>& ends)
{
    const auto before = std::exchange(ride_ends_, ends);
    if (ends == before) return;
    const std::string& name = config->name;
    if (ends && !before) ride_layout_ = layout_;
    if (ends == kNever)
        spdlog::warn("{}: the master is lost; the outputs keep their values until it returns (RIDE THROUGH)",
                     name);
    else if (ends)
        spdlog::warn("{}: the master is lost; the outputs keep their values for {:.1f} s more (RIDE THROUGH)",
                     name, std::chrono::duration<double>(*ends - io::monotonic_now()).count());
    else if (layout_ != ride_layout_)
        spdlog::info("{}: the master is back and has taken over the outputs", name);
    else
        spdlog::warn("{}: RIDE THROUGH is over: the outputs are set to 0", name);
}

} // namespace dpslave::app
