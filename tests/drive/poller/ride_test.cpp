// SPDX-License-Identifier: Apache-2.0
/// RIDE THROUGH (HA463561U002, B-047, X-46): how long the outputs stand after the loss of the master.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerRide : public testing::Test {
protected:
    explicit PollerRide(ZeroAfter after = 10s) : tags(test::table_up_to(99)), bench({settings(tags, after)})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
        exchanges(1, {10, 11});
    }
    static DriveSettings settings(const TagTable& tags, ZeroAfter after)
    {
        DriveSettings one;
        one.tags = &tags;
        one.zero_after = after;
        return one;
    }
    /// The master is in Data_Exchange with these outputs, each with the word of its tag.
    void exchanges(Generation generation, const std::vector<int>& outputs)
    {
        bench.layout(0, generation, {1}, outputs);
        for (const int tag : outputs) bench.master_writes(0, tag, tag);
        bench.run(300ms);
        bench.log.clear();
    }
    /// When the tag was written 0 for the safe state, from `begin` on.
    std::vector<std::chrono::nanoseconds> zeros_of(int tag, Instant begin) const
    {
        std::vector<std::chrono::nanoseconds> at;
        for (const test::Done& done : bench.log)
            if (done.purpose == Purpose::safe_state && done.kind == Transaction::Kind::write &&
                done.tag == tag)
                at.push_back(done.at - begin);
        return at;
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }

    TagTable tags;
    PollerBench bench;
};

TEST_F(PollerRide, OutputsStandAndNothingIsWrittenUntilTheRideIsOver)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(9900ms);
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.kind == Transaction::Kind::write; }), 0u);
    EXPECT_EQ(drive().words[10], 10);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    bench.run(200s);
    ASSERT_EQ(zeros_of(10, loss).size(), 1u);
    ASSERT_EQ(zeros_of(11, loss).size(), 1u);
    EXPECT_GE(zeros_of(10, loss)[0], 10s);
    EXPECT_LE(zeros_of(11, loss)[0], 10s + 3 * test::kAnswerTime);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 0);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerRide, ItsEndIsADeadlineWhereNothingElseIsToBeDone)
{
    bench.master_leaves(0);
    const Instant loss = bench.now;
    bench.layout(0, 2, {});
    while (bench.step()) {
    }
    bench.run(9700ms);
    EXPECT_EQ(bench.poller.next_deadline(), loss + 10s);
    bench.now = loss + 10s;
    bench.steps(1);
    EXPECT_EQ(bench.log.back().purpose, Purpose::safe_state);
}

TEST_F(PollerRide, AMasterThatReturnsInTimeWritesOnAsIfNothingHadHappened)
{
    bench.master_leaves(0);
    bench.run(5s);
    exchanges(2, {10, 11});
    const Instant back = bench.now;
    bench.run(30s);
    EXPECT_TRUE(zeros_of(10, back).empty());
    EXPECT_EQ(drive().words[10], 10);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerRide, OutputsThatTheNewLayoutDoesNotWriteGoToZeroAtTheirTime)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(5s);
    bench.layout(0, 2, {1}, {11, 12});
    bench.master_writes(0, 11, 33);
    bench.run(20s);
    ASSERT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_GE(zeros_of(10, loss)[0], 10s);
    EXPECT_LE(zeros_of(10, loss)[0], 10s + 3 * test::kAnswerTime);
    EXPECT_TRUE(zeros_of(11, loss).empty());
    EXPECT_EQ(drive().words[11], 33);
    EXPECT_EQ(drive().words[12], 0) << "the master's own zero";
}

TEST_F(PollerRide, AReturnWithoutDataExchangeDoesNotEndIt)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(3s);
    bench.layout(0, 2, {1}, {10, 11}); // Chk_Cfg, and no more
    bench.run(3s);
    bench.poller.left_data_exchange(0, {2});
    bench.run(20s);
    ASSERT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_GE(zeros_of(10, loss)[0], 10s);
    EXPECT_LE(zeros_of(10, loss)[0], 10s + 3 * test::kAnswerTime);
}

TEST_F(PollerRide, IsOverBeforeTheNewLayoutMayWrite)
{
    bench.master_leaves(0);
    bench.run(9s);
    bench.layout(0, 2, {1}, {10, 11});
    bench.run(3s);
    EXPECT_EQ(drive().words[10], 0);
    bench.master_writes(0, 10, 44);
    bench.run(20s);
    EXPECT_EQ(drive().words[10], 44);
}

TEST_F(PollerRide, ASecondLossCountsAnew)
{
    bench.master_leaves(0);
    bench.run(6s);
    exchanges(2, {10, 11});
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(9s);
    EXPECT_EQ(drive().words[10], 10);
    bench.run(2s);
    EXPECT_EQ(drive().words[10], 0);
    ASSERT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_GE(zeros_of(10, loss)[0], 10s);
}

TEST_F(PollerRide, EachLayoutThatEndedHasItsOwn)
{
    const Instant first = bench.now;
    bench.master_leaves(0);
    bench.run(4s);
    exchanges(2, {12});
    const Instant second = bench.now;
    bench.master_leaves(0);
    bench.run(20s);
    ASSERT_EQ(zeros_of(10, first).size(), 1u);
    ASSERT_EQ(zeros_of(12, second).size(), 1u);
    EXPECT_LE(zeros_of(10, first)[0], 10s + 3 * test::kAnswerTime);
    EXPECT_GE(zeros_of(12, second)[0], 10s);
}

TEST_F(PollerRide, AnotherTimeCountsFromTheLossWhileItIsUnderWay)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(2s);
    bench.poller.set_zero_after(0, 5s);
    bench.run(2900ms);
    EXPECT_EQ(drive().words[10], 10);
    bench.run(1s);
    ASSERT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_GE(zeros_of(10, loss)[0], 5s);
    EXPECT_LE(zeros_of(10, loss)[0], 5s + 3 * test::kAnswerTime);
}

TEST_F(PollerRide, ATimeThatHasPassedAlreadyZeroesAtOnce)
{
    bench.master_leaves(0);
    bench.run(6s);
    bench.poller.set_zero_after(0, 3s);
    bench.steps(2);
    EXPECT_EQ(bench.purposes().substr(bench.log.size() - 2), "ss");
}

TEST_F(PollerRide, SetToNeverWhileItIsUnderWayZeroesNothing)
{
    bench.master_leaves(0);
    bench.run(5s);
    bench.poller.set_zero_after(0, std::nullopt);
    EXPECT_FALSE(bench.poller.safe_state_pending());
    bench.run(60s);
    EXPECT_EQ(drive().words[10], 10);
    bench.poller.set_zero_after(0, 30s);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 0) << "30 s after the loss have passed";
}

TEST_F(PollerRide, SetAfterTheZeroChangesNothingMore)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(11s);
    bench.poller.set_zero_after(0, 20s);
    EXPECT_FALSE(bench.poller.safe_state_pending());
    bench.run(60s);
    EXPECT_EQ(zeros_of(10, loss).size(), 1u);
}

TEST_F(PollerRide, TheEndOfTheProgramZeroesNow)
{
    bench.master_leaves(0);
    bench.run(1s);
    bench.log.clear();
    bench.poller.cancel_ride_through(0);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    bench.steps(4); // two zeros, and what shows them
    EXPECT_EQ(bench.purposes(), "ssss");
    EXPECT_FALSE(bench.poller.safe_state_pending());
    EXPECT_EQ(drive().words[10], 0);
}

TEST_F(PollerRide, ALossThatIsNotRiddenThroughIsZeroedNowAndTheNextOneRidesAgain)
{
    Instant loss = bench.now;
    bench.master_leaves(0);
    bench.poller.end_ride(0);
    bench.run(500ms);
    EXPECT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(bench.poller.snapshot(0).ride_ends, std::nullopt);

    exchanges(2, {10, 11});
    ASSERT_EQ(drive().words[10], 10);
    loss = bench.now;
    bench.master_leaves(0);
    bench.run(9900ms);
    EXPECT_EQ(drive().words[10], 10);
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 0);
}

TEST_F(PollerRide, NamesTheTagsThatWaitForTheirZero)
{
    EXPECT_TRUE(bench.poller.safe_state_left(0).empty());
    drive().silent_tags = {10, 11};
    bench.master_leaves(0);
    bench.poller.cancel_ride_through(0);
    bench.run(2s);
    EXPECT_EQ(bench.poller.safe_state_left(0), (std::vector<ZeroLeft>{{10, false}, {11, false}}));
}

TEST_F(PollerRide, AMasterThatIsLostAfterTheEndOfTheProgramBeganDoesNotRide)
{
    bench.poller.cancel_ride_through(0);
    bench.master_leaves(0);
    bench.poller.set_zero_after(0, 60s); // the main thread said it meanwhile
    bench.steps(2);
    EXPECT_EQ(bench.purposes(), "ss");
}

TEST_F(PollerRide, ADriveThatIsLostWhenItIsOverIsZeroedAtItsReturn)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(2s);
    drive().alive = false;
    bench.run(20s);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    drive().alive = true;
    bench.run(9s);
    EXPECT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 0);
}

TEST_F(PollerRide, CountsFromALossWhileTheDriveIsLostToo)
{
    drive().alive = false;
    bench.run(9s); // the probes are far apart by now
    const Instant loss = bench.now;
    bench.master_leaves(0);
    EXPECT_LE(bench.poller.next_deadline(), loss) << "the time is set now, not with the next probe";
    bench.run(5s);
    drive().alive = true;
    while (!bench.poller.snapshot(0).answers) bench.run(10ms);
    bench.run(loss + 9900ms - bench.now);
    EXPECT_EQ(drive().words[10], 10);
    bench.run(300ms);
    EXPECT_EQ(drive().words[10], 0) << "10 s after the loss, not after the return";
}

TEST_F(PollerRide, ANewLayoutThatIsLostBeforeItsFirstWriteGotThroughIsZeroedToo)
{
    drive().alive = false;
    bench.run(2s);
    bench.master_leaves(0);
    bench.layout(0, 2, {1}, {10});
    bench.master_writes(0, 10, 77);
    bench.run(1s);
    bench.master_leaves(0);
    bench.run(60s);
    drive().alive = true;
    bench.run(9s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 0);
}

class PollerRideNever : public PollerRide {
protected:
    PollerRideNever() : PollerRide(std::nullopt) {}
};

TEST_F(PollerRideNever, WritingStopsAndTheOutputsStand)
{
    bench.master_leaves(0);
    bench.run(200s);
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.kind == Transaction::Kind::write; }), 0u);
    EXPECT_EQ(drive().words[10], 10);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerRideNever, StaysNeverAtTheEndOfTheProgram)
{
    bench.master_leaves(0);
    bench.poller.cancel_ride_through(0);
    EXPECT_FALSE(bench.poller.safe_state_pending());
    bench.run(10s);
    EXPECT_EQ(drive().words[10], 10);
}

TEST_F(PollerRideNever, BecomesATimeOfALossThatWasBefore)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    bench.run(4s);
    bench.poller.set_zero_after(0, 10s);
    bench.run(20s);
    ASSERT_EQ(zeros_of(10, loss).size(), 1u);
    EXPECT_GE(zeros_of(10, loss)[0], 10s);
    EXPECT_LE(zeros_of(10, loss)[0], 10s + 3 * test::kAnswerTime);
}

TEST_F(PollerRideNever, LeavesToTheNewMasterWhatItWrites)
{
    const Instant loss = bench.now;
    bench.master_leaves(0);
    exchanges(2, {11});
    bench.poller.set_zero_after(0, 0s);
    bench.run(5s);
    EXPECT_EQ(drive().words[11], 11);
    EXPECT_EQ(zeros_of(10, loss).size(), 1u);
}

TEST(PollerRides, AreThoseOfEachDrive)
{
    const TagTable tags = test::table_up_to(20);
    DriveSettings hasty, patient;
    hasty.tags = patient.tags = &tags;
    patient.zero_after = 60s;
    PollerBench bench{{hasty, patient}};
    for (std::size_t unit = 0; unit < 2; ++unit) {
        bench.drives[unit].words = {{1, 1}, {10, 1}};
        bench.layout(unit, 1, {1}, {10});
        bench.master_writes(unit, 10, 5);
    }
    bench.run(1s);
    for (std::size_t unit = 0; unit < 2; ++unit) bench.master_leaves(unit);
    bench.run(1s);
    EXPECT_EQ(bench.drives[0].words[10], 0);
    EXPECT_EQ(bench.drives[1].words[10], 5);
    bench.poller.cancel_ride_through(0);
    bench.poller.cancel_ride_through(1);
    bench.run(1s);
    EXPECT_EQ(bench.drives[1].words[10], 0);
}

} // namespace
} // namespace dpslave::drive
