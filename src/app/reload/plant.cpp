// SPDX-License-Identifier: Apache-2.0
#include "plant.hpp"

#include "app/state/device_news.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"
#include "dpslave/io/tty.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>

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

bool has_ended(const DriveLine& line)
{
    return line.link.ended.load(std::memory_order_acquire);
}

/// One that has given no sign yet has not begun.
std::chrono::nanoseconds silence_of(const DriveLine& line, Instant now)
{
    const Instant last = line.link.sign->last();
    return last == Instant{} ? std::chrono::nanoseconds{} : now - last;
}

/// Soon: this decides only who is waited for, and what is said.
bool is_stalled(const DriveLine& line, Instant now)
{
    return silence_of(line, now) >= io::ThreadSign::kStall;
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

void Plant::request_end(Instant ends_by)
{
    for (auto* const lines : {&lines_, &leaving_lines_})
        for (const auto& line : *lines) line->request_stop(io::monotonic_now(), ends_by);
}

std::vector<const DriveLine*> Plant::end(Instant limit)
{
    std::vector<const DriveLine*> hanging;
    for (auto* const lines : {&lines_, &leaving_lines_})
        for (const auto& line : *lines) {
            if (!line->thread.joinable()) continue;
            while (!has_ended(*line) && io::monotonic_now() < limit)
                std::this_thread::sleep_for(std::chrono::milliseconds{1});
            if (has_ended(*line))
                line->thread.join();
            else
                hanging.push_back(line.get());
        }
    return hanging;
}

Station Plant::new_station(const config::StationConfig& config, const std::shared_ptr<DriveLine>& line)
{
    Station station;
    station.number = ++last_number_;
    station.config = std::make_shared<const config::StationConfig>(config);
    station.link = std::make_shared<StationLink>(line->link.sign);
    const bool waits = config.loss.when == drive::WhenLost::silent; // for the first answer of its drive
    station.link->departures.store(waits ? 1 : 0, std::memory_order_relaxed);
    station.bus_station = std::make_shared<BusStation>(*station.config, station.link);
    station.drive_line = line;
    station.line = &line->config;
    station.device = std::make_shared<EmulatedDevice>(*station.config, self_test_passed_);
    station.news = std::make_shared<DeviceNews>();
    station.address = station.device->address();
    // Before the bus has the station: one that is to be silent never answers.
    station.ordered = station.device->bus_orders();
    station.link->bus_orders.publish(station.ordered);
    station.link->zero_after_ms.store(station.device->zero_after_ms(), std::memory_order_relaxed);
    return station;
}

void Plant::open(const config::Config& config)
{
    for (const config::LineConfig& line : config.lines)
        lines_.push_back(std::make_shared<DriveLine>(line, config.trace));
    for (const config::StationConfig& station : config.stations)
        stations_.push_back(new_station(station, lines_[station.line]));
    for (const auto& line : lines_)
        line->work = std::make_unique<DriveThread>(line->config, false, units_on(*line, stations_),
                                                   line->link, bus_.signs);
}

void Plant::start()
{
    for (const auto& line : lines_) start(*line);
}

void Plant::start(DriveLine& line)
{
    line.thread = std::jthread([this, &line](const std::stop_token& stop) {
        guarded(bus_.failed, "drive", [&] {
            io::unlock_deep_stack(); // it waits for drives anyway, and there may be many lines
            line.work->run(stop, line.wake);
        });
        line.link.ended.store(true, std::memory_order_release);
    });
}

std::unique_ptr<BusStations> Plant::bus_stations() const
{
    auto all = std::make_unique<BusStations>();
    for (const Station& station : stations_) all->push_back(station.bus_station);
    return all;
}

// ---- the exchange

struct Plant::Next {
    DriveLines lines;
    std::vector<Station> stations;
    std::vector<Change> changes;
};

bool Plant::has_port(const std::string& port, const RealPaths& real) const
{
    return std::any_of(lines_.begin(), lines_.end(),
                       [&](const auto& line) { return real.of(line->config.port) == real.of(port); });
}

bool Plant::has_gpio_line(const config::LineConfig& wanted, const RealPaths& real) const
{
    const io::DriverEnableSettings& driver = wanted.driver_enable;
    return driver.direction == io::Direction::gpio &&
           std::any_of(lines_.begin(), lines_.end(), [&](const auto& line) {
               const io::DriverEnableSettings& present = line->config.driver_enable;
               return present.direction == io::Direction::gpio && present.gpio_line == driver.gpio_line &&
                      real.of(present.gpio_chip) == real.of(driver.gpio_chip);
           });
}

/// A present line has its port, or the GPIO line of its transceiver, and closes it first.
bool Plant::is_held(const config::LineConfig& wanted, const RealPaths& real) const
{
    return has_port(wanted.port, real) || has_gpio_line(wanted, real);
}

std::vector<std::string> Plant::missing_ports(const Plan& plan,
                                              const std::vector<std::optional<std::string>>& troubles) const
{
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < plan.lines.size(); ++i) {
        const config::LineConfig& line = plan.config.lines[i];
        const bool is_opened = !plan.lines[i].before || plan.lines[i].is_opened_anew;
        if (troubles[i] && is_opened && !is_held(line, plan.real_paths))
            missing.push_back(
                fmt::format("{}[[line]] \"{}\": {}; its drives count as silent until it can be opened",
                            place(plan.config, line.port_line), line.name, *troubles[i]));
    }
    return missing;
}

void Plant::make_lines(const Plan& plan, Next& next) const
{
    for (std::size_t i = 0; i < plan.lines.size(); ++i) {
        const auto before = plan.lines[i].before;
        next.lines.push_back(before ? lines_[*before]
                                    : std::make_shared<DriveLine>(plan.config.lines[i], plan.config.trace));
    }
}

void Plant::make_stations(const Plan& plan, Next& next)
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
void Plant::plan_port(const Plan& plan, std::size_t index, LineChange& change) const
{
    const Plan::Line& planned = plan.lines[index];
    if (!planned.is_changed) return;
    change.line = plan.config.lines[index];
    change.opens_port = planned.is_opened_anew;
    const RealPaths& real = plan.real_paths;
    change.is_held = is_held(*change.line, real);
    const std::string& old_port = real.of(lines_[*planned.before]->config.port);
    change.is_other_port = real.of(change.line->port) != old_port;
    change.leaves_drives =
        change.is_other_port &&
        std::none_of(plan.config.lines.begin(), plan.config.lines.end(),
                     [&](const config::LineConfig& line) { return real.of(line.port) == old_port; });
}

/// What is new for each line that goes on; lines that are new get their threads.
void Plant::make_changes(const Plan& plan, Next& next) const
{
    for (std::size_t i = 0; i < next.lines.size(); ++i) {
        DriveLine& line = *next.lines[i];
        auto units = units_on(line, next.stations);
        if (!plan.lines[i].before) {
            line.work = std::make_unique<DriveThread>(line.config, is_held(line.config, plan.real_paths),
                                                      units, line.link, bus_.signs);
        } else if (plan.lines[i].is_changed || !are_same(units, units_on(line, stations_))) {
            auto change = std::make_unique<LineChange>();
            change->units = std::move(units);
            plan_port(plan, i, *change);
            next.changes.push_back({next.lines[i], std::move(change)});
        }
    }
}

void Plant::exchange(const Plan& plan)
{
    Next next;
    make_lines(plan, next);
    make_stations(plan, next);
    make_changes(plan, next);
    for (std::size_t i = 0; i < next.lines.size(); ++i)
        if (!plan.lines[i].before) start(*next.lines[i]);

    commit(plan, std::move(next));
}

/// Nothing can fail any more.
void Plant::commit(const Plan& plan, Next next)
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
    for (Change& older : std::exchange(changes_, std::move(next.changes))) { // that could not be offered yet
        const auto newer = std::find_if(changes_.begin(), changes_.end(),
                                        [&](const Change& one) { return one.line == older.line; });
        if (newer != changes_.end())
            newer->change->replaces(std::move(*older.change));
        else
            changes_.push_back(std::move(older));
    }
}

void Plant::finish()
{
    std::erase_if(changes_, [](Change& one) {
        DriveLine& line = *one.line;
        if (const auto older = line.link.change.withdraw()) {
            one.change->replaces(std::move(*older));
            --line.changes_offered;
        }
        if (!line.link.change.offer(one.change)) return false; // the line takes the older one at this moment
        ++line.changes_offered;
        line.wake.ring();
        return true;
    });
    const Instant now = io::monotonic_now();
    for (const auto& line : leaving_lines_)
        if (!line->thread.get_stop_token().stop_requested())
            line->request_stop(now, kNever); // one that stalls has its time behind its return
}

bool Plant::has_taken(const DriveLine& line) const
{
    return line.link.change.taken() && std::none_of(changes_.begin(), changes_.end(), [&](const Change& one) {
               return one.line.get() == &line;
           });
}

bool Plant::is_done(const DriveLine& line) const
{
    return has_taken(line) && line.link.changes_done.load(std::memory_order_acquire) == line.changes_offered;
}

bool Plant::have_taken(Instant now) const
{
    return std::all_of(lines_.begin(), lines_.end(),
                       [&](const auto& line) { return has_taken(*line) || is_stalled(*line, now); });
}

bool Plant::is_settled(Instant now) const
{
    const bool are_done = std::all_of(lines_.begin(), lines_.end(), [&](const auto& line) {
        return is_done(*line) || is_stalled(*line, now);
    });
    return are_done && std::all_of(leaving_lines_.begin(), leaving_lines_.end(), [&](const auto& line) {
               return has_ended(*line) || is_stalled(*line, now);
           });
}

std::vector<std::string> Plant::late(Instant now) const
{
    std::vector<std::string> sentences;
    for (const auto& line : lines_) {
        if (is_done(*line) || (has_taken(*line) && !is_stalled(*line, now))) continue;
        const std::string who = is_stalled(*line, now)
                                    ? stall_words(*line, silence_of(*line, now)) + " and"
                                    : fmt::format("line {} is busy and", line->config.name);
        sentences.push_back(fmt::format("{} has not {} the new configuration yet", who,
                                        has_taken(*line) ? "carried out" : "taken"));
    }
    for (const auto& line : leaving_lines_)
        if (!has_ended(*line) && is_stalled(*line, now))
            sentences.push_back(fmt::format("{} and ends when its call comes back",
                                            stall_words(*line, silence_of(*line, now))));
    return sentences;
}

/// Its line does not have it any more.
bool Plant::has_left(const Station& station) const
{
    const bool stays = std::find(lines_.begin(), lines_.end(), station.drive_line) != lines_.end();
    return stays ? is_done(*station.drive_line) : has_ended(*station.drive_line);
}

bool Plant::one_has_left() const
{
    return std::any_of(leaving_lines_.begin(), leaving_lines_.end(),
                       [](const auto& line) { return has_ended(*line); }) ||
           std::any_of(leaving_stations_.begin(), leaving_stations_.end(),
                       [this](const Station& station) { return has_left(station); });
}

std::vector<Station> Plant::take_leaving()
{
    const auto stays = std::stable_partition(leaving_stations_.begin(), leaving_stations_.end(),
                                             [this](const Station& station) { return has_left(station); });
    std::vector<Station> left(std::make_move_iterator(leaving_stations_.begin()),
                              std::make_move_iterator(stays));
    leaving_stations_.erase(leaving_stations_.begin(), stays);
    std::erase_if(leaving_lines_, [](const auto& line) { return has_ended(*line); });
    return left;
}

} // namespace dpslave::app
