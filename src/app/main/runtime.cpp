// SPDX-License-Identifier: Apache-2.0
#include "runtime.hpp"

#include "app/drive/line_backend.hpp"
#include "device_state.hpp"

#include "dpslave/io/realtime.hpp"
#include "dpslave/io/tty.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace dpslave::app {

namespace {

DriveUnit unit_of(const Station& station)
{
    return {.number = station.number, .config = station.config, .link = station.link};
}

std::vector<DriveUnit> units_on(const DriveLine& line, const std::vector<Station>& stations)
{
    std::vector<DriveUnit> units;
    for (const Station& station : stations)
        if (station.drive_line.get() == &line) units.push_back(unit_of(station));
    return units;
}

bool are_same(const std::vector<DriveUnit>& a, const std::vector<DriveUnit>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const DriveUnit& one, const DriveUnit& other) {
                          return one.number == other.number && one.config == other.config;
                      });
}

std::string not_opened(const config::Config& config, const config::LineConfig& line, const std::string& why)
{
    return fmt::format("{}[[line]] \"{}\": {}", place(config, line.port_line), line.name, why);
}

} // namespace

std::string place(const config::Config& config, unsigned line)
{
    return fmt::format("{}:{}: ", config.file.string(), line);
}

void guarded(std::atomic<bool>& failed, const char* name, const std::function<void()>& work)
{
    try {
        io::name_thread(name);
        work();
    } catch (const std::exception& error) {
        spdlog::critical("the {} thread ended because of an error: {}", name, error.what());
        failed.store(true, std::memory_order_relaxed);
    }
}

void DriveLine::request_stop()
{
    thread.request_stop();
    wake.ring();
}

void Runtime::end()
{
    for (auto* const lines : {&lines_, &leaving_lines_})
        for (const auto& line : *lines) line->request_stop();
    for (auto* const lines : {&lines_, &leaving_lines_})
        for (const auto& line : *lines)
            if (line->thread.joinable()) line->thread.join();
}

Station Runtime::new_station(const config::StationConfig& config, const std::shared_ptr<DriveLine>& line)
{
    Station station;
    station.number = ++last_number_;
    station.config = std::make_shared<const config::StationConfig>(config);
    station.link = std::make_shared<StationLink>();
    station.bus_station = std::make_shared<BusStation>(*station.config, station.link);
    station.drive_line = line;
    station.line = &line->config;
    station.device = std::make_shared<DeviceState>(*station.config, self_test_passed_);
    station.address = station.device->address();
    // Before the bus has the station: one that is to be silent never answers.
    station.ordered = station.device->bus_orders();
    station.link->bus_orders.publish(station.ordered);
    station.link->zero_after_ms.store(station.device->zero_after_ms(), std::memory_order_relaxed);
    return station;
}

std::optional<std::string> Runtime::open(const config::Config& config)
{
    std::vector<std::unique_ptr<LineBackend>> backends;
    for (const config::LineConfig& line : config.lines) {
        lines_.push_back(std::make_shared<DriveLine>(line, config.trace));
        LineLink& link = lines_.back()->link;
        auto backend = LineBackend::open(line, link.port_open, *link.trace);
        if (!backend) return not_opened(config, line, backend.error());
        backends.push_back(std::move(*backend));
    }
    for (const config::StationConfig& station : config.stations)
        stations_.push_back(new_station(station, lines_[station.line]));
    for (std::size_t i = 0; i < lines_.size(); ++i)
        lines_[i]->work = std::make_unique<DriveThread>(lines_[i]->config, std::move(backends[i]),
                                                        units_on(*lines_[i], stations_), lines_[i]->link);
    return std::nullopt;
}

void Runtime::start()
{
    for (const auto& line : lines_) start(*line);
}

void Runtime::start(DriveLine& line)
{
    line.thread = std::jthread([this, &line](const std::stop_token& stop) {
        guarded(failed_, "drive", [&] {
            io::unlock_deep_stack(); // it waits for drives anyway, and there may be many lines
            line.work->run(stop, line.wake);
        });
    });
}

std::unique_ptr<BusStations> Runtime::bus_stations() const
{
    auto all = std::make_unique<BusStations>();
    for (const Station& station : stations_) all->push_back(station.bus_station);
    return all;
}

// ---- the exchange

struct Runtime::Next {
    std::vector<std::shared_ptr<DriveLine>> lines;
    std::vector<std::unique_ptr<LineBackend>> backends; ///< opened as a trial, in the order of `lines`
    std::vector<Station> stations;
    std::vector<Work> works;
};

/// A port that a present line has cannot be opened as a trial: that line closes it first.
bool Runtime::has_port(const std::string& port) const
{
    const std::string wanted = config::canonical(port);
    return std::any_of(lines_.begin(), lines_.end(), [&wanted](const auto& line) {
        return config::canonical(line->config.port) == wanted;
    });
}

bool Runtime::opens_for_a_trial(const Plan& plan, std::size_t line) const
{
    const Plan::Line& planned = plan.lines[line];
    return (!planned.before || planned.is_opened_anew) && !has_port(plan.config.lines[line].port);
}

std::optional<std::string> Runtime::trouble_of(const Plan& plan) const
{
    for (std::size_t i = 0; i < plan.lines.size(); ++i) {
        const config::LineConfig& line = plan.config.lines[i];
        if (!opens_for_a_trial(plan, i)) continue;
        if (const auto trouble = io::port_trouble(line.port)) return not_opened(plan.config, line, *trouble);
    }
    return std::nullopt;
}

std::optional<std::string> Runtime::make_lines(const Plan& plan, Next& next) const
{
    for (std::size_t i = 0; i < plan.lines.size(); ++i) {
        const config::LineConfig& config = plan.config.lines[i];
        const Plan::Line& planned = plan.lines[i];
        next.lines.push_back(planned.before ? lines_[*planned.before]
                                            : std::make_shared<DriveLine>(config, plan.config.trace));
        next.backends.emplace_back();
        if (!opens_for_a_trial(plan, i)) continue;
        LineLink& link = next.lines[i]->link;
        auto backend = LineBackend::open(config, link.port_open, *link.trace);
        if (!backend) return not_opened(plan.config, config, backend.error());
        next.backends[i] = std::move(*backend);
    }
    return std::nullopt;
}

void Runtime::make_stations(const Plan& plan, Next& next)
{
    for (std::size_t i = 0; i < plan.stations.size(); ++i) {
        const config::StationConfig& config = plan.config.stations[i];
        const auto [stays, is_changed] = plan.stations[i];
        if (!stays) {
            next.stations.push_back(new_station(config, next.lines[config.line]));
            continue;
        }
        next.stations.push_back(stations_[*stays]);
        if (is_changed) next.stations.back().config = std::make_shared<const config::StationConfig>(config);
    }
}

/// What a line that goes on has to do with its port. Two names may be those of one port.
void Runtime::plan_port(const Plan& plan, std::size_t index, LineWork& work) const
{
    const Plan::Line& planned = plan.lines[index];
    if (!planned.is_changed) return;
    work.line = plan.config.lines[index];
    work.opens_port = planned.is_opened_anew;
    const std::string old_port = config::canonical(lines_[*planned.before]->config.port);
    work.is_other_port = config::canonical(work.line->port) != old_port;
    work.leaves_drives =
        work.is_other_port && std::none_of(plan.config.lines.begin(), plan.config.lines.end(),
                                           [&old_port](const config::LineConfig& line) {
                                               return config::canonical(line.port) == old_port;
                                           });
}

/// What is new for each line that goes on; lines that are new get their threads.
void Runtime::make_works(const Plan& plan, Next& next) const
{
    for (std::size_t i = 0; i < next.lines.size(); ++i) {
        DriveLine& line = *next.lines[i];
        auto units = units_on(line, next.stations);
        if (!plan.lines[i].before) {
            line.work =
                std::make_unique<DriveThread>(line.config, std::move(next.backends[i]), units, line.link);
        } else if (plan.lines[i].is_changed || !are_same(units, units_on(line, stations_))) {
            auto work = std::make_unique<LineWork>();
            work->units = std::move(units);
            plan_port(plan, i, *work);
            work->backend = std::move(next.backends[i]);
            next.works.push_back({next.lines[i], std::move(work)});
        }
    }
}

std::optional<std::string> Runtime::exchange(const Plan& plan)
{
    Next next;
    if (auto trouble = make_lines(plan, next)) return trouble;
    make_stations(plan, next);
    make_works(plan, next);
    for (std::size_t i = 0; i < next.lines.size(); ++i)
        if (!plan.lines[i].before) start(*next.lines[i]);

    commit(plan, std::move(next));
    return std::nullopt;
}

/// Nothing can fail any more.
void Runtime::commit(const Plan& plan, Next next)
{
    for (const auto& line : lines_)
        if (std::find(next.lines.begin(), next.lines.end(), line) == next.lines.end())
            leaving_lines_.push_back(line);
    for (std::size_t i = 0; i < next.lines.size(); ++i) next.lines[i]->config = plan.config.lines[i];
    std::vector<bool> stays(stations_.size());
    for (std::size_t i = 0; i < next.stations.size(); ++i) {
        const auto before = plan.stations[i].stays;
        if (!before) continue;
        stays[*before] = true;
        if (plan.stations[i].is_changed) next.stations[i].device->adopt(*next.stations[i].config);
    }
    for (std::size_t i = 0; i < stations_.size(); ++i)
        if (!stays[i]) leaving_stations_.push_back(std::move(stations_[i]));
    lines_ = std::move(next.lines);
    stations_ = std::move(next.stations);
    works_ = std::move(next.works);
}

void Runtime::finish()
{
    for (Work& work : works_) {
        ++work.line->works_offered;
        work.line->link.work.offer(work.work);
        work.line->wake.ring();
    }
    works_.clear();
    for (const auto& line : leaving_lines_) line->request_stop();
}

bool Runtime::is_settled()
{
    std::erase_if(leaving_lines_,
                  [](const auto& line) { return line->link.ended.load(std::memory_order_acquire); });
    const bool done = std::all_of(lines_.begin(), lines_.end(), [](const auto& line) {
        return line->link.work_done.load(std::memory_order_acquire) == line->works_offered;
    });
    return done && leaving_lines_.empty() && works_.empty();
}

} // namespace dpslave::app
