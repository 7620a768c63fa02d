// SPDX-License-Identifier: Apache-2.0
// ProbeDrive: the drive thread looks for a drive. Who asks with "more" is told how far it is, and ends it by
// going.
#include "main_thread.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

namespace {

Json probe_reply(const std::string& station, const std::string& line, const std::string& port,
                 const ProbeLength& length, std::uint32_t tried)
{
    return {{"station", station},
            {"line", line},
            {"port", port},
            {"tried", tried},
            {"to_try", length.questions},
            {"longest_s", length.longest.count()},
            {"done", false},
            {"answering", Json::array()}};
}

Json answers_json(const ProbeReport& report, const config::LineConfig& line)
{
    Json all = Json::array();
    for (std::size_t i = 0; i < report.count; ++i) {
        const ProbeAnswer& one = report.answers[i];
        all.push_back({{"protocol", line.protocol},
                       {"baud", one.baud},
                       {"format", format_text(one.format)},
                       {"unit", unit_text(line, one.unit)}});
    }
    return all;
}

} // namespace

Reply MainThread::on_probe(const Json& parameters, const control::Caller& who)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const Post& post = posts_[*choice.station];
    const config::LineConfig& line = post.station.line->config;
    const bool is_sure = parameters.value("yes", Json()).is_boolean() && parameters["yes"].get<bool>();
    Json exchanging = Json::array();
    for (const StationView& one : view_.stations)
        if (one.line == &line && one.bus.state == dp::State::data_exch)
            exchanging.push_back(one.config->name);
    if (!exchanging.empty() && !is_sure)
        return Error{"LineInUse", {{"line", line.name}, {"stations", std::move(exchanging)}}};
    const bool is_free = probing_.size() < kMaxProbes;
    if (!is_free ||
        !post.station.line->link.probes.push({.number = next_order_, .station = post.station.number}))
        return Error{"Busy", Json::object()};
    const std::string& name = post.station.config->name;
    spdlog::info("{}: the drive is looked for on line {} by {}", name, line.name, words_of(who));
    Probing probing{.config = post.station.config,
                    .line = line.name,
                    .port = line.port,
                    .length = length_of(probe_plan(line, post.station.config->unit), line),
                    .stream = std::nullopt};
    Reply reply = control::Later{.token = next_order_};
    if (who.more) {
        probing.stream = next_stream_++;
        reply = control::Stream{.stream = *probing.stream,
                                .first = probe_reply(name, line.name, line.port, probing.length, 0)};
    }
    probing_[next_order_++] = std::move(probing);
    return reply;
}

void MainThread::answer_probes()
{
    if (probing_.empty()) return;
    const auto open = server_->streams();
    for (const auto& line : plant_.lines()) {
        LineLink& link = line->link;
        while (const auto report = link.probe_reports.pop()) {
            const auto found = probing_.find(report->number);
            if (found == probing_.end()) continue;
            const Probing& probing = found->second;
            Json reply =
                probe_reply(probing.config->name, probing.line, probing.port, probing.length, report->tried);
            reply["done"] = true;
            reply["answering"] = answers_json(*report, line->config);
            if (probing.stream)
                server_->push(*probing.stream, reply);
            else
                server_->complete(report->number, Done{std::move(reply)});
            probing_.erase(found);
        }
        for (auto& [number, probing] : probing_) {
            if (probing.line != line->config.name || !probing.stream) continue;
            const std::uint32_t tried = link.probe_tried.load(std::memory_order_relaxed);
            if (!std::binary_search(open.begin(), open.end(), *probing.stream))
                link.probe_ended.store(number, std::memory_order_relaxed);
            else if (std::exchange(probing.told, tried) != tried)
                server_->push(*probing.stream, probe_reply(probing.config->name, probing.line, probing.port,
                                                           probing.length, tried));
        }
    }
}

} // namespace dpslave::app
