// SPDX-License-Identifier: Apache-2.0
#include "pending_probes.hpp"

#include "app/line/line_probe.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/report/answering.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>
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
    if (station.line_stalled.count() != 0)
        return Error{"ProbeEnded",
                     {{"station", station.config->name},
                      {"reason", stall_words(*station.drive_line, station.line_stalled)}}};
    const bool is_confirmed = parameters.value("yes", false);
    Json exchanging = Json::array();
    for (const Station& one : monitor_.view().stations)
        if (one.line == &line && one.bus.state == dp::State::data_exch)
            exchanging.push_back(one.config->name);
    if (!exchanging.empty() && !is_confirmed)
        return Error{"LineInUse", {{"line", line.name}, {"stations", std::move(exchanging)}}};
    LineLink& link = station.drive_line->link;
    const std::uint32_t number = waiting_.next_number();
    if (waiting_.size() >= kMaxProbes || !link.probe_states.add(number)) return Error{"Busy", Json::object()};
    if (!link.probes.push({.number = number, .station = station.number})) {
        link.probe_states.take_back(number);
        return Error{"Busy", Json::object()};
    }
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

/// The line stops asking, or does not begin. False: the line has come to an end, and its report is there.
bool PendingProbes::end(std::uint32_t number, const Waiting::Call& call, std::string_view reason)
{
    if (call.what.drive_line->link.probe_states.end(number) == OrderStates::End::answered) return false;
    call.to.end(Error{"ProbeEnded", {{"station", call.what.config->name}, {"reason", reason}}});
    return true;
}

void PendingProbes::refuse(const std::vector<Station>& left)
{
    take_reports();
    waiting_.end_of(left, [](std::uint32_t number, const Waiting::Call& call) {
        return end(number, call, "the station was changed or removed by a reload");
    });
}

/// A line that stalls asks nothing, and does not begin when it goes round again.
void PendingProbes::end_of_stalled_lines()
{
    for (const Station& station : monitor_.view().stations) {
        if (station.line_stalled.count() == 0) continue;
        const auto is_of_line = [&](const Waiting::Call& call) {
            return call.what.drive_line == station.drive_line;
        };
        waiting_.end_where(is_of_line, [&](std::uint32_t number, const Waiting::Call& call) {
            return end(number, call, stall_words(*station.drive_line, station.line_stalled));
        });
    }
}

/// Also those of lines that have left by a reload.
void PendingProbes::take_reports()
{
    std::set<std::shared_ptr<DriveLine>> lines{lines_.begin(), lines_.end()};
    waiting_.each([&](std::uint32_t, const Waiting::Call& call) { lines.insert(call.what.drive_line); });
    for (const auto& line : lines)
        while (const auto report = line->link.probe_reports.pop()) answer(*report);
}

/// The first probe of a line is the one that it carries out.
void PendingProbes::send_progress()
{
    std::set<const DriveLine*> told;
    waiting_.each([&](std::uint32_t, Waiting::Call& call) {
        const DriveLine* const line = call.what.drive_line.get();
        if (!told.insert(line).second) return;
        const std::uint32_t tried = line->link.probe_tried.load(std::memory_order_relaxed);
        if (std::exchange(call.what.sent, tried) != tried) call.to.send(json_of(progress(call.what, tried)));
    });
}

void PendingProbes::answer(Instant now)
{
    take_reports();
    send_progress();
    waiting_.end_where([](const Waiting::Call& call) { return !call.to.is_open(); },
                       [](std::uint32_t number, const Waiting::Call& call) {
                           return end(number, call, "its caller has gone");
                       });
    end_of_stalled_lines();
    waiting_.end_late(now, [](std::uint32_t number, const Waiting::Call& call) {
        return end(number, call, "its drive line did not come to an end");
    });
}

} // namespace dpslave::app
