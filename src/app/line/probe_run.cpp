// SPDX-License-Identifier: Apache-2.0
#include "probe_run.hpp"

#include "line_backend.hpp"
#include "line_probe.hpp"

#include "dpslave/io/clock.hpp"

#include <spdlog/spdlog.h>

#include <atomic>

namespace dpslave::app {

namespace {

/// Each question has a back-end of its own, which is owed nothing: what answers late could be taken for the
/// answer of the next unit.
drive::Sight ask(const config::LineConfig& line, const drive::SearchQuestion& question, LineLink& link)
{
    config::LineConfig trial = line;
    trial.timeout = probe_timeout(line);
    trial.baud = question.setting.baud;
    trial.format = question.setting.format;
    std::atomic<bool> is_open{false}; // a trial is no event of the port
    const auto unheard = std::make_unique<LineHappenings>();
    const auto backend = LineBackend::open(trial, {.is_open = is_open,
                                                   .transceiver = link.transceiver,
                                                   .frames = *link.trace,
                                                   .happenings = *unheard,
                                                   .settings_changed = link.settings_changed,
                                                   .changed_settings = link.changed_settings,
                                                   .ends_by = link.ends_by});
    return backend ? (*backend)->backend().look(question.unit, question.look) : drive::Sight{};
}

} // namespace

ProbeReport run_probe(const ProbeOrder& order, const config::LineConfig& line, const LineUnit& unit,
                      const std::vector<LineUnit>& units, LineLink& link,
                      const std::function<bool()>& has_to_end)
{
    spdlog::info("{}: searching for the drive on {} with other rates, formats and units", unit.config->name,
                 line.port);
    std::vector<drive::UnitAddress> others;
    for (const LineUnit& one : units)
        if (one.number != unit.number) others.push_back(one.config->unit);
    drive::LineSearch search = probe_search(line, *unit.config, others);
    const Instant ends = io::monotonic_now() + search.longest();
    bool is_ended = false;
    while (const auto question = search.next()) {
        is_ended = has_to_end();
        if (is_ended || io::monotonic_now() >= ends) break;
        link.probe_tried.store(search.asked() + 1, std::memory_order_relaxed);
        drive::Sight sight = ask(line, *question, link);
        if (link.sign->stall()) { // the silence of a call that stalled is none of the drive
            link.sign->clear_stall();
            sight = ask(line, *question, link);
        }
        search.take(sight);
    }
    if (is_ended)
        spdlog::info("{}: the search for the drive was ended", unit.config->name);
    else if (search.next())
        spdlog::info("{}: the search for the drive took longer than was said, and was ended",
                     unit.config->name);
    ProbeReport report{.number = order.number, .tried = search.asked(), .answers = {}, .count = 0};
    put_found(search, report);
    return report;
}

} // namespace dpslave::app
