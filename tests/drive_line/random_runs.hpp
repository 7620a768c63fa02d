// SPDX-License-Identifier: Apache-2.0
/// Lines, drives and faults drawn from a seed, and what became of a run on them.
#pragma once

#include "ei_line.hpp"
#include "line_run.hpp"
#include "modbus_frames.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/modbus/modbus_client.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dpslave::drive_line {

/// What a seed makes of a line; the rest comes from its Chance while it runs.
struct Conditions {
    LineTiming line;
    Faults faults;
    EchoMode echo = EchoMode::off; ///< as configured
    std::uint32_t baud = 9600;
    int bits_of_a_character = 10; ///< as configured
    std::size_t drives = 1;
    bool tags_are_shared = true;
    void make_calm(); ///< no faults but those of the drives themselves
    /// Three drives that share tags, often late, with duplicates and losses: where owed answers decide most.
    void make_late();
    /// Two drives that share tags, at 19200 bit/s, with duplicates 1 to 10 ms behind an answer.
    void make_repeating();
    std::string text() const;
};
Conditions conditions(Chance& chance);

/// Drives with inputs, outputs and tags for orders.
void add_drives(SimulatedLine& line, const Conditions& conditions, bool is_modbus);
/// One more output to each, of which each write counts.
void add_counting_tags(SimulatedLine& line);
/// The tables that describe them.
std::vector<drive::TagTable> tables_of(const SimulatedLine& line, bool says_once = true);

struct RunResult {
    std::string violation; ///< empty: everything was true
    std::uint64_t transactions = 0;
    std::uint64_t silences = 0, departures = 0; ///< of drives and of their stations
    std::vector<std::string> trace;             ///< the last lines, if they were wanted
};

std::string story(const RunResult& result);
using MakeEiBackend = std::function<std::unique_ptr<drive::Backend>(EiLine&, const Conditions&)>;
using MakeModbusBackend = std::function<std::unique_ptr<drive::Backend>(ModbusFrames&, const Conditions&)>;

/// The clients of the program.
std::unique_ptr<drive::Backend> ei_client(EiLine& line, const Conditions& conditions);
/// The same where something lies between it and the drives of `line`.
std::unique_ptr<drive::Backend> ei_client_on(drive::SerialLine& port, const EiLine& line,
                                             const Conditions& conditions);
std::unique_ptr<drive::Backend> modbus_client(ModbusFrames& line, const Conditions& conditions);
std::unique_ptr<drive::Backend> modbus_client_on(modbus::ModbusPort& port, const ModbusFrames& line,
                                                 const Conditions& conditions);

struct RunOptions {
    std::uint64_t transactions = 2'000;
    bool calm = false;
    bool late = false;
    bool repeating = false;
    bool wire_time = true; ///< false, with `repeating`: the client is told that nothing takes time
    bool traces = false;
    bool counts = false;   ///< one more output, of which each write counts
    bool says_once = true; ///< false, with `counts`: the tables do not say so
    bool silent = false;   ///< when_drive_lost, with drives that often fall silent
    Instant begins{std::chrono::hours{1}};
};

/// One line under faults for so many transactions, then without until all is right again.
RunResult run_ei(std::uint64_t seed, const MakeEiBackend& backend, RunOptions options = {});
RunResult run_modbus(std::uint64_t seed, const MakeModbusBackend& backend, RunOptions options = {});

} // namespace dpslave::drive_line
