// SPDX-License-Identifier: Apache-2.0
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

const TagTable& table()
{
    static const TagTable all = [] {
        std::vector<Tag> tags = test::table_up_to(99).all();
        tags[90].access = Access::read_only;
        tags[91].access = Access::write_only;
        tags[92].type = TagType::string;
        return TagTable{tags};
    }();
    return all;
}

DriveSettings unit(std::chrono::nanoseconds refresh = 1s)
{
    DriveSettings settings;
    settings.tags = &table();
    settings.output_refresh = refresh;
    return settings;
}

class PollerOfOne : public testing::Test {
protected:
    explicit PollerOfOne(const DriveSettings& settings = unit()) : bench({settings})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }
    PollerBench bench;
};

TEST_F(PollerOfOne, ReadsEveryInputOfTheLayoutOnceARound)
{
    bench.layout(0, 1, {5, 6, 7});
    bench.steps(6);
    EXPECT_EQ(bench.reads_of(5), 2u);
    EXPECT_EQ(bench.reads_of(6), 2u);
    EXPECT_EQ(bench.reads_of(7), 2u);
    EXPECT_EQ(bench.purposes(), "iiiiii");
}

TEST_F(PollerOfOne, GivesTheInputsUnderTheGenerationTheyWereReadFor)
{
    bench.layout(0, 7, {6, 5});
    bench.steps(1);
    const auto first = bench.poller.take_inputs(0);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->generation, 7u);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
    EXPECT_FALSE(first->every_input_tried);
    bench.steps(1);
    const auto second = bench.poller.take_inputs(0);
    ASSERT_TRUE(second);
    EXPECT_TRUE(second->every_input_tried);
    EXPECT_EQ(second->words[0], 1006);
    EXPECT_EQ(second->words[1], 1005);
}

TEST_F(PollerOfOne, GivesInputsOnlyWhenTheyChanged)
{
    bench.layout(0, 1, {5});
    bench.steps(1);
    EXPECT_TRUE(bench.poller.take_inputs(0));
    bench.steps(3);
    EXPECT_FALSE(bench.poller.take_inputs(0));
    drive().words[5] = 42;
    bench.steps(1);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[0], 42);
}

TEST_F(PollerOfOne, ReadsATagThatTheLayoutNamesTwiceOnce)
{
    bench.layout(0, 1, {5, 6, 5});
    bench.steps(2);
    const auto inputs = bench.poller.take_inputs(0);
    EXPECT_TRUE(inputs->every_input_tried);
    EXPECT_EQ(inputs->words[0], 1005);
    EXPECT_EQ(inputs->words[2], 1005);
}

TEST_F(PollerOfOne, WritesNothingBeforeTheMasterMay)
{
    bench.layout(0, 1, {5}, {10, 11});
    bench.run(5s);
    EXPECT_EQ(bench.writes_of(10) + bench.writes_of(11), 0u);
    EXPECT_EQ(bench.log.back().purpose, Purpose::input);
}

TEST_F(PollerOfOne, WritesEveryOutputOnceWhenTheMasterMay)
{
    bench.layout(0, 1, {5}, {10, 11});
    bench.master_writes(0, 10, 77);
    bench.run(500ms);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(bench.writes_of(11), 1u) << "a zero is a value too";
    EXPECT_EQ(drive().words[10], 77);
    EXPECT_EQ(drive().words[11], 0);
}

TEST_F(PollerOfOne, WritesAnOutputOnceOnEachChange)
{
    bench.layout(0, 1, {}, {10});
    for (int word = 1; word <= 5; ++word) {
        bench.master_writes(0, 10, word);
        bench.master_writes(0, 10, word);
        bench.run(100ms);
        EXPECT_EQ(drive().words[10], word);
    }
    EXPECT_EQ(bench.writes_of(10), 5u);
}

TEST_F(PollerOfOne, WritesAStandingOutputAgainAfterTheRefreshTime)
{
    bench.layout(0, 1, {5}, {10});
    bench.master_writes(0, 10, 1);
    bench.run(10'500ms);
    EXPECT_EQ(bench.writes_of(10), 11u) << "at 0 s and at 1 to 10 s";
}

TEST_F(PollerOfOne, RepairsAForeignChangeOfAValueByItsRefresh)
{
    bench.layout(0, 1, {5}, {10});
    bench.master_writes(0, 10, 1);
    bench.run(100ms);
    drive().words[10] = 999;
    bench.run(1s);
    EXPECT_EQ(drive().words[10], 1);
}

TEST_F(PollerOfOne, RepeatsAWriteWhoseAnswerWasLostEvenIfTheValueGoesBack)
{
    bench.layout(0, 1, {5}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(100ms);
    drive().lost_answers = 1;
    bench.master_writes(0, 10, 7);
    while (drive().lost_answers > 0) bench.step();
    bench.master_writes(0, 10, 5); // the drive may hold 7 by now
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 5);
}

TEST_F(PollerOfOne, WritesAValueThatChangedWhileTheOldOneWasOnItsWay)
{
    bench.layout(0, 1, {5}, {10});
    bench.meanwhile = [this](const Transaction& t) {
        if (t.purpose == Purpose::output && t.words.front() == 1) bench.master_writes(0, 10, 2);
    };
    bench.master_writes(0, 10, 1);
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 2);
    EXPECT_EQ(bench.writes_of(10), 2u);
}

TEST_F(PollerOfOne, AnOutputThatChangesAllTheTimeTakesOnlyItsShareOfTheCycle)
{
    bench.layout(0, 1, {1, 2, 3, 4, 5}, {10});
    int word = 0;
    for (int i = 0; i < 60; ++i) {
        bench.master_writes(0, 10, ++word);
        bench.step();
    }
    EXPECT_EQ(bench.writes_of(10), 10u);
    EXPECT_EQ(bench.reads_of(1), 10u);
    EXPECT_EQ(seen().cycle, 6 * test::kAnswerTime) << "the cycle is the sum of its parameters (A-081)";
}

TEST_F(PollerOfOne, CountsEachWholeRoundByItsTimeThroughAllLayouts)
{
    bench.layout(0, 1, {1, 2, 3, 4}, {});
    bench.steps(4 * 3 + 1);
    EXPECT_EQ(seen().refresh_ms.count(), 3u);
    EXPECT_EQ(seen().refresh_ms.sum(), 3 * 80u) << "four answers of 20 ms in each";

    bench.layout(0, 2, {1}, {});
    bench.steps(2);
    EXPECT_EQ(seen().refresh_ms.count(), 4u) << "the start of another layout ends no round";
    EXPECT_EQ(seen().refresh_ms.sum(), 3 * 80u + 20);
}

TEST_F(PollerOfOne, WritesAChangeBeforeItReadsOn)
{
    bench.layout(0, 1, {1, 2, 3, 4, 5}, {10});
    bench.steps(2);
    bench.master_writes(0, 10, 9);
    bench.steps(1);
    EXPECT_EQ(bench.log.back().purpose, Purpose::output);
}

class PollerOfOneEveryCycle : public PollerOfOne {
protected:
    PollerOfOneEveryCycle() : PollerOfOne(unit(0s)) {}
};

TEST_F(PollerOfOneEveryCycle, WritesStandingOutputsEveryCycleAsTheOldBoardsDid)
{
    bench.layout(0, 1, {1, 2}, {10, 11});
    bench.master_writes(0, 10, 3);
    bench.steps(40);
    EXPECT_EQ(bench.writes_of(10), 10u);
    EXPECT_EQ(bench.writes_of(11), 10u);
    EXPECT_EQ(bench.reads_of(1), 10u);
    EXPECT_EQ(bench.reads_of(2), 10u);
}

// ---- refusals

TEST_F(PollerOfOne, GivesAnInvalidTagAs0AndTheOthersGoOn)
{
    drive().words.erase(6);
    bench.layout(0, 1, {5, 6, 7}, {});
    bench.run(1s);
    const auto inputs = bench.poller.take_inputs(0);
    EXPECT_TRUE(inputs->every_input_tried);
    EXPECT_EQ(inputs->words[0], 1005);
    EXPECT_EQ(inputs->words[1], 0);
    EXPECT_EQ(inputs->words[2], 1007);
    EXPECT_EQ(seen().states[1], WordState::invalid_tag);
    EXPECT_EQ(seen().states[2], WordState::good);
    EXPECT_EQ(bench.reads_of(6), 1u);
}

TEST_F(PollerOfOne, AsksForAnInvalidTagAgainNowAndThen)
{
    drive().words.erase(6);
    bench.layout(0, 1, {5, 6});
    bench.run(9s);
    EXPECT_EQ(bench.reads_of(6), 1u);
    drive().words[6] = 66;
    bench.run(2s);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[1], 66);
    EXPECT_EQ(seen().states[1], WordState::good);
}

TEST_F(PollerOfOne, DropsAnOutputWithAnInvalidTagAndNoticesACorrectedDrive)
{
    drive().words.erase(10);
    bench.layout(0, 1, {5}, {10, 11});
    bench.master_writes(0, 10, 1);
    bench.master_writes(0, 11, 2);
    bench.run(500ms);
    bench.master_writes(0, 10, 3);
    bench.run(8s);
    EXPECT_EQ(bench.writes_of(10), 1u);
    EXPECT_EQ(seen().states[1], WordState::invalid_tag);
    EXPECT_EQ(drive().words[11], 2);
    drive().words[10] = 0;
    bench.run(3s);
    EXPECT_EQ(drive().words[10], 3);
    EXPECT_EQ(seen().states[1], WordState::good);
}

TEST_F(PollerOfOne, KeepsARefusedWriteAsStateAndTriesItOnChangeAndRefresh)
{
    const std::pair<AccessError, WordState> list[] = {
        {AccessError::read_only, WordState::read_only},
        {AccessError::out_of_range, WordState::out_of_range},
        {AccessError::value_not_encoded, WordState::out_of_range},
        {AccessError::not_stopped, WordState::refused},
        {AccessError::not_config_mode, WordState::refused},
        {AccessError::unsupported_type, WordState::refused},
    };
    Generation generation = 0;
    for (const auto& [error, state] : list) {
        drive().write_errors[10] = error;
        bench.layout(0, ++generation, {5}, {10});
        bench.log.clear();
        bench.master_writes(0, 10, 1);
        bench.run(500ms);
        EXPECT_EQ(bench.writes_of(10), 1u);
        EXPECT_EQ(seen().states[1], state);
        bench.master_writes(0, 10, 2);
        bench.run(200ms);
        EXPECT_EQ(bench.writes_of(10), 2u);
        drive().write_errors.clear();
        bench.run(1100ms);
        EXPECT_EQ(drive().words[10], 2);
        EXPECT_EQ(seen().states[1], WordState::good);
    }
}

TEST_F(PollerOfOne, RepeatsAReadThatIsNotUnderstoodLikeSilence)
{
    bench.layout(0, 1, {5, 6});
    drive().not_understood = 2;
    bench.steps(3);
    EXPECT_EQ(bench.reads_of(5), 3u);
    EXPECT_EQ(seen().states[0], WordState::good);
    EXPECT_EQ(seen().losses, 0u);
}

TEST_F(PollerOfOne, HoldsAnInputThatIsNotUnderstoodAndTheOthersGoOn)
{
    bench.layout(0, 1, {5, 6});
    bench.steps(4);
    drive().read_errors[5] = AccessError::not_understood;
    drive().words[6] = 66;
    bench.log.clear();
    bench.run(9s);
    EXPECT_EQ(bench.reads_of(5), 3u) << "the retries, and then only now and then";
    EXPECT_GE(bench.reads_of(6), 400u);
    const auto inputs = bench.poller.take_inputs(0);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
    EXPECT_EQ(inputs->words[0], 1005);
    EXPECT_EQ(inputs->words[1], 66);
    EXPECT_EQ(seen().states[0], WordState::refused);
    EXPECT_EQ(seen().losses, 0u);
    bench.run(5s);
    EXPECT_EQ(bench.reads_of(5), 6u);
    drive().read_errors.clear();
    drive().words[5] = 55;
    bench.run(10s);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[0], 55);
    EXPECT_EQ(seen().states[0], WordState::good);
}

TEST_F(PollerOfOne, TriesEveryInputEvenIfNoneIsUnderstood)
{
    bench.layout(0, 1, {5, 6});
    drive().read_errors = {{5, AccessError::not_understood}, {6, AccessError::not_understood}};
    bench.run(1s);
    const auto inputs = bench.poller.take_inputs(0);
    EXPECT_TRUE(inputs->every_input_tried);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
    EXPECT_EQ(bench.reads_of(5), 3u);
    EXPECT_EQ(bench.reads_of(6), 3u);
}

class PollerOfOneWithoutRefresh : public PollerOfOne {
protected:
    PollerOfOneWithoutRefresh() : PollerOfOne(unit(3600s)) {}
};

TEST_F(PollerOfOneWithoutRefresh, RepeatsAnOutputThatIsNotUnderstoodSeldomUntilItIs)
{
    drive().write_errors[10] = AccessError::not_understood;
    bench.layout(0, 1, {5}, {10, 11});
    bench.master_writes(0, 10, 1);
    bench.run(9s);
    EXPECT_EQ(bench.writes_of(10), 3u);
    EXPECT_EQ(bench.writes_of(11), 1u);
    EXPECT_GE(bench.reads_of(5), 400u);
    EXPECT_EQ(seen().states[1], WordState::refused);
    EXPECT_EQ(seen().losses, 0u);
    bench.master_writes(0, 10, 2);
    bench.run(200ms);
    EXPECT_EQ(bench.writes_of(10), 6u) << "a new word is tried at once";
    drive().write_errors.clear();
    bench.run(11s);
    EXPECT_EQ(drive().words[10], 2) << "nothing that the drive has not taken is left at that";
    EXPECT_EQ(seen().states[1], WordState::good);
    EXPECT_EQ(bench.writes_of(10), 7u);
}

TEST_F(PollerOfOne, ShowsARefusedWriteOfAParameterThatIsAlsoRead)
{
    drive().write_errors[10] = AccessError::out_of_range;
    bench.layout(0, 1, {10});
    bench.images[0].layout.generation = 2;
    bench.images[0].layout.parameters[0].writes = true;
    bench.master_writes(0, 10, 5);
    bench.steps(4);
    EXPECT_EQ(seen().states[0], WordState::out_of_range);
    EXPECT_EQ(seen().words[0], 1010);
}

TEST_F(PollerOfOne, DecidesByTheTableWhatItHas)
{
    bench.layout(0, 1, {91, 92, 5}, {90, 92});
    bench.master_writes(0, 90, 1);
    bench.run(2s);
    EXPECT_EQ(bench.reads_of(91) + bench.reads_of(92) + bench.writes_of(90) + bench.writes_of(92), 0u);
    EXPECT_EQ(seen().states[0], WordState::refused) << "write-only";
    EXPECT_EQ(seen().states[1], WordState::refused) << "STRING";
    EXPECT_EQ(seen().states[3], WordState::read_only);
    EXPECT_EQ(seen().states[4], WordState::refused);
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
}

TEST_F(PollerOfOne, AsksForATagThatIsInNoTableUnderARowOfItsOwn)
{
    drive().words[500] = 0xABCD;
    bool listed = true;
    bench.meanwhile = [&listed](const Transaction& t) { listed = t.tag->listed; };
    bench.layout(0, 1, {500});
    bench.steps(1);
    EXPECT_FALSE(listed);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[0], 0xABCD);
}

class PollerOfListedTags : public PollerOfOne {
protected:
    static DriveSettings refusing()
    {
        DriveSettings settings = unit();
        settings.tags_only_from_table = true;
        return settings;
    }
    PollerOfListedTags() : PollerOfOne(refusing()) {}
};

TEST_F(PollerOfListedTags, RefusesOthersWithoutAskingTheDrive)
{
    drive().words[500] = 1;
    bench.layout(0, 1, {500, 5}, {501});
    bench.master_writes(0, 501, 1);
    bench.run(1s);
    EXPECT_EQ(bench.reads_of(500) + bench.writes_of(501), 0u);
    EXPECT_EQ(seen().states[0], WordState::invalid_tag);
    EXPECT_EQ(seen().states[2], WordState::invalid_tag);
    bench.poller.set_demand(0, {DemandOrder::Kind::read, 500, 0, 1, 1});
    EXPECT_EQ(bench.poller.take_demand_answer(0)->error, AccessError::invalid_tag);
}

// ---- layouts

TEST_F(PollerOfOne, ANewLayoutStartsUntried)
{
    bench.layout(0, 1, {5});
    bench.steps(2);
    (void)bench.poller.take_inputs(0);
    bench.layout(0, 2, {6, 7});
    const auto inputs = bench.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(inputs->generation, 2u);
    EXPECT_FALSE(inputs->every_input_tried);
    EXPECT_EQ(inputs->words[0], 0);
    EXPECT_EQ(seen().states[0], WordState::untried);
}

TEST_F(PollerOfOne, ALayoutWithoutInputsHasTriedThemAll)
{
    bench.steps(1);
    bench.layout(0, 1, {}, {10});
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
}

TEST_F(PollerOfOne, DropsAResultThatBelongsToTheOldLayout)
{
    bench.layout(0, 1, {5});
    bool changed = false;
    bench.meanwhile = [this, &changed](const Transaction&) {
        if (!changed) bench.layout(0, 2, {6});
        changed = true;
    };
    bench.steps(1);
    const auto inputs = bench.poller.take_inputs(0);
    ASSERT_TRUE(inputs);
    EXPECT_EQ(inputs->generation, 2u);
    EXPECT_FALSE(inputs->every_input_tried);
    EXPECT_EQ(inputs->words[0], 0) << "1005 belongs to tag 5 of the old layout";
}

TEST_F(PollerOfOne, AWriteUnderWayForTheOldLayoutDoesNotCountForTheNew)
{
    bench.layout(0, 1, {}, {10});
    bool changed = false;
    bench.meanwhile = [this, &changed](const Transaction& t) {
        if (changed || t.purpose != Purpose::output) return;
        changed = true;
        bench.layout(0, 2, {}, {10});
        bench.master_writes(0, 10, 6);
    };
    bench.master_writes(0, 10, 5);
    bench.run(200ms);
    EXPECT_EQ(drive().words[10], 6);
    EXPECT_EQ(bench.writes_of(10), 2u);
}

// ---- the line

TEST_F(PollerOfOne, ProbesAnIdleDriveSoThatTheLinkIsKnown)
{
    EXPECT_FALSE(bench.poller.take_inputs(0)) << "nothing is known yet";
    EXPECT_FALSE(seen().known);
    bench.run(5s);
    EXPECT_EQ(bench.purposes(), "ppppp");
    EXPECT_TRUE(seen().known);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
}

TEST_F(PollerOfOne, SaysWhenItHasSomethingToDo)
{
    bench.layout(0, 1, {}, {10});
    bench.master_writes(0, 10, 1);
    while (bench.step()) {
    }
    EXPECT_GT(bench.poller.next_deadline(), bench.now);
    EXPECT_LE(bench.poller.next_deadline(), bench.now + 1s);
    bench.now = bench.poller.next_deadline();
    EXPECT_TRUE(bench.step());
}

TEST_F(PollerOfOne, GivesOneTransactionAtATime)
{
    bench.layout(0, 1, {5});
    EXPECT_TRUE(bench.poller.next(bench.now));
    EXPECT_FALSE(bench.poller.next(bench.now));
    EXPECT_EQ(bench.poller.next_deadline(), kNever);
}

TEST(PollerOfNone, HasNothingToDo)
{
    Poller poller{{}, {}};
    EXPECT_FALSE(poller.next(Instant{}));
    EXPECT_EQ(poller.next_deadline(), kNever);
    EXPECT_FALSE(poller.operate({}));
}

TEST(PollerOfThree, GivesEachDriveOneTransactionATurn)
{
    PollerBench bench{{unit(), unit(), unit()}};
    for (auto& drive : bench.drives)
        for (int tag = 0; tag < 20; ++tag) drive.words[tag] = 1;
    bench.layout(0, 1, {1});
    bench.layout(1, 1, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    bench.layout(2, 1, {1, 2});
    bench.steps(30);
    for (std::size_t i = 0; i < bench.log.size(); ++i) EXPECT_EQ(bench.log[i].unit, i % 3);
}

TEST(PollerOfThree, ADeadDriveCostsTheOthersOnlyItsOwnTimeOuts)
{
    PollerBench bench{{unit(), unit(), unit()}};
    for (auto& drive : bench.drives)
        for (int tag = 0; tag < 20; ++tag) drive.words[tag] = 1;
    for (std::size_t i = 0; i < 3; ++i) bench.layout(i, 1, {1, 2, 3});
    bench.drives[1].alive = false;
    bench.run(60s);
    const auto silences = bench.count([](const test::Done& d) { return d.error == AccessError::no_answer; });
    const auto others = bench.count([](const test::Done& d) { return d.unit != 1; });
    // Three attempts, then a probe each second.
    EXPECT_GE(silences, 3u + 46u);
    EXPECT_LE(silences, 3u + 50u);
    EXPECT_GE(others, (60'000u - silences * 220u) / 20u - 2u) << "all the rest of the time is theirs";
    const auto first_lost = bench.poller.snapshot(1);
    EXPECT_EQ(first_lost.losses, 1u);
    EXPECT_FALSE(first_lost.answers);
}

TEST(PollerOfSix, FiveDeadDrivesLeaveTheLineToTheLivingOne)
{
    PollerBench bench{{unit(), unit(), unit(), unit(), unit(), unit()}};
    for (std::size_t i = 0; i < 6; ++i) {
        bench.drives[i].words = {{1, 1}, {2, 2}, {3, 3}};
        bench.drives[i].alive = i == 3;
        bench.layout(i, 1, {1, 2, 3});
    }
    bench.run(60s);
    bench.log.clear();
    bench.run(60s);
    const auto living = bench.count([](const test::Done& d) { return d.unit == 3; });
    EXPECT_GE(living * test::kAnswerTime, 40s);
}

} // namespace
} // namespace dpslave::drive
