// SPDX-License-Identifier: Apache-2.0
// ProbeDrive: the drive thread looks for a drive, the answer comes when it is done.
#include "dpslave/app/main_thread.hpp"

#include <spdlog/spdlog.h>

namespace dpslave::app {

using control::Done;
using control::Error;
using control::Json;
using control::Reply;

Reply MainThread::on_probe(const Json& parameters, const control::Caller& who)
{
    const Choice choice = choose(parameters, true);
    if (choice.error) return *choice.error;
    const Post& post = posts_[*choice.station];
    const bool is_sure = parameters.value("yes", Json()).is_boolean() && parameters["yes"].get<bool>();
    Json exchanging = Json::array();
    for (const StationView& one : view_.stations)
        if (one.line == &post.station.line->config && one.bus.state == dp::State::data_exch)
            exchanging.push_back(one.config->name);
    if (!exchanging.empty() && !is_sure)
        return Error{"LineInUse",
                     {{"line", post.station.line->config.name}, {"stations", std::move(exchanging)}}};
    const bool is_free = probing_.size() < kMaxProbes;
    if (!is_free ||
        !post.station.line->link.probes.push({.number = next_order_, .station = post.station.number}))
        return Error{"Busy", Json::object()};
    spdlog::info("{}: the drive is looked for on line {} by {}", post.station.config->name,
                 post.station.line->config.name, words_of(who));
    probing_[next_order_] = post.station.config;
    return control::Later{.token = next_order_++};
}

void MainThread::answer_probes()
{
    for (const auto& line : plant_.lines()) {
        while (const auto report = line->link.probe_reports.pop()) {
            const auto found = probing_.find(report->number);
            if (found == probing_.end()) continue;
            Json answering = Json::array();
            for (std::size_t i = 0; i < report->count; ++i) {
                const ProbeAnswer& one = report->answers[i];
                answering.push_back({{"protocol", line->config.protocol},
                                     {"baud", one.baud},
                                     {"format", format_text(one.format)},
                                     {"unit", unit_text(line->config, one.unit)}});
            }
            server_->complete(report->number, Done{{{"station", found->second->name},
                                                    {"line", line->config.name},
                                                    {"port", line->config.port},
                                                    {"tried", report->tried},
                                                    {"answering", std::move(answering)}}});
            probing_.erase(found);
        }
    }
}

} // namespace dpslave::app
