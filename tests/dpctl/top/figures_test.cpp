// SPDX-License-Identifier: Apache-2.0
// Rates, and where the turnaround of the last minute lies.
#include "control/fixtures.hpp"
#include "dpctl/top/figures.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace dpslave::dpctl {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::FieldsAre;
using testing::Optional;

report::CounterGroup group(std::vector<std::pair<const char*, std::int64_t>> values)
{
    report::CounterGroup out;
    for (const auto& [name, value] : values) out.counters.push_back({name, value, {}, 0, {}, {}});
    return out;
}

TEST(Rates, AreTheDifferencesForEachSecond)
{
    const auto before = group({{"telegrams", 1000}, {"retries", 3}});
    const auto now = group({{"telegrams", 1500}, {"retries", 3}});

    EXPECT_THAT(rates(&before, &now, 2500ms),
                ElementsAre(FieldsAre("telegrams", 200.0), FieldsAre("retries", 0.0)));
}

TEST(Rates, LeaveOutACounterThatBeganAnewOrIsNoCount)
{
    const auto before = group({{"reads", 1000}, {"drive_delay_ms", 5}});
    const auto now = group({{"reads", 7}, {"drive_delay_ms", 420}, {"new", 1}});

    EXPECT_THAT(rates(&before, &now, 1s), ElementsAre());
}

TEST(Rates, AreNoneWithoutAGroupOrWithoutTime)
{
    const auto one = group({{"reads", 1}});
    EXPECT_THAT(rates(nullptr, &one, 1s), ElementsAre());
    EXPECT_THAT(rates(&one, nullptr, 1s), ElementsAre());
    EXPECT_THAT(rates(&one, &one, 0s), ElementsAre());
}

TEST(Rates, OfAStationWithTheNameOfTheBusAreItsOwn)
{
    report::GetCountersReply reply;
    for (const char* name : {"bus", "control socket", "bus", "control socket"})
        reply.groups.push_back({name, {}});

    EXPECT_EQ(bus_group(reply), &reply.groups[0]);
    EXPECT_EQ(station_group(reply, "control socket"), &reply.groups[1]);
    EXPECT_EQ(station_group(reply, "bus"), &reply.groups[2]);
    EXPECT_EQ(station_group(reply, "unwinder"), nullptr);
}

/// `counts`: lower end of the class, replies in it. The upper end is of no importance here.
report::GetCountersReply turnaround(std::vector<std::pair<std::int64_t, std::int64_t>> counts)
{
    report::GetCountersReply reply;
    reply.turnaround.resize(2);
    reply.turnaround[0].unit = "us";
    reply.turnaround[1].unit = "T_bit";
    for (const auto& [from, count] : counts) reply.turnaround[1].classes.push_back({from, from + 3, count});
    return reply;
}

TEST(RecentTurnaround, IsThatSinceTheStartBeforeTheSecondLook)
{
    RecentTurnaround recent;
    recent.add(10s, turnaround({{12, 1}, {64, 3}}));

    EXPECT_FALSE(recent.is_recent());
    ASSERT_TRUE(recent.now());
    EXPECT_EQ(recent.now()->unit, "T_bit");
    EXPECT_EQ(recent.now()->count, 4);
    EXPECT_THAT(recent.now()->p50, Optional(67));
}

TEST(RecentTurnaround, ForgetsWhatIsOlderThanAMinute)
{
    RecentTurnaround recent;
    recent.add(0s, turnaround({{12, 100}}));
    recent.add(30s, turnaround({{12, 150}, {64, 1}}));
    EXPECT_TRUE(recent.is_recent());
    EXPECT_EQ(recent.now()->count, 51);

    recent.add(90s, turnaround({{12, 160}, {64, 1}}));

    EXPECT_EQ(recent.now()->count, 10) << "those since 30 s";
    EXPECT_EQ(recent.now()->classes.size(), 1u);
    EXPECT_THAT(recent.now()->highest, Optional(15));
}

TEST(RecentTurnaround, IsNoneWithoutAReply)
{
    RecentTurnaround recent;
    EXPECT_FALSE(recent.now());
    recent.add(1s, {});
    recent.add(2s, turnaround({}));
    EXPECT_FALSE(recent.now());
}

TEST(RecentTurnaround, TakesNumbersThatCannotBe)
{
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    RecentTurnaround recent;
    recent.add(1s, turnaround({{12, -kMost}, {13, kMost}, {-5, kMost}}));
    recent.add(2s, turnaround({{12, kMost}, {13, kMost}, {kMost - 9, kMost}}));

    ASSERT_TRUE(recent.now());
    EXPECT_GT(recent.now()->count, 0);
    EXPECT_FALSE(sparkline(*recent.now(), 40, true).empty());
}

report::Distribution distribution(std::vector<std::pair<std::int64_t, std::int64_t>> counts)
{
    return turnaround(std::move(counts)).turnaround[1];
}

TEST(Sparkline, IsOneCharacterForEachClassAsHighAsItsCount)
{
    EXPECT_EQ(sparkline(distribution({{11, 8}, {12, 4}, {14, 1}}), 40, true), "█▄ ▁");
    EXPECT_EQ(sparkline(distribution({{11, 8}, {12, 4}, {14, 1}}), 40, false), "#= .");
}

TEST(Sparkline, ShowsASingleReplyAmongMany)
{
    EXPECT_EQ(sparkline(distribution({{11, 1'000'000}, {12, 1}}), 40, true), "█▁");
}

TEST(Sparkline, PutsClassesTogetherWhenThereIsNoRoom)
{
    EXPECT_EQ(sparkline(distribution({{8, 4}, {9, 4}, {10, 1}, {11, 3}}), 2, true), "█▄");
    EXPECT_EQ(sparkline(distribution({{8, 4}, {15, 4}}), 1, true), "█");
    EXPECT_EQ(sparkline(distribution({{8, 4}}), 0, true), "");
    EXPECT_EQ(sparkline({}, 40, true), "");
}

TEST(Sparkline, HasTheClassesOfTheHistogramSideBySide)
{
    EXPECT_EQ(sparkline(distribution({{15, 1}, {16, 1}, {18, 1}, {60, 1}}), 40, true),
              "███" + std::string(13, ' ') + "█")
        << "from 16 on a class has two values, from 32 on four";
}

TEST(Sparkline, OfTheFixtureHasThreeClasses)
{
    const auto counters = report::read<report::GetCountersReply>(test::fixture("GetCounters"));
    const std::string line = sparkline(counters.turnaround[1], 64, false);
    EXPECT_EQ(line.front(), '#');
    EXPECT_EQ(line.back(), '.');
    EXPECT_EQ(std::count(line.begin(), line.end(), ' '), static_cast<std::ptrdiff_t>(line.size()) - 3);
}

} // namespace
} // namespace dpslave::dpctl
