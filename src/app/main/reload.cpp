// SPDX-License-Identifier: Apache-2.0
#include "reload.hpp"

#include "device_state.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace dpslave::app {

using control::Done;
using control::Json;
using control::Reply;

namespace {

std::vector<std::string> sentences(const toml::Faults& faults)
{
    std::vector<std::string> all;
    for (const toml::Fault& fault : faults) all.push_back(to_string(fault));
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

Reply Reload::request(bool dry_run)
{
    if (dry_run) return Done{reply_of(judge().outcome)};
    wanted_ = true;
    waiting_.push_back(parts_.replies.next_token);
    return control::Later{.token = parts_.replies.next_token++};
}

void Reload::advance()
{
    switch (step_) {
        case Step::idle:
            if (wanted_) start();
            break;
        case Step::bus:
            if (!bus_has_taken()) break;
            parts_.runtime.finish();
            step_ = Step::drives;
            answer();
            break;
        case Step::drives:
            if (!parts_.runtime.is_settled()) break;
            // Their events are in the log: no tick begins before the one before it has written them.
            for (const Station& left : parts_.runtime.take_leaving())
                parts_.monitor.add_lost_events(left.link->events.refused());
            step_ = Step::idle;
            break;
    }
}

void Reload::start()
{
    wanted_ = false;
    current_ = std::exchange(waiting_, {});
    parts_.notifier.reloading(io::monotonic_now());
    spdlog::info("reading {} again", parts_.file.path().string());
    try {
        outcome_ = attempt();
    } catch (const std::exception& error) { // no descriptor, no thread or no memory left; nothing was changed
        outcome_ = {};
        outcome_.faults.push_back(fmt::format("a system error: {}", error.what()));
    }
    for (const std::string& fault : outcome_.faults) spdlog::error("{}", fault);
    if (!outcome_.applied) spdlog::error("the new configuration is refused; the old one stays in use");
    if (outcome_.applied && outcome_.changes.empty() && outcome_.pending.empty())
        spdlog::info("nothing has changed");
    record();
    if (step_ == Step::idle) answer();
}

/// What came of it, for `dpctl events`: one event for each change, or for each fault.
void Reload::record() const
{
    const Instant now = io::monotonic_now();
    const auto add = [&](const std::string& before, const std::vector<std::string>& sentences) {
        for (const std::string& one : sentences) parts_.events.add(Happened::reload, {}, before + one, now);
    };
    if (!outcome_.applied) return add("reload refused: ", outcome_.faults);
    add("reload: ", outcome_.changes);
    add("reload, pending: ", outcome_.pending);
    if (outcome_.changes.empty() && outcome_.pending.empty()) add("reload: ", {"nothing has changed"});
}

/// What the masters use now, as far as a value of it was ever on the bus or in the drive.
std::vector<InForce> Reload::in_force() const
{
    std::vector<InForce> all;
    for (const Station& station : parts_.monitor.view().stations) {
        InForce& one = all.emplace_back(InForce{station.address});
        const dp::Snapshot& bus = station.bus;
        const drive::UnitSnapshot& drive = station.drive;
        if (bus.state != dp::State::data_exch) continue;
        for (std::size_t k = 0; k < bus.layout.count; ++k) {
            const Parameter& parameter = bus.layout.parameters[k];
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
    if (auto trouble = parts_.runtime.trouble_of(plan)) plan.refusals.push_back(std::move(*trouble));
    if (!plan.refusals.empty()) {
        outcome.faults = std::move(plan.refusals);
        return judged;
    }
    outcome.changes = plan.changes;
    outcome.leaving = plan.leaving;
    outcome.pending = plan.pending;
    judged.plan = std::move(plan);
    return judged;
}

/// What will be different is in the log before it is.
Reload::Outcome Reload::attempt()
{
    auto [outcome, plan] = judge();
    for (const std::string& warning : outcome.warnings) spdlog::warn("{}", warning);
    if (!plan) return outcome;
    for (const std::string& change : outcome.changes) spdlog::info("{}", change);
    for (const std::string& pending : outcome.pending) spdlog::warn("{}", pending);
    if (auto trouble = apply(std::move(*plan))) {
        Outcome refused;
        refused.warnings = std::move(outcome.warnings);
        refused.faults.push_back(std::move(*trouble));
        return refused;
    }
    outcome.applied = true;
    return outcome;
}

/// Nothing: the new configuration is in force, and the bus is about to take it. Else why not, and nothing was
/// changed.
std::optional<std::string> Reload::apply(Plan plan)
{
    if (plan.changes.empty()) {
        parts_.monitor.set_config(std::move(plan.config)); // other texts in the file, and what is pending
        return std::nullopt;
    }
    if (auto trouble = parts_.runtime.exchange(plan)) return trouble;
    parts_.monitor.set_config(std::move(plan.config));
    stations_ = parts_.runtime.bus_stations();
    step_ = Step::bus;
    const config::Config& config = parts_.monitor.config();
    for (const std::string& warning : parts_.lamps.exchange(config)) spdlog::warn("{}", warning);
    parts_.replies.server->set_operators(config::operator_group_of(config.control),
                                         config.control.operator_group);
    parts_.accesses.refuse(parts_.runtime.leaving());
    return std::nullopt;
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
    for (const std::uint32_t token : current_)
        parts_.replies.server->complete(token, Done{reply_of(outcome_)});
    current_.clear();
}

} // namespace dpslave::app
