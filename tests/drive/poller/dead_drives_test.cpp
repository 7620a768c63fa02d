// SPDX-License-Identifier: Apache-2.0
/// Tests what drives that do not answer may cost those that do, and what cannot be asked for the sake of an
/// owed answer.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

const TagTable& rows_of_100()
{
    static const TagTable rows = test::table_up_to(99);
    return rows;
}

DriveSettings drive_of_line()
{
    DriveSettings settings;
    settings.tags = &rows_of_100();
    settings.probe_interval = 2s;
    return settings;
}

class SixDrives : public testing::Test {
protected:
    /// The first one lives; the others are known to be dead.
    SixDrives()
    {
        for (std::size_t i = 0; i < 6; ++i) {
            bench.drives[i].words = {{1, 1}, {2, 2}, {3, 3}, {10, 0}};
            bench.drives[i].alive = i == 0;
            bench.layout(i, 1, {1, 2, 3}, {10});
            bench.master_writes(i, 10, 1);
        }
        bench.run(30s);
        bench.log.clear();
    }
    /// From now until the living drive has the word.
    std::chrono::nanoseconds time_until_it_holds(std::uint16_t word)
    {
        const Instant began = bench.now;
        while (bench.drives[0].words[10] != word && bench.now < began + 10s) bench.run(1ms);
        return bench.now - began;
    }
    PollerBench bench{{drive_of_line(), drive_of_line(), drive_of_line(), drive_of_line(), drive_of_line(),
                       drive_of_line()}};
};

TEST_F(SixDrives, AChangedOutputReachesTheLivingOneTwoTimeOutsLaterAtMost)
{
    for (std::uint16_t word = 100; word < 160; ++word) {
        bench.master_writes(0, 10, word);
        EXPECT_LE(time_until_it_holds(word), 2 * test::kSilenceTime + 5 * test::kAnswerTime);
        bench.run(173ms);
    }
}

TEST_F(SixDrives, SoDoesTheZeroAfterTheLossOfTheMaster)
{
    for (std::size_t i = 0; i < 6; ++i) bench.master_leaves(i);
    EXPECT_LE(time_until_it_holds(0), 2 * test::kSilenceTime + 5 * test::kAnswerTime);
}

TEST_F(SixDrives, BetweenTwoProbesLieAProbeIntervalAndTheOneThatWaitedLongestIsNext)
{
    bench.run(60s);
    std::vector<std::size_t> probed;
    Instant last{};
    for (const test::Done& done : bench.log) {
        if (done.purpose != Purpose::probe) continue;
        if (!probed.empty()) {
            EXPECT_GE(done.at - last, 2s + test::kSilenceTime);
        }
        last = done.at;
        probed.push_back(done.unit);
    }
    ASSERT_GE(probed.size(), 20u);
    for (std::size_t i = 5; i < probed.size(); ++i) EXPECT_EQ(probed[i], probed[i - 5]);
}

TEST_F(SixDrives, BetweenTwoTimeOutsTheLivingOneHasItsRound)
{
    for (std::size_t i = 1; i < 6; ++i) bench.drives[i].alive = true;
    bench.run(30s);
    bench.log.clear();
    for (std::size_t i = 1; i < 6; ++i) bench.drives[i].alive = false; // all at once
    bench.run(20s);
    std::size_t reads = 0;
    unsigned silences = 0;
    for (const test::Done& done : bench.log) {
        if (done.unit == 0) ++reads;
        if (done.error != AccessError::no_answer) continue;
        if (++silences > 5) {
            EXPECT_GE(reads, 1u) << "beyond the one that each of them may add in this round";
        }
        reads = 0;
    }
    EXPECT_GE(silences, 15u);
}

TEST_F(SixDrives, NothingIsWrittenToADeadOneAndEverythingWhenItReturns)
{
    bench.master_writes(3, 10, 77);
    bench.run(5s);
    EXPECT_EQ(
        bench.count([](const test::Done& d) { return d.unit == 3 && d.kind == Transaction::Kind::write; }),
        0u);
    bench.drives[3].alive = true;
    bench.run(30s);
    EXPECT_EQ(bench.drives[3].words[10], 77);
}

class OneDrive : public testing::Test {
protected:
    OneDrive()
    {
        bench.drives[0].words = {{1, 11}, {2, 22}, {10, 0}};
        bench.layout(0, 1, {1, 2}, {10});
        bench.run(1s);
    }
    /// What next() gives now, with this outcome.
    Transaction next(AccessError error)
    {
        const auto transaction = bench.poller.next(bench.now);
        EXPECT_TRUE(transaction);
        std::array<std::uint16_t, 1> words{};
        bench.poller.done({error, words}, bench.now);
        return *transaction;
    }
    PollerBench bench{{drive_of_line()}};
};

TEST_F(OneDrive, WhatIsDeferredIsHeldMarkedAndCountedNeitherAsSilenceNorAsRefusal)
{
    const DriveSnapshot before = bench.poller.snapshot(0);
    for (int i = 0; i < 20; ++i) {
        if (bench.poller.next_deadline() > bench.now) bench.now = bench.poller.next_deadline();
        next(AccessError::deferred);
    }
    const DriveSnapshot& after = bench.poller.snapshot(0);
    EXPECT_EQ(after.silences, before.silences);
    EXPECT_EQ(after.refusals, before.refusals);
    EXPECT_TRUE(after.answers);
    EXPECT_EQ(after.words[0], 11);
    EXPECT_EQ(after.states[0], WordState::stale);
    EXPECT_EQ(after.errors[0], AccessError::deferred);
    bench.run(100ms);
    EXPECT_EQ(bench.poller.snapshot(0).states[0], WordState::good);
}

TEST_F(OneDrive, ADeferredTagLetsTheOthersGoFirst)
{
    const Transaction first = next(AccessError::deferred);
    const auto second = bench.poller.next(bench.now);
    ASSERT_TRUE(second);
    EXPECT_NE(second->tag, first.tag);
}

TEST_F(OneDrive, WhereNothingCanBeAskedItRestsInsteadOfTurningRound)
{
    int transactions = 0;
    const Instant end = bench.now + 1s;
    while (bench.now < end) {
        if (bench.poller.next(bench.now)) {
            ++transactions;
            bench.poller.done({AccessError::deferred, {}}, bench.now);
        } else {
            bench.now = std::max(bench.now + 1us, bench.poller.next_deadline());
        }
    }
    EXPECT_LT(transactions, 400);
}

TEST_F(OneDrive, BetweenTwoWritesThereIsARead)
{
    bench.layout(0, 2, {1, 2, 3}, {10, 11});
    bench.drives[0].words = {{1, 1}, {2, 2}, {3, 3}, {10, 0}, {11, 0}};
    for (int i = 1; i < 50; ++i) {
        for (const int tag : {10, 11}) bench.master_writes(0, tag, i);
        bench.log.clear();
        bench.steps(4);
        EXPECT_EQ(bench.purposes().find("oo"), std::string::npos) << bench.purposes();
    }
}

TEST_F(OneDrive, AWriteOfDemandDataIsReadBackAndRepeatedUntilItIsHeld)
{
    bench.drives[0].words[50] = 1;
    bench.drives[0].not_kept = {50};
    bench.poller.set_demand(
        0, {.kind = DemandOrder::Kind::write, .tag = 50, .value = 9, .number = 1, .generation = 1});
    bench.run(40ms);
    EXPECT_FALSE(bench.poller.take_demand_answer(0)) << "an ACK is no proof";
    bench.drives[0].not_kept.clear();
    bench.run(500ms);
    const auto answer = bench.poller.take_demand_answer(0);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->error, AccessError::none);
    EXPECT_EQ(bench.drives[0].words[50], 9);
}

} // namespace
} // namespace dpslave::drive
