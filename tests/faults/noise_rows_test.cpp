// SPDX-License-Identifier: Apache-2.0
// Bit errors on the lines of the real programs: what the operator is told. That no damaged telegram counts is
// judged bit by bit on the simulated clock (tests/dp/bus, tests/drive_line).
#include "fault_row.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Le;

/// Values in both directions while a line inverts bits, and when it does so no more.
class RowOfNoise : public RowOfADrive {
protected:
    void goes_through(Process& line, const char* rule)
    {
        const std::size_t before = taken().size();
        line.send_line("errors 0.0005");
        int value = 1;
        for (int change = 0; change < 8; ++change) both_ways(++value);
        EXPECT_TRUE(doctor_names(rule));
        EXPECT_TRUE(master_stays_in_data_exchange());

        line.send_line("errors 0");
        fault_ends();
        both_ways(++value);
        recovered();
        EXPECT_THAT(taken(before), Each(AllOf(Ge(1), Le(value)))) << "or nobody sent it";
        EXPECT_TRUE(never_an_older_one(taken()));
        EXPECT_TRUE(never_an_older_one(seen()));
    }

private:
    void both_ways(int value)
    {
        drive_shows(value);
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(drive_takes(value));
        EXPECT_TRUE(master_sees(value));
    }
};

TEST_P(RowOfNoise, F08_OnTheBusIsNamedByTheDoctor)
{
    begins(wiring_of(GetParam()), master_of(GetParam(), {"--retries", "15"}));
    goes_through(gateway->bus(), "bus.flaws");
}

TEST_P(RowOfNoise, F09_OnTheLineOfADriveIsNamedByTheDoctor)
{
    begins(GetParam());
    goes_through(gateway->drive_line(), "drive.damaged");
}

INSTANTIATE_TEST_SUITE_P(Over, RowOfNoise, ::testing::Values("ei-ascii", "modbus-rtu"));

} // namespace
} // namespace dpslave::test
