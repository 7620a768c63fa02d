// SPDX-License-Identifier: Apache-2.0
// Drives that come and go while the others on the line are served.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive::test {
namespace {

using namespace std::chrono_literals;

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

    static inline const TagTable table = table_up_to(99);
    static DriveSettings unit(std::uint8_t address)
    {
        DriveSettings settings;
        settings.address.unit = address;
        settings.tags = &table;
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
    DriveSettings more = unit(1);
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
    bench.poller.cancel_ride_through(0);
    EXPECT_FALSE(bench.poller.safe_state_left(0).empty());
    bench.run(1s);
    EXPECT_TRUE(bench.poller.safe_state_left(0).empty());
    EXPECT_EQ(bench.drives[0].words[10], 0);
    EXPECT_FALSE(bench.poller.safe_state_left(1).empty()) << "it rides on";
    EXPECT_EQ(bench.drives[1].words[10], 500);
}

// ---- other rows for a drive that stays

/// The first one stays with another table; the second one as it is.
class PollerOtherRows : public PollerExchange {
protected:
    void first_has(const TagTable& tags)
    {
        DriveSettings first = unit(0);
        first.tags = &tags;
        bench.poller.exchange({first, unit(1)}, {0U, 1U}, {});
    }
    static TagTable table_with(const Tag& changed)
    {
        std::vector<Tag> rows = table_up_to(99).all();
        rows[changed.number] = changed;
        return TagTable{rows};
    }
    TagTable other;
};

TEST_F(PollerOtherRows, NoticesNothingOfANameOrALimit)
{
    Tag row = table_up_to(99).all()[10];
    row.name = "SETPOINT";
    row.max = 600;
    const auto before = bench.poller.snapshot(0);
    other = table_with(row);
    first_has(other);
    bench.run(500ms);
    EXPECT_EQ(bench.poller.snapshot(0).words, before.words);
    const auto writes_to = [this](std::size_t unit) {
        return bench.count(
            [unit](const Done& d) { return d.unit == unit && d.kind == Transaction::Kind::write; });
    };
    EXPECT_EQ(writes_to(0), writes_to(1)) << "its output is refreshed when it is due, as that of the other";
}

TEST_F(PollerOtherRows, AsksWithTheNewRow)
{
    Tag row = table_up_to(99).all()[1];
    row.decimals = 2;
    other = table_with(row);
    first_has(other);
    bool asked = false;
    bench.meanwhile = [&](const Transaction& transaction) {
        if (transaction.tag == nullptr || transaction.tag->number != 1 || transaction.unit != 0) return;
        EXPECT_EQ(transaction.tag->decimals, 2);
        asked = true;
    };
    bench.run(1s);
    EXPECT_TRUE(asked);
}

TEST_F(PollerOtherRows, HoldsTheWordUntilItIsReadWithTheNewRow)
{
    Tag row = table_up_to(99).all()[1];
    row.decimals = 2;
    other = table_with(row);
    first_has(other);
    const auto held = bench.poller.take_inputs(0);
    ASSERT_TRUE(held);
    EXPECT_EQ(held->words[0], 100);
    EXPECT_TRUE(held->every_input_tried);
    bench.drives[0].words[1] = 10000;
    bench.run(1s);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[0], 10000);
}

TEST_F(PollerOtherRows, WritesAnOutputAtOnceThatTheOldRowForbade)
{
    Tag row = table_up_to(99).all()[10];
    row.access = Access::read_only;
    const TagTable forbidding = table_with(row);
    first_has(forbidding);
    bench.master_writes(0, 10, 600);
    bench.run(3s);
    EXPECT_EQ(bench.drives[0].words[10], 500);
    EXPECT_EQ(bench.poller.snapshot(0).states[1], WordState::read_only);

    first_has(table);
    bench.run(100ms);
    EXPECT_EQ(bench.drives[0].words[10], 600);
}

TEST_F(PollerOtherRows, MayForgetTheOldTable)
{
    bench.poller.set_zero_after(0, 1s);
    {
        const TagTable passing = table_with(table_up_to(99).all()[10]);
        first_has(passing);
        bench.poller.operate({.number = 9, .unit = 0, .tag = 20});
        bench.poller.set_demand(0, {.kind = DemandOrder::Kind::read, .tag = 1, .number = 4, .generation = 7});
        bench.master_leaves(0);
        first_has(table);
    }
    bench.run(5s);
    EXPECT_EQ(bench.drives[0].words[10], 0);
    EXPECT_TRUE(bench.poller.take_operate_answer());
}

// ---- another port

class PollerOtherPort : public PollerExchange {
protected:
    void other_port() { bench.poller.port_changed(); }
};

TEST_F(PollerOtherPort, ZeroesWhatItHasWrittenAtTheOneThatIsLeft)
{
    bench.poller.set_zero_after(0, 60s); // a ride is not waited for
    bench.poller.leave_port();
    EXPECT_FALSE(bench.poller.safe_state_left(0).empty());
    bench.run(500ms);
    EXPECT_FALSE(bench.poller.safe_state_pending());
    EXPECT_EQ(bench.drives[0].words[10], 0);
    EXPECT_EQ(bench.drives[1].words[10], 0);

    bench.master_writes(0, 10, 700);
    bench.run(3s);
    EXPECT_EQ(bench.drives[0].words[10], 0) << "what the master writes meanwhile is for the new port";
}

TEST_F(PollerOtherPort, LeavesADriveAsItIsWhoseOutputsAreNeverZeroed)
{
    bench.poller.set_zero_after(0, std::nullopt);
    bench.poller.leave_port();
    EXPECT_TRUE(bench.poller.safe_state_left(0).empty());
    bench.run(500ms);
    EXPECT_EQ(bench.drives[0].words[10], 500);
}

TEST_F(PollerOtherPort, WritesTheStandingOutputsAtTheNewOneFirst)
{
    bench.poller.leave_port();
    bench.run(500ms);
    other_port();
    for (MemoryDrive& drive : bench.drives) drive.words[10] = 0;
    bench.log.clear();
    bench.steps(2);
    EXPECT_EQ(bench.purposes(), "oo");
    EXPECT_EQ(bench.drives[0].words[10], 500);
    EXPECT_EQ(bench.drives[1].words[10], 500);
    bench.run(3s);
    EXPECT_EQ(bench.count([](const Done& d) { return d.purpose == Purpose::safe_state; }), 0U);
}

TEST_F(PollerOtherPort, HoldsAnOutputWithTheReasonThatItIsNotWrittenThereYet)
{
    bench.poller.leave_port();
    bench.run(500ms);
    other_port();
    const DriveSnapshot& seen = bench.poller.snapshot(0);
    EXPECT_EQ(seen.states[1], WordState::stale);
    EXPECT_EQ(seen.errors[1], AccessError::deferred);
    bench.run(1s);
    EXPECT_EQ(bench.poller.snapshot(0).states[1], WordState::good);
}

TEST_F(PollerOtherPort, WritesAtOnceToADriveThatWasLostAtTheOldOne)
{
    bench.drives[0].alive = false;
    bench.run(20s);
    ASSERT_FALSE(bench.poller.snapshot(0).answers);
    bench.poller.leave_port();
    bench.drives[0].alive = true;
    bench.drives[0].words[10] = 0;
    other_port();
    bench.run(100ms);
    EXPECT_EQ(bench.drives[0].words[10], 500);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
}

TEST_F(PollerOtherPort, ZeroesThereWhenTheMasterIsLostLater)
{
    bench.poller.leave_port();
    bench.run(500ms);
    other_port();
    bench.run(500ms);
    bench.master_leaves(0);
    bench.run(500ms);
    EXPECT_EQ(bench.drives[0].words[10], 0);
}

TEST_F(PollerOtherPort, ARideGoesOnThere)
{
    bench.poller.set_zero_after(0, 5s);
    bench.master_leaves(0);
    bench.run(1s);
    other_port();
    bench.run(1s);
    EXPECT_EQ(bench.drives[0].words[10], 500);
    bench.run(5s);
    EXPECT_EQ(bench.drives[0].words[10], 0);
}

} // namespace
} // namespace dpslave::drive::test
