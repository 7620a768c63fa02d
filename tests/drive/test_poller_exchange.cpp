// SPDX-License-Identifier: Apache-2.0
// Drives that come and go while the others on the line are served.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive::test {
namespace {

/// Two drives with input 1 and output 10 each, in service, and then other ones.
class PollerExchange : public testing::Test {
protected:
    PollerExchange() : bench({unit(0), unit(1)})
    {
        for (const std::size_t i : {0U, 1U}) {
            bench.drives[i].words = {{1, static_cast<std::uint16_t>(100 + i)}, {10, 0}};
            bench.layout(i, 7, {1}, {10});
            bench.master_writes(i, 10, 500);
        }
        bench.run(2s);
        for (const std::size_t i : {0U, 1U}) bench.poller.take_inputs(i);
        bench.log.clear();
    }

    static UnitSettings unit(std::uint8_t address)
    {
        static const TagTable tags = table_up_to(99);
        UnitSettings settings;
        settings.address.unit = address;
        settings.tags = &tags;
        return settings;
    }
    /// The second one stays and is the first from now on; behind it comes a new one.
    void second_stays_and_another_comes()
    {
        bench.poller.exchange({unit(1), unit(2)}, {1U, std::nullopt}, {});
        bench.drives = {bench.drives[1], MemoryDrive{}};
        bench.drives[1].words = {{1, 300}};
        bench.images = {bench.images[1], OutputImage{}};
    }

    PollerBench bench;
};

TEST_F(PollerExchange, LeavesTheInputsOfTheOneThatStaysAsTheyAre)
{
    second_stays_and_another_comes();
    EXPECT_FALSE(bench.poller.take_inputs(0)) << "nothing of it has changed";

    bench.drives[0].words[1] = 111;
    bench.run(1s);
    const auto inputs = bench.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(inputs->generation, 7U);
    EXPECT_TRUE(inputs->every_input_tried);
    EXPECT_EQ(inputs->words[0], 111);
}

TEST_F(PollerExchange, GoesOnWritingTheOutputsOfTheOneThatStays)
{
    const std::uint64_t written = bench.poller.snapshot(1).writes;
    second_stays_and_another_comes();
    EXPECT_EQ(bench.poller.snapshot(0).writes, written) << "its counters go on";

    bench.master_writes(0, 10, 600);
    bench.run(1s);
    EXPECT_EQ(bench.drives[0].words[10], 600);
    EXPECT_EQ(bench.count([](const Done& d) { return d.purpose == Purpose::safe_state; }), 0U);
}

TEST_F(PollerExchange, AsksTheNewOneAsAnyDriveThatIsNew)
{
    second_stays_and_another_comes();
    EXPECT_FALSE(bench.poller.snapshot(1).known);
    bench.run(100ms);
    EXPECT_TRUE(bench.poller.snapshot(1).answers);

    bench.layout(1, 1, {1});
    bench.run(1s);
    EXPECT_EQ(bench.poller.take_inputs(1)->words[0], 300);
}

TEST_F(PollerExchange, HasTheNumberOfRetriesOfTheNewSettings)
{
    UnitSettings more = unit(1);
    more.retries = 5;
    bench.poller.exchange({more}, {1U}, {});
    bench.drives = {bench.drives[1]};
    bench.drives[0].alive = false;
    bench.steps(5);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
    bench.steps(1);
    EXPECT_FALSE(bench.poller.snapshot(0).answers);
}

TEST_F(PollerExchange, CanLeaveALineWithoutDrives)
{
    bench.poller.exchange({}, {}, {});
    EXPECT_FALSE(bench.poller.next(bench.now));
    EXPECT_EQ(bench.poller.next_deadline(), kNever);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerExchange, ComesWhenTheOneThatLeavesIsZeroedWhichTheOtherDoesNotNotice)
{
    bench.poller.set_zero_after(0, 60s);
    bench.poller.set_zero_after(1, 60s);
    bench.master_leaves(0);
    bench.master_leaves(1);
    bench.poller.ride_no_longer(0);
    EXPECT_TRUE(bench.poller.safe_state_pending(0));
    bench.run(1s);
    EXPECT_FALSE(bench.poller.safe_state_pending(0));
    EXPECT_EQ(bench.drives[0].words[10], 0);
    EXPECT_TRUE(bench.poller.safe_state_pending(1)) << "it rides on";
    EXPECT_EQ(bench.drives[1].words[10], 500);
}

} // namespace
} // namespace dpslave::drive::test
