// SPDX-License-Identifier: Apache-2.0
/// A drive that is gone: when it counts as gone, what the station does then, and when it is back.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using namespace test;

const TagTable kTable = table_up_to(9);

DriveSettings drive_with(WhenLost when, std::chrono::nanoseconds after = 2s)
{
    DriveSettings unit;
    unit.tags = &kTable;
    unit.loss = {.when = when, .after = after};
    unit.zeroes_on_return = true;
    unit.decides_every = kSilenceTime;
    return unit;
}

class GoneDrive : public ::testing::Test {
protected:
    explicit GoneDrive(WhenLost when = WhenLost::silent) : GoneDrive({drive_with(when)}) {}
    explicit GoneDrive(const std::vector<DriveSettings>& units) : bench(units)
    {
        for (MemoryDrive& drive : bench.drives)
            for (int tag = 1; tag <= 9; ++tag) drive.words[tag] = static_cast<std::uint16_t>(tag);
    }
    const DriveSnapshot& seen(std::size_t unit = 0) const { return bench.poller.snapshot(unit); }
    bool is_away(std::size_t unit = 0) const { return seen(unit).away; }
    /// How long it takes until the station leaves; `limit`: it did not.
    std::chrono::nanoseconds until_away(std::chrono::nanoseconds limit, std::size_t unit = 0)
    {
        return until([&] { return is_away(unit); }, limit);
    }
    std::chrono::nanoseconds until(const std::function<bool()>& is_so, std::chrono::nanoseconds limit)
    {
        const Instant began = bench.now;
        while (!is_so() && bench.now < began + limit) bench.run(10ms);
        return std::min(bench.now - began, limit);
    }
    /// The bus side: a station that is away has left Data_Exch.
    void exchanges()
    {
        bench.run(100ms); // it appears
        bench.layout(0, ++generation_, {1, 2}, {3});
        bench.master_writes(0, 3, 300);
        bench.run(1s);
        ASSERT_EQ(bench.drives[0].words[3], 300);
    }

    Generation generation() const { return generation_; }

    PollerBench bench;

private:
    Generation generation_ = 0;
};

TEST_F(GoneDrive, AtTheStartItIsAwayUntilItsDriveHasAnswered)
{
    bench.drives[0].alive = false;
    bench.run(10s);
    EXPECT_TRUE(is_away());

    bench.drives[0].alive = true;
    EXPECT_LE(until([&] { return !is_away(); }, 10s), 4s) << "its probe, and 1 s";
}

/// A tag for which no rule gives a mnemonic: the client refuses it, and the drive hears nothing of it.
TEST_F(GoneDrive, ARefusalThatTheDriveWasNotAskedForIsNoSignOfLife)
{
    Poller poller{{drive_with(WhenLost::silent)}, {}};
    Instant now{1h};
    OutputImage image;
    image.layout = {.generation = 1, .count = 1, .parameters = {{{1, true, false}}}};
    poller.set_outputs(0, image);
    for (const Instant end = now + 10s; now < end;) {
        const auto transaction = poller.next(now);
        if (!transaction) {
            now = std::max(now + 1us, poller.next_deadline());
            continue;
        }
        const bool is_asked = transaction->kind == Transaction::Kind::probe;
        if (is_asked) now += kSilenceTime;
        poller.done({.error = is_asked ? AccessError::no_answer : AccessError::invalid_tag, .words = {}},
                    now);
        ASSERT_TRUE(poller.snapshot(0).away);
    }
    EXPECT_GT(poller.snapshot(0).silences, 0U) << "it is asked whether it is there";
}

TEST_F(GoneDrive, WithADriveThatAnswersAtOnceItAppearsAtOnce)
{
    bench.run(100ms);
    EXPECT_FALSE(is_away());
    EXPECT_EQ(seen().presence, DrivePresence::here);
}

TEST_F(GoneDrive, ItLeavesWhenTheRetriesTheTimeAndFourFurtherQuestionsAreOver)
{
    exchanges();
    bench.drives[0].alive = false;
    const Instant died = bench.now;
    std::size_t questions = bench.log.size();
    const auto took = until_away(10s);
    questions = bench.log.size() - questions;

    EXPECT_GE(took, 3 * kSilenceTime + 2s);
    EXPECT_LE(took, 3 * kSilenceTime + 2s + 20ms) << "and not behind one more question";
    EXPECT_GE(questions, 7u) << "the retries, and four further questions";
    EXPECT_EQ(seen().departures, 1u);
    EXPECT_GT(bench.now, died);
}

TEST_F(GoneDrive, AWordOfItThatComesTooLateKeepsTheStation)
{
    exchanges();
    bench.drives[0].alive = false;
    for (int i = 0; i < 40; ++i) {
        bench.run(500ms);
        bench.poller.heard(0, bench.now);
        ASSERT_FALSE(is_away()) << i;
    }
    EXPECT_FALSE(seen().answers) << "it is lost, and not gone";
    EXPECT_LE(until_away(10s), 2s + 2 * kSilenceTime);
}

/// As while dpctl doctor --probe has the line.
TEST_F(GoneDrive, ADriveThatIsAskedNothingForLongIsGoneAtOnceAndComesBackByItself)
{
    exchanges();
    bench.poller.not_asked(0, bench.now);
    EXPECT_TRUE(is_away());
    EXPECT_EQ(seen().departures, 1u);
    bench.now += 60s;
    EXPECT_LE(until([&] { return !is_away(); }, 10s), 4s);
    EXPECT_EQ(bench.drives[0].words[3], 0) << "nobody knows what became of it";
    bench.layout(0, generation() + 1, {1, 2}, {3});
    bench.run(1s);
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
}

TEST_F(GoneDrive, ALongerTimeIsWaitedFor)
{
    PollerBench patient{{drive_with(WhenLost::silent, 30s)}};
    patient.drives[0].words[1] = 1;
    patient.run(100ms);
    patient.layout(0, 1, {1});
    patient.run(1s);
    patient.drives[0].alive = false;
    patient.run(30s);
    EXPECT_FALSE(patient.poller.snapshot(0).away);
    patient.run(2s);
    EXPECT_TRUE(patient.poller.snapshot(0).away);
}

TEST_F(GoneDrive, ItAppearsWhenItsDriveHasAnsweredForOneSecond)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    ASSERT_TRUE(is_away());

    bench.drives[0].alive = true;
    ASSERT_LT(until([&] { return seen().presence == DrivePresence::returning; }, 5s), 5s);
    const auto took = until([&] { return !is_away(); }, 5s);
    EXPECT_GE(took, 990ms);
    EXPECT_LE(took, 1s + kSilenceTime + 20ms) << "the next answer behind it";
}

TEST_F(GoneDrive, ADriveThatIsLostAgainBeforeTheSecondIsOverIsStillGone)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    bench.drives[0].alive = true;
    ASSERT_LT(until([&] { return seen().presence == DrivePresence::returning; }, 5s), 5s);
    bench.drives[0].alive = false;
    bench.run(5s);

    EXPECT_TRUE(is_away());
    EXPECT_EQ(seen().departures, 1u) << "it had not come back";
}

TEST_F(GoneDrive, NoOutputIsCalledNotZeroWhileTheZerosAreStillUnderWay)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    ASSERT_TRUE(is_away());
    bench.drives[0].alive = true;
    for (const Instant end = bench.now + 5s; is_away() && bench.now < end; bench.run(1ms))
        ASSERT_EQ(seen().not_zeroed, 0);
    EXPECT_FALSE(is_away());
    EXPECT_EQ(seen().not_zeroed, 0);
}

TEST_F(GoneDrive, ADriveThatIsLostWhileItReturnsHasItsOutputsSetToZeroAgain)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    bench.drives[0].alive = true;
    ASSERT_LT(until([&] { return bench.drives[0].words[3] == 0; }, 5s), 5s);
    ASSERT_TRUE(is_away());
    bench.drives[0].alive = false;
    bench.run(5s);

    bench.drives[0].words[3] = 77; // as it was stored
    bench.drives[0].alive = true;
    ASSERT_LT(until([&] { return !is_away(); }, 5s), 5s);
    EXPECT_EQ(bench.drives[0].words[3], 0);
}

TEST_F(GoneDrive, AnOutputThatWasZeroBeforeItsDriveWasGoneIsSetToZeroWhenItIsBack)
{
    exchanges();
    bench.poller.left_data_exchange(0, {generation()});
    bench.run(1s);
    ASSERT_EQ(bench.drives[0].words[3], 0);
    bench.drives[0].alive = false;
    bench.run(5s);
    ASSERT_TRUE(is_away());

    bench.drives[0].words[3] = 77; // as it was stored
    bench.drives[0].alive = true;
    ASSERT_LT(until([&] { return !is_away(); }, 5s), 5s);
    EXPECT_EQ(bench.drives[0].words[3], 0);
}

TEST_F(GoneDrive, AfterThreeLeavesInAMinuteItAppearsAfterTenSeconds)
{
    for (int i = 0; i < 3; ++i) {
        bench.drives[0].alive = true;
        bench.run(5s);
        ASSERT_FALSE(is_away()) << i;
        bench.drives[0].alive = false;
        bench.run(4s);
        ASSERT_TRUE(is_away()) << i;
    }
    EXPECT_EQ(seen().departures, 3u);
    bench.drives[0].alive = true;
    bench.run(9s);
    EXPECT_TRUE(is_away());
    bench.run(4s);
    EXPECT_FALSE(is_away());
}

TEST_F(GoneDrive, WhatTheMasterHasWrittenIsZeroBeforeTheStationAppears)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    bench.drives[0].alive = true;
    while (is_away()) {
        bench.run(10ms);
        if (!is_away()) break;
    }
    EXPECT_EQ(bench.drives[0].words[3], 0);
    EXPECT_EQ(seen().not_zeroed, 0);
}

TEST_F(GoneDrive, NothingOfTheOldLayoutIsWrittenAfterTheReturn)
{
    exchanges();
    bench.drives[0].alive = false;
    ASSERT_LT(until_away(5s), 5s);
    bench.master_writes(0, 3, 301); // the bus does not know yet
    bench.drives[0].alive = true;
    bench.run(5s);
    EXPECT_EQ(bench.drives[0].words[3], 0);
}

TEST_F(GoneDrive, AnOutputThatCannotBeZeroedIsNamedAfterTwoSecondsAndTheStationAppears)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    bench.drives[0].not_kept = {3};
    bench.drives[0].alive = true;
    ASSERT_LT(until([&] { return seen().presence == DrivePresence::returning; }, 5s), 5s);
    const auto took = until([&] { return !is_away(); }, 10s);

    EXPECT_GE(took, 1900ms);
    EXPECT_LE(took, 2300ms);
    EXPECT_EQ(seen().not_zeroed, 3);
}

TEST_F(GoneDrive, AnOutputWhoseZeroIsRefusedIsNamed)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    bench.drives[0].write_errors[3] = AccessError::out_of_range;
    bench.drives[0].alive = true;
    bench.run(5s);

    EXPECT_FALSE(is_away());
    EXPECT_EQ(seen().not_zeroed, 3);
}

TEST_F(GoneDrive, RideThroughDoesNotRunForIt)
{
    DriveSettings box = drive_with(WhenLost::silent);
    box.zero_after = std::nullopt; // RIDE THROUGH -1
    PollerBench riding{{box}};
    riding.drives[0].words = {{1, 1}, {3, 3}};
    riding.run(100ms);
    riding.layout(0, 1, {1}, {3});
    riding.master_writes(0, 3, 300);
    riding.run(1s);
    riding.drives[0].alive = false;
    riding.run(5s);
    EXPECT_FALSE(riding.poller.snapshot(0).ride_ends);

    riding.drives[0].alive = true;
    riding.run(5s);
    EXPECT_EQ(riding.drives[0].words[3], 0);
}

TEST_F(GoneDrive, WithOutputLossHoldNothingIsZeroed)
{
    DriveSettings board = drive_with(WhenLost::silent);
    board.zero_after = std::nullopt;
    board.zeroes_on_return = false;
    PollerBench holding{{board}};
    holding.drives[0].words = {{1, 1}, {3, 3}};
    holding.run(100ms);
    holding.layout(0, 1, {1}, {3});
    holding.master_writes(0, 3, 300);
    holding.run(1s);
    holding.drives[0].alive = false;
    holding.run(5s);
    holding.drives[0].alive = true;
    holding.run(10s);
    EXPECT_FALSE(holding.poller.snapshot(0).away);
    EXPECT_EQ(holding.drives[0].words[3], 300);
}

TEST_F(GoneDrive, WithoutALayoutADriveThatDiesIsFoundGoneAsSoon)
{
    bench.run(10s);
    bench.drives[0].alive = false;
    EXPECT_LE(until_away(10s), 250ms + 4 * kSilenceTime + 2s);
}

class TwoDrives : public GoneDrive {
protected:
    TwoDrives() : GoneDrive({drive_with(WhenLost::silent), drive_with(WhenLost::silent)}) {}
};

TEST_F(TwoDrives, TheStationOfTheOtherOneStays)
{
    bench.layout(0, 1, {1, 2});
    bench.layout(1, 1, {1, 2});
    bench.run(1s);
    bench.drives[0].alive = false;
    bench.run(10s);
    EXPECT_TRUE(is_away(0));
    EXPECT_FALSE(is_away(1));
    EXPECT_EQ(seen(1).departures, 0u);
}

class ReportedDrive : public GoneDrive {
protected:
    ReportedDrive() : GoneDrive(WhenLost::diagnosis) {}
    bool reported()
    {
        if (const auto inputs = bench.poller.take_inputs(0)) image_ = *inputs;
        return image_.drive_gone;
    }
    bool ready()
    {
        reported();
        return image_.every_input_tried;
    }

private:
    InputImage image_;
};

TEST_F(ReportedDrive, IsNotReadyBehindItsReturnWithValuesThatMayBeFromBefore)
{
    exchanges();
    bench.drives[0].alive = false;
    ASSERT_LT(until([&] { return reported(); }, 60s), 60s);
    bench.drives[0].is_behind = true;
    bench.drives[0].alive = true;
    bench.run(10s);
    EXPECT_FALSE(ready());

    bench.drives[0].is_behind = false;
    bench.run(1s);
    EXPECT_TRUE(ready());
}

TEST_F(ReportedDrive, TheMasterIsToldAndTheStationStays)
{
    exchanges();
    ASSERT_FALSE(reported());
    bench.drives[0].alive = false;
    bench.run(5s);
    EXPECT_TRUE(reported());
    EXPECT_FALSE(is_away());
    EXPECT_EQ(bench.drives[0].words[3], 300) << "outputs stand";
}

TEST_F(ReportedDrive, ItIsReadyOnlyWhenEveryInputHasBeenReadAgain)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(5s);
    ASSERT_FALSE(ready());
    bench.drives[0].alive = true;
    bench.drives[0].words[1] = 111;
    bench.drives[0].words[2] = 222;
    while (!ready()) {
        ASSERT_TRUE(bench.step() || (bench.run(10ms), true));
        const auto& words = seen().words;
        if (ready()) {
            EXPECT_EQ(words[0], 111);
            EXPECT_EQ(words[1], 222);
        }
    }
    EXPECT_FALSE(reported());
}

TEST_F(ReportedDrive, ALayoutThatBeginsWhileItIsSilentIsNotReady)
{
    bench.drives[0].alive = false;
    bench.layout(0, 1, {1, 2});
    for (int i = 0; i < 50; ++i) {
        bench.run(100ms);
        ASSERT_FALSE(ready()) << i;
    }
}

class HeldDrive : public GoneDrive {
protected:
    HeldDrive() : GoneDrive(WhenLost::hold) {}
};

TEST_F(HeldDrive, ThatWasNotAskedStaysAndNoWordIsGoodBeforeItAnswersAgain)
{
    exchanges();
    bench.poller.not_asked(0, bench.now);
    EXPECT_FALSE(is_away());
    EXPECT_FALSE(seen().answers);
    EXPECT_EQ(seen().states[1], WordState::stale);
    ASSERT_TRUE(bench.poller.take_inputs(0));

    bench.run(200ms);
    EXPECT_FALSE(is_away());
    EXPECT_TRUE(seen().answers) << "it is asked at once";
    EXPECT_EQ(seen().states[1], WordState::good);
}

TEST(DrivesOfALineThatStalled, AreAllAskedAtOnceAndDeadOnesInTheirTurn)
{
    PollerBench bench{{drive_with(WhenLost::hold), drive_with(WhenLost::silent),
                       drive_with(WhenLost::diagnosis), drive_with(WhenLost::silent)}};
    bench.drives[3].alive = false;
    bench.run(30s);
    for (std::size_t i = 0; i < 4; ++i) bench.poller.not_asked(i, bench.now);
    bench.log.clear();
    bench.steps(3);
    ASSERT_EQ(bench.log.size(), 3U);
    std::set<std::size_t> asked;
    for (const Done& one : bench.log) asked.insert(one.unit);
    EXPECT_EQ(asked, (std::set<std::size_t>{0, 1, 2}));
}

/// All that it could be asked for is owed: it is not asked again and again without a pause.
TEST(LostDrive, ThatIsAskedAtOnceAndCannotBeAskedWaitsForItsTurn)
{
    PollerBench bench{{drive_with(WhenLost::hold)}};
    bench.run(1s);
    bench.poller.not_asked(0, bench.now);
    ASSERT_TRUE(bench.poller.next(bench.now));
    bench.poller.done({AccessError::deferred, {}}, bench.now);
    EXPECT_FALSE(bench.poller.next(bench.now));
    EXPECT_GT(bench.poller.next_deadline(), bench.now);
}

TEST(LostDrive, OfAProgramThatEndsIsAskedOnceMoreAndHasItsSafeStateIfItIsBack)
{
    PollerBench bench{{drive_with(WhenLost::hold)}};
    bench.drives[0].words[3] = 0;
    bench.run(1s);
    bench.layout(0, 1, {}, {3});
    bench.master_writes(0, 3, 300);
    bench.run(1s);
    bench.drives[0].alive = false;
    bench.run(30s);
    bench.drives[0].alive = true;
    while (bench.step()) { // until it waits for its turn
    }
    bench.master_leaves(0);
    bench.poller.cancel_ride_through(0);
    bench.run(200ms);
    EXPECT_EQ(bench.drives[0].words[3], 0);
}

TEST_F(HeldDrive, NothingFollowsFromALoss)
{
    exchanges();
    bench.drives[0].alive = false;
    bench.run(20s);
    const auto inputs = bench.poller.take_inputs(0);
    EXPECT_FALSE(is_away());
    ASSERT_TRUE(inputs);
    EXPECT_FALSE(inputs->drive_gone);
    EXPECT_EQ(inputs->words[1], 2) << "it keeps its value";
    EXPECT_EQ(seen().departures, 0u);
}

} // namespace
} // namespace dpslave::drive
