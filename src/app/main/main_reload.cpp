// SPDX-License-Identifier: Apache-2.0
// The configuration is read again: SIGHUP, or the method Reload. It is judged whole; then either all of it is
// done or nothing. The order matters: first the bus lets go of those who leave, then their drives get their
// safe state, and only then new ones take their place.
#include "main_thread.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace dpslave::app {

using control::Done;
using control::Error;
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

Json MainThread::reply_of(const Reloaded& reloaded)
{
    Json leaving = Json::array();
    for (const Plan::Leaving& one : reloaded.leaving)
        leaving.push_back(Json::object({{"station", one.station}, {"reason", one.reason}}));
    return Json::object({{"applied", reloaded.applied},
                         {"changes", reloaded.changes},
                         {"leaving", std::move(leaving)},
                         {"pending", reloaded.pending},
                         {"warnings", reloaded.warnings},
                         {"faults", reloaded.faults}});
}

/// While one is under way the next one waits; all who wait then share it.
Reply MainThread::on_reload(const Json& parameters)
{
    if (parameters.value("dry_run", false)) return Done{reply_of(judge_file().result)};
    reload_wanted_ = true;
    reload_asked_.push_back(next_order_);
    return control::Later{.token = next_order_++};
}

void MainThread::mind_reload()
{
    switch (reloading_) {
        case Reloading::idle:
            if (reload_wanted_) reload();
            break;
        case Reloading::bus:
            if (!bus_has_let_go()) break;
            plant_.finish();
            reloading_ = Reloading::drives;
            answer_reload();
            break;
        case Reloading::drives:
            if (!plant_.is_settled()) break;
            for (const Station& gone : leaving_) {
                log_events(gone);
                lost_before_ += gone.link->events.refused();
            }
            leaving_.clear();
            reloading_ = Reloading::idle;
            break;
    }
}

void MainThread::reload()
{
    reload_wanted_ = false;
    reload_told_ = std::move(reload_asked_);
    reload_asked_.clear();
    notifier_.reloading(io::monotonic_now());
    spdlog::info("reading {} again", config_.file.string());
    try {
        reloaded_ = try_reload();
    } catch (const std::exception& error) { // no descriptor, no thread or no memory left; nothing was changed
        reloaded_ = {};
        reloaded_.faults.push_back(fmt::format("a failure of the system: {}", error.what()));
    }
    for (const std::string& fault : reloaded_.faults) spdlog::error("{}", fault);
    if (!reloaded_.applied) spdlog::error("the new configuration is refused; the one until now runs on");
    if (reloaded_.applied && reloaded_.changes.empty() && reloaded_.pending.empty())
        spdlog::info("nothing has changed");
    if (reloading_ == Reloading::idle) answer_reload();
}

/// What the masters use at this moment, as far as a value of it was ever on the bus or in the drive.
std::vector<InForce> MainThread::in_force() const
{
    std::vector<InForce> all;
    for (std::size_t i = 0; i < posts_.size(); ++i) {
        InForce& one = all.emplace_back(InForce{posts_[i].device.address()});
        const dp::Snapshot& bus = view_.stations[i].bus;
        const drive::UnitSnapshot& drive = view_.stations[i].drive;
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

MainThread::Judged MainThread::judge_file()
{
    Judged judged;
    Reloaded& result = judged.result;
    auto wanted = config::load_config(config_.file, profiles_);
    remember_file(wanted ? &*wanted : nullptr);
    if (!wanted) {
        result.faults = sentences(wanted.error());
        return judged;
    }
    result.warnings = sentences(wanted->warnings);
    refresh();
    Plan plan = plan_reload(config_, in_force(), std::move(*wanted));
    if (auto trouble = plant_.trouble_of(plan)) plan.refusals.push_back(std::move(*trouble));
    if (!plan.refusals.empty()) {
        result.faults = std::move(plan.refusals);
        return judged;
    }
    result.changes = plan.changes;
    result.leaving = plan.leaving;
    result.pending = plan.pending;
    judged.plan = std::move(plan);
    return judged;
}

/// What will be different is in the log before it is.
MainThread::Reloaded MainThread::try_reload()
{
    auto [result, plan] = judge_file();
    for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
    if (!plan) return result;
    for (const std::string& change : result.changes) spdlog::info("{}", change);
    for (const std::string& pending : result.pending) spdlog::warn("{}", pending);
    if (auto trouble = apply(std::move(*plan))) {
        Reloaded refused;
        refused.warnings = std::move(result.warnings);
        refused.faults.push_back(std::move(*trouble));
        return refused;
    }
    result.applied = true;
    return result;
}

/// Nothing: the new configuration is the present one, and the bus is told. Else why not, and nothing was
/// changed.
std::optional<std::string> MainThread::apply(Plan plan)
{
    if (plan.changes.empty()) {
        config_ = std::move(plan.config); // what stands elsewhere in the file, and what is pending
        show_posts();
        return std::nullopt;
    }
    if (auto trouble = plant_.exchange(plan)) return trouble;
    config_ = std::move(plan.config);
    repost();
    bus_set_ = plant_.bus_stations();
    reloading_ = Reloading::bus;
    for (std::string& warning : lamps_.exchange(config_)) spdlog::warn("{}", warning);
    show_lamps(io::monotonic_now());
    server_->set_operators(config::operator_group_of(config_.control), config_.control.operator_group);
    answer_those_who_asked();
    return std::nullopt;
}

/// The posts of the stations that there are now; who stays keeps his.
void MainThread::repost()
{
    std::vector<Post> before = std::move(posts_);
    posts_.clear();
    for (std::size_t i = 0; i < plant_.stations().size(); ++i) {
        const Station& station = plant_.stations()[i];
        const auto known = std::find_if(before.begin(), before.end(), [&station](const Post& post) {
            return post.station.number == station.number;
        });
        if (known == before.end()) {
            posts_.push_back(make_post(station));
            continue;
        }
        Post& post = posts_.emplace_back(std::move(*known));
        before.erase(known);
        if (post.station.config != station.config) post.device.adopt(*station.config);
        post.station = station;
    }
    for (Post& gone : before) leaving_.push_back(std::move(gone.station));
    show_posts();
}

/// Those whose station has gone. The last step: what their caller sent behind it is answered on the spot, out
/// of the new configuration.
void MainThread::answer_those_who_asked()
{
    for (const Station& gone : leaving_) {
        for (auto one = asked_.begin(); one != asked_.end();) {
            if (one->second.station != gone.number) {
                ++one;
                continue;
            }
            const auto [token, asked] = *one;
            asked_.erase(one);
            if (asked.is_write) log_write(asked, "the station was changed or removed by a reload");
            server_->complete(
                token,
                Error{"DriveRefused",
                      {{"tag", asked.tag},
                       {"reason", fmt::format("station {} has just been changed or removed by a reload",
                                              gone.config->name)},
                       {"code", nullptr}}});
            one = asked_.upper_bound(token);
        }
    }
}

/// The bus takes its new set when the stations that are not in it have passed on what they had.
bool MainThread::bus_has_let_go()
{
    bus_.stations.collect();
    if (bus_set_ && !bus_.stations.offer(bus_set_)) return false;
    return bus_.stations.taken();
}

void MainThread::answer_reload()
{
    status_said_ = status_line(view_);
    notifier_.ready(status_said_);
    for (const std::uint32_t token : reload_told_) server_->complete(token, Done{reply_of(reloaded_)});
    reload_told_.clear();
}

} // namespace dpslave::app
