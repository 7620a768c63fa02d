// SPDX-License-Identifier: Apache-2.0
/// A word that could not be refreshed keeps its value and is marked, from the first failure on and until a
/// good answer (drive-answers.md, "What is shown while an answer is missing").
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerHeld : public testing::Test {
protected:
    explicit PollerHeld(BlockRule rule = {}, bool compares = false)
        : tags(test::table_up_to(99)), bench({settings(tags, compares)}, rule)
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
        bench.layout(0, 1, {1, 2, 3}, {10});
        bench.master_writes(0, 10, 5);
        bench.run(500ms);
        bench.log.clear();
    }
    static DriveSettings settings(const TagTable& tags, bool compares)
    {
        DriveSettings one;
        one.tags = &tags;
        one.compare_outputs = compares;
        one.output_refresh = 60s;
        one.watched = {50};
        return one;
    }
    /// Until this tag was asked for once more.
    void asks(int tag)
    {
        bench.log.clear();
        for (int i = 0; i < 100 && (bench.log.empty() || bench.log.back().tag != tag); ++i) bench.step();
        ASSERT_EQ(bench.log.back().tag, tag);
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }
    WordState state(std::size_t parameter) { return seen().states[parameter]; }

    TagTable tags;
    PollerBench bench;
};

TEST_F(PollerHeld, AnInputIsMarkedWithItsFirstUnansweredRead)
{
    ASSERT_EQ(state(1), WordState::good);
    drive().silent_tags = {2};
    asks(2);
    EXPECT_EQ(state(1), WordState::stale);
    EXPECT_EQ(seen().errors[1], AccessError::no_answer);
    EXPECT_EQ(seen().words[1], 1002) << "it keeps its value";
    EXPECT_TRUE(seen().answers) << "the drive is not given up for one silence";
    EXPECT_TRUE(seen().repeated[1]);
}

TEST_F(PollerHeld, ItIsGoodAgainWithTheNextGoodAnswerAndNotBefore)
{
    drive().lost_answers = 1;
    bench.steps(1);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::stale) << i;
    bench.run(1s);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::good) << i;
}

TEST_F(PollerHeld, AValueThatMayBeOlderThanItsQuestionIsNewerThanTheOneBefore)
{
    drive().is_behind = true;
    drive().words[2] = 7;
    asks(2);
    EXPECT_EQ(seen().words[1], 7);
    EXPECT_EQ(state(1), WordState::good);
}

TEST_F(PollerHeld, OfANewLayoutItIsNoValueForItMayBeFromBefore)
{
    drive().is_behind = true;
    bench.layout(0, 2, {1, 2, 3});
    bench.run(1s);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::untried) << i;

    drive().is_behind = false;
    bench.run(1s);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::good) << i;
}

TEST_F(PollerHeld, OfANewLayoutThatBeginsWhileTheDriveIsLostItIsNoneEither)
{
    drive().alive = false;
    bench.run(5s);
    bench.layout(0, 2, {1, 2, 3});
    bench.run(1s);
    drive().is_behind = drive().alive = true;
    bench.run(10s);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NE(state(i), WordState::good) << i;
}

/// Whatever is asked again and again, all reads wait for it.
TEST_F(PollerHeld, AllThatIsReadIsMarkedWhileTheDriveIsInDoubt)
{
    drive().silent_tags = {2};
    asks(2);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::stale) << i;
    EXPECT_EQ(seen().watched[0].state, WordState::stale);
    EXPECT_EQ(seen().watched[0].word, 1050);
    drive().silent_tags.clear();
    asks(2);
    EXPECT_EQ(state(1), WordState::good);
    EXPECT_EQ(state(2), WordState::stale) << "it has not been read since";
    asks(3);
    EXPECT_EQ(state(2), WordState::good);
}

TEST_F(PollerHeld, AnOutputIsMarkedWithItsFirstUnansweredWrite)
{
    ASSERT_EQ(state(3), WordState::good);
    drive().unanswered_writes = {10};
    bench.master_writes(0, 10, 6);
    asks(10);
    EXPECT_EQ(state(3), WordState::stale);
    EXPECT_EQ(state(0), WordState::stale) << "its refresh waits for the write";
    drive().unanswered_writes.clear();
    asks(10);
    EXPECT_EQ(state(3), WordState::good);
}

TEST_F(PollerHeld, AReadThatIsNotUnderstoodMarksItsOwnWordOnly)
{
    asks(1);
    drive().not_understood = 1;
    asks(2);
    EXPECT_EQ(state(1), WordState::stale);
    EXPECT_EQ(seen().errors[1], AccessError::not_understood);
    EXPECT_EQ(state(2), WordState::good);
    EXPECT_TRUE(seen().repeated[1]);
}

TEST_F(PollerHeld, OnlyRetriesThatAreStillToComeKeepTheLampsAsTheyAre)
{
    drive().alive = false;
    bench.steps(2);
    EXPECT_TRUE(seen().repeated[0]);
    EXPECT_TRUE(seen().watched[0].repeated);
    bench.steps(1);
    ASSERT_FALSE(seen().answers);
    EXPECT_FALSE(seen().repeated[0]);
    EXPECT_FALSE(seen().watched[0].repeated);
    drive().alive = true;
    bench.run(2s);
    EXPECT_EQ(state(0), WordState::good);
    EXPECT_FALSE(seen().repeated[0]);
}

/// What holds it is not its own silence.
TEST_F(PollerHeld, AnOrderThatIsNotAnsweredMarksWhatWaitsForIt)
{
    drive().silent_tags = {70};
    bench.poller.set_demand(
        0, {.kind = DemandOrder::Kind::read, .tag = 70, .value = 0, .number = 1, .generation = 1});
    asks(70);
    EXPECT_EQ(state(0), WordState::stale);
}

TEST_F(PollerHeld, NothingOfItChangesTheInputsOfTheMaster)
{
    (void)bench.poller.take_inputs(0);
    drive().silent_tags = {2};
    asks(2);
    EXPECT_FALSE(bench.poller.take_inputs(0)) << "it keeps its words, and the drive answers as before";
}

TEST_F(PollerHeld, AWordThatTheDriveDeniesIsHeldByNothing)
{
    drive().words.erase(2);
    asks(2);
    ASSERT_EQ(state(1), WordState::invalid_tag);
    drive().silent_tags = {3};
    asks(3);
    EXPECT_EQ(state(1), WordState::invalid_tag);
}

class PollerHeldBlocks : public PollerHeld {
protected:
    PollerHeldBlocks() : PollerHeld({.max_tags = 8, .max_gap = 2, .max_written = 8}, true) {}
};

TEST_F(PollerHeldBlocks, ARefusedBlockHoldsItsWordsUntilEachIsReadAgain)
{
    ASSERT_EQ(state(0), WordState::good);
    drive().longest_read = 1;
    asks(1);
    ASSERT_EQ(bench.log.back().count, 3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::stale) << i;
    bench.run(1s);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(state(i), WordState::good) << i;
}

TEST_F(PollerHeldBlocks, ABlockThatIsNotUnderstoodHoldsItsWords)
{
    drive().read_errors[2] = AccessError::not_understood;
    bench.run(50ms);
    asks(1);
    EXPECT_EQ(state(0), WordState::stale);
    EXPECT_EQ(seen().errors[0], AccessError::not_understood);
    EXPECT_EQ(seen().words[0], 1001);
}

} // namespace
} // namespace dpslave::drive
