// SPDX-License-Identifier: Apache-2.0
/// The programs of dpsim, after their options were read. Each returns its exit status.
#pragma once

#include "dpsim/master/master.hpp"

#include "dpslave/arguments/exit_status.hpp"
#include "dpslave/arguments/options.hpp"

#include <chrono>

namespace dpslave::sim {

using arguments::kFine, arguments::kNo, arguments::kUsage;

inline constexpr arguments::RateLimits kRatesOfALine{50, 12'000'000};
inline constexpr arguments::TimeLimits kDelaysOfALine{std::chrono::seconds{0}, std::chrono::seconds{10}};

struct LineOptions {
    std::uint32_t baud = 187'500;
    unsigned bits = 11;
    std::string a, b;
    double errors = 0;
    std::chrono::nanoseconds delay{0};
    std::uint64_t seed = 1;
    bool any_rate = false;    ///< the ends may be set to any rate
    std::string log_a, log_b; ///< files for what arrives at each end; empty: none
};
inline constexpr std::string_view kLineCommands =
    "cut | restore | baud RATE | errors P | delay TIME | stats | quit";
int run_line(const LineOptions& options);

struct DriveOptions {
    std::string profile, port;
    std::uint32_t baud = 9600;
    std::vector<std::string> units; ///< empty: "00", of an instrument "1"
    std::string table;              ///< empty: the table that is shipped
    std::string mnemonics;          ///< a rule or a file; empty: those of the table and of the profile
    std::string programs = "1";     ///< of an instrument: how many it stores
    bool parity = false;            ///< of an instrument: 8E1 instead of 8N1
    std::chrono::nanoseconds turnaround = std::chrono::milliseconds{1};
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
    std::string drive_port;       ///< where the gateway's drive line ends; empty: its drive is another one
    std::string line;             ///< which one of the capture; empty: it has one
    std::uint32_t drive_baud = 9600;
    bool fast = false; ///< without the pauses of the capture
    unsigned retries = 3;
    std::chrono::nanoseconds slot = std::chrono::milliseconds{20};
};
int run_replay(const ReplayOptions& options);

} // namespace dpslave::sim
