// SPDX-License-Identifier: Apache-2.0
/// Watched tags: read for diagnosis and lamps beside what the master asks for.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerWatch : public testing::Test {
protected:
    explicit PollerWatch(std::vector<std::uint16_t> watched = {40, 75}, BlockRule rule = {})
        : tags(make_tags()), bench({settings(tags, std::move(watched))}, rule)
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
    }
    static TagTable make_tags()
    {
        std::vector<Tag> rows = test::table_up_to(99).all();
        rows[91].access = Access::write_only;
        return TagTable{rows};
    }
    static DriveSettings settings(const TagTable& tags, std::vector<std::uint16_t> watched)
    {
        DriveSettings one;
        one.tags = &tags;
        one.watched = std::move(watched);
        return one;
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    const Watched& seen(std::size_t i) { return bench.poller.snapshot(0).watched[i]; }

    TagTable tags;
    PollerBench bench;
};

TEST_F(PollerWatch, ReadsWithoutALayoutFourTimesASecondAtMost)
{
    EXPECT_EQ(seen(0).state, WordState::untried);
    bench.run(10s);
    EXPECT_EQ(bench.reads_of(40), 40u);
    EXPECT_EQ(bench.reads_of(75), 40u);
    EXPECT_EQ(bench.purposes().find_first_not_of('w'), std::string::npos) << "they are the probe as well";
    EXPECT_EQ(seen(0).word, 1040);
    EXPECT_EQ(seen(1).word, 1075);
    EXPECT_EQ(seen(1).state, WordState::good);
    EXPECT_EQ(bench.poller.snapshot(0).cycle, 0ns) << "no parameter, no cycle";
}

TEST_F(PollerWatch, ReadsOnceARoundWithALayout)
{
    bench.layout(0, 1, {1, 2});
    bench.run(2s);
    EXPECT_GE(bench.reads_of(1), 24u);
    EXPECT_LE(bench.reads_of(1) - bench.reads_of(40), 1u);
    EXPECT_LE(bench.reads_of(1) - bench.reads_of(75), 1u);
}

TEST_F(PollerWatch, ReadsATagThatIsAlsoAnInputOnce)
{
    bench.layout(0, 1, {40, 1, 75});
    bench.steps(9);
    EXPECT_EQ(bench.reads_of(40), 3u);
    EXPECT_EQ(bench.reads_of(1), 3u);
    EXPECT_EQ(bench.reads_of(75), 3u);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[0], 1040);
    EXPECT_EQ(seen(0).word, 1040);
    EXPECT_EQ(bench.purposes(), "iiiiiiiii");
}

TEST_F(PollerWatch, StaysCalmWithALayoutThatReadsNothing)
{
    bench.layout(0, 1, {}, {10});
    bench.master_writes(0, 10, 1);
    bench.run(10s);
    EXPECT_LE(bench.reads_of(40), 41u);
    EXPECT_EQ(drive().words[10], 1);
}

TEST_F(PollerWatch, FollowsTheDrive)
{
    bench.run(1s);
    drive().words[75] = 0x4030;
    bench.run(300ms);
    EXPECT_EQ(seen(1).word, 0x4030);
}

TEST_F(PollerWatch, ChangesNeitherInputsNorTheirBeingTried)
{
    bench.layout(0, 1, {1});
    bench.steps(1);
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried) << "40 and 75 were not read yet";
    bench.steps(10);
    drive().words[40] = 7;
    bench.steps(10);
    EXPECT_EQ(seen(0).word, 7);
    EXPECT_FALSE(bench.poller.take_inputs(0)) << "no input changed";
}

TEST_F(PollerWatch, KeepsTheLastWordOverANewLayoutAndASilentDrive)
{
    bench.run(1s);
    bench.layout(0, 1, {1});
    EXPECT_EQ(seen(0).word, 1040);
    EXPECT_EQ(seen(0).state, WordState::good);
    bench.run(1s);
    drive().alive = false;
    bench.run(3s);
    EXPECT_EQ(seen(0).word, 1040);
    EXPECT_EQ(seen(0).state, WordState::stale);
    bench.layout(0, 2, {2});
    bench.poller.set_outputs(0, {});
    bench.run(1s);
    EXPECT_EQ(seen(0).word, 1040);
    drive().alive = true;
    drive().words[40] = 3;
    bench.run(9s);
    EXPECT_EQ(seen(0).word, 3);
    EXPECT_EQ(seen(0).state, WordState::good);
}

TEST_F(PollerWatch, ARefusedTagShowsItAndDisturbsNothing)
{
    drive().words.erase(40);
    drive().read_errors[75] = AccessError::not_understood;
    bench.layout(0, 1, {1, 2}, {10});
    bench.master_writes(0, 10, 5);
    bench.run(9s);
    EXPECT_EQ(seen(0).state, WordState::invalid_tag);
    EXPECT_EQ(seen(1).state, WordState::refused);
    EXPECT_EQ(bench.reads_of(40), 1u);
    EXPECT_EQ(bench.reads_of(75), 3u) << "the retries, and then only now and then";
    EXPECT_GE(bench.reads_of(1), 200u);
    EXPECT_TRUE(bench.poller.snapshot(0).answers);
    const auto inputs = bench.poller.take_inputs(0);
    EXPECT_TRUE(inputs->every_input_tried);
    EXPECT_EQ(inputs->words[1], 1002);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(bench.poller.snapshot(0).errors[i], AccessError::none);
    drive().words[40] = 4;
    bench.run(3s);
    EXPECT_EQ(seen(0).word, 4) << "a corrected drive is noticed";
}

TEST_F(PollerWatch, WaitsWhileAllIsRefusedWithoutALayout)
{
    drive().words.clear();
    bench.run(9s);
    EXPECT_EQ(bench.reads_of(40), 1u);
    EXPECT_EQ(bench.reads_of(75), 1u);
    EXPECT_GE(bench.count([](const test::Done& d) { return d.purpose == Purpose::probe; }), 7u);
}

TEST_F(PollerWatch, IsSilentOnALineWhoseDriveIsLost)
{
    drive().alive = false;
    bench.run(60s);
    EXPECT_LE(bench.count([](const test::Done& d) { return d.purpose == Purpose::watch; }), 3u);
    drive().alive = true;
    bench.run(9s);
    EXPECT_EQ(seen(0).word, 1040);
}

class PollerWatchByTable : public PollerWatch {
protected:
    PollerWatchByTable() : PollerWatch({91, 1, 1, 2, 3, 4, 5, 6, 7, 8}) {}
};

TEST_F(PollerWatchByTable, RecognisesWhatCannotBeReadAndTakesNoMoreThanItsPlaces)
{
    EXPECT_EQ(seen(0).state, WordState::refused) << "write-only by the table, known before anything is asked";
    bench.run(1s);
    EXPECT_EQ(bench.reads_of(91), 0u);
    EXPECT_EQ(seen(1).word, 1001);
    EXPECT_EQ(seen(2).word, 1001) << "named twice";
    EXPECT_EQ(seen(7).word, 1006);
    EXPECT_EQ(bench.reads_of(7) + bench.reads_of(8), 0u) << "beyond kMaxWatched";
}

class PollerWatchInBlocks : public PollerWatch {
protected:
    PollerWatchInBlocks() : PollerWatch({12, 75, 77}, {.max_tags = 16, .max_gap = 2}) {}
};

TEST_F(PollerWatchInBlocks, JoinsWatchedTagsAndInputsWhereTheRuleAllows)
{
    bench.layout(0, 1, {10, 13});
    bench.steps(2);
    EXPECT_EQ(bench.log[0].tag, 10);
    EXPECT_EQ(bench.log[0].count, 4);
    EXPECT_EQ(bench.log[1].tag, 75);
    EXPECT_EQ(bench.log[1].count, 3);
    EXPECT_EQ(bench.purposes(), "iw");
    EXPECT_EQ(seen(0).word, 1012);
    EXPECT_EQ(seen(1).word, 1075);
    EXPECT_EQ(seen(2).word, 1077);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[1], 1013);
}

TEST_F(PollerWatchInBlocks, ARefusedWatchedTagIsAHoleThatCostsOnlyItsSearch)
{
    drive().words.erase(12);
    bench.layout(0, 1, {10, 11, 13});
    bench.run(1s);
    bench.log.clear();
    bench.run(5s);
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.error != AccessError::none; }), 0u);
    EXPECT_EQ(seen(0).state, WordState::invalid_tag);
    EXPECT_EQ(bench.poller.take_inputs(0)->words[2], 1013);
}

} // namespace
} // namespace dpslave::drive
