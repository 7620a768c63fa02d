// SPDX-License-Identifier: Apache-2.0
/// Tests what a bus thread knows of the age of a request, on a simulated clock.
#include "app/bus/backlog_age.hpp"

#include <gtest/gtest.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;

constexpr Instant kOpened{100ms};

TEST(BacklogAge, OfWhatIsReadWhileTheThreadLooksWithEachTickIsNone)
{
    BacklogAge age{kOpened};
    for (auto at = kOpened; at < kOpened + 1s; at += 10ms) {
        EXPECT_EQ(age.age_of(at + 9ms), 0ns);
        age.emptied(at + 10ms);
    }
}

TEST(BacklogAge, OfWhatIsReadBehindAFewTicksOfABusyMachineIsNone)
{
    BacklogAge age{kOpened};
    EXPECT_EQ(age.age_of(kOpened + 50ms - 1ns), 0ns);
    age.emptied(kOpened + 50ms - 1ns);
    EXPECT_EQ(age.age_of(kOpened + 51ms), 0ns);
}

TEST(BacklogAge, BeginsWithTheLookBeforeTheThreadStoodStill)
{
    BacklogAge age{kOpened};
    age.emptied(kOpened + 8ms);
    EXPECT_EQ(age.age_of(kOpened + 8ms + 50ms), 50ms);
    EXPECT_EQ(age.age_of(kOpened + 8ms + 2s), 2s);
}

TEST(BacklogAge, GrowsUntilTheReadWhereverBeforeItTheThreadStoodStill)
{
    BacklogAge age{kOpened};
    age.emptied(kOpened + 1ms);
    // The epoll reported octets at 2 ms, and the thread went on at 80 ms.
    EXPECT_EQ(age.age_of(kOpened + 80ms), 79ms);
}

TEST(BacklogAge, OfWhatTheKernelsWorkerBringsWithinATickBehindAStandstillBeginsBeforeIt)
{
    BacklogAge age{kOpened};
    age.emptied(kOpened + 5ms);
    age.emptied(kOpened + 65ms); // the tick came first, and nothing lay there yet
    EXPECT_EQ(age.age_of(kOpened + 66ms), 61ms);
    age.emptied(kOpened + 70ms);
    EXPECT_EQ(age.age_of(kOpened + 75ms - 1ns), 70ms - 1ns);
    EXPECT_EQ(age.age_of(kOpened + 75ms), 0ns) << "the worker has gone on";
}

TEST(BacklogAge, OfWhatCameToAPortThatWasOpenedLongBeforeTheFirstLookBeginsWithItsOpening)
{
    BacklogAge age{kOpened};
    EXPECT_EQ(age.age_of(kOpened + 270ms), 270ms); // a slow line of a GPIO chip was measured meanwhile
    age.emptied(kOpened + 271ms);
    EXPECT_EQ(age.age_of(kOpened + 272ms), 0ns) << "and what came then has been read";
}

} // namespace
} // namespace dpslave::app
