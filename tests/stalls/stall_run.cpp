// SPDX-License-Identifier: Apache-2.0
#include "stall_run.hpp"

#include "drive_line/random_runs.hpp"
#include "simulated_port.hpp"
#include "world.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <deque>

namespace dpslave::stalls {
namespace {

using drive_line::Conditions;
using drive_line::TagUse;

constexpr std::size_t kTraceLines = 250;
constexpr double kShortest = 1e6, kLongest = 60e9; ///< of a stall, ns

/// 1 ms to 60 s, as many of each order of magnitude.
Time stall_length(Chance& chance)
{
    const double part = static_cast<double>(chance.below(1'000'000)) / 1e6;
    return Time{static_cast<std::int64_t>(kShortest * std::pow(kLongest / kShortest, part))};
}

Conditions conditions_of(Chance& chance)
{
    Conditions conditions = drive_line::conditions(chance);
    conditions.make_calm();
    conditions.line.port_holds = 0ns;
    if (chance.one_in(6)) { // slow and well
        conditions.baud = 300;
        conditions.line.character = Time{10'000'000'000 / conditions.baud};
        conditions.line.timeout = 10s;
        conditions.line.turnaround = chance.between(10ms, 500ms);
        conditions.drives = 1 + chance.below(2);
    } else if (chance.one_in(4)) {
        conditions.faults.late = conditions.faults.a_little_late = 600;
    }
    return conditions;
}

/// Three outputs and some inputs of a drive with tags of each kind.
std::vector<LayoutEntry> layout_of(const drive_line::SimulatedDrive& drive, Chance& chance, std::size_t most)
{
    std::vector<LayoutEntry> layout;
    std::size_t inputs = 0, outputs = 0;
    for (const SimulatedTag& tag : drive.tags) {
        const bool is_input = tag.use == TagUse::input;
        if (!is_input && tag.use != TagUse::output) continue;
        std::size_t& count = is_input ? inputs : outputs;
        if (count >= most || (count != 0 && chance.one_in(4))) continue;
        ++count;
        layout.push_back({tag.number, is_input, !is_input});
    }
    return layout;
}

Setting setting_of(const Conditions& conditions, const SimulatedLine& line, bool is_modbus, Chance& chance)
{
    Setting setting;
    const bool is_slow = conditions.baud < 1'000;
    setting.line.name = "p3";
    setting.line.protocol = is_modbus ? config::kModbusRtu : config::kEiAscii;
    setting.line.baud = conditions.baud;
    setting.line.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(conditions.line.timeout);
    setting.line.retries = setting.retries;
    setting.tables = drive_line::tables_of(line);
    setting.answers_late = conditions.faults.late != 0;
    setting.bus_tick = chance.between(10ms, 95ms);
    setting.main_tick = chance.between(10ms, 95ms);
    for (const auto& drive : line.drives) {
        const Time times[] = {500ms, 1s, 2s, 2s, 5s, 30s};
        StationRules rules;
        rules.when = chance.one_in(2)   ? drive::WhenLost::silent
                     : chance.one_in(2) ? drive::WhenLost::diagnosis
                                        : drive::WhenLost::hold;
        rules.after = times[chance.below(6)];
        rules.zero_after = chance.one_in(4)   ? drive::ZeroAfter{}
                           : chance.one_in(3) ? drive::ZeroAfter{700ms}
                                              : drive::ZeroAfter{0ns};
        setting.stations.push_back(rules);
        setting.layouts.push_back(layout_of(drive, chance, is_slow ? 2 : 4));
    }
    return setting;
}

std::string text_of(const Setting& setting)
{
    std::string text =
        fmt::format("the bus turns every {} ms, the main thread every {} ms",
                    setting.bus_tick.count() / 1'000'000, setting.main_tick.count() / 1'000'000);
    for (const StationRules& one : setting.stations)
        text += fmt::format("; {} after {} ms, zero after {} ms",
                            one.when == drive::WhenLost::silent      ? "silent"
                            : one.when == drive::WhenLost::diagnosis ? "diagnosis"
                                                                     : "hold",
                            one.after.count() / 1'000'000, app::to_ms(one.zero_after));
    return text;
}

/// The script of the histories of one line.
class Script {
public:
    Script(World& world, Chance& chance, const HistoryOptions& options)
        : world_(world), chance_(chance), options_(options), returns_at_(world.line().drives.size(), kNever)
    {
        next_history_ = world_.now() + 15s;
        world_.acts_at = world_.now();
    }

    void act();
    std::uint64_t histories = 0, stalls = 0;

private:
    void begin_history();
    void begin_to_settle(Instant now);
    void settle();
    void leave();
    void disturb();
    void operate();
    LineStall line_stall(Instant due);

    World& world_;
    Chance& chance_;
    const HistoryOptions& options_;
    std::vector<Instant> returns_at_; ///< of drives that are off
    Instant next_history_;
    std::optional<Instant> settles_until_, leaves_by_;
};

void Script::act()
{
    const Instant now = world_.now();
    world_.acts_at = now + chance_.between(20ms, 600ms);
    for (std::size_t i = 0; i < returns_at_.size(); ++i) {
        if (returns_at_[i] > now) continue;
        returns_at_[i] = kNever;
        world_.line().returns(i, false);
    }
    if (leaves_by_) return leave();
    if (settles_until_) return settle();
    if (world_.any_stall()) {
        next_history_ = now + chance_.between(100ms, 8s);
    } else if (now >= next_history_) {
        if (histories >= static_cast<std::uint64_t>(options_.histories) || world_.line().words().used_up())
            begin_to_settle(now);
        else
            begin_history();
    }
    operate();
}

void Script::begin_to_settle(Instant now)
{
    world_.line().faults = {};
    settles_until_ = now + 600s;
}

/// Each thread alone, and together.
void Script::begin_history()
{
    ++histories;
    const Instant now = world_.now();
    const auto due = [&] { return now + chance_.between(0ns, 1500ms); };
    const auto said = [&](const char* who, Instant at, Time length) {
        ++stalls;
        if (world_.line().traces())
            world_.line().trace(fmt::format("{:.1f} ms: the {} will stall for {:.3f} s",
                                            double(at.time_since_epoch().count()) / 1e6, who,
                                            std::chrono::duration<double>(length).count()));
    };
    if (chance_.one_in(12)) { // the machine sleeps
        const ThreadStall all{due(), stall_length(chance_)};
        world_.bus_stalls(all);
        world_.main_stalls(all);
        world_.line_stalls({.due = all.due, .length = all.length, .where = Where::rest});
        return said("machine", all.due, all.length);
    }
    const std::size_t which = chance_.below(10);
    const bool bus = which == 6 || which == 8, main = which == 7 || which == 9;
    if (which < 6 || which > 7) {
        const LineStall stall = line_stall(due());
        world_.line_stalls(stall);
        said(fmt::format("line ({}, {})", int(stall.where), int(stall.leave)).c_str(), stall.due,
             stall.length);
    }
    if (bus) {
        const ThreadStall stall{due(), stall_length(chance_)};
        world_.bus_stalls(stall);
        said("bus thread", stall.due, stall.length);
    }
    if (main) {
        const ThreadStall stall{due(), stall_length(chance_)};
        world_.main_stalls(stall);
        said("main thread", stall.due, stall.length);
    }
}

LineStall Script::line_stall(Instant due)
{
    const Where where[] = {Where::rest, Where::read, Where::write, Where::write_value, Where::drain};
    const Leave leave[] = {Leave::at_once, Leave::meanwhile, Leave::never, Leave::partly};
    LineStall stall{.due = due,
                    .length = stall_length(chance_),
                    .where = where[chance_.below(5)],
                    .leave = leave[chance_.below(4)]};
    if (chance_.one_in(5)) stall.opens = stall_length(chance_);
    return stall;
}

/// What masters and the operator want, and drives that lose their power.
void Script::operate()
{
    const std::size_t drive = chance_.below(returns_at_.size());
    Plc& plc = world_.plc(drive);
    const auto number = [&](TagUse use) {
        for (const SimulatedTag& tag : world_.line().drives[drive].tags)
            if (tag.use == use) return tag.number;
        return std::uint16_t{0};
    };
    const auto word = [&]() -> std::optional<std::uint16_t> {
        if (chance_.one_in(3)) return std::nullopt;
        return world_.line().words().take();
    };
    switch (chance_.below(12)) {
        case 0:
        case 1:
        case 2: return world_.demand(drive, number(TagUse::demand), word());
        case 3:
        case 4: return world_.order(drive, number(TagUse::operated), word());
        case 5: return disturb();
        default: break;
    }
    for (std::size_t i = 0; i < plc.parameters().size(); ++i)
        if (plc.parameters()[i].writes && !chance_.one_in(3)) plc.want(i, world_.line().words().take());
}

void Script::disturb()
{
    const std::size_t drive = chance_.below(returns_at_.size());
    if (!chance_.one_in(6) || !world_.line().drives[drive].alive) return;
    world_.line().dies(drive);
    returns_at_[drive] = world_.now() + chance_.between(50ms, 8s);
}

/// All go round, and what the PLCs want has to reach the drives.
void Script::settle()
{
    std::string wrong;
    for (std::size_t i = 0; i < returns_at_.size() && wrong.empty(); ++i) {
        if (!world_.line().drives[i].alive || !world_.plc(i).exchanges())
            wrong = fmt::format("the PLC of drive {} does not exchange", i);
        else
            wrong = world_.judge().not_settled(i);
    }
    if (wrong.empty()) return leave();
    if (world_.now() > *settles_until_) world_.judge().report_violation(world_.now(), "in the end " + wrong);
}

/// The line is removed, mostly while a call of its port stalls.
void Script::leave()
{
    if (!leaves_by_) {
        leaves_by_ = world_.now() + 3s;
        world_.line_stalls(line_stall(world_.now()));
        return;
    }
    if (world_.judge().line_thread.is_stalled() || world_.now() > *leaves_by_) {
        world_.leave();
        world_.acts_at = kNever;
    }
}

template <class Line, class Port, class Make>
HistoryResult run(std::uint64_t seed, const HistoryOptions& options, const Make& make)
{
    spdlog::set_level(spdlog::level::off);
    Chance chance{seed};
    const Conditions conditions = conditions_of(chance);
    Line line{conditions.line, chance};
    line.faults = conditions.faults;
    std::deque<std::string> lines;
    if (options.traces) {
        lines.push_back(conditions.text());
        line.on_trace = [&lines](const std::string& text) {
            lines.push_back(text);
            if (lines.size() > kTraceLines) lines.erase(lines.begin() + 2);
        };
    }
    drive_line::add_drives(line, conditions, options.is_modbus);
    const auto open = [&](World& world) -> std::unique_ptr<drive::Backend> {
        auto port = std::make_unique<Port>(world, line);
        auto client = make(*port, line, conditions);
        return std::make_unique<OnPort<Port>>(world, std::move(port), std::move(client));
    };
    const Setting setting = setting_of(conditions, line, options.is_modbus, chance);
    if (options.traces) lines.push_back(text_of(setting));
    World world{line, setting, open};
    Script script{world, chance, options};
    world.run([&] { script.act(); });
    return {.violation = world.judge().violation().value_or(""),
            .histories = script.histories,
            .stalls = script.stalls,
            .departures = world.judge().departures(),
            .trace = {lines.begin(), lines.end()}};
}

} // namespace

HistoryResult run_histories(std::uint64_t seed, const HistoryOptions& options)
{
    if (options.is_modbus)
        return run<drive_line::ModbusFrames, FramesPort>(
            seed, options, [](modbus::ModbusPort& port, const auto& line, const Conditions& conditions) {
                return drive_line::modbus_client_on(port, line, conditions);
            });
    return run<drive_line::EiLine, EiPort>(
        seed, options, [](drive::SerialLine& port, const auto& line, const Conditions& conditions) {
            return drive_line::ei_client_on(port, line, conditions);
        });
}

std::string story(const HistoryResult& result)
{
    std::string text = result.violation + "\n";
    for (const std::string& line : result.trace) text += line + "\n";
    return text;
}

} // namespace dpslave::stalls
