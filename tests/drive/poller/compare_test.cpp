// SPDX-License-Identifier: Apache-2.0
/// Compared outputs (C-019, C-020): the panel of an instrument is overridden, and its memory is not worn.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerCompare : public testing::Test {
protected:
    PollerCompare() : tags(make_tags()), bench({settings(tags)}, {.max_tags = 16, .max_gap = 2})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
    }
    static TagTable make_tags()
    {
        std::vector<Tag> rows = test::table_up_to(99).all();
        rows[90].access = Access::read_only;
        rows[91].access = Access::write_only;
        return TagTable{rows};
    }
    static DriveSettings settings(const TagTable& tags)
    {
        DriveSettings one;
        one.tags = &tags;
        one.compare_outputs = true;
        one.output_refresh = 0ns; // must have no meaning here
        one.zero_after = std::nullopt;
        return one;
    }
    /// Inputs 1 and 2, one output with this word, written and seen.
    void exchanges(int tag, int word)
    {
        bench.layout(0, ++generation, {1, 2}, {tag});
        bench.master_writes(0, tag, word);
        bench.run(1s);
        bench.log.clear();
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }

    TagTable tags;
    PollerBench bench;
    Generation generation = 0;
};

TEST_F(PollerCompare, AStandingWordIsWrittenOnceInTenThousandRounds)
{
    bench.layout(0, 1, {1, 2}, {10, 40});
    bench.master_writes(0, 10, 5);
    bench.master_writes(0, 40, 6);
    bench.run(1s);
    bench.log.clear();
    while (bench.reads_of(10) < 10'000) bench.steps(1000);
    EXPECT_EQ(bench.writes_of(10) + bench.writes_of(40), 0u);
    EXPECT_GE(bench.reads_of(40), 9'999u);
    EXPECT_EQ(drive().words[10], 5);
    EXPECT_EQ(drive().words[40], 6);
}

TEST_F(PollerCompare, ABusThatFlapsCostsNoWriteWhereTheDriveHoldsTheWord)
{
    drive().words[10] = 5;
    drive().words[40] = 6;
    for (int i = 0; i < 20; ++i) {
        bench.layout(0, ++generation, {1, 2}, {10, 40});
        bench.images[0].may_write = true;
        bench.images[0].words[2] = 5;
        bench.images[0].words[3] = 6;
        bench.send_outputs(0);
        bench.run(1s);
        bench.master_leaves(0);
    }
    EXPECT_EQ(bench.writes_of(10) + bench.writes_of(40), 0u);
    EXPECT_EQ(seen().states[2], WordState::good);
    EXPECT_EQ(seen().words[2], 5);
}

TEST_F(PollerCompare, TheFirstWordOfALayoutIsWrittenWithinARoundWhereTheDriveHoldsAnother)
{
    bench.layout(0, 1, {1, 2}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(4 * test::kAnswerTime); // three reads and the write
    EXPECT_EQ(drive().words[10], 5);
}

TEST_F(PollerCompare, AWriteThatIsNeverAnsweredEndsWhenTheReadShowsTheWord)
{
    drive().unanswered_writes = {10};
    exchanges(10, 5);
    bench.run(9s);
    bench.log.clear();
    bench.run(60s);
    EXPECT_EQ(bench.writes_of(10), 0u);
    EXPECT_EQ(seen().states[2], WordState::good);
    drive().words[10] = 9; // at the panel
    bench.run(5s);
    EXPECT_EQ(drive().words[10], 5) << "and is compared from then on";
}

TEST_F(PollerCompare, AWordIsWrittenOnEachChangeOfTheMaster)
{
    exchanges(10, 1);
    for (int word = 2; word <= 6; ++word) {
        bench.master_writes(0, 10, word);
        bench.run(200ms);
        EXPECT_EQ(drive().words[10], word);
    }
    bench.run(10s);
    EXPECT_EQ(bench.writes_of(10), 5u);
}

TEST_F(PollerCompare, ThePanelIsOverriddenOnceForEachChangeMadeThere)
{
    exchanges(10, 5);
    for (int turn = 1; turn <= 5; ++turn) {
        drive().words[10] = 999;
        bench.run(1s);
        EXPECT_EQ(drive().words[10], 5) << "within a round or two";
        EXPECT_EQ(bench.writes_of(10), static_cast<std::size_t>(turn));
    }
    EXPECT_EQ(seen().states[2], WordState::good);
}

TEST_F(PollerCompare, WhatDemandDataOrDpctlWroteIsOverriddenToo)
{
    exchanges(10, 5);
    EXPECT_TRUE(bench.poller.operate({.number = 1, .unit = 0, .is_write = true, .tag = 10, .word = 7}));
    bench.run(1s);
    EXPECT_EQ(drive().words[10], 5);
    EXPECT_EQ(bench.writes_of(10), 2u) << "theirs and the one against it";
}

TEST_F(PollerCompare, ThePanelRegainsControlWhenTheMasterIsLost)
{
    exchanges(10, 5);
    bench.master_leaves(0);
    bench.log.clear();
    drive().words[10] = 999;
    bench.run(60s);
    EXPECT_EQ(drive().words[10], 999);
    EXPECT_EQ(bench.writes_of(10), 0u);
    EXPECT_EQ(bench.reads_of(10), 0u) << "there is nothing to compare";
}

TEST_F(PollerCompare, OutputsAreReadOnlyWhileTheyAreWritten)
{
    bench.layout(0, 1, {1, 40}, {20});
    bench.run(1s);
    EXPECT_EQ(bench.reads_of(20), 0u);
    bench.master_writes(0, 20, 5);
    bench.run(1s);
    EXPECT_GE(bench.reads_of(20), 5u);
}

TEST_F(PollerCompare, AReadOfAnOutputIsNoInput)
{
    bench.layout(0, 1, {50}, {10});
    bench.master_writes(0, 10, 5);
    bench.steps(3); // the write, the read of 10, the read of 50
    EXPECT_EQ(bench.purposes(), "ooi");
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
    drive().words[10] = 6;
    bench.run(2s);
    EXPECT_FALSE(bench.poller.take_inputs(0)) << "no input changed";
    EXPECT_EQ(drive().words[10], 5);
}

TEST_F(PollerCompare, AnOutputThatCannotBeReadDoesNotHoldUpThatEveryInputWasTried)
{
    drive().read_errors[10] = AccessError::not_understood;
    bench.layout(0, 1, {50}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(200ms);
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
    EXPECT_EQ(seen().errors[0], AccessError::none);
    EXPECT_EQ(seen().errors[1], AccessError::none) << "the write worked";
}

TEST_F(PollerCompare, ATagThatIsBothIsReadOnceARound)
{
    bench.layout(0, 1, {10, 50}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(2s);
    EXPECT_LE(bench.reads_of(10) - bench.reads_of(50), 1u);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[0], 5);
}

TEST_F(PollerCompare, AReadThatShowsTheOldWordRightBehindTheWriteIsNoDifference)
{
    exchanges(10, 5);
    bool lagging = false;
    Instant written{};
    bench.meanwhile = [&](const Transaction& t) { // the parameter follows 150 ms after the acknowledgement
        if (t.purpose == Purpose::output && t.kind == Transaction::Kind::write) {
            lagging = true;
            written = bench.now;
        } else if (lagging) {
            drive().words[10] = bench.now < written + 150ms ? 5 : 6;
        }
    };
    bench.master_writes(0, 10, 6);
    bench.run(5s);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(seen().states[2], WordState::good);
}

TEST_F(PollerCompare, AReadUnderWayWhenTheMasterChangesItsWordIsNoDifference)
{
    exchanges(10, 5);
    bool changed = false;
    bench.meanwhile = [&](const Transaction& t) {
        if (changed || t.kind != Transaction::Kind::read || t.tag->number != 10) return;
        changed = true;
        bench.master_writes(0, 10, 6);
    };
    bench.run(3s);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(drive().words[10], 6);
}

TEST_F(PollerCompare, ARefusedWordIsTriedAgainCalmly)
{
    for (const AccessError error :
         {AccessError::read_only, AccessError::out_of_range, AccessError::not_stopped}) {
        drive().write_errors = {{10, error}};
        bench.layout(0, ++generation, {1, 2}, {10});
        bench.log.clear();
        bench.master_writes(0, 10, 5);
        bench.run(60s);
        std::vector<std::chrono::milliseconds> pauses;
        std::optional<Instant> last;
        for (const test::Done& done : bench.log) {
            if (done.kind != Transaction::Kind::write) continue;
            if (last)
                pauses.push_back(std::chrono::duration_cast<std::chrono::milliseconds>(done.at - *last));
            last = done.at;
        }
        ASSERT_GE(pauses.size(), 6u);
        const std::chrono::milliseconds expected[] = {1s, 2s, 4s, 8s, 10s, 10s};
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_GE(pauses[i], expected[i]) << i;
            EXPECT_LE(pauses[i], expected[i] + 100ms) << i;
        }
        EXPECT_EQ(seen().errors[2], error);
        EXPECT_GE(bench.reads_of(1), 900u) << "the others go on";
        drive().write_errors.clear();
        bench.run(10s + 200ms);
        EXPECT_EQ(drive().words[10], 5);
        EXPECT_EQ(seen().states[2], WordState::good);
        drive().words[10] = 1010;
    }
}

TEST_F(PollerCompare, ANewWordIsTriedAtOnceThoughTheOldOneWasRefused)
{
    exchanges(10, 5);
    drive().write_errors[10] = AccessError::out_of_range;
    bench.master_writes(0, 10, 600);
    bench.run(20s);
    EXPECT_EQ(seen().states[2], WordState::out_of_range);
    drive().write_errors.clear();
    bench.master_writes(0, 10, 50);
    bench.run(100ms);
    EXPECT_EQ(drive().words[10], 50);
    EXPECT_EQ(seen().states[2], WordState::good);
}

TEST_F(PollerCompare, ARefusedWordThatTheDriveHoldsAfterAllIsNotWritten)
{
    drive().write_errors[10] = AccessError::out_of_range;
    exchanges(10, 5);
    EXPECT_EQ(seen().errors[2], AccessError::out_of_range);
    drive().words[10] = 5; // by hand
    bench.run(500ms);
    bench.log.clear();
    EXPECT_EQ(seen().errors[2], AccessError::none);
    bench.run(30s);
    EXPECT_EQ(bench.writes_of(10), 0u);
}

TEST_F(PollerCompare, AReadOnlyTagStaysKnownAsSuchThoughItHoldsTheWord)
{
    drive().write_errors[10] = AccessError::read_only;
    exchanges(10, 5);
    drive().words[10] = 5;
    bench.run(30s);
    bench.log.clear();
    bench.run(30s);
    EXPECT_EQ(bench.writes_of(10), 0u);
    EXPECT_EQ(seen().states[2], WordState::read_only) << "the mapping is wrong, and that is to be seen";
}

TEST_F(PollerCompare, AWordThatIsAcceptedAndNotKeptIsRepeatedMoreAndMoreSeldomAndShown)
{
    drive().not_kept = {10};
    bench.layout(0, 1, {1, 2}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(5s);
    EXPECT_EQ(seen().states[2], WordState::refused);
    EXPECT_EQ(seen().errors[2], AccessError::not_understood);
    bench.run(10min - 5s);
    EXPECT_GE(bench.writes_of(10), 10u);
    EXPECT_LE(bench.writes_of(10), 7u + 9u) << "at last once a minute";
    drive().not_kept.clear();
    bench.run(61s);
    EXPECT_EQ(drive().words[10], 5);
    EXPECT_EQ(seen().states[2], WordState::good);
    bench.log.clear();
    drive().words[10] = 9;
    bench.run(1s);
    EXPECT_EQ(drive().words[10], 5) << "and now it is the panel again";
}

TEST_F(PollerCompare, AWriteOnlyTagIsWrittenOnChangeAndNotRead)
{
    exchanges(91, 5);
    bench.run(30s);
    EXPECT_EQ(bench.writes_of(91) + bench.reads_of(91), 0u);
    bench.master_writes(0, 91, 6);
    bench.run(1s);
    EXPECT_EQ(bench.writes_of(91), 1u);
}

TEST_F(PollerCompare, ATagThatTheTableCallsReadOnlyIsNeitherWrittenNorRead)
{
    exchanges(90, 5);
    bench.run(5s);
    EXPECT_EQ(bench.writes_of(90) + bench.reads_of(90), 0u);
    EXPECT_EQ(seen().errors[2], AccessError::read_only);
}

TEST_F(PollerCompare, AWriteWhoseAnswerWasLostIsRepeatedThoughTheWordGoesBack)
{
    exchanges(10, 5);
    drive().lost_answers = 1;
    bench.master_writes(0, 10, 7);
    while (drive().lost_answers > 0) bench.step();
    bench.master_writes(0, 10, 5); // the drive holds 7 by now
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 5);
}

TEST_F(PollerCompare, AfterTheReturnOfTheDriveOnlyWhatItLostIsWritten)
{
    bench.layout(0, 1, {1}, {10, 40, 91});
    for (const int tag : {10, 40, 91}) bench.master_writes(0, tag, tag);
    bench.run(1s);
    drive().alive = false;
    bench.run(3s);
    drive().words[40] = 0;
    drive().alive = true;
    bench.log.clear();
    bench.run(10s);
    EXPECT_EQ(bench.writes_of(10), 0u) << "its memory held";
    EXPECT_EQ(bench.writes_of(40), 1u);
    EXPECT_EQ(bench.writes_of(91), 1u) << "it cannot be read back";
    EXPECT_EQ(drive().words[40], 40);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(seen().states[i], WordState::good) << i;
}

TEST_F(PollerCompare, AfterTheReturnAWordThatCanNoLongerBeReadIsWritten)
{
    exchanges(10, 5);
    drive().alive = false;
    bench.run(3s);
    drive().words[10] = 0;
    drive().read_errors[10] = AccessError::unsupported_type; // another firmware
    drive().alive = true;
    bench.run(10s);
    EXPECT_EQ(drive().words[10], 5);
}

TEST_F(PollerCompare, OfTwoOutputsWithOneTagTheLastIsWritten)
{
    bench.layout(0, 1, {1}, {10, 10});
    bench.images[0].may_write = true;
    bench.images[0].words[1] = 5;
    bench.images[0].words[2] = 6;
    bench.send_outputs(0);
    bench.run(60s);
    EXPECT_EQ(bench.writes_of(10), 1u) << "they are not written over each other for ever";
    EXPECT_EQ(drive().words[10], 6);
    EXPECT_EQ(seen().states[1], WordState::refused);
    EXPECT_EQ(seen().states[2], WordState::good);
}

TEST_F(PollerCompare, AnInvalidTagIsDroppedAndTriedNowAndThen)
{
    drive().words.erase(10);
    exchanges(10, 5);
    EXPECT_EQ(seen().errors[2], AccessError::invalid_tag);
    bench.run(25s);
    EXPECT_LE(bench.writes_of(10), 3u);
    drive().words[10] = 0;
    bench.run(11s);
    EXPECT_EQ(drive().words[10], 5);
}

} // namespace
} // namespace dpslave::drive
