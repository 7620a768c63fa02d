// SPDX-License-Identifier: Apache-2.0
#include "pending_probes.hpp"

#include "app/line/line_probe.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/report/answering.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

constexpr std::size_t kMaxProbes = 2;
constexpr std::chrono::minutes kMargin{2}; ///< more than the longest of all probes may take

std::vector<report::Answering> answering(const ProbeReport& report)
{
    std::vector<report::Answering> all;
    for (std::size_t i = 0; i < report.count; ++i)
        all.push_back(report::answering_of(found_of(report.answers[i])));
    return all;
}

} // namespace

report::ProbeDriveReply PendingProbes::progress(const Probe& probe, std::uint32_t tried)
{
    return {probe.config->name,
            probe.line,
            probe.port,
            tried,
            integer(probe.questions),
            integer(probe.longest.count())};
}

Reply PendingProbes::start(const Station& station, const Json& parameters, const control::Caller& caller)
{
    const config::LineConfig& line = *station.line;
    const bool is_confirmed = parameters.value("yes", false);
    Json exchanging = Json::array();
    for (const Station& one : monitor_.view().stations)
        if (one.line == &line && one.bus.state == dp::State::data_exch)
            exchanging.push_back(one.config->name);
    if (!exchanging.empty() && !is_confirmed)
        return Error{"LineInUse", {{"line", line.name}, {"stations", std::move(exchanging)}}};
    if (waiting_.size() >= kMaxProbes ||
        !station.drive_line->link.probes.push({.number = waiting_.next_number(), .station = station.number}))
        return Error{"Busy", Json::object()};
    spdlog::info("{}: search for the drive on line {}, started by {}", station.config->name, line.name,
                 words_of(caller));
    const drive::LineSearch search = probe_search(line, *station.config, {});
    const Probe probe{.config = station.config,
                      .drive_line = station.drive_line,
                      .line = line.name,
                      .port = line.port,
                      .questions = search.most(),
                      .longest = search.longest()};
    waiting_.add({.to = caller.reply_to,
                  .station = station.number,
                  .due = io::monotonic_now() + kMaxProbes * search.longest() + kMargin,
                  .what = probe});
    if (!caller.more) return control::Later{};
    return control::Stream{.first = json_of(progress(probe, 0))};
}

void PendingProbes::answer(const ProbeReport& report)
{
    const auto call = waiting_.take(report.number);
    if (!call) return;
    report::ProbeDriveReply reply = progress(call->what, report.tried);
    reply.done = true;
    reply.answering = answering(report);
    call->to.end(Done{json_of(reply)});
}

/// The line stops asking, if it has not begun or not ended.
void PendingProbes::end(std::uint32_t number, const Waiting::Call& call, std::string_view reason)
{
    call.what.drive_line->link.probe_ended.store(number, std::memory_order_relaxed);
    call.to.end(Error{"ProbeEnded", {{"station", call.what.config->name}, {"reason", reason}}});
}

void PendingProbes::refuse(const std::vector<Station>& left)
{
    waiting_.end_of(left, [](std::uint32_t number, const Waiting::Call& call) {
        end(number, call, "the station was changed or removed by a reload");
    });
}

/// The first probe of a line is the one that it carries out.
void PendingProbes::answer(DriveLine& line)
{
    LineLink& link = line.link;
    while (const auto report = link.probe_reports.pop()) answer(*report);
    const std::uint32_t tried = link.probe_tried.load(std::memory_order_relaxed);
    bool is_first = true;
    waiting_.each([&](std::uint32_t number, Waiting::Call& call) {
        if (call.what.drive_line.get() != &line || !std::exchange(is_first, false)) return;
        if (!call.to.is_open())
            link.probe_ended.store(number, std::memory_order_relaxed);
        else if (std::exchange(call.what.sent, tried) != tried)
            call.to.send(json_of(progress(call.what, tried)));
    });
}

void PendingProbes::answer(Instant now)
{
    for (const auto& line : lines_) answer(*line);
    waiting_.end_late(now, [](std::uint32_t number, const Waiting::Call& call) {
        end(number, call, "its drive line did not come to an end");
    });
}

} // namespace dpslave::app
