// SPDX-License-Identifier: Apache-2.0
#include "pending_probes.hpp"

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

std::vector<report::Answering> answering(const ProbeReport& report, const config::LineConfig& line)
{
    std::vector<report::Answering> all;
    for (std::size_t i = 0; i < report.count; ++i) {
        const ProbeAnswer& one = report.answers[i];
        all.push_back({line.protocol, one.baud, format_text(one.format), unit_text(line, one.unit)});
    }
    return all;
}

} // namespace

report::ProbeDriveReply PendingProbes::progress(const Probe& probe, std::uint32_t tried)
{
    return {probe.config->name,
            probe.line,
            probe.port,
            tried,
            integer(probe.length.questions),
            integer(probe.length.longest.count())};
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
    if (pending_.size() >= kMaxProbes ||
        !station.drive_line->link.probes.push({.number = replies_.next_token, .station = station.number}))
        return Error{"Busy", Json::object()};
    spdlog::info("{}: search for the drive on line {}, started by {}", station.config->name, line.name,
                 words_of(caller));
    Probe& probe = pending_[replies_.next_token];
    probe = {.config = station.config,
             .line = line.name,
             .port = line.port,
             .length = length_of(probe_plan(line, station.config->unit), line),
             .stream = std::nullopt};
    const control::Later later{.token = replies_.next_token++};
    if (!caller.more) return later;
    probe.stream = replies_.next_stream++;
    return control::Stream{.stream = *probe.stream, .first = json_of(progress(probe, 0))};
}

void PendingProbes::answer(const DriveLine& line, const ProbeReport& report)
{
    const auto found = pending_.find(report.number);
    if (found == pending_.end()) return;
    const Probe& probe = found->second;
    report::ProbeDriveReply reply = progress(probe, report.tried);
    reply.done = true;
    reply.answering = answering(report, line.config);
    if (probe.stream)
        replies_.server->push(*probe.stream, json_of(reply));
    else
        replies_.server->complete(report.number, Done{json_of(reply)});
    pending_.erase(found);
}

void PendingProbes::answer()
{
    if (pending_.empty()) return;
    const auto open = replies_.server->streams();
    for (const auto& line : runtime_.lines()) {
        LineLink& link = line->link;
        while (const auto report = link.probe_reports.pop()) answer(*line, *report);
        const std::uint32_t tried = link.probe_tried.load(std::memory_order_relaxed);
        for (auto& [number, probe] : pending_) {
            if (probe.line != line->config.name || !probe.stream) continue;
            if (!std::binary_search(open.begin(), open.end(), *probe.stream))
                link.probe_ended.store(number, std::memory_order_relaxed);
            else if (std::exchange(probe.sent, tried) != tried)
                replies_.server->push(*probe.stream, json_of(progress(probe, tried)));
        }
    }
}

} // namespace dpslave::app
