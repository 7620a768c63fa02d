// SPDX-License-Identifier: Apache-2.0
#include "probe_run.hpp"

#include "line_backend.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>

namespace dpslave::app {

namespace {

/// Each question has a back-end of its own, which is owed nothing, and an answer counts when it comes twice:
/// what answers late could be taken for the answer of the next unit.
bool answers_twice(const config::LineConfig& trial, drive::UnitAddress address, drive::FrameListener& frames)
{
    const auto answers_once = [&] {
        std::atomic<bool> is_open{false}; // a trial is no event of the port
        const auto backend = LineBackend::open(trial, is_open, frames);
        return backend && (*backend)->backend().probe(address);
    };
    return answers_once() && answers_once();
}

} // namespace

ProbeReport run_probe(const ProbeOrder& order, const config::LineConfig& line, const LineUnit& unit,
                      const std::vector<LineUnit>& units, LineLink& link, const std::stop_token& stop)
{
    spdlog::info("{}: searching for the drive on {} with other rates, formats and units", unit.config->name,
                 line.port);
    // The drive of another station is where it should be: what answers there is not the one looked for.
    const auto is_of_another = [&](drive::UnitAddress address) {
        return std::any_of(units.begin(), units.end(), [&](const LineUnit& one) {
            return one.number != unit.number && one.config->unit == address;
        });
    };
    const auto is_ended = [&] {
        return stop.stop_requested() || link.probe_ended.load(std::memory_order_relaxed) == order.number;
    };
    ProbeReport report{.number = order.number, .tried = 0, .answers = {}, .count = 0};
    config::LineConfig trial = line;
    trial.timeout = probe_timeout(line);
    for (const ProbeTry& one : probe_plan(line, unit.config->unit)) {
        trial.baud = one.baud;
        trial.format = one.format;
        for (const drive::UnitAddress address : one.units) {
            if (is_ended()) break;
            if (is_of_another(address)) continue;
            link.probe_tried.store(++report.tried, std::memory_order_relaxed);
            if (answers_twice(trial, address, *link.trace) && report.count < report.answers.size())
                report.answers[report.count++] = {one.baud, one.format, address};
        }
        if (report.count != 0 || is_ended()) break; // what answers at one rate answers at no other
    }
    if (is_ended()) spdlog::info("{}: the search for the drive was ended", unit.config->name);
    return report;
}

} // namespace dpslave::app
