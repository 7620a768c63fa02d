// SPDX-License-Identifier: Apache-2.0
#include "line_unit.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace dpslave::app {

namespace {

drive::DriveSettings unit_settings(const config::StationConfig& station, const config::LineConfig& line)
{
    drive::DriveSettings unit;
    unit.address = station.unit;
    unit.tags = station.tags.get();
    unit.tags_only_from_table = station.profile->tags_only_from_table;
    unit.scale_from_table = line.protocol == config::kEiAscii;
    unit.unlisted_decimals = station.unlisted_decimals;
    unit.scale_registers = station.scale_registers;
    unit.unscaled_holds = station.unscaled_holds;
    unit.denied_holds = station.denied_holds;
    unit.output_refresh = station.output_refresh;
    unit.zero_after = station.zero_after;
    // Modbus instruments store each write in a memory that wears: only what differs is written.
    unit.compare_outputs = line.protocol == config::kModbusRtu;
    unit.never_written = station.profile->never_written;
    unit.watched = station.watched;
    unit.retries = line.retries;
    unit.loss = station.loss;
    unit.zeroes_on_return = station.profile->has_tec || station.zero_after.has_value();
    unit.decides_every = line.timeout;
    // Ten timeouts, as the clients have it: a late answer to a probe is then over.
    unit.probe_interval = line.settle.count() != 0 ? line.settle : 10 * line.timeout;
    return unit;
}

} // namespace

std::vector<drive::DriveSettings> poller_settings(const std::vector<DriveUnit>& units,
                                                  const config::LineConfig& line)
{
    std::vector<drive::DriveSettings> settings;
    for (const DriveUnit& unit : units) settings.push_back(unit_settings(*unit.config, line));
    return settings;
}

std::string zeros_in_words(const std::vector<drive::ZeroLeft>& left)
{
    std::string words;
    for (const bool is_written : {false, true}) {
        std::string tags;
        unsigned count = 0;
        for (const drive::ZeroLeft& one : left) {
            if (one.is_written != is_written) continue;
            tags += (count++ == 0 ? "" : ", ") + std::to_string(one.tag);
        }
        if (count == 0) continue;
        words += fmt::format("{}tag{} {} {} {}", words.empty() ? "" : "; ", count == 1 ? "" : "s", tags,
                             count == 1 ? "was" : "were",
                             is_written ? "written and not read back" : "not written");
    }
    return words;
}

LineUnit::LineUnit(const DriveUnit& made_of)
    : DriveUnit(made_of),
      zero_after_ms_(to_ms(made_of.config->zero_after)),
      is_away_(made_of.config->loss.when == drive::WhenLost::silent)
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
    while (const auto order = link->demand_orders.pop()) {
        poller.set_demand(index, *order);
        ordered_ = order->number;
    }
}

bool LineUnit::note_stall(drive::Poller& poller, std::size_t index, Instant now)
{
    const std::uint32_t all = link->stalls.load(std::memory_order_acquire);
    if (std::exchange(stalls_, all) == all) return false;
    // A newer order waits at the bus: of those that are here none stands any more.
    const std::uint32_t stands_from = link->stands_from.load(std::memory_order_acquire);
    if (static_cast<std::int32_t>(stands_from - ordered_) > 0)
        poller.set_demand(index, {.kind = DemandOrder::Kind::cancel});
    poller.not_asked(index, now);
    return true;
}

void LineUnit::show_stall()
{
    link->stalls_noted.store(stalls_, std::memory_order_release);
}

void LineUnit::lose_master()
{
    link->departures.fetch_add(2, std::memory_order_release);
}

void LineUnit::publish(drive::Poller& poller, std::size_t index,
                       const std::optional<drive::AnswerCounts>& heard)
{
    if (const auto inputs = poller.take_inputs(index)) link->inputs.publish(*inputs);
    while (const auto answer = poller.take_demand_answer(index)) link->demand_answer.publish(*answer);
    drive::DriveSnapshot snapshot = poller.snapshot(index);
    if (heard) snapshot.heard = *heard;
    link->drive_snapshot.publish(snapshot);
    if (std::exchange(is_away_, snapshot.away) != snapshot.away)
        link->departures.fetch_add(1, std::memory_order_release);
}

void LineUnit::sample(const drive::DriveSnapshot& now, trace::Ring& ring)
{
    sampler_.sample(number, now, ended_, ring, io::monotonic_now());
}

void LineUnit::tell(const drive::DriveSnapshot& now, LineHappenings& happenings)
{
    tell_link(now, happenings);
    if (now.presence != drive::DrivePresence::gone) // a ride that the drive has ended is not over
        tell_ride_through(now.ride_ends, happenings);
    else
        ride_ends_.reset();
}

void LineUnit::tell_link(const drive::DriveSnapshot& now, LineHappenings& happenings)
{
    if (!now.known || (was_known_ && answered_ == now.answers)) return;
    was_known_ = true;
    answered_ = now.answers;
    const std::string& name = config->name;
    if (now.answers) {
        happenings.tell(Severity::info, number, name + ": the drive answers", LineHappenings::Kind::answers);
        return;
    }
    const bool holds =
        config->loss.when == drive::WhenLost::hold; // else what follows is said when it is gone
    happenings.tell(
        Severity::warning, number,
        name +
            (holds ? ": the drive does not answer; inputs are held, outputs are written again when it returns"
                   : ": the drive does not answer"),
        LineHappenings::Kind::silent);
}

/// The outputs of a lost master stand for a while: the operator has to know that it begins and how it ends.
void LineUnit::tell_ride_through(const std::optional<Instant>& ends, LineHappenings& happenings)
{
    const auto before = std::exchange(ride_ends_, ends);
    if (ends == before) return;
    if (ends && !before) ride_layout_ = layout_;
    const auto say = [&](Severity severity, const std::string& text) {
        happenings.tell(severity, number, config->name + ": " + text, LineHappenings::Kind::ride_through);
    };
    if (ends == kNever)
        say(Severity::warning,
            "the master is lost; the outputs keep their values until it returns (RIDE THROUGH)");
    else if (ends)
        say(Severity::warning,
            fmt::format("the master is lost; the outputs keep their values for {:.1f} s more (RIDE THROUGH)",
                        std::chrono::duration<double>(*ends - io::monotonic_now()).count()));
    else if (layout_ != ride_layout_)
        say(Severity::info, "the master is back and has taken over the outputs");
    else
        say(Severity::warning, "RIDE THROUGH is over: the outputs are set to 0");
}

} // namespace dpslave::app
