// SPDX-License-Identifier: Apache-2.0
#include "reload.hpp"

#include "app/state/emulated_device.hpp"

#include "dpslave/app/service.hpp"
#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace dpslave::app {

using control::Done;
using control::Json;
using control::Reply;

namespace {

std::vector<std::string> sentences(const input::Faults& faults)
{
    std::vector<std::string> all;
    for (const input::Fault& fault : faults) all.push_back(to_string(fault));
    return all;
}

/// Lines that leave have their driver enables for a moment still.
void keep_drivers(const config::Config& before, const config::Config& now)
{
    std::vector<DriverInUse> drivers = drivers_of(now);
    for (const DriverInUse& one : drivers_of(before))
        if (std::find(drivers.begin(), drivers.end(), one) == drivers.end()) drivers.push_back(one);
    if (const auto trouble = keep(drivers, runtime_folder())) spdlog::warn("{}", *trouble);
}

} // namespace

Json Reload::reply_of(const Outcome& outcome)
{
    report::ReloadReply result{outcome.applied, outcome.changes};
    for (const Plan::Leaving& one : outcome.leaving) result.leaving.push_back({one.station, one.reason});
    result.pending = outcome.pending;
    result.warnings = outcome.warnings;
    result.faults = outcome.faults;
    return json_of(result);
}

Reply Reload::request(bool dry_run, const control::Caller& caller)
{
    if (dry_run) return Done{reply_of(judge().outcome)};
    wanted_ = true;
    if (waiting_.empty()) waits_since_ = io::monotonic_now();
    waiting_.push_back(caller.reply_to);
    return control::Later{};
}

void Reload::advance()
{
    switch (step_) {
        case Step::idle:
            if (wanted_) start();
            break;
        case Step::bus:
            if (!bus_has_taken()) break;
            parts_.plant.finish();
            step_ = Step::drives;
            answer();
            break;
        case Step::drives:
            if (parts_.plant.is_settled()) step_ = Step::told;
            break;
        case Step::told: // by the tick before this one
            for (const Station& left : parts_.plant.take_leaving())
                parts_.monitor.add_lost_events(left.link->events.refused());
            step_ = Step::idle;
            break;
    }
    answer_late();
}

/// A bus thread or a drive line that hangs keeps no caller: the reload itself goes on when it can.
void Reload::answer_late()
{
    constexpr std::chrono::minutes kLongestWait{5}; // a search for a drive ends before
    const Instant now = io::monotonic_now();
    if (!current_.empty() && now > began_ + kLongestWait) {
        outcome_.warnings.push_back("the bus has not yet taken the new configuration");
        answer();
    }
    if (waiting_.empty() || now <= waits_since_ + kLongestWait) return;
    for (const control::ReplyTo& caller : std::exchange(waiting_, {}))
        caller.end(control::Error{"Busy", Json::object()});
}

void Reload::start()
{
    wanted_ = false;
    current_ = std::exchange(waiting_, {});
    began_ = io::monotonic_now();
    parts_.notifier.reloading(io::monotonic_now());
    spdlog::info("reading {} again", parts_.file.path().string());
    try {
        outcome_ = attempt();
    } catch (const std::exception& error) { // no descriptor, no thread or no memory left; nothing was changed
        outcome_ = {};
        outcome_.faults.push_back(fmt::format("a system error: {}", error.what()));
    }
    tell("reload refused: ", Severity::error, outcome_.faults);
    if (!outcome_.applied) spdlog::error("the new configuration is refused; the old one stays in use");
    if (outcome_.applied && outcome_.changes.empty() && outcome_.pending.empty())
        tell("reload: ", Severity::info, {"nothing has changed"});
    if (step_ == Step::idle) answer();
}

/// One for each change, or for each fault.
void Reload::tell(const std::string& before, Severity severity,
                  const std::vector<std::string>& sentences) const
{
    for (const std::string& one : sentences)
        parts_.happenings.tell({.kind = Happened::reload, .severity = severity, .text = before + one},
                               io::monotonic_now());
}

/// What the masters use now, as far as a value of it was ever on the bus or in the drive.
std::vector<InForce> Reload::in_force() const
{
    std::vector<InForce> all;
    for (const Station& station : parts_.monitor.view().stations) {
        InForce& one = all.emplace_back(InForce{station.address});
        const dp::Snapshot& bus = station.bus;
        const drive::DriveSnapshot& drive = station.drive;
        if (bus.state != dp::State::data_exch) continue;
        for (std::size_t k = 0; k < bus.layout.count; ++k) {
            const LayoutEntry& parameter = bus.layout.parameters[k];
            TagInUse& used = one.tags.emplace_back(TagInUse{parameter.tag, std::nullopt});
            if (drive.generation == bus.layout.generation && drive.updated_at[k] != Instant{})
                used.word = parameter.writes ? bus.outputs[k] : bus.inputs[k];
        }
        if (bus.demand_order.kind != DemandOrder::Kind::cancel)
            one.tags.push_back({bus.demand_order.tag, bus.demand_reply.back()});
    }
    return all;
}

Reload::Judged Reload::judge()
{
    Judged judged;
    Outcome& outcome = judged.outcome;
    auto wanted = parts_.file.load();
    if (!wanted) {
        outcome.faults = sentences(wanted.error());
        return judged;
    }
    if (!config::operator_group_of(wanted->control))
        wanted->warnings.push_back(config::without_operator_group(*wanted));
    outcome.warnings = sentences(wanted->warnings);
    parts_.monitor.refresh();
    Plan plan = plan_reload(parts_.monitor.config(), in_force(), std::move(*wanted));
    if (!plan.refusals.empty()) {
        outcome.faults = std::move(plan.refusals);
        return judged;
    }
    for (std::string& missing : parts_.plant.missing_ports(plan))
        outcome.warnings.push_back(std::move(missing));
    outcome.changes = plan.changes;
    outcome.leaving = plan.leaving;
    outcome.pending = plan.pending;
    judged.plan = std::move(plan);
    return judged;
}

Reload::Outcome Reload::attempt()
{
    auto [outcome, plan] = judge();
    for (const std::string& warning : outcome.warnings) spdlog::warn("{}", warning);
    if (!plan) return outcome;
    apply(std::move(*plan));
    tell("reload: ", Severity::info, outcome.changes);
    tell("reload, pending: ", Severity::warning, outcome.pending);
    outcome.applied = true;
    return outcome;
}

/// The new configuration is in force, and the bus is about to take it.
void Reload::apply(Plan plan)
{
    if (plan.changes.empty()) {
        parts_.monitor.set_config(std::move(plan.config)); // other texts in the file, and what is pending
        return;
    }
    parts_.plant.exchange(plan);
    keep_drivers(parts_.monitor.config(), plan.config);
    parts_.monitor.set_config(std::move(plan.config));
    stations_ = parts_.plant.bus_stations();
    step_ = Step::bus;
    parts_.lamps.exchange(parts_.monitor.config());
    parts_.applied(parts_.plant.leaving());
}

/// The bus takes its new stations when those that leave have published their end.
bool Reload::bus_has_taken()
{
    parts_.bus.stations.collect();
    if (stations_ && !parts_.bus.stations.offer(stations_)) return false;
    return parts_.bus.stations.taken();
}

void Reload::answer()
{
    parts_.notifier.ready(status_line(parts_.monitor.view()));
    for (const control::ReplyTo& caller : std::exchange(current_, {})) caller.end(Done{reply_of(outcome_)});
}

} // namespace dpslave::app
