// SPDX-License-Identifier: Apache-2.0
/// Demand Data and the orders of dpctl.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;
using Kind = DemandOrder::Kind;

class PollerOrders : public testing::Test {
protected:
    PollerOrders() : tags(make_tags()), bench(settings(tags))
    {
        for (auto& drive : bench.drives)
            for (int tag = 0; tag < 100; ++tag) drive.words[tag] = static_cast<std::uint16_t>(1000 + tag);
        bench.layout(0, 1, {1, 2, 3, 4, 5, 6}, {});
        bench.run(500ms);
        bench.log.clear();
    }
    static TagTable make_tags()
    {
        std::vector<Tag> rows = test::table_up_to(99).all();
        rows[90].access = Access::read_only;
        rows[91].access = Access::write_only;
        rows[92].type = TagType::string;
        rows[93].max = 10;
        return TagTable{rows};
    }
    static std::vector<DriveSettings> settings(const TagTable& tags)
    {
        DriveSettings one;
        one.tags = &tags;
        return {one, one};
    }
    void order(Kind kind, int tag, int value = 0)
    {
        bench.poller.set_demand(
            0, {kind, static_cast<std::uint16_t>(tag), static_cast<std::uint16_t>(value), ++number, 1});
    }
    std::vector<DemandAnswer> answers()
    {
        std::vector<DemandAnswer> all;
        while (const auto answer = bench.poller.take_demand_answer(0)) all.push_back(*answer);
        return all;
    }
    /// Transactions of the drive under test, as letters.
    std::string purposes() const
    {
        std::string out;
        for (const test::Done& done : bench.log)
            if (done.unit == 0) out += "iosdcwp"[static_cast<std::size_t>(done.purpose)];
        return out;
    }

    TagTable tags;
    PollerBench bench;
    std::uint32_t number = 0;
};

TEST_F(PollerOrders, ANewOrderGoesBeforeEverythingElseOfItsDrive)
{
    order(Kind::read, 50);
    bench.run(200ms);
    EXPECT_EQ(purposes().front(), 'd');
    ASSERT_FALSE(answers().empty());
}

/// The value may be from before the order.
TEST_F(PollerOrders, AReadIsNotAnsweredByAnAnswerThatMayBeToAnEarlierQuestion)
{
    bench.drives[0].is_behind = true;
    order(Kind::read, 50);
    bench.run(500ms);
    EXPECT_TRUE(answers().empty());
    EXPECT_GT(bench.reads_of(50), 1U) << "it is asked again";

    bench.drives[0].is_behind = false;
    bench.run(500ms);
    EXPECT_FALSE(answers().empty());
}

TEST_F(PollerOrders, ANewOrderGoesRightBehindTheRepetitionOfTheOneBefore)
{
    order(Kind::read, 50);
    bench.run(500ms);
    bench.meanwhile = [this](const Transaction& t) {
        if (t.purpose == Purpose::demand && t.tag->number == 50) order(Kind::read, 51);
    };
    bench.log.clear();
    bench.run(400ms);
    EXPECT_NE(purposes().find("dd"), std::string::npos);
    EXPECT_EQ(answers().back().value, 1051);
}

TEST_F(PollerOrders, ANewOrderGoesRightBehindAWriteOfTheCycle)
{
    bench.layout(0, 2, {1}, {2});
    bench.master_writes(0, 2, 7);
    bench.run(500ms);
    bench.log.clear();
    bool ordered = false;
    bench.meanwhile = [&](const Transaction& t) {
        if (t.purpose != Purpose::output || std::exchange(ordered, true)) return;
        bench.poller.set_demand(0, {Kind::read, 50, 0, 1, 2});
    };
    bench.master_writes(0, 2, 8);
    bench.run(100ms);
    ASSERT_TRUE(ordered);
    const std::string all = purposes();
    EXPECT_EQ(all.at(all.find('o') + 1), 'd') << all;
}

TEST_F(PollerOrders, AStandingReadIsRefreshedOnceARound)
{
    order(Kind::read, 50);
    bench.run(20ms * 7 * 10); // six inputs and the order, ten times
    const auto all = answers();
    EXPECT_GE(all.size(), 9u);
    EXPECT_LE(all.size(), 11u);
    for (const DemandAnswer& answer : all) {
        EXPECT_EQ(answer.number, 1u);
        EXPECT_EQ(answer.error, AccessError::none);
        EXPECT_EQ(answer.value, 1050);
    }
    EXPECT_EQ(bench.poller.snapshot(0).cycle, 7 * test::kAnswerTime)
        << "one transaction on top of the cycle (A-082)";
}

TEST_F(PollerOrders, AStandingReadFollowsTheDrive)
{
    order(Kind::read, 50);
    bench.run(500ms);
    (void)answers();
    bench.drives[0].words[50] = 7;
    bench.run(200ms);
    EXPECT_EQ(answers().back().value, 7);
}

TEST_F(PollerOrders, OrdersInARowNeverStarveTheCycle)
{
    for (int i = 0; i < 40; ++i) order(Kind::write, 50, i);
    bench.steps(200);
    const std::string all = purposes();
    EXPECT_EQ(all.find("dd"), std::string::npos) << "after each of them one cyclic transaction";
    const auto inputs = static_cast<std::size_t>(std::count(all.begin(), all.end(), 'i'));
    const auto demands = static_cast<std::size_t>(std::count(all.begin(), all.end(), 'd'));
    EXPECT_EQ(demands, 51u) << "each write and, as its answer is no proof, what the drive holds then";
    EXPECT_GE(inputs, 3 * (demands - 3)) << "two a round of six at most (A-082)";
}

TEST_F(PollerOrders, AWriteIsDoneAndAnsweredOnce)
{
    order(Kind::write, 50, 123);
    bench.run(5s);
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].number, 1u);
    EXPECT_EQ(all[0].value, 123);
    EXPECT_EQ(bench.writes_of(50), 1u);
    EXPECT_EQ(bench.drives[0].words[50], 123);
}

TEST_F(PollerOrders, AWriteIsNotLostWhenTheNextOrderComesBeforeItsTurn)
{
    order(Kind::write, 50, 1);
    order(Kind::write, 51, 2);
    order(Kind::cancel, 0);
    order(Kind::read, 52);
    order(Kind::write, 50, 3);
    bench.run(3s);
    EXPECT_EQ(bench.drives[0].words[50], 3);
    EXPECT_EQ(bench.drives[0].words[51], 2);
    EXPECT_EQ(bench.reads_of(52), 0u) << "it stands no longer";
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u) << "only the order that stands is answered";
    EXPECT_EQ(all[0].number, 5u);
}

TEST_F(PollerOrders, TheAnswerOfTheOrderThatStandsIsTheLastOne)
{
    bench.meanwhile = [this](const Transaction& t) {
        if (t.kind == Transaction::Kind::write && t.tag->number == 50) order(Kind::write, 90, 1);
    };
    order(Kind::write, 50, 7);
    bench.run(500ms); // while it is on its way comes one that the table answers at once
    EXPECT_EQ(bench.drives[0].words[50], 7);
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u) << "a mailbox keeps the newest: behind it nothing may come";
    EXPECT_EQ(all[0].number, 2u);
    EXPECT_EQ(all[0].error, AccessError::read_only);
}

TEST_F(PollerOrders, CancelEndsAStandingRead)
{
    order(Kind::read, 50);
    bench.run(500ms);
    (void)answers();
    order(Kind::cancel, 0);
    bench.log.clear();
    bench.run(1s);
    EXPECT_TRUE(answers().empty());
    EXPECT_EQ(bench.reads_of(50), 0u);
}

TEST_F(PollerOrders, WhatComesLateForAnOrderThatNoLongerStandsIsDropped)
{
    bench.meanwhile = [this](const Transaction& t) {
        if (t.purpose == Purpose::demand && t.tag->number == 50) order(Kind::read, 51);
    };
    order(Kind::read, 50);
    bench.run(500ms);
    for (const DemandAnswer& answer : answers()) EXPECT_EQ(answer.number, 2u);
}

TEST_F(PollerOrders, ErrorsOfTheDriveComeBackByName)
{
    bench.drives[0].words.erase(60);
    bench.drives[0].write_errors[61] = AccessError::out_of_range;
    order(Kind::read, 60);
    bench.run(200ms);
    EXPECT_EQ(answers().back().error, AccessError::invalid_tag);
    order(Kind::write, 61, 5);
    bench.run(200ms);
    const auto all = answers();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back().error, AccessError::out_of_range);
    EXPECT_EQ(all.back().number, 2u);
}

/// A tag that resets itself, or that rounds: nothing is wrong with its range.
TEST_F(PollerOrders, AWriteThatTheDriveTakesAndDoesNotKeepIsAnsweredSo)
{
    bench.drives[0].not_kept = {61};
    order(Kind::write, 61, 5);
    bench.run(2s);
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].error, AccessError::not_kept);
    EXPECT_EQ(all[0].value, 5) << "the word that was taken";

    ASSERT_TRUE(bench.poller.operate({.number = 9, .unit = 0, .is_write = true, .tag = 61, .word = 6}));
    bench.run(2s);
    const auto answer = bench.poller.take_operate_answer();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->error, AccessError::not_kept);
}

TEST_F(PollerOrders, WhatTheTableForbidsIsAnsweredWithoutTheDrive)
{
    order(Kind::write, 90, 1);
    EXPECT_EQ(answers().at(0).error, AccessError::read_only);
    order(Kind::read, 91);
    EXPECT_EQ(answers().at(0).error, AccessError::unsupported_type);
    order(Kind::read, 92);
    EXPECT_EQ(answers().at(0).error, AccessError::unsupported_type);
    bench.run(1s);
    EXPECT_TRUE(answers().empty());
    EXPECT_EQ(bench.writes_of(90) + bench.reads_of(91) + bench.reads_of(92), 0u);
}

TEST_F(PollerOrders, TheLimitsOfTheTableAreTheDrivesBusiness)
{
    order(Kind::write, 93, 11);
    bench.run(200ms);
    EXPECT_EQ(answers().back().error, AccessError::none);
    EXPECT_EQ(bench.drives[0].words[93], 11);
}

TEST_F(PollerOrders, ASilentDriveGivesNoAnswerAndTheWriteIsDoneAfterItsReturn)
{
    bench.drives[0].alive = false;
    order(Kind::write, 50, 9);
    bench.run(10s);
    EXPECT_TRUE(answers().empty());
    bench.drives[0].alive = true;
    bench.run(9s);
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].error, AccessError::none);
    EXPECT_EQ(bench.drives[0].words[50], 9);
}

TEST_F(PollerOrders, WritesThatNoLongerStandAreDroppedWhenTheDriveIsLost)
{
    bench.drives[0].alive = false;
    order(Kind::write, 50, 1); // start
    order(Kind::write, 50, 2); // stop
    order(Kind::write, 51, 3);
    bench.run(60s);
    EXPECT_EQ(bench.poller.snapshot(0).orders_dropped, 2u);
    bench.drives[0].alive = true;
    bench.run(10s);
    EXPECT_EQ(bench.drives[0].words[50], 1050);
    EXPECT_EQ(bench.drives[0].words[51], 3) << "the one that stands is done at the return";
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].number, 3u);
}

TEST_F(PollerOrders, AWriteThatIsSupersededWhileTheDriveIsLostIsDropped)
{
    bench.drives[0].alive = false;
    bench.run(5s);
    order(Kind::write, 50, 1);
    order(Kind::write, 51, 2);
    order(Kind::cancel, 0);
    EXPECT_EQ(bench.poller.snapshot(0).orders_dropped, 2u);
    order(Kind::write, 52, 3);
    order(Kind::read, 53);
    bench.drives[0].alive = true;
    bench.run(10s);
    EXPECT_EQ(bench.writes_of(50) + bench.writes_of(51) + bench.writes_of(52), 0u);
    EXPECT_EQ(answers().back().value, 1053);
    EXPECT_EQ(bench.poller.snapshot(0).orders_dropped, 3u);
}

TEST_F(PollerOrders, CountsTheWritesThatFindNoRoom)
{
    for (int i = 0; i < 70; ++i) order(Kind::write, 50, i);
    bench.run(30s);
    EXPECT_EQ(bench.poller.snapshot(0).orders_dropped, 6u);
    EXPECT_EQ(bench.writes_of(50), 64u);
    EXPECT_EQ(bench.drives[0].words[50], 69) << "the last one is what counts";
}

TEST_F(PollerOrders, AnOrderThatIsNotUnderstoodGivesNoAnswerAndIsTriedOnceARound)
{
    bench.drives[0].read_errors[50] = AccessError::not_understood;
    order(Kind::read, 50);
    bench.run(20ms * 7 * 10);
    EXPECT_TRUE(answers().empty()) << "the previous answer stays";
    EXPECT_GE(bench.reads_of(50), 9u);
    EXPECT_LE(bench.reads_of(50), 11u);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
    bench.drives[0].read_errors.clear();
    bench.run(200ms);
    EXPECT_EQ(answers().back().value, 1050);
}

TEST_F(PollerOrders, AWriteThatIsNotUnderstoodWaitsForItsTurnWhileItStands)
{
    bench.drives[0].not_understood = 5;
    order(Kind::write, 50, 9);
    bench.run(2s);
    const auto all = answers();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].error, AccessError::none);
    EXPECT_EQ(bench.drives[0].words[50], 9);
}

TEST_F(PollerOrders, AWriteThatIsNeverUnderstoodDoesNotStopTheOrdersBehindIt)
{
    bench.drives[0].write_errors[50] = AccessError::not_understood;
    order(Kind::write, 50, 1);
    bench.run(1s);
    order(Kind::write, 51, 2);
    bench.run(1s);
    EXPECT_EQ(bench.drives[0].words[51], 2);
    EXPECT_EQ(bench.poller.snapshot(0).orders_dropped, 1u);
    EXPECT_EQ(answers().size(), 1u);
}

TEST_F(PollerOrders, AWriteWhoseAnswerWasLostIsRepeated)
{
    bench.drives[0].lost_answers = 1;
    order(Kind::write, 50, 9);
    bench.run(2s);
    EXPECT_EQ(answers().size(), 1u);
    EXPECT_EQ(bench.writes_of(50), 2u);
}

TEST_F(PollerOrders, OrdersEndWithTheirLayout)
{
    order(Kind::read, 50);
    bench.run(200ms);
    (void)answers();
    bench.poller.left_data_exchange(0, {1});
    bench.log.clear();
    order(Kind::read, 51); // it comes late, of the layout that has ended
    bench.run(1s);
    EXPECT_EQ(bench.reads_of(50) + bench.reads_of(51), 0u);
    bench.poller.set_demand(0, {Kind::read, 52, 0, 99, 2}); // the order may come before the layout
    bench.layout(0, 2, {1});
    bench.run(200ms);
    ASSERT_FALSE(answers().empty());
}

TEST_F(PollerOrders, AnOrderWorksWithoutAnyParameter)
{
    bench.layout(0, 2, {});
    bench.poller.set_demand(0, {Kind::read, 50, 0, 7, 2});
    bench.run(1s);
    EXPECT_GE(answers().size(), 20u);
}

// ---- dpctl

TEST_F(PollerOrders, DpctlReadsAndWritesOneTag)
{
    EXPECT_TRUE(bench.poller.operate({.number = 1, .unit = 0, .is_write = false, .tag = 50}));
    EXPECT_TRUE(bench.poller.operate({.number = 2, .unit = 1, .is_write = true, .tag = 51, .word = 5}));
    bench.run(200ms);
    const auto first = bench.poller.take_operate_answer();
    const auto second = bench.poller.take_operate_answer();
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->number, 1u);
    EXPECT_EQ(first->word, 1050);
    EXPECT_EQ(second->number, 2u);
    EXPECT_EQ(second->error, AccessError::none);
    EXPECT_EQ(bench.drives[1].words[51], 5);
    EXPECT_FALSE(bench.poller.take_operate_answer());
}

TEST_F(PollerOrders, DpctlComesAfterDemandData)
{
    EXPECT_TRUE(bench.poller.operate({.number = 1, .unit = 0, .tag = 50}));
    order(Kind::write, 51, 1);
    bench.run(200ms);
    const std::string all = purposes();
    EXPECT_EQ(all.substr(0, 5), "didic") << "the write is read back";
}

TEST_F(PollerOrders, ReportErrorsAndTheSilenceOfADriveToDpctl)
{
    bench.drives[0].words.erase(60);
    EXPECT_TRUE(bench.poller.operate({.number = 1, .unit = 0, .tag = 60}));
    EXPECT_TRUE(bench.poller.operate({.number = 2, .unit = 0, .is_write = true, .tag = 90}));
    bench.run(300ms);
    EXPECT_EQ(bench.poller.take_operate_answer()->error, AccessError::read_only) << "by the table, at once";
    EXPECT_EQ(bench.poller.take_operate_answer()->error, AccessError::invalid_tag);
    bench.drives[0].alive = false;
    EXPECT_TRUE(bench.poller.operate({.number = 3, .unit = 0, .tag = 50}));
    bench.run(1500ms);
    EXPECT_EQ(bench.poller.take_operate_answer()->error, AccessError::no_answer);
    EXPECT_TRUE(bench.poller.operate({.number = 4, .unit = 0, .tag = 50}));
    EXPECT_EQ(bench.poller.take_operate_answer()->error, AccessError::no_answer)
        << "known to be lost: at once";
}

TEST_F(PollerOrders, ReportAfterTheRetriesThatTheDriveDidNotUnderstand)
{
    bench.drives[0].write_errors[50] = AccessError::not_understood;
    EXPECT_TRUE(bench.poller.operate({.number = 1, .unit = 0, .is_write = true, .tag = 50, .word = 1}));
    bench.run(1s);
    EXPECT_EQ(bench.poller.take_operate_answer()->error, AccessError::not_understood);
    EXPECT_EQ(bench.writes_of(50), 3u);
}

TEST_F(PollerOrders, OfDpctlThatAreWithdrawnAreNeitherCarriedOutNorAnswered)
{
    for (std::uint32_t n = 1; n <= 3; ++n)
        ASSERT_TRUE(bench.poller.operate({n, 0, true, static_cast<std::uint16_t>(20 + n), 5}));
    bench.poller.survey(0, 4, 30);
    bench.poller.withdraw(2);
    bench.poller.withdraw(1);
    bench.run(1s);

    std::vector<std::uint32_t> answered;
    while (const auto answer = bench.poller.take_operate_answer()) answered.push_back(answer->number);
    EXPECT_EQ(answered, (std::vector<std::uint32_t>{3, 4}));
    EXPECT_EQ(bench.drives[0].words[21], 1021);
    EXPECT_EQ(bench.drives[0].words[22], 1022);
    EXPECT_EQ(bench.drives[0].words[23], 5);

    bench.poller.survey(0, 5, 30);
    bench.poller.withdraw(5);
    bench.run(1s);
    EXPECT_FALSE(bench.poller.take_operate_answer());
}

TEST_F(PollerOrders, OfDpctlThatIsWithdrawnBetweenItsWriteAndTheProofIsNotSentAgain)
{
    bench.drives[0].not_kept.insert(21);
    ASSERT_TRUE(bench.poller.operate({1, 0, true, 21, 5}));
    while (bench.writes_of(21) == 0) bench.step();
    bench.poller.withdraw(1);
    bench.run(1s);

    EXPECT_EQ(bench.writes_of(21), 1u);
    EXPECT_EQ(bench.reads_of(21), 0u);
    EXPECT_FALSE(bench.poller.take_operate_answer());
}

TEST_F(PollerOrders, OfDemandDataThatNewerOnesHaveTakenThePlaceOfAreDroppedWhereNobodyWaitsForThem)
{
    order(Kind::write, 20, 5);
    order(Kind::write, 21, 6);
    bench.poller.not_asked(0, bench.now);
    bench.run(3s);
    EXPECT_EQ(bench.drives[0].words[20], 1020);
    EXPECT_EQ(bench.drives[0].words[21], 6);
    EXPECT_EQ(bench.poller.snapshot(0).orders_dropped, 1u);
}

TEST_F(PollerOrders, DpctlCannotPileUpOrders)
{
    int taken = 0;
    for (std::uint32_t i = 0; i < 100; ++i)
        taken += bench.poller.operate({.number = i, .unit = 0, .tag = 50}) ? 1 : 0;
    EXPECT_EQ(taken, 16);
    EXPECT_FALSE(bench.poller.operate({.number = 1, .unit = 2, .tag = 50})) << "there is no such drive";
    bench.run(3s);
    while (bench.poller.take_operate_answer()) --taken;
    EXPECT_EQ(taken, 0);
    EXPECT_TRUE(bench.poller.operate({.number = 1, .unit = 0, .tag = 50}));
}

} // namespace
} // namespace dpslave::drive
