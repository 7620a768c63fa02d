// SPDX-License-Identifier: Apache-2.0
/// Tests when each station's state is shown to the main thread.
#include "app/bus/snapshot_schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

namespace dpslave::test {
namespace {

using app::SnapshotSchedule;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr Instant kStart{std::chrono::seconds{9}};
constexpr nanoseconds kInterval = milliseconds{50};

TEST(SnapshotSchedule, HaveNothingToShowUntilSomethingChanges)
{
    SnapshotSchedule turns;
    EXPECT_EQ(turns.next(), kNever);
    EXPECT_EQ(turns.take(kStart), std::nullopt);
    turns.changed(7);
    EXPECT_LE(turns.next(), kStart);
    EXPECT_EQ(turns.take(kStart), 7u);
    EXPECT_EQ(turns.take(kStart + std::chrono::hours{1}), std::nullopt);
    EXPECT_EQ(turns.next(), kNever);
}

TEST(SnapshotSchedule, ShowAStationThatAlwaysChangesOnceIn50Ms)
{
    SnapshotSchedule turns;
    turns.changed(3);
    ASSERT_EQ(turns.take(kStart), 3u);
    turns.changed(3);
    EXPECT_EQ(turns.next(), kStart + kInterval);
    EXPECT_EQ(turns.take(kStart + kInterval - nanoseconds{1}), std::nullopt);
    EXPECT_EQ(turns.take(kStart + kInterval), 3u);
}

/// Each round of the thread shows one, so that a telegram waits for one at most.
TEST(SnapshotSchedule, ShowAllThatHaveChangedAtOnceInTheRoundsThatFollow)
{
    constexpr std::size_t kStations = 127;
    SnapshotSchedule turns;
    for (std::size_t place = 0; place < kStations; ++place) turns.changed(place);
    for (std::size_t place = 0; place < kStations; ++place) {
        EXPECT_LE(turns.next(), kStart);
        EXPECT_EQ(turns.take(kStart), place);
    }
    EXPECT_EQ(turns.next(), kNever);
}

TEST(SnapshotSchedule, ShowEveryStationInItsTurnWhereAllChangeAllTheTime)
{
    constexpr std::size_t kStations = 100;
    SnapshotSchedule turns;
    std::map<std::size_t, std::vector<Instant>> shown;
    for (std::size_t place = 0; place < kStations; ++place) turns.changed(place);
    while (turns.next() < kStart + 10 * kInterval) {
        const Instant now = std::max(turns.next(), kStart);
        const auto place = turns.take(now);
        ASSERT_TRUE(place);
        shown[*place].push_back(now);
        turns.changed(*place);
    }
    EXPECT_EQ(shown.size(), kStations);
    for (const auto& [place, times] : shown) {
        EXPECT_GE(times.size(), 9u) << place;
        for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GE(times[i] - times[i - 1], kInterval) << place;
    }
}

TEST(SnapshotSchedule, DoNotLetOneThatRestsKeepAnotherWaiting)
{
    SnapshotSchedule turns;
    turns.changed(1);
    ASSERT_EQ(turns.take(kStart), 1u);
    turns.changed(1);
    turns.changed(2);
    EXPECT_LE(turns.next(), kStart);
    EXPECT_EQ(turns.take(kStart), 2u);
    EXPECT_EQ(turns.next(), kStart + kInterval);
}

TEST(SnapshotSchedule, ForgetAStationThatHasGone)
{
    SnapshotSchedule turns;
    turns.changed(1);
    turns.forget(1);
    EXPECT_EQ(turns.next(), kNever);
    turns.changed(1);
    ASSERT_EQ(turns.take(kStart), 1u);
    turns.forget(1);
    turns.changed(1); // another one has its place, and need not rest
    EXPECT_LE(turns.next(), kStart);
    EXPECT_EQ(turns.take(kStart), 1u);
}

} // namespace
} // namespace dpslave::test
