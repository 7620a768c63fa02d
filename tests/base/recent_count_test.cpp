// SPDX-License-Identifier: Apache-2.0
#include "support/long_times.hpp"

#include "dpslave/base/recent_count.hpp"

#include <gtest/gtest.h>

namespace dpslave {
namespace {

using std::chrono::seconds;

constexpr Instant kStart{seconds{1000}};

TEST(RecentCount, HasNothingOfACounterThatNeverGrew)
{
    RecentCount count;
    count.sample(0, kStart);

    EXPECT_EQ(count.in_span(), 0U);
    EXPECT_EQ(count.last(), Instant{});
    EXPECT_EQ(count.since(), Instant{});
}

TEST(RecentCount, DropsAfterAMinuteWhatItCountedAndKeepsWhenThatWas)
{
    RecentCount count;
    count.sample(5, kStart);
    count.sample(7, kStart + seconds{30});
    EXPECT_EQ(count.in_span(), 7U);

    count.sample(7, kStart + seconds{60});
    EXPECT_EQ(count.in_span(), 2U);
    count.sample(7, kStart + seconds{90});
    EXPECT_EQ(count.in_span(), 0U);
    EXPECT_EQ(count.last(), kStart + seconds{30});
    EXPECT_EQ(count.since(), Instant{});
}

TEST(RecentCount, SaysSinceWhenItGrowsWithoutAQuietMinute)
{
    RecentCount count;
    for (int i = 0; i <= 20; ++i) count.sample(static_cast<std::uint64_t>(i) + 1, kStart + seconds{i * 50});
    EXPECT_EQ(count.since(), kStart);

    const Instant later = kStart + seconds{2000};
    count.sample(30, later);
    EXPECT_EQ(count.since(), later);
    EXPECT_EQ(count.in_span(), 9U);
}

TEST(RecentCount, TakesASmallerTotalForACounterThatBeganAnew)
{
    RecentCount count;
    count.sample(1000, kStart);
    count.sample(3, kStart + seconds{100});

    EXPECT_EQ(count.in_span(), 3U);
}

TEST(RecentCount, IsTheSameWhenTheClockHasRunForWeeks)
{
    for (const test::LongTime& time : test::kLongTimes) {
        RecentCount count;
        count.sample(5, time.instant() - seconds{100});
        count.sample(7, time.instant() - seconds{1});
        count.sample(10, time.instant() + seconds{1});

        EXPECT_EQ(count.in_span(), 5U) << time;
        EXPECT_EQ(count.last(), time.instant() + seconds{1}) << time;
        count.sample(10, time.instant() + seconds{62});
        EXPECT_EQ(count.in_span(), 0U) << time;
    }
}

} // namespace
} // namespace dpslave
