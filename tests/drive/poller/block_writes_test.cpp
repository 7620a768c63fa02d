// SPDX-License-Identifier: Apache-2.0
/// Block writes: adjoining outputs in one transaction, where the cyclic read proves what became of each.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerBlockWrites : public testing::Test {
protected:
    explicit PollerBlockWrites(bool compare = true, int retries = 2)
        : tags(make_tags()),
          bench({settings(tags, compare, retries)}, {.max_tags = 16, .max_gap = 2, .max_written = 8})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
    }
    static TagTable make_tags()
    {
        std::vector<Tag> rows = test::table_up_to(99).all();
        rows[31].modbus_register = std::uint16_t{0x803E};
        rows[41].access = Access::write_only;
        return TagTable{rows};
    }
    static DriveSettings settings(const TagTable& tags, bool compare, int retries)
    {
        DriveSettings one;
        one.retries = retries;
        one.tags = &tags;
        one.compare_outputs = compare;
        one.output_refresh = 60s;
        return one;
    }
    static std::vector<int> from_to(int first, int last)
    {
        std::vector<int> all(static_cast<std::size_t>(last - first + 1));
        std::iota(all.begin(), all.end(), first);
        return all;
    }
    /// Output words tag + `offset`, all set at once.
    void master_writes_all(int offset)
    {
        OutputImage& image = bench.images[0];
        image.may_write = true;
        for (std::size_t i = 0; i < image.layout.count; ++i)
            image.words[i] = static_cast<std::uint16_t>(image.layout.parameters[i].tag + offset);
        bench.send_outputs(0);
    }
    /// "10+4 20": the writes of the log, first tag and count; a refused or silent one with a mark.
    std::string writes()
    {
        std::string out;
        for (const test::Done& done : bench.log) {
            if (done.kind != Transaction::Kind::write) continue;
            out += (out.empty() ? "" : " ") + std::to_string(done.tag) +
                   (done.count > 1 ? "+" + std::to_string(done.count) : "") +
                   (done.error != AccessError::none ? "!" : "");
            EXPECT_EQ(done.words.size(), done.count);
        }
        bench.log.clear();
        return out;
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const DriveSnapshot& seen() { return bench.poller.snapshot(0); }

    TagTable tags;
    PollerBench bench;
};

TEST_F(PollerBlockWrites, JoinAdjoiningOutputsInTheOrderOfTheirTags)
{
    bench.layout(0, 1, {1}, {13, 10, 12, 11, 20});
    master_writes_all(100);
    bench.steps(5); // the reads come first, and show that all of them differ
    ASSERT_EQ(bench.log[2].count, 4);
    EXPECT_EQ(bench.log[2].words, (std::vector<std::uint16_t>{110, 111, 112, 113}));
    EXPECT_EQ(writes(), "10+4 20");
    bench.run(60s);
    EXPECT_EQ(writes(), "") << "the reads have proven all of them";
    for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(seen().states[i], WordState::good);
    EXPECT_EQ(seen().writes, 2u);
}

TEST_F(PollerBlockWrites, AreNoLongerThanTheRule)
{
    bench.layout(0, 1, {1}, from_to(10, 29));
    master_writes_all(100);
    bench.run(1s);
    EXPECT_EQ(writes(), "10+8 18+8 26+4");
    EXPECT_EQ(drive().words[29], 129);
}

TEST_F(PollerBlockWrites, TakeOnlyWhatIsDue)
{
    bench.layout(0, 1, {1}, from_to(10, 14));
    master_writes_all(100);
    bench.run(1s);
    (void)writes();
    bench.master_writes(0, 12, 5);
    bench.run(1s);
    EXPECT_EQ(writes(), "12");
    drive().words[11] = drive().words[12] = drive().words[14] = 0; // changed at the panel
    bench.run(1s);
    EXPECT_EQ(writes(), "11+2 14");
}

TEST_F(PollerBlockWrites, LeaveOutATagWithARegisterOfItsOwn)
{
    bench.layout(0, 1, {1}, from_to(30, 33));
    master_writes_all(100);
    bench.run(1s);
    EXPECT_EQ(writes(), "30 31 32+2");
    bench.run(1s);
    const auto in_a_block = [](const test::Done& d) {
        return d.tag <= 31 && 31 < d.tag + d.count && d.count > 1;
    };
    EXPECT_EQ(bench.count(in_a_block), 0u) << "nor is it read in one";
    EXPECT_EQ(drive().words[31], 131);
}

TEST_F(PollerBlockWrites, LeaveOutAWriteOnlyTagThatCannotBeReadBack)
{
    bench.layout(0, 1, {1}, from_to(40, 42));
    master_writes_all(100);
    bench.run(1s);
    EXPECT_EQ(writes(), "41 40 42") << "nor compared before it is written first";
}

TEST_F(PollerBlockWrites, ThatAreRefusedAreRepeatedAsSingleWritesWhichDecide)
{
    drive().write_errors[12] = AccessError::read_only;
    bench.layout(0, 1, {1}, from_to(10, 14));
    master_writes_all(100);
    bench.run(500ms);
    EXPECT_EQ(writes(), "10+5! 10 11 12! 13 14");
    EXPECT_EQ(seen().states[2], WordState::good);
    EXPECT_EQ(seen().states[3], WordState::read_only);
    EXPECT_EQ(seen().states[4], WordState::good);
    EXPECT_EQ(drive().words[14], 114);
    EXPECT_EQ(seen().losses, 0u);
    bench.run(20s);
    (void)writes();
    master_writes_all(200);
    bench.run(500ms);
    EXPECT_EQ(writes(), "10+2 12! 13+2") << "the one that is refused stays alone";
}

TEST_F(PollerBlockWrites, ThatAreNotUnderstoodAreRepeatedAsSingleWrites)
{
    bench.layout(0, 1, {1}, from_to(10, 12));
    master_writes_all(100);
    bench.run(1s);
    (void)writes();
    drive().not_understood = 1;
    master_writes_all(200);
    bench.run(1s);
    EXPECT_EQ(writes(), "10+3! 10 11 12");
}

TEST_F(PollerBlockWrites, WhatTheDriveDropsInSilenceIsFoundByTheReadAndWrittenAlone)
{
    drive().not_kept = {12, 13};
    bench.layout(0, 1, {1}, from_to(10, 14));
    master_writes_all(100);
    bench.run(200ms);
    EXPECT_EQ(writes(), "10+5");
    drive().not_kept.clear();
    drive().write_errors[12] = AccessError::not_config_mode;
    bench.run(500ms);
    EXPECT_EQ(writes(), "12! 13") << "they adjoin, but only a single write proves it";
    EXPECT_EQ(drive().words[13], 113);
    EXPECT_EQ(seen().errors[3], AccessError::not_config_mode);
    EXPECT_EQ(seen().errors[2], AccessError::none);
}

TEST_F(PollerBlockWrites, AnInvalidTagInABlockIsFoundByItsSingleWrite)
{
    drive().words.erase(12);
    bench.layout(0, 1, {1}, from_to(10, 14));
    master_writes_all(100);
    bench.run(2s);
    EXPECT_EQ(writes(), "10+2 12! 13+2");
    EXPECT_EQ(seen().states[3], WordState::invalid_tag);
    EXPECT_EQ(drive().words[13], 113);
    master_writes_all(200);
    bench.run(1s);
    EXPECT_EQ(writes(), "10+2 13+2");
}

TEST_F(PollerBlockWrites, ThatAreNotAnsweredAreRepeatedAsSingleWritesBeforeTheDriveIsLost)
{
    drive().answers_blocks = false;
    bench.layout(0, 1, {1}, from_to(10, 12));
    master_writes_all(100);
    bench.run(2s);
    EXPECT_EQ(writes(), "10+3! 10 11 12");
    EXPECT_EQ(seen().losses, 0u);
    EXPECT_EQ(drive().words[12], 112);
}

TEST_F(PollerBlockWrites, EndForADriveThatNeverTakesThem)
{
    for (const bool silent : {true, false}) {
        drive().answers_blocks = !silent;
        drive().refuses_blocks = silent ? AccessError::none : AccessError::unsupported_type;
        bench.layout(0, silent ? 1 : 2, {1}, from_to(10, 11));
        bench.log.clear();
        for (int i = 1; i <= 10; ++i) {
            master_writes_all(100 * i);
            bench.run(1s);
            EXPECT_EQ(drive().words[11], 100 * i + 11);
        }
        EXPECT_EQ(bench.count([](const test::Done& d) {
            return d.purpose == Purpose::output && d.count > 1 && d.kind == Transaction::Kind::write;
        }),
                  3u);
    }
    EXPECT_EQ(seen().losses, 0u);
}

TEST_F(PollerBlockWrites, AWordThatChangedWhileItsBlockWasOnItsWayIsWritten)
{
    bench.layout(0, 1, {1}, from_to(10, 12));
    bool changed = false;
    bench.meanwhile = [&](const Transaction& t) {
        if (changed || t.words.size() < 2) return;
        changed = true;
        bench.master_writes(0, 11, 7);
        EXPECT_EQ(t.words[1], 111) << "valid until done()";
    };
    master_writes_all(100);
    bench.run(1s);
    EXPECT_EQ(writes(), "10+3 11");
    EXPECT_EQ(drive().words[11], 7);
}

TEST_F(PollerBlockWrites, ABlockUnderWayForTheOldLayoutDoesNotCountForTheNew)
{
    bench.layout(0, 1, {1}, from_to(10, 12));
    bool changed = false;
    bench.meanwhile = [&](const Transaction& t) {
        if (changed || t.words.size() < 2) return;
        changed = true;
        bench.layout(0, 2, {1}, {12, 11});
        master_writes_all(200);
        EXPECT_EQ(t.words[2], 112) << "valid until done()";
    };
    master_writes_all(100);
    bench.run(1s);
    EXPECT_EQ(drive().words[11], 211);
    EXPECT_EQ(drive().words[12], 212);
    EXPECT_EQ(drive().words[10], 0) << "its layout has ended";
}

TEST_F(PollerBlockWrites, AreTakenUpAgainWhenTheDriveReturns)
{
    bench.layout(0, 1, {1}, from_to(10, 12));
    drive().alive = false;
    master_writes_all(100);
    bench.run(5s);
    bench.log.clear();
    drive().alive = true;
    bench.run(9s);
    EXPECT_EQ(writes(), "10+3");
    EXPECT_EQ(drive().words[10], 110);
    EXPECT_EQ(drive().words[12], 112);
}

class PollerWithoutRetries : public PollerBlockWrites {
protected:
    PollerWithoutRetries() : PollerBlockWrites(true, 0) {}
};

TEST_F(PollerWithoutRetries, EndsBlocksForADriveThatIsLostOnEachOfThem)
{
    drive().answers_blocks = false;
    bench.layout(0, 1, {1}, from_to(10, 12));
    for (int i = 1; i <= 20; ++i) {
        master_writes_all(100 * i);
        bench.run(10s);
        EXPECT_EQ(drive().words[12], 100 * i + 12);
    }
    EXPECT_LE(seen().losses, 3u) << "kMaxFailedBlocks";
}

class PollerSingleWrites : public PollerBlockWrites {
protected:
    PollerSingleWrites() : PollerBlockWrites(false) {}
};

TEST_F(PollerSingleWrites, AreAllThereIsWhereOutputsAreNotCompared)
{
    bench.layout(0, 1, {1}, from_to(10, 12));
    master_writes_all(100);
    bench.run(1s);
    EXPECT_EQ(writes(), "10 11 12");
}

} // namespace
} // namespace dpslave::drive
