// SPDX-License-Identifier: Apache-2.0
/// The programs of dpsim, after their options were read. Each returns its exit status.
#pragma once

#include "dpsim/master/master.hpp"

namespace dpslave::sim {

/// Exit status: 0 success, 1 an expectation failed or the slave cannot be reached, 2 wrong usage, 3 a port
/// cannot be opened.
inline constexpr int kFine = 0, kFailed = 1, kUsage = 2, kNoPort = 3;

struct LineOptions {
    std::uint32_t baud = 187'500;
    unsigned bits = 11;
    std::string a, b;
    double errors = 0;
    std::uint32_t delay_us = 0;
    std::uint64_t seed = 1;
    bool any_rate = false;    ///< the ends may be set to any rate
    std::string log_a, log_b; ///< files for what arrives at each end; empty: none
};
inline constexpr std::string_view kLineCommands =
    "cut | restore | baud N | errors P | delay US | stats | quit";
int run_line(const LineOptions& options);

struct DriveOptions {
    std::string profile, port;
    std::uint32_t baud = 9600;
    std::vector<std::string> units; ///< empty: "00", of an instrument "1"
    std::string table;              ///< empty: the table that is shipped
    unsigned programs = 1;          ///< of an instrument
    bool parity = false;            ///< of an instrument: 8E1 instead of 8N1
    double turnaround_ms = 1;
    std::vector<std::string> faults;
    bool log = false;
};
int run_drive(const DriveOptions& options);

struct MasterOptions {
    MasterSettings settings;
    std::string port;
    std::string script; ///< empty: commands are typed; "-": a script from standard input
};
int run_master(const MasterOptions& options);

struct ReplayOptions {
    std::string file, port;
    std::uint32_t baud = 187'500; ///< of PROFIBUS
    std::string drive;            ///< where the gateway's drive line ends; empty: its drive is another one
    std::string line;             ///< which one of the capture; empty: it has one
    std::uint32_t drive_baud = 9600;
    bool fast = false; ///< without the pauses of the capture
    unsigned retries = 3;
    unsigned slot_ms = 20;
};
int run_replay(const ReplayOptions& options);

} // namespace dpslave::sim
