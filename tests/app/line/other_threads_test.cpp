// SPDX-License-Identifier: Apache-2.0
/// When a drive line takes the master for lost because the bus thread or the main thread stalls. The
/// test has the only clock.
#include "app/line/other_threads.hpp"

#include <gtest/gtest.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;

constexpr Instant kStarted{1h};

/// A line that looks every 50 ms, as it does while it waits for an answer.
class OtherThreadsOfALine : public ::testing::Test {
protected:
    /// Until `end`. `bus`, `main`: they go round. How often the master was taken for lost.
    int until(Instant end, bool bus, bool main)
    {
        int losses = 0;
        for (; now < end; now += 50ms) {
            if (bus) bus_sign = now;
            if (main) main_sign = now;
            losses += others.look(bus_sign, main_sign, now) ? 1 : 0;
        }
        return losses;
    }
    Instant now = kStarted, bus_sign = kStarted, main_sign = kStarted;
    OtherThreads others;
};

TEST_F(OtherThreadsOfALine, WhoGoRoundLoseNoMaster)
{
    EXPECT_EQ(until(kStarted + 1h, true, true), 0);
    EXPECT_EQ(others.which(), "");
}

TEST_F(OtherThreadsOfALine, ABusThreadWithoutASignForASecondIsALossOfTheMasterAndOneOnly)
{
    EXPECT_EQ(until(kStarted + 1s, false, true), 0);
    EXPECT_EQ(until(kStarted + 1s + 50ms, false, true), 1);
    EXPECT_EQ(others.which(), "bus thread");
    EXPECT_EQ(until(kStarted + 1min, false, true), 0);
}

TEST_F(OtherThreadsOfALine, AMainThreadWithoutASignForTwoAndAHalfSecondsIsOneToo)
{
    EXPECT_EQ(until(kStarted + 2500ms, true, false), 0);
    EXPECT_EQ(until(kStarted + 2550ms, true, false), 1);
    EXPECT_EQ(others.which(), "main thread");
    EXPECT_EQ(until(kStarted + 1min, true, false), 0);
}

TEST_F(OtherThreadsOfALine, EachNewStallIsANewLoss)
{
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(until(now + 2s, false, true), 1);
        EXPECT_EQ(until(now + 2s, true, true), 0);
        EXPECT_EQ(others.which(), "");
    }
}

TEST_F(OtherThreadsOfALine, WhatTheLineItselfStalledDoesNotCount)
{
    until(kStarted + 100ms, true, true);
    now += 1h; // all of them: the machine was asleep, and the line wakes up first
    EXPECT_EQ(until(now + 800ms, false, false), 0);
}

TEST_F(OtherThreadsOfALine, WhoHasNotBegunYetIsNotJudged)
{
    bus_sign = main_sign = Instant{};
    EXPECT_EQ(until(kStarted + 1h, false, false), 0);
}

} // namespace
} // namespace dpslave::app
