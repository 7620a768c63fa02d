// SPDX-License-Identifier: Apache-2.0
/// A parameter of which each write counts (column `once`): a word goes out once for each change, whatever is
/// heard of it (rules of the drive line, section 2).
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

constexpr int kCounts = 10;

TagTable with_a_tag_that_counts()
{
    std::vector<Tag> rows = test::table_up_to(99).all();
    rows[kCounts].once = true;
    return TagTable{rows};
}

class Once : public testing::Test {
protected:
    explicit Once(ZeroAfter loss = 0s, bool compares = false)
        : tags(with_a_tag_that_counts()),
          bench({settings(loss, compares)}, {.max_tags = 20, .max_gap = 5, .max_written = 5})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
        enter(1);
    }
    DriveSettings settings(ZeroAfter loss, bool compares) const
    {
        DriveSettings one;
        one.tags = &tags;
        one.zero_after = loss;
        one.output_refresh = 500ms;
        one.compare_outputs = compares;
        return one;
    }
    void enter(Generation generation) { bench.layout(0, generation, {1}, {kCounts, 11}); }
    /// The word that counts; tag 11 beside it does not.
    void master_writes(int word)
    {
        bench.master_writes(0, 11, 6);
        bench.master_writes(0, kCounts, word);
        bench.run(5s);
    }
    void order(DemandOrder::Kind kind, int tag, int value = 0)
    {
        bench.poller.set_demand(0, {kind, static_cast<std::uint16_t>(tag), static_cast<std::uint16_t>(value),
                                    ++orders, bench.images[0].layout.generation});
        bench.run(5s);
    }
    AccessError demand_write(int word)
    {
        order(DemandOrder::Kind::write, kCounts, word);
        const auto answer = bench.poller.take_demand_answer(0);
        return answer ? answer->error : AccessError::none;
    }
    AccessError operate(int word)
    {
        bench.poller.operate({.number = ++orders,
                              .unit = 0,
                              .is_write = true,
                              .tag = kCounts,
                              .word = static_cast<std::uint16_t>(word)});
        bench.run(5s);
        const auto answer = bench.poller.take_operate_answer();
        return answer ? answer->error : AccessError::none;
    }
    std::vector<int> written() const
    {
        std::vector<int> words;
        for (const test::Done& done : bench.log)
            if (done.kind == Transaction::Kind::write && done.tag == kCounts) words.push_back(done.words[0]);
        return words;
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }

    TagTable tags;
    PollerBench bench;
    std::uint32_t orders = 0;
};

class OnceHold : public Once {
protected:
    OnceHold() : Once(std::nullopt) {}
};

class OnceCompared : public Once {
protected:
    OnceCompared() : Once(std::nullopt, true) {}
};

TEST_F(Once, AWordGoesOutOnceForEachChangeAndIsNotRefreshed)
{
    master_writes(5);
    EXPECT_GT(bench.writes_of(11), 5U) << "the other one is";
    master_writes(6);
    master_writes(5);
    EXPECT_EQ(written(), (std::vector{5, 6, 5}));
}

TEST_F(Once, AWordWhoseAckIsLostIsNotKnownAndNotRepeated)
{
    master_writes(5);
    drive().unanswered_writes = {kCounts};
    master_writes(6);
    EXPECT_EQ(written(), (std::vector{5, 6}));
    EXPECT_EQ(seen().states[1], WordState::stale);
    EXPECT_EQ(seen().errors[1], AccessError::not_known);
    EXPECT_TRUE(seen().answers) << "the drive is asked whether it is there, by something else";
    drive().unanswered_writes.clear();
    master_writes(7);
    EXPECT_EQ(seen().states[1], WordState::good);
    EXPECT_EQ(written(), (std::vector{5, 6, 7}));
}

TEST_F(Once, AWordThatTheDriveRefusesIsNotTriedAgain)
{
    drive().write_errors[kCounts] = AccessError::out_of_range;
    master_writes(5);
    EXPECT_EQ(written(), std::vector{5});
    EXPECT_EQ(seen().states[1], WordState::out_of_range);
}

TEST_F(Once, AWordThatWasNeverSentGoesOutWhenTheDriveIsBack)
{
    master_writes(5);
    drive().alive = false;
    bench.run(5s);
    master_writes(6);
    EXPECT_EQ(written(), std::vector{5}) << "it is lost";
    drive().alive = true;
    bench.run(5s);
    EXPECT_EQ(written(), (std::vector{5, 6}));
}

TEST_F(Once, AWordThatDidNotGetOnTheLineGoesOutWhenTheAdapterIsBack)
{
    master_writes(5);
    bench.unplugged = true;
    bench.master_writes(0, kCounts, 6);
    bench.steps(1);
    bench.unplugged = false;
    bench.log.clear();
    bench.run(5s);
    EXPECT_EQ(written(), std::vector{6});
}

TEST_F(Once, AWordThatWasSentIsGoodAgainWhenTheDriveIsBack)
{
    master_writes(5);
    drive().alive = false;
    bench.run(5s);
    EXPECT_EQ(seen().states[1], WordState::stale);
    drive().alive = true;
    bench.run(5s);
    EXPECT_EQ(seen().states[1], WordState::good);
    EXPECT_EQ(seen().words[1], 5);
}

TEST_F(Once, OfTwoOutputsWithTheSameTagOnlyTheLastIsWritten)
{
    bench.layout(0, 2, {1}, {kCounts, kCounts});
    bench.images[0].words[1] = 5;
    bench.images[0].words[2] = 6;
    bench.images[0].may_write = true;
    bench.send_outputs(0);
    bench.run(5s);
    EXPECT_EQ(written(), std::vector{6});
}

TEST_F(Once, AReloadThatAsksInAnotherWaySendsTheWord)
{
    master_writes(5);
    std::vector<Tag> rows = tags.all();
    rows[kCounts].decimals = 1;
    const TagTable other{rows};
    DriveSettings changed = settings(0s, false);
    changed.tags = &other;
    bench.poller.exchange({changed}, {0}, {});
    bench.run(5s);
    EXPECT_EQ(written(), (std::vector{5, 5}));
}

TEST_F(Once, AWriteOfTheOperatorThatIsNotReadBackIsNotSaidToBeUnanswered)
{
    drive().read_errors[kCounts] = AccessError::no_answer;
    EXPECT_EQ(operate(9), AccessError::not_known);
    EXPECT_EQ(written(), std::vector{9});
}

TEST_F(Once, NeitherALossOfTheDriveNorANewPortWritesAStandingWordAgain)
{
    master_writes(5);
    drive().alive = false;
    bench.run(5s);
    drive().alive = true;
    bench.run(5s);
    bench.poller.port_changed();
    bench.run(5s);
    EXPECT_EQ(written(), std::vector{5});
}

TEST_F(Once, ThePortThatIsLeftGetsTheZeroAndTheNewOneTheWord)
{
    master_writes(5);
    bench.poller.leave_port();
    bench.run(5s);
    bench.poller.port_changed();
    bench.run(5s);
    EXPECT_EQ(written(), (std::vector{5, 0, 5}));
}

TEST_F(Once, TheLossOfTheMasterWritesOneZeroThatIsNotRepeatedWhenItsAckIsLost)
{
    master_writes(5);
    drive().unanswered_writes = {kCounts};
    bench.master_leaves(0);
    bench.run(5s);
    drive().unanswered_writes.clear();
    bench.run(30s);
    EXPECT_EQ(written(), (std::vector{5, 0}));
}

TEST_F(Once, AZeroThatTheDriveDoesNotKeepIsNotWrittenAgain)
{
    master_writes(5);
    drive().not_kept = {kCounts};
    bench.master_leaves(0);
    bench.run(30s);
    EXPECT_EQ(written(), (std::vector{5, 0}));
}

TEST_F(OnceHold, ANewExchangeDoesNotWriteTheWordThatWasSentLast)
{
    master_writes(5);
    bench.master_leaves(0);
    enter(2);
    master_writes(5);
    EXPECT_EQ(written(), std::vector{5});
    EXPECT_EQ(seen().states[1], WordState::good);
    EXPECT_EQ(seen().words[1], 5);
    master_writes(6);
    EXPECT_EQ(written(), (std::vector{5, 6}));
}

TEST_F(OnceCompared, NoReadWritesTheWordAgain)
{
    master_writes(5);
    drive().words[kCounts] = 77; // by the front panel
    bench.run(70s);
    EXPECT_EQ(written(), std::vector{5});
    EXPECT_EQ(bench.reads_of(kCounts), 0U);
}

TEST_F(OnceCompared, TheWordIsNotPartOfABlock)
{
    bench.images[0].words[2] = 6;
    master_writes(5);
    EXPECT_EQ(bench.count([](const test::Done& done) {
        return done.kind == Transaction::Kind::write && done.tag == kCounts && done.count > 1;
    }),
              0U);
    EXPECT_EQ(bench.writes_of(kCounts), 1U);
}

TEST_F(Once, AReloadThatSaysSoDoesNotWriteTheStandingWordAgain)
{
    const TagTable plain = test::table_up_to(99);
    DriveSettings before = settings(0s, false);
    before.tags = &plain;
    bench.poller.exchange({before}, {0}, {});
    master_writes(5);
    bench.log.clear();
    bench.poller.exchange({settings(0s, false)}, {0}, {});
    bench.run(5s);
    EXPECT_EQ(written(), std::vector<int>{});
}

TEST_F(Once, AWriteOfDemandDataIsMadeOnceWhateverBecomesOfIt)
{
    drive().unanswered_writes = {kCounts};
    EXPECT_EQ(demand_write(9), AccessError::not_known);
    drive().unanswered_writes.clear();
    drive().not_kept = {kCounts};
    EXPECT_EQ(demand_write(8), AccessError::not_kept);
    EXPECT_EQ(written(), (std::vector{9, 8}));
}

TEST_F(Once, AWriteOfTheOperatorIsMadeOnceWhateverBecomesOfIt)
{
    drive().unanswered_writes = {kCounts};
    EXPECT_EQ(operate(9), AccessError::not_known);
    drive().unanswered_writes.clear();
    drive().not_kept = {kCounts};
    EXPECT_EQ(operate(8), AccessError::not_kept);
    EXPECT_EQ(written(), (std::vector{9, 8}));
}

} // namespace
} // namespace dpslave::drive
