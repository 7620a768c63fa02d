// SPDX-License-Identifier: Apache-2.0
/// For how long a part of the program has given no sign. The test has the only clock.
#include "dpslave/base/sign_of_life.hpp"

#include <gtest/gtest.h>

namespace dpslave {
namespace {

using namespace std::chrono_literals;

constexpr Instant kBegin{1h};

TEST(Silence, IsNothingAtTheFirstLookHoweverOldTheSign)
{
    Silence silence;
    EXPECT_EQ(silence.look(kBegin - 1h, kBegin), 0s);
}

TEST(Silence, GrowsWithEachLookAtTheSameSign)
{
    Silence silence;
    for (Instant now = kBegin; now < kBegin + 2s; now += 10ms)
        EXPECT_EQ(silence.look(kBegin, now), now - kBegin);
}

TEST(Silence, EndsWithANewSign)
{
    Silence silence;
    silence.look(kBegin, kBegin);
    EXPECT_EQ(silence.look(kBegin, kBegin + 50ms), 50ms);
    EXPECT_EQ(silence.look(kBegin + 60ms, kBegin + 70ms), 0s);
    EXPECT_EQ(silence.look(kBegin + 60ms, kBegin + 80ms), 10ms);
}

TEST(Silence, DoesNotCountWhatTheObserverItselfStoodStill)
{
    Silence silence;
    silence.look(kBegin, kBegin);
    EXPECT_EQ(silence.look(kBegin, kBegin + 60s), 100ms);
    EXPECT_EQ(silence.look(kBegin, kBegin + 60s + 20ms), 120ms);
}

TEST(Silence, IsNothingWhileThereWasNoSign)
{
    Silence silence;
    for (Instant now = kBegin; now < kBegin + 10s; now += 10ms) EXPECT_EQ(silence.look(Instant{}, now), 0s);
}

TEST(SignOfLife, HasNoneUntilTheFirstIsGiven)
{
    SignOfLife sign;
    EXPECT_EQ(sign.last(), Instant{});
    sign.give(kBegin);
    EXPECT_EQ(sign.last(), kBegin);
}

} // namespace
} // namespace dpslave
