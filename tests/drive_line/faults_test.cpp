// SPDX-License-Identifier: Apache-2.0
/// Rows of the fault matrix on the simulated clock: a cable that is pulled for long, one dead drive of many.
/// Bit errors: bit_errors_test.cpp.
#include "line_bench.hpp"
#include "support/row.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive_line {
namespace {

constexpr unsigned kAlways = 10'000; // in parts of 10'000

template <class Line, class Make>
void cable_is_pulled(const Make& make, bool is_modbus)
{
    for (const Time pulled : {Time{10ms}, Time{1s}, Time{10s}, Time{60s}, Time{600s}}) {
        SCOPED_TRACE(std::chrono::duration<double>{pulled}.count());
        LineBench<Line> bench{calm(1), make, is_modbus};
        bench.run->live_for(20s);
        ASSERT_TRUE(bench.works());
        const std::uint16_t last = bench.held();

        bench.line.faults.question_lost = kAlways;
        for (int change = 0; change < 5; ++change) {
            bench.run->change(0);
            bench.run->live_for(pulled / 5);
            EXPECT_TRUE(pulled < 1s || bench.held() == last) << "the last value stands in the drive";
        }
        const drive::DriveSnapshot& shown = bench.run->seen(0);
        EXPECT_TRUE(pulled < 10s || !shown.answers) << "the log says it";
        EXPECT_TRUE(pulled < 10s || shown.states[0] == WordState::stale) << "dpctl io says it";

        bench.line.faults = {};
        const Time took = bench.until_it_works(60s);
        EXPECT_TRUE(bench.works()) << "after " << took.count() << " ns";
        test::recovered_in(took);
        bench.run->live_for(20s); // repeats carry the same value: the judge looks
        EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();
    }
}

TEST(PulledCable, F02_OfAnEiAsciiDriveForTenMinutesLeavesTheLastValueAndNoOlderOneComesAfterIt)
{
    cable_is_pulled<EiLine>(ei_client, false);
}

TEST(PulledCable, F02_OfAModbusDriveForTenMinutesLeavesTheLastValueAndNoOlderOneComesAfterIt)
{
    cable_is_pulled<ModbusFrames>(modbus_client, true);
}

/// Reads of all drives but one within a minute.
std::uint64_t reads_of_others(LineBench<EiLine>& bench, std::size_t drives, std::size_t left_out)
{
    const auto all = [&] {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < drives; ++i)
            if (i != left_out) sum += bench.run->seen(i).reads;
        return sum;
    };
    const std::uint64_t before = all();
    bench.run->live_for(60s);
    return all() - before;
}

TEST(DeadDriveOfMany, F34_CostsTheOthersLessThanATenthOfTheirReads)
{
    constexpr std::size_t kDrives = 9, kDead = 4;
    LineBench<EiLine> bench{calm(kDrives), ei_client, false};
    bench.run->live_for(20s);
    const std::uint64_t before = reads_of_others(bench, kDrives, kDead);
    bench.line.dies(kDead);
    bench.run->live_for(20s);
    EXPECT_FALSE(bench.run->seen(kDead).answers);
    EXPECT_GT(reads_of_others(bench, kDrives, kDead), before * 9 / 10);
    for (std::size_t i = 0; i < kDrives; ++i) EXPECT_EQ(bench.run->seen(i).losses, i == kDead ? 1U : 0U);
    EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();

    bench.line.returns(kDead, false);
    const Instant returned = bench.line.time;
    while (!bench.works(kDead) && bench.line.time < returned + 60s)
        bench.run->live(bench.run->transactions() + 1);
    EXPECT_TRUE(bench.works(kDead));
    test::recovered_in(bench.line.time - returned);
}

} // namespace
} // namespace dpslave::drive_line
