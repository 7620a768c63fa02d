// SPDX-License-Identifier: Apache-2.0
/// Nothing old is good, and nothing old is sent: random histories in which the line, the bus thread
/// and the main thread stall, over both protocols. The loop of the line, the stations on the bus and what
/// they decide are the program's own; clock, port, PLCs and script are simulated. tools/run drive-line makes
/// a million for each protocol; one run with its trace: STALLS_ONLY=SEED.
#include "stall_run.hpp"
#include "support/count_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

namespace dpslave::stalls {
namespace {

constexpr std::uint64_t kHistories = 1000;

void nothing_old_is_good_and_nothing_old_is_sent(bool is_modbus)
{
    const std::uint64_t only = test::count_of("STALLS_ONLY", 0);
    const std::uint64_t wanted = only != 0 ? 1 : test::count_of("STALLS_HISTORIES", kHistories);
    HistoryOptions options{.is_modbus = is_modbus};
    std::uint64_t histories = 0, stalls = 0, departures = 0;
    int findings = 0;
    for (std::uint64_t seed = only != 0 ? only : test::count_of("STALLS_SEED", 1);
         histories < wanted && findings < 3; ++seed) {
        options.traces = only != 0;
        const HistoryResult result = run_histories(seed, options);
        histories += std::max<std::uint64_t>(result.histories, 1);
        stalls += result.stalls;
        departures += result.departures;
        if (result.violation.empty()) continue;
        ++findings;
        options.traces = true;
        ADD_FAILURE() << "seed " << seed << ": " << story(run_histories(seed, options));
    }
    if (wanted > kHistories)
        std::cout << histories << " histories, " << stalls << " stalls, " << departures << " departures\n";
    if (only != 0) return;
    EXPECT_GT(departures, histories / 10) << "or nothing was shown";
}

TEST(Stalls, OverEiAsciiNothingOldIsGoodAndNothingOldIsSent)
{
    nothing_old_is_good_and_nothing_old_is_sent(false);
}

TEST(Stalls, OverModbusNothingOldIsGoodAndNothingOldIsSent)
{
    nothing_old_is_good_and_nothing_old_is_sent(true);
}

} // namespace
} // namespace dpslave::stalls
