// SPDX-License-Identifier: Apache-2.0
/// A station leaves if, and only if, its drive is gone, with the clients of both protocols on a line
/// with noise, late answers, refusals, surveys, reloads, Demand Data and an operator. A history is a drive
/// that falls silent, or answers so rarely that it nearly counts as gone. tools/run drive-line makes a
/// million for each protocol; one run with its trace: DRIVE_LINE_ONLY=SEED.
#include "random_runs.hpp"
#include "support/count_of.hpp"

#include <gtest/gtest.h>

#include <iostream>

namespace dpslave::drive_line {
namespace {

constexpr std::uint64_t kHistories = 5000;

template <class Run, class Make>
void leaves_if_and_only_if_gone(const Run& run, const Make& make)
{
    const std::uint64_t only = test::count_of("DRIVE_LINE_ONLY", 0);
    const std::uint64_t wanted = only != 0 ? 1 : test::count_of("DRIVE_LINE_HISTORIES", kHistories);
    RunOptions options;
    options.silent = true;
    std::uint64_t histories = 0, departures = 0;
    int findings = 0;
    for (std::uint64_t seed = only != 0 ? only : test::count_of("DRIVE_LINE_SEED", 1);
         histories < wanted && findings < 3; ++seed) {
        const RunResult result = run(seed, make, options);
        histories += std::max<std::uint64_t>(result.silences, 1);
        departures += result.departures;
        if (result.violation.empty()) continue;
        ++findings;
        RunOptions traced = options;
        traced.traces = true;
        ADD_FAILURE() << "seed " << seed << ": " << story(run(seed, make, traced));
    }
    if (wanted > kHistories) std::cout << histories << " histories, " << departures << " departures\n";
    EXPECT_GT(departures, wanted / 50) << "or nothing was shown";
    EXPECT_GT(histories, 2 * departures) << "or nothing was shown of the drives that stay";
}

TEST(LossOfADrive, OverEiAsciiAStationLeavesIfAndOnlyIfItsDriveIsGone)
{
    leaves_if_and_only_if_gone(run_ei, ei_client);
}

TEST(LossOfADrive, OverModbusAStationLeavesIfAndOnlyIfItsDriveIsGone)
{
    leaves_if_and_only_if_gone(run_modbus, modbus_client);
}

} // namespace
} // namespace dpslave::drive_line
