// SPDX-License-Identifier: Apache-2.0
#include "random_runs.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <deque>

namespace dpslave::drive_line {
namespace {

constexpr std::size_t kTraceLines = 150;
constexpr Time kSettles = 300s; ///< probes every 8 s, words that are not kept every minute

unsigned part(Chance& chance, unsigned most)
{
    return chance.one_in(2) ? 0 : static_cast<unsigned>(chance.below(most));
}

drive::TagTable table_of(const SimulatedDrive& drive, bool says_once)
{
    std::vector<drive::Tag> rows;
    for (const SimulatedTag& tag : drive.tags) {
        drive::Tag row;
        row.number = tag.number;
        row.name = fmt::format("tag {}", tag.number);
        row.type = tag.is_word ? drive::TagType::word : drive::TagType::number;
        row.is_real = tag.is_ieee;
        row.decimals = static_cast<std::uint8_t>(tag.decimals);
        row.mnemonic = tag.mnemonic;
        row.once = tag.counts && says_once;
        if (tag.is_ieee) row.modbus_register = static_cast<std::uint16_t>(0x8000 + 2 * tag.number);
        rows.push_back(row);
    }
    return drive::TagTable{rows};
}

template <class Line, class Make>
RunResult run(std::uint64_t seed, const Make& make, bool is_modbus, RunOptions options)
{
    Chance chance{seed};
    Conditions conditions = drive_line::conditions(chance);
    if (options.calm) conditions.make_calm();
    if (options.late) conditions.make_late();
    if (options.repeating) {
        conditions.make_calm();
        conditions.make_repeating();
        conditions.line.wire_time = options.wire_time;
    }
    Line line{conditions.line, chance};
    line.faults = conditions.faults;
    line.time = options.begins;
    std::deque<std::string> lines;
    if (options.traces) {
        lines.push_back(conditions.text());
        line.on_trace = [&lines](const std::string& text) {
            lines.push_back(text);
            if (lines.size() > kTraceLines) lines.erase(lines.begin() + 1);
        };
    }
    add_drives(line, conditions, is_modbus);
    if (options.counts) add_counting_tags(line);
    const std::vector<drive::TagTable> tables = tables_of(line, options.says_once);
    const auto backend = make(line, conditions);
    RunRules rules;
    rules.compare_outputs = is_modbus;
    rules.output_refresh = chance.one_in(3) ? Time{300ms} : Time{1s};
    for (std::size_t i = 0; i < conditions.drives; ++i)
        rules.zero_after.push_back(chance.one_in(4)   ? drive::ZeroAfter{}
                                   : chance.one_in(3) ? drive::ZeroAfter{700ms}
                                                      : drive::ZeroAfter{0ns});
    if (conditions.tags_are_shared && chance.one_in(2)) rules.watched = {line.drives[0].tags[0].number};
    if (options.silent) {
        const Time times[] = {500ms, 1s, 2s};
        line.faults.noise_of_the_dead = chance.one_in(2) ? 0 : chance.one_in(2) ? 10'000 : 2'000;
        rules.loss = {.when = drive::WhenLost::silent, .after = times[chance.below(3)]};
    }
    LineRun run{line, *backend, tables, rules};
    run.live(options.transactions);
    run.settle(kSettles);
    return {.violation = run.violation().value_or(""),
            .transactions = run.transactions(),
            .silences = run.silences(),
            .departures = run.loss_judge().departures(),
            .trace = {lines.begin(), lines.end()}};
}

} // namespace

void Conditions::make_calm()
{
    faults = {};
    line.echo = false;
    line.wire_time = true;
    echo = EchoMode::off;
    line.port_holds = 0ns;
}

void Conditions::make_late()
{
    drives = 3;
    tags_are_shared = true;
    line.timeout = 100ms;
    faults = {};
    faults.late = faults.a_little_late = 1'500;
    faults.never = faults.answer_lost = 300;
    faults.question_lost = 800;
    faults.duplicate = 3'000;
}

void Conditions::make_repeating()
{
    drives = 2;
    tags_are_shared = true;
    baud = 19'200;
    line.character = Time{10'000'000'000 / baud};
    line.turnaround = 4ms;
    faults.isolated = 3'000;
    faults.isolated_to = 10ms;
}

std::string Conditions::text() const
{
    return fmt::format(
        "{} drives, tags {}, {} bit/s, timeout {} ms, the port holds octets {} ms, echo {} ({}); parts of "
        "10000: late {} and {}, never {}, questions lost {} and spoilt {}, answers lost {} and spoilt {}, "
        "twice {}, noise {}, twice apart {}",
        drives, tags_are_shared ? "shared" : "of their own", baud, line.timeout.count() / 1'000'000,
        line.port_holds.count() / 1'000'000, line.echo ? "heard" : "not heard", static_cast<int>(echo),
        faults.late, faults.a_little_late, faults.never, faults.question_lost, faults.question_spoilt,
        faults.answer_lost, faults.answer_spoilt, faults.duplicate, faults.noise, faults.isolated);
}

Conditions conditions(Chance& chance)
{
    Conditions one;
    const std::uint32_t bauds[] = {9'600, 19'200, 38'400};
    const Time timeouts[] = {100ms, 200ms, 600ms};
    one.baud = bauds[chance.below(3)];
    one.line.timeout = timeouts[chance.below(3)];
    one.line.turnaround = chance.between(1ms, 20ms);
    one.line.character = Time{10'000'000'000 / one.baud};
    one.line.port_holds = chance.one_in(4) ? (chance.one_in(2) ? Time{16ms} : Time{1ms}) : Time{0};
    one.line.echo = chance.one_in(4);
    one.echo = chance.one_in(3) ? EchoMode::automatic : one.line.echo ? EchoMode::on : EchoMode::off;
    one.drives = 1 + chance.below(4);
    one.tags_are_shared = !chance.one_in(4);
    const unsigned most = chance.one_in(3) ? 2'500 : chance.one_in(2) ? 600 : 150;
    one.faults.late = part(chance, most);
    one.faults.a_little_late = part(chance, most);
    one.faults.never = part(chance, most);
    one.faults.question_lost = part(chance, most);
    one.faults.question_spoilt = part(chance, most);
    one.faults.answer_lost = part(chance, most);
    one.faults.answer_spoilt = part(chance, most);
    one.faults.duplicate = part(chance, most);
    one.faults.noise = part(chance, most);
    Chance kinds = chance; // the same seeds have the same other faults as before
    one.faults.isolated = one.line.port_holds <= 1ms ? part(kinds, most) : 0;
    one.line.wire_time = one.faults.isolated != 0 || !kinds.one_in(4);
    return one;
}

void add_drives(SimulatedLine& line, const Conditions& conditions, bool is_modbus)
{
    Chance& chance = line.chance();
    for (std::size_t i = 0; i < conditions.drives; ++i) {
        SimulatedDrive drive;
        drive.unit = static_cast<std::uint8_t>(i + 1);
        drive.knows_identity = chance.one_in(2);
        drive.remembers_spoilt = chance.one_in(2);
        drive.has_loopback = chance.one_in(2);
        drive.change_every = chance.between(50ms, 1s);
        const unsigned first = conditions.tags_are_shared ? 100 : 100 + 40 * static_cast<unsigned>(i);
        const auto add = [&](unsigned number, TagUse use, bool is_ieee) {
            SimulatedTag tag;
            tag.number = static_cast<std::uint16_t>(number);
            tag.use = use;
            tag.mnemonic = {static_cast<char>('a' + number / 26 % 26), static_cast<char>('A' + number % 26)};
            tag.is_word = number % 3 == 0 && !is_ieee;
            tag.decimals = tag.is_word ? 0 : number % 3;
            tag.is_ieee = is_ieee;
            tag.read_only = use == TagUse::input;
            tag.history.push_back({line.time, line.words().take(), false});
            if (use == TagUse::input) tag.changes_at = line.time + chance.between(0ns, drive.change_every);
            drive.tags.push_back(tag);
        };
        for (unsigned k = 0; k < 4; ++k) add(first + k, TagUse::input, false);
        add(first + 6, TagUse::input, false); // beyond a gap
        add(first + 7, TagUse::input, is_modbus);
        for (unsigned k = 0; k < 3; ++k) add(first + 10 + k, TagUse::output, false);
        add(first + 14, TagUse::output, is_modbus);
        add(first + 20, TagUse::demand, false);
        add(first + 21, TagUse::operated, false);
        line.drives.push_back(std::move(drive));
    }
}

void add_counting_tags(SimulatedLine& line)
{
    for (SimulatedDrive& drive : line.drives) {
        SimulatedTag tag;
        tag.number = static_cast<std::uint16_t>(drive.tags.front().number + 13);
        tag.use = TagUse::output;
        tag.mnemonic = {'#', static_cast<char>('A' + tag.number % 26)};
        tag.is_word = true;
        tag.counts = true;
        tag.history.push_back({line.time, line.words().take(), false});
        drive.tags.push_back(tag);
    }
}

std::vector<drive::TagTable> tables_of(const SimulatedLine& line, bool says_once)
{
    std::vector<drive::TagTable> tables;
    for (const SimulatedDrive& drive : line.drives) tables.push_back(table_of(drive, says_once));
    return tables;
}

std::string story(const RunResult& result)
{
    std::string text = result.violation + "\n";
    for (const std::string& line : result.trace) text += line + "\n";
    return text;
}

std::unique_ptr<drive::Backend> ei_client(EiLine& line, const Conditions& conditions)
{
    return ei_client_on(line, line, conditions);
}

std::unique_ptr<drive::Backend> ei_client_on(drive::SerialLine& port, const EiLine& line,
                                             const Conditions& conditions)
{
    std::vector<drive::EiDrive> units;
    for (const SimulatedDrive& drive : line.drives)
        units.push_back({{0, drive.unit}, drive::MnemonicRule::none});
    drive::EiTiming timing;
    timing.baud = conditions.baud;
    timing.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(conditions.line.timeout);
    timing.rules.hold_back = conditions.line.port_holds;
    timing.rules.echo = conditions.echo;
    return std::make_unique<drive::EiAsciiClient>(port, timing, units);
}

std::unique_ptr<drive::Backend> modbus_client(ModbusFrames& line, const Conditions& conditions)
{
    return modbus_client_on(line, line, conditions);
}

std::unique_ptr<drive::Backend> modbus_client_on(modbus::ModbusPort& port, const ModbusFrames& line,
                                                 const Conditions& conditions)
{
    modbus::ClientSettings settings;
    settings.baud = conditions.baud;
    settings.bits_of_a_character = conditions.bits_of_a_character;
    settings.timeout = std::chrono::duration_cast<std::chrono::milliseconds>(conditions.line.timeout);
    settings.rules.hold_back = conditions.line.port_holds;
    settings.rules.echo = conditions.echo;
    for (const SimulatedDrive& drive : line.drives)
        settings.units.push_back(
            {.unit = drive.unit, .reads_by_4 = true, .has_loopback = drive.has_loopback});
    return std::make_unique<modbus::ModbusClient>(port, settings);
}

RunResult run_ei(std::uint64_t seed, const MakeEiBackend& backend, RunOptions options)
{
    return run<EiLine>(seed, backend, false, options);
}

RunResult run_modbus(std::uint64_t seed, const MakeModbusBackend& backend, RunOptions options)
{
    return run<ModbusFrames>(seed, backend, true, options);
}

} // namespace dpslave::drive_line
