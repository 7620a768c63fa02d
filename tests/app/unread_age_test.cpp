// SPDX-License-Identifier: Apache-2.0
/// What a bus thread knows of the age of a request, on a simulated clock.
#include "app/bus/unread_age.hpp"

#include <gtest/gtest.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;

constexpr Instant kOpened{100ms};

TEST(UnreadAge, OfWhatIsReadWhileTheThreadLooksWithEachTickIsNone)
{
    UnreadAge age{kOpened};
    for (auto at = kOpened; at < kOpened + 1s; at += 10ms) {
        EXPECT_EQ(age.at(at + 9ms), 0ns);
        age.looked(at + 10ms);
    }
}

TEST(UnreadAge, OfWhatIsReadBehindAFewTicksOfABusyMachineIsNone)
{
    UnreadAge age{kOpened};
    EXPECT_EQ(age.at(kOpened + 50ms - 1ns), 0ns);
    age.looked(kOpened + 50ms - 1ns);
    EXPECT_EQ(age.at(kOpened + 51ms), 0ns);
}

TEST(UnreadAge, BeginsWithTheLookBeforeTheThreadStoodStill)
{
    UnreadAge age{kOpened};
    age.looked(kOpened + 8ms);
    EXPECT_EQ(age.at(kOpened + 8ms + 50ms), 50ms);
    EXPECT_EQ(age.at(kOpened + 8ms + 2s), 2s);
}

TEST(UnreadAge, GrowsUntilTheReadWhereverBeforeItTheThreadStoodStill)
{
    UnreadAge age{kOpened};
    age.looked(kOpened + 1ms);
    // The epoll reported octets at 2 ms, and the thread went on at 80 ms.
    EXPECT_EQ(age.at(kOpened + 80ms), 79ms);
}

TEST(UnreadAge, OfWhatTheKernelsWorkerBringsWithinATickBehindAStandstillBeginsBeforeIt)
{
    UnreadAge age{kOpened};
    age.looked(kOpened + 5ms);
    age.looked(kOpened + 65ms); // the tick came first, and nothing lay there yet
    EXPECT_EQ(age.at(kOpened + 66ms), 61ms);
    age.looked(kOpened + 70ms);
    EXPECT_EQ(age.at(kOpened + 75ms - 1ns), 70ms - 1ns);
    EXPECT_EQ(age.at(kOpened + 75ms), 0ns) << "the worker has gone on";
}

TEST(UnreadAge, OfWhatCameToAPortThatWasOpenedLongBeforeTheFirstLookBeginsWithItsOpening)
{
    UnreadAge age{kOpened};
    EXPECT_EQ(age.at(kOpened + 270ms), 270ms); // a slow line of a GPIO chip was measured meanwhile
    age.looked(kOpened + 271ms);
    EXPECT_EQ(age.at(kOpened + 272ms), 0ns) << "and what came then has been read";
}

} // namespace
} // namespace dpslave::app
