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
    if (dry_run) {
        trials_.push_back(caller.reply_to);
        return control::Later{};
    }
    wanted_ = true;
    if (waiting_.empty()) waits_since_ = io::monotonic_now();
    waiting_.push_back(caller.reply_to);
    return control::Later{};
}

void Reload::advance(Instant now)
{
    now_ = now;
    switch (step_) {
        case Step::idle:
            if (wanted_ && !is_trial_)
                start(now);
            else if (parts_.plant.one_has_left()) // a line that had stalled
                step_ = Step::told;
            break;
        case Step::reading: break;
        case Step::bus:
            if (!bus_has_taken()) break;
            offered_ = now;
            step_ = Step::lines;
            [[fallthrough]];
        case Step::lines:
            parts_.plant.finish();
            if (!parts_.plant.have_taken(now) && now <= offered_ + kLongestTaking) break;
            step_ = Step::drives;
            answer();
            break;
        case Step::drives:
            if (parts_.plant.is_settled(now) || now > offered_ + kLongestLeaving) step_ = Step::told;
            break;
        case Step::told: // by the tick before this one
            for (const Station& left : parts_.plant.take_leaving())
                parts_.monitor.add_lost_events(left.link->events.refused());
            step_ = Step::idle;
            break;
    }
    if (!trials_.empty() && !is_trial_ && step_ != Step::reading) start_trial(now);
    give_up_reading(now);
    answer_late(now);
}

/// The disk or the name service hangs: nobody waits for it, and what comes of it is not used.
void Reload::give_up_reading(Instant now)
{
    const bool is_reading = step_ == Step::reading || is_trial_;
    if (!is_reading || now <= (is_trial_ ? trial_began_ : began_) + kLongestReading) return;
    Outcome outcome;
    outcome.faults.push_back(fmt::format(
        "{} has not answered for {} s: nothing was changed, and nothing of it is done later; repeat the reload when it answers",
        parts_.file.waits_for(), kLongestReading.count()));
    parts_.file.forget();
    for (const control::ReplyTo& caller : std::exchange(trials_, {})) tried_.push_back(caller);
    answer_trials(outcome);
    // Also those that wait for it: another one would hang as well. Not those that wait for the bus.
    const bool is_refused = step_ == Step::reading || (step_ == Step::idle && wanted_);
    if (!is_refused) return;
    step_ = Step::idle;
    wanted_ = false;
    for (const control::ReplyTo& caller : std::exchange(waiting_, {})) current_.push_back(caller);
    outcome_ = std::move(outcome);
    tell("reload refused: ", Severity::error, outcome_.faults);
    answer();
}

/// A bus thread that hangs keeps no caller: the reload itself goes on when it can.
void Reload::answer_late(Instant now)
{
    constexpr std::chrono::minutes kLongestWait{5}; // a search for a drive ends before
    if (!current_.empty() && now > began_ + kLongestWait) {
        outcome_.warnings.push_back("the bus has not yet taken the new configuration");
        answer();
    }
    if (waiting_.empty() || now <= waits_since_ + kLongestWait) return;
    for (const control::ReplyTo& caller : std::exchange(waiting_, {}))
        caller.end(control::Error{"Busy", Json::object()});
}

void Reload::start(Instant now)
{
    wanted_ = false;
    current_ = std::exchange(waiting_, {});
    began_ = now;
    parts_.notifier.reloading(io::monotonic_now());
    spdlog::info("reading {} again", parts_.file.path().string());
    step_ = Step::reading;
    parts_.file.read(parts_.monitor.config().lines, [this](ReadConfig& read) { carry_out(read); });
}

void Reload::start_trial(Instant now)
{
    is_trial_ = true;
    trial_began_ = now;
    tried_ = std::exchange(trials_, {});
    parts_.file.read(parts_.monitor.config().lines,
                     [this](ReadConfig& read) { answer_trials(judge(read).outcome); });
}

void Reload::answer_trials(const Outcome& outcome)
{
    is_trial_ = false;
    for (const control::ReplyTo& caller : std::exchange(tried_, {})) caller.end(Done{reply_of(outcome)});
}

void Reload::carry_out(ReadConfig& read)
{
    step_ = Step::idle;
    try {
        outcome_ = attempt(read);
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

Reload::Judged Reload::judge(ReadConfig& read)
{
    Judged judged;
    Outcome& outcome = judged.outcome;
    auto& wanted = read.config;
    if (!wanted) {
        outcome.faults = sentences(wanted.error());
        return judged;
    }
    if (!read.group) wanted->warnings.push_back(config::without_operator_group(*wanted));
    outcome.warnings = sentences(wanted->warnings);
    parts_.monitor.refresh();
    Plan plan = plan_reload(parts_.monitor.config(), in_force(), std::move(*wanted));
    if (!plan.refusals.empty()) {
        outcome.faults = std::move(plan.refusals);
        return judged;
    }
    plan.real_paths = std::move(read.real_paths);
    for (std::string& missing : parts_.plant.missing_ports(plan, read.ports))
        outcome.warnings.push_back(std::move(missing));
    outcome.changes = plan.changes;
    outcome.leaving = plan.leaving;
    outcome.pending = plan.pending;
    judged.plan = std::move(plan);
    return judged;
}

Reload::Outcome Reload::attempt(ReadConfig& read)
{
    auto [outcome, plan] = judge(read);
    for (const std::string& warning : outcome.warnings) spdlog::warn("{}", warning);
    if (!plan) return outcome;
    apply(std::move(*plan), read.group);
    tell("reload: ", Severity::info, outcome.changes);
    tell("reload, pending: ", Severity::warning, outcome.pending);
    outcome.applied = true;
    return outcome;
}

/// The new configuration is in force, and the bus is about to take it.
void Reload::apply(Plan plan, std::optional<gid_t> group)
{
    if (plan.changes.empty()) { // other texts in the file, and what is pending
        parts_.monitor.set_config(std::move(plan.config));
    } else {
        parts_.plant.exchange(plan);
        keep_drivers(parts_.monitor.config(), plan.config);
        parts_.monitor.set_config(std::move(plan.config));
        stations_ = parts_.plant.bus_stations();
        step_ = Step::bus;
        parts_.lamps.exchange(parts_.monitor.config());
    }
    parts_.applied(parts_.plant.leaving(), group);
}

/// Lines that leave have their driver enables for a moment still; one that stalls, until it has ended.
void Reload::keep_drivers(const config::Config& before, const config::Config& now)
{
    std::vector<DriverInUse> drivers = drivers_of(now);
    config::Config left = before;
    for (const auto& line : parts_.plant.leaving_lines()) left.lines.push_back(line->config);
    for (const DriverInUse& one : drivers_of(left))
        if (std::find(drivers.begin(), drivers.end(), one) == drivers.end()) drivers.push_back(one);
    parts_.file.keep(std::move(drivers));
}

/// The bus takes its new stations when those that leave have published their end.
bool Reload::bus_has_taken()
{
    parts_.bus.stations.collect();
    if (stations_ && !parts_.bus.stations.offer(stations_)) return false;
    return parts_.bus.stations.taken();
}

/// Also what lines still owe of this reload, or of one before.
void Reload::answer()
{
    if (outcome_.applied) {
        const std::vector<std::string> late = parts_.plant.late(now_);
        tell("reload: ", Severity::warning, late);
        outcome_.warnings.insert(outcome_.warnings.end(), late.begin(), late.end());
    }
    parts_.notifier.ready(status_line(parts_.monitor.view()));
    for (const control::ReplyTo& caller : std::exchange(current_, {})) caller.end(Done{reply_of(outcome_)});
}

} // namespace dpslave::app
