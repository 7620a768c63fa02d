// SPDX-License-Identifier: Apache-2.0
/// Loss of the drive and loss of the master.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerLoss : public testing::Test {
protected:
    explicit PollerLoss(ZeroAfter loss = 0s) : tags(test::table_up_to(99)), bench({settings(tags, loss)})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
        bench.layout(0, 1, {1, 2}, {10, 11});
    }
    static DriveSettings settings(const TagTable& tags, ZeroAfter loss)
    {
        DriveSettings one;
        one.tags = &tags;
        one.zero_after = loss;
        one.output_refresh = 60s;
        return one;
    }
    void exchanges()
    {
        bench.master_writes(0, 10, 5);
        bench.master_writes(0, 11, 6);
        bench.run(300ms);
        bench.log.clear();
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }

    TagTable tags;
    PollerBench bench;
};

// ---- the drive

TEST_F(PollerLoss, ADriveIsLostAfterTheRetries)
{
    exchanges();
    drive().alive = false;
    bench.steps(2);
    EXPECT_TRUE(seen().answers);
    bench.steps(1);
    EXPECT_FALSE(seen().answers);
    EXPECT_EQ(seen().losses, 1u);
    EXPECT_EQ(seen().silences, 3u);
    EXPECT_EQ(bench.log[0].tag, bench.log[2].tag) << "the same transaction is repeated";
}

TEST_F(PollerLoss, InputsHoldAndAreMarkedStaleWhileTheDriveIsLost)
{
    exchanges();
    (void)bench.poller.take_inputs(0);
    drive().alive = false;
    bench.run(2s);
    const auto inputs = bench.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_FALSE(bench.poller.snapshot(0).answers);
    EXPECT_EQ(inputs->words[0], 1001);
    EXPECT_EQ(seen().states[0], WordState::stale);
    EXPECT_EQ(seen().states[2], WordState::stale);
}

TEST_F(PollerLoss, ALostDriveIsOnlyProbedOnceAProbeInterval)
{
    exchanges();
    drive().alive = false;
    bench.run(3 * test::kSilenceTime);
    for (int loss = 0; loss < 2; ++loss) { // it starts anew with each loss
        ASSERT_FALSE(seen().answers);
        Instant free = bench.now;
        bench.log.clear();
        bench.run(5 * (1s + test::kSilenceTime));
        ASSERT_EQ(bench.purposes(), "ppppp");
        for (std::size_t i = 0; i < 5; ++i) {
            EXPECT_EQ(bench.log[i].at - free, 1s) << i;
            free = bench.log[i].at + test::kSilenceTime;
        }
        drive().alive = true;
        bench.run(9s);
        ASSERT_TRUE(seen().answers);
        drive().alive = false;
        while (seen().answers) bench.step();
    }
}

TEST_F(PollerLoss, AfterTheReturnEveryPresentOutputIsWrittenAgain)
{
    exchanges();
    drive().alive = false;
    bench.run(2s);
    drive().words[10] = drive().words[11] = 0; // it was without power
    bench.master_writes(0, 11, 7);             // changed while it was lost
    drive().alive = true;
    bench.run(2s);
    EXPECT_EQ(drive().words[10], 5);
    EXPECT_EQ(drive().words[11], 7);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(seen().states[0], WordState::good);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
}

TEST_F(PollerLoss, OneSilenceIsNoLoss)
{
    exchanges();
    drive().lost_answers = 2;
    bench.run(1s);
    EXPECT_TRUE(seen().answers);
    EXPECT_EQ(seen().losses, 0u);
    EXPECT_EQ(seen().silences, 2u);
}

TEST_F(PollerLoss, ADriveThatWasNeverThereIsKnownToBeLost)
{
    drive().alive = false;
    EXPECT_FALSE(bench.poller.take_inputs(0)->every_input_tried);
    bench.run(1s);
    const auto inputs = bench.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_FALSE(bench.poller.snapshot(0).answers);
    EXPECT_TRUE(inputs->every_input_tried) << "with the result that no drive answers";
    EXPECT_EQ(seen().states[0], WordState::stale);
}

TEST_F(PollerLoss, ANewLayoutForALostDriveIsTriedAlready)
{
    drive().alive = false;
    bench.run(2s);
    bench.layout(0, 2, {3, 4}, {});
    const auto inputs = bench.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(inputs->generation, 2u);
    EXPECT_TRUE(inputs->every_input_tried);
    EXPECT_FALSE(bench.poller.snapshot(0).answers);
}

TEST_F(PollerLoss, ATagThatIsNeverAnsweredDoesNotStopTheOthersForEver)
{
    drive().silent_tags = {1, 10};
    bench.master_writes(0, 11, 6);
    bench.run(20s);
    EXPECT_GE(bench.reads_of(2), 3u);
    EXPECT_EQ(drive().words[11], 6);
}

TEST_F(PollerLoss, AnInvalidTagIsAskedForAgainAfterTheReturn)
{
    drive().words.erase(2);
    drive().words.erase(11);
    exchanges();
    drive().alive = false;
    bench.run(1s);
    drive().words[2] = 22;
    drive().words[11] = 0;
    drive().alive = true;
    bench.run(2s);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[1], 22);
    EXPECT_EQ(drive().words[11], 6);
}

// ---- the master

TEST_F(PollerLoss, EveryOutputIsWritten0OnceWhenTheMasterLeaves)
{
    exchanges();
    bench.master_leaves(0);
    bench.run(200s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 0);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(bench.writes_of(11), 1u);
    EXPECT_EQ(bench.log[0].purpose, Purpose::safe_state) << "before anything else";
    EXPECT_EQ(bench.log[1].purpose, Purpose::safe_state);
}

TEST_F(PollerLoss, LeavingIsReportedTwiceAndCountsOnce)
{
    exchanges();
    bench.master_leaves(0);
    bench.run(1s);
    bench.poller.left_data_exchange(0, {1});
    bench.run(1s);
    EXPECT_EQ(bench.writes_of(10), 1u);
}

TEST_F(PollerLoss, AnOldImageThatComesAfterTheLeavingWritesNothing)
{
    exchanges();
    bench.poller.left_data_exchange(0, {1});
    bench.master_writes(0, 10, 8); // the mailbox still held it
    bench.run(5s);
    EXPECT_EQ(drive().words[10], 0);
}

TEST_F(PollerLoss, TheZeroIsRepeatedUntilItIsAnswered)
{
    exchanges();
    drive().lost_answers = 1;
    bench.master_leaves(0);
    bench.run(2s);
    EXPECT_EQ(bench.writes_of(10) + bench.writes_of(11), 3u);
}

TEST_F(PollerLoss, AnAcknowledgedZeroCountsWhenItIsReadBack)
{
    exchanges();
    drive().not_kept = {10}; // as if the write had got lost and noise looked like its ACK
    bench.master_leaves(0);
    while (bench.writes_of(10) == 0) ASSERT_TRUE(bench.step());
    drive().not_kept.clear();
    bench.run(2s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(bench.writes_of(10), 2u);
    EXPECT_EQ(bench.writes_of(11), 1u);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, EveryZeroIsWrittenBeforeTheFirstIsReadBack)
{
    exchanges();
    bench.master_leaves(0);
    bench.steps(4);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(bench.log[i].purpose, Purpose::safe_state) << i;
        EXPECT_EQ(bench.log[i].kind, i < 2 ? Transaction::Kind::write : Transaction::Kind::read) << i;
    }
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, AZeroThatTheDriveNeverHoldsStopsNeitherTheOthersNorTheCycle)
{
    exchanges();
    drive().not_kept = {10};
    bench.master_leaves(0);
    bench.run(9s);
    EXPECT_EQ(bench.writes_of(10), 3u) << "once a round, then every 10 s";
    EXPECT_EQ(drive().words[11], 0);
    EXPECT_GE(bench.reads_of(1), 200u);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    drive().not_kept.clear();
    bench.run(2s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, AZeroThatCannotBeReadBackCountsWithItsAck)
{
    exchanges();
    drive().read_errors[10] = AccessError::unsupported_type;
    bench.master_leaves(0);
    bench.run(1s);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, AZeroThatWasNotReadBackBeforeTheDriveWasLostIsWrittenAgain)
{
    exchanges();
    bench.master_leaves(0);
    bench.steps(2);
    drive().alive = false;
    bench.run(2s);
    ASSERT_FALSE(seen().answers);
    drive().words[10] = 5; // it was without power
    drive().alive = true;
    bench.run(9s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, TheZeroReachesADriveThatIsLostAtThatMomentAndReturnsLater)
{
    exchanges();
    drive().alive = false;
    bench.run(2s);
    bench.master_leaves(0);
    bench.run(30s);
    EXPECT_EQ(drive().words[10], 5);
    drive().alive = true;
    bench.run(9s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 0);
    EXPECT_EQ(bench.writes_of(10), 1u);
}

TEST_F(PollerLoss, ARefusedZeroIsAnAnswer)
{
    exchanges();
    drive().write_errors[10] = AccessError::out_of_range;
    bench.master_leaves(0);
    bench.run(3s);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(drive().words[11], 0);
}

TEST_F(PollerLoss, AWriteUnderWayWhenTheMasterLeavesIsFollowedByTheZero)
{
    exchanges();
    bench.meanwhile = [this](const Transaction& t) {
        if (t.purpose == Purpose::output) bench.master_leaves(0);
    };
    bench.master_writes(0, 10, 9);
    bench.run(1s);
    EXPECT_EQ(drive().words[10], 0);
}

TEST_F(PollerLoss, ANewLayoutIsZeroedOnlyWhereItDoesNotWriteItself)
{
    exchanges();
    drive().alive = false;
    bench.run(2s);
    bench.master_leaves(0);
    bench.layout(0, 2, {1}, {11, 12});
    bench.master_writes(0, 11, 33);
    drive().alive = true;
    bench.run(3s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 33);
    EXPECT_EQ(
        bench.count([](const test::Done& d) { return d.purpose == Purpose::safe_state && d.tag == 11; }), 0u);
}

TEST_F(PollerLoss, TheZeroIsWrittenWhileTheNewLayoutMayNotWriteYet)
{
    exchanges();
    bench.master_leaves(0);
    bench.layout(0, 2, {1}, {10, 11});
    bench.run(500ms);
    EXPECT_EQ(drive().words[10], 0);
    bench.master_writes(0, 10, 44);
    bench.run(500ms);
    EXPECT_EQ(drive().words[10], 44);
}

TEST_F(PollerLoss, ANewLayoutIsTheEndOfTheOneBefore)
{
    exchanges();
    bench.layout(0, 2, {1}, {11});
    bench.master_writes(0, 11, 33);
    bench.run(1s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 33);
    bench.poller.left_data_exchange(0, {1});
    bench.master_writes(0, 11, 34);
    bench.run(1s);
    EXPECT_EQ(drive().words[11], 34) << "the order ended generation 1, not 2";
    EXPECT_EQ(bench.writes_of(10), 1u);
}

TEST_F(PollerLoss, AnOrderToLeaveEndsEveryLayoutBeforeIt)
{
    exchanges();
    bench.poller.left_data_exchange(0, {3});
    bench.run(1s);
    EXPECT_EQ(drive().words[10], 0);
    bench.layout(0, 2, {1}, {12}); // the mailbox was read before the order
    bench.master_writes(0, 12, 50);
    bench.run(1s);
    EXPECT_EQ(drive().words[12], 0) << "the master was in Data_Exchange with it";
    bench.layout(0, 4, {1}, {12});
    bench.master_writes(0, 12, 51);
    bench.run(1s);
    EXPECT_EQ(drive().words[12], 51);
}

TEST_F(PollerLoss, AnOrderToLeaveThatComesBeforeItsLayoutEndsIt)
{
    exchanges();
    bench.poller.left_data_exchange(0, {2});
    bench.layout(0, 2, {1}, {12});
    bench.run(1s);
    EXPECT_EQ(bench.writes_of(12), 0u) << "the master was never allowed to write it";
    EXPECT_EQ(drive().words[10], 0) << "generation 1 had ended before it";
    bench.log.clear();
    bench.master_writes(0, 12, 50);
    bench.master_writes(0, 12, 51);
    bench.run(1s);
    EXPECT_EQ(drive().words[12], 0);
    EXPECT_EQ(bench.writes_of(12), 1u);
}

TEST_F(PollerLoss, FailedStartUpsWriteNothingToADriveThatRunsLocally)
{
    for (Generation generation = 2; generation < 10; ++generation) {
        bench.layout(0, generation, {1}, {10, 11});
        bench.run(300ms);
        if (generation % 3 == 0) bench.poller.left_data_exchange(0, {generation});
        if (generation % 3 == 1) bench.poller.set_outputs(0, {});
        bench.run(300ms);
    }
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.kind == Transaction::Kind::write; }), 0u);
    EXPECT_FALSE(bench.poller.safe_state_pending());
    EXPECT_EQ(drive().words[10], 1010);
}

TEST_F(PollerLoss, AZeroThatIsNotUnderstoodIsRepeatedUntilItIs)
{
    exchanges();
    drive().not_understood = 1;
    bench.master_leaves(0);
    bench.run(500ms);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_EQ(drive().words[11], 0);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, AZeroThatIsNeverUnderstoodStopsNeitherTheOthersNorTheCycle)
{
    exchanges();
    drive().write_errors[10] = AccessError::not_understood;
    bench.master_leaves(0);
    bench.run(9s);
    EXPECT_EQ(bench.writes_of(10), 3u);
    EXPECT_EQ(drive().words[11], 0);
    EXPECT_GE(bench.reads_of(1), 200u);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    drive().write_errors.clear();
    bench.run(2s);
    EXPECT_EQ(drive().words[10], 0);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, AZeroThatWasNotUnderstoodIsWrittenAtOnceAfterTheReturn)
{
    exchanges();
    drive().write_errors[10] = AccessError::not_understood;
    bench.master_leaves(0);
    bench.run(500ms);
    drive().alive = false;
    while (seen().answers) bench.step();
    drive().write_errors.clear();
    drive().alive = true;
    bench.run(1500ms);
    EXPECT_EQ(drive().words[10], 0);
}

TEST_F(PollerLoss, AZeroThatWaitsWithoutAnyCycleIsADeadline)
{
    exchanges();
    drive().write_errors[10] = AccessError::not_understood;
    bench.poller.left_data_exchange(0, {1});
    bench.layout(0, 2, {});
    while (bench.step()) {
    }
    EXPECT_GT(bench.poller.next_deadline(), bench.now);
    drive().write_errors.clear();
    bench.run(11s);
    EXPECT_EQ(drive().words[10], 0);
}

TEST_F(PollerLoss, TheEndOfALayoutThatWasNeverSeenZeroesNothingTwice)
{
    exchanges();
    bench.master_leaves(0);
    bench.run(1s);
    bench.poller.left_data_exchange(0, {2});
    bench.run(1s);
    EXPECT_EQ(bench.writes_of(10), 1u);
}

TEST_F(PollerLoss, SaysAsLongAsZerosAreToBeWritten)
{
    exchanges();
    EXPECT_FALSE(bench.poller.safe_state_pending());
    drive().alive = false;
    bench.master_leaves(0);
    bench.run(5s);
    EXPECT_TRUE(bench.poller.safe_state_pending());
    drive().alive = true;
    bench.run(9s);
    EXPECT_FALSE(bench.poller.safe_state_pending());
}

TEST_F(PollerLoss, GenerationsMayPassThroughTheirEnd)
{
    for (const Generation generation : {0x70000000u, 0xD0000000u}) bench.layout(0, generation, {1});
    bench.layout(0, 0xFFFFFFFF, {1}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(200ms);
    bench.master_leaves(0);
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 0);
    bench.layout(0, 1, {1}, {10});
    bench.master_writes(0, 10, 6);
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 6);
}

class PollerLossHold : public PollerLoss {
protected:
    PollerLossHold() : PollerLoss(std::nullopt) {}
};

TEST_F(PollerLossHold, WritingStopsAndNothingIsZeroed)
{
    exchanges();
    bench.master_leaves(0);
    bench.master_writes(0, 10, 9);
    bench.run(200s);
    EXPECT_EQ(drive().words[10], 5);
    EXPECT_EQ(drive().words[11], 6);
    EXPECT_EQ(bench.writes_of(10) + bench.writes_of(11), 0u);
}

} // namespace
} // namespace dpslave::drive
