// SPDX-License-Identifier: Apache-2.0
/// Block reads of a back-end that has them (Modbus): joined at small gaps, split at holes.
#include "poller_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dpslave::drive {
namespace {

using test::PollerBench;
using namespace std::chrono_literals;

class PollerBlocks : public testing::Test {
protected:
    PollerBlocks() : tags(make_tags()), bench({settings(tags)}, {.max_tags = 16, .max_gap = 2})
    {
        for (int tag = 0; tag < 100; ++tag) drive().words[tag] = static_cast<std::uint16_t>(1000 + tag);
    }
    static TagTable make_tags()
    {
        std::vector<Tag> rows = test::table_up_to(99).all();
        rows[52].modbus_register = std::uint16_t{0x8068};
        return TagTable{rows};
    }
    static DriveSettings settings(const TagTable& tags)
    {
        DriveSettings one;
        one.tags = &tags;
        return one;
    }
    test::MemoryDrive& drive() { return bench.drives[0]; }
    std::uint16_t input(std::size_t i)
    {
        if (const auto fresh = bench.poller.take_inputs(0)) inputs = *fresh;
        return inputs.words[i];
    }
    /// "1+5 7" : blocks of one settled round, first tag and count.
    std::string round()
    {
        bench.run(1s);
        bench.log.clear();
        bench.run(400ms);
        std::map<int, int> blocks;
        for (const test::Done& done : bench.log) blocks[done.tag] = done.count;
        std::string out;
        for (const auto& [tag, count] : blocks)
            out += (out.empty() ? "" : " ") + std::to_string(tag) +
                   (count > 1 ? "+" + std::to_string(count) : "");
        return out;
    }

    TagTable tags;
    PollerBench bench;
    InputImage inputs;
};

TEST_F(PollerBlocks, JoinTagsAtGapsUpToTheRule)
{
    bench.layout(0, 1, {10, 11, 14, 18});
    bench.steps(2);
    ASSERT_EQ(bench.log.size(), 2u);
    EXPECT_EQ(bench.log[0].tag, 10);
    EXPECT_EQ(bench.log[0].count, 5);
    EXPECT_EQ(bench.log[1].tag, 18);
    EXPECT_EQ(bench.log[1].count, 1);
    EXPECT_EQ(input(0), 1010);
    EXPECT_EQ(input(1), 1011);
    EXPECT_EQ(input(2), 1014);
    EXPECT_EQ(input(3), 1018);
}

TEST_F(PollerBlocks, AreNoLongerThanTheRule)
{
    std::vector<int> all;
    for (int tag = 0; tag < 40; ++tag) all.push_back(tag);
    bench.layout(0, 1, all);
    bench.steps(3);
    EXPECT_EQ(bench.log[0].count, 16);
    EXPECT_EQ(bench.log[1].count, 16);
    EXPECT_EQ(bench.log[2].count, 8);
    EXPECT_EQ(input(39), 1039);
    EXPECT_TRUE(inputs.every_input_tried);
}

TEST_F(PollerBlocks, AreSplitAtAHoleBetweenTheRequestedTags)
{
    drive().words.erase(13);
    bench.layout(0, 1, {10, 11, 14, 15});
    EXPECT_EQ(round(), "10+2 14+2");
    for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(input(i), 1000) << "no tag of the layout is invalid";
    EXPECT_EQ(bench.poller.snapshot(0).states[2], WordState::good);
}

TEST_F(PollerBlocks, AreSplitAtAnInvalidTagWhichOnlyASingleReadDecides)
{
    drive().words.erase(12);
    bench.layout(0, 1, {10, 11, 12, 13, 14, 15});
    EXPECT_EQ(round(), "10+2 13+3");
    EXPECT_EQ(input(2), 0);
    EXPECT_EQ(input(3), 1013);
    EXPECT_EQ(bench.poller.snapshot(0).states[2], WordState::invalid_tag);
    EXPECT_EQ(bench.poller.snapshot(0).losses, 0u);
}

TEST_F(PollerBlocks, RememberTheirHoles)
{
    drive().words.erase(12);
    drive().words.erase(17);
    bench.layout(0, 1, {10, 12, 14, 15, 17, 18, 19});
    EXPECT_EQ(round(), "10 14+2 18+2");
    bench.log.clear();
    bench.run(5s);
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.error != AccessError::none; }), 0u);
}

TEST_F(PollerBlocks, AreCutAtTheirHoleOnlyAndNotOnTheWayToIt)
{
    drive().words.erase(12);
    std::vector<int> asked;
    for (int tag = 10; tag <= 25; ++tag)
        if (tag != 12) asked.push_back(tag);
    bench.layout(0, 1, asked);
    EXPECT_EQ(round(), "10+2 13+13");
    drive().words.erase(20);
    asked.erase(std::remove(asked.begin(), asked.end(), 20), asked.end());
    bench.layout(0, 2, asked);
    EXPECT_EQ(round(), "10+2 13+7 21+5") << "two holes between the requested tags";
    bench.log.clear();
    bench.run(60s);
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.error != AccessError::none; }), 0u);
}

TEST_F(PollerBlocks, AreCutWhereTheDriveTakesNoMoreAtATime)
{
    drive().longest_read = 5;
    bench.layout(0, 1, {10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25});
    bench.run(2s);
    bench.log.clear();
    bench.run(5s);
    EXPECT_EQ(bench.count([](const test::Done& d) { return d.error != AccessError::none; }), 0u);
    for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(input(i), 1010 + i);
}

TEST_F(PollerBlocks, AreOneAgainBehindADriveThatWasBusy)
{
    bench.layout(0, 1, {10, 11, 13, 14, 15, 16});
    drive().not_understood = 6;
    bench.steps(6);
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
    EXPECT_EQ(round(), "10+7");
    EXPECT_EQ(input(5), 1016);
}

TEST_F(PollerBlocks, ThatAreNeverUnderstoodAreCutInTheEnd)
{
    drive().read_errors[12] = AccessError::not_understood;
    bench.layout(0, 1, {10, 11, 12, 13, 14});
    bench.run(3s);
    EXPECT_EQ(input(0), 1010);
    EXPECT_EQ(input(4), 1014);
    EXPECT_EQ(bench.poller.snapshot(0).errors[2], AccessError::not_understood);
}

TEST_F(PollerBlocks, JoinAgainWhenTheHoleIsGone)
{
    drive().words.erase(12);
    bench.layout(0, 1, {10, 11, 12, 13});
    EXPECT_EQ(round(), "10+2 13");
    drive().words[12] = 12;
    bench.run(10s);
    EXPECT_EQ(round(), "10+4");
    EXPECT_EQ(input(2), 12);
}

TEST_F(PollerBlocks, OfAllInvalidTagsEndInSingleReads)
{
    drive().words.clear();
    bench.layout(0, 1, {10, 11, 12, 13, 14, 15, 16, 17});
    bench.run(2s);
    const auto seen = bench.poller.snapshot(0);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(seen.states[i], WordState::invalid_tag);
    EXPECT_LE(seen.refusals, 8u * 5u);
    EXPECT_TRUE(bench.poller.take_inputs(0)->every_input_tried);
}

TEST_F(PollerBlocks, ThatAreNotAnsweredAreRepeatedAsTheyAre)
{
    bench.layout(0, 1, {10, 11, 12});
    drive().lost_answers = 2;
    bench.steps(3);
    for (const test::Done& done : bench.log) EXPECT_EQ(done.count, 3);
    EXPECT_EQ(input(2), 1012);
}

TEST_F(PollerBlocks, LeaveOutATagWithARegisterOfItsOwn)
{
    bench.layout(0, 1, {50, 51, 52, 53, 54});
    EXPECT_EQ(round(), "50+2 52 53+2");
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(input(i), 1050 + i);
    bench.layout(0, 2, {51, 53});
    EXPECT_EQ(round(), "51+3") << "it is not asked for: what lies under its number is only passed over";
}

} // namespace
} // namespace dpslave::drive
