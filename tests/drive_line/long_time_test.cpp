// SPDX-License-Identifier: Apache-2.0
/// Drive lines on a clock that has run for weeks: what a random run may never do holds there, too.
#include "random_runs.hpp"
#include "support/long_times.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive_line {
namespace {

constexpr std::uint64_t kSeedsAcross = 10;

class LineAcrossLongTimes : public ::testing::TestWithParam<::test::LongTime> {
protected:
    /// So that the moment comes within the run.
    static RunOptions across() { return {.transactions = 1'000, .begins = GetParam().instant() - 10s}; }
};

TEST_P(LineAcrossLongTimes, EveryValueIsThatOfItsDriveOverEiAscii)
{
    for (std::uint64_t seed = 1; seed <= kSeedsAcross; ++seed)
        EXPECT_EQ(run_ei(seed, ei_client, across()).violation, "") << "seed " << seed;
}

TEST_P(LineAcrossLongTimes, EveryValueIsThatOfItsDriveOverModbus)
{
    for (std::uint64_t seed = 1; seed <= kSeedsAcross; ++seed)
        EXPECT_EQ(run_modbus(seed, modbus_client, across()).violation, "") << "seed " << seed;
}

INSTANTIATE_TEST_SUITE_P(, LineAcrossLongTimes, ::testing::ValuesIn(::test::kLongTimes),
                         [](const auto& row) { return std::string{row.param.name}; });

} // namespace
} // namespace dpslave::drive_line
