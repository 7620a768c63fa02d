// SPDX-License-Identifier: Apache-2.0
/// Tests when the driver may be let go: T_bit arithmetic, the UART's word and the guard (wire reference 11.3,
///
#include "dpslave/fdl/transmission.hpp"

#include <gtest/gtest.h>

using namespace dpslave;
using std::chrono::microseconds;
using std::chrono::nanoseconds;

namespace {

constexpr Instant kFirstWrite{std::chrono::seconds{7}};

TEST(Transmission, IsIdleBeforeTheFirstReply)
{
    fdl::Transmission idle;

    EXPECT_FALSE(idle.is_running());
    EXPECT_EQ(idle.ends_at(), kNever);
    EXPECT_EQ(idle.guard_at(), kNever);
    EXPECT_FALSE(idle.is_over(kFirstWrite, true)); // nothing ends that did not begin
    EXPECT_EQ(idle.guarded(), 0u);
}

TEST(Transmission, EndsAfterElevenBitTimesAnOctet)
{
    fdl::Transmission one, longest;
    one.begin(1, kFirstWrite, Baud::k1500);
    longest.begin(255, kFirstWrite, Baud::k9_6);

    EXPECT_EQ(one.ends_at() - kFirstWrite, nanoseconds{7334});          // 7.333 us, rounded up
    EXPECT_EQ(longest.ends_at() - kFirstWrite, nanoseconds{292187500}); // 292.188 ms
}

TEST(Transmission, IsOverWithTheLastStopBitWhereTheUartReportsNothing)
{
    fdl::Transmission reply;
    reply.begin(10, kFirstWrite, Baud::k500); // 220 us

    EXPECT_FALSE(reply.is_over(kFirstWrite + microseconds{220} - nanoseconds{1}, std::nullopt));
    EXPECT_TRUE(reply.is_over(kFirstWrite + microseconds{220}, std::nullopt));
    EXPECT_FALSE(reply.is_running());
    EXPECT_EQ(reply.guarded(), 0u);
}

TEST(Transmission, UsesArithmeticBeforeTheUart)
{
    fdl::Transmission reply;
    reply.begin(10, kFirstWrite, Baud::k500);

    // Right after the write some drivers call a transmitter empty that has not begun.
    EXPECT_FALSE(reply.is_over(kFirstWrite + microseconds{100}, true));
    EXPECT_TRUE(reply.is_running());
}

TEST(Transmission, WaitsForAUartThatIsNotEmptyAndAsksAgainAfterAQuarterOfACharacter)
{
    fdl::Transmission reply;
    reply.begin(10, kFirstWrite, Baud::k500);
    const Instant first = reply.ends_at();

    EXPECT_FALSE(reply.is_over(first, false));
    EXPECT_EQ(reply.ends_at() - first, nanoseconds{5500}); // of 22 us
    EXPECT_FALSE(reply.is_over(reply.ends_at(), false));
    EXPECT_TRUE(reply.is_over(reply.ends_at(), true));
    EXPECT_EQ(reply.guarded(), 0u);
}

TEST(Transmission, IsGuardedAtTwiceTheLongestTelegram)
{
    fdl::Transmission reply;
    reply.begin(1, kFirstWrite, Baud::k1500);
    EXPECT_EQ(reply.guard_at() - kFirstWrite, microseconds{3740}); // 2 * 255 * 11 bits at 1.5 Mbit/s
    EXPECT_EQ(fdl::transmission_guard(Baud::k9_6), microseconds{584375});

    EXPECT_FALSE(reply.is_over(reply.guard_at() - nanoseconds{1}, false));
    EXPECT_LE(reply.ends_at(), reply.guard_at()); // it is asked for in time
    EXPECT_TRUE(reply.is_over(reply.guard_at(), false));
    EXPECT_FALSE(reply.is_running());
    EXPECT_EQ(reply.guarded(), 1u);
}

TEST(Transmission, IsNotTheGuardsMeritWhenTheUartSaysItIsEmptyAfterTheGuard)
{
    fdl::Transmission late, silent;
    late.begin(1, kFirstWrite, Baud::k1500);
    silent.begin(1, kFirstWrite, Baud::k1500);

    EXPECT_TRUE(late.is_over(kFirstWrite + std::chrono::seconds{1}, true)); // the thread was late
    EXPECT_TRUE(silent.is_over(kFirstWrite + std::chrono::seconds{1}, std::nullopt));
    EXPECT_EQ(late.guarded() + silent.guarded(), 0u);
}

TEST(Transmission, OfASecondReplyComesBehindTheFirst)
{
    fdl::Transmission both;
    both.begin(10, kFirstWrite, Baud::k500);                    // until 220 us
    both.begin(10, kFirstWrite + microseconds{50}, Baud::k500); // until 440 us

    EXPECT_EQ(both.ends_at() - kFirstWrite, microseconds{440});
    EXPECT_TRUE(both.is_over(kFirstWrite + microseconds{440}, std::nullopt));
    both.begin(10, kFirstWrite + microseconds{1000}, Baud::k500); // idle in between: from its own begin
    EXPECT_EQ(both.ends_at() - kFirstWrite, microseconds{1220});
}

TEST(Transmission, IsGuardedFromTheFirstReplyOnHoweverManyFollow)
{
    fdl::Transmission many;
    many.begin(255, kFirstWrite, Baud::k500);
    const Instant guard = many.guard_at();
    many.begin(255, kFirstWrite + microseconds{1}, Baud::k500);
    many.begin(255, kFirstWrite + microseconds{2}, Baud::k500);

    EXPECT_EQ(many.guard_at(), guard);
    EXPECT_EQ(many.ends_at(), guard);
    EXPECT_TRUE(many.is_over(guard, std::nullopt));
    EXPECT_EQ(many.guarded(), 1u);
}

TEST(Transmission, StopsWhenThePortGoes)
{
    fdl::Transmission reply;
    reply.begin(10, kFirstWrite, Baud::k500);
    reply.stop();

    EXPECT_FALSE(reply.is_running());
    EXPECT_EQ(reply.ends_at(), kNever);
    EXPECT_EQ(reply.guarded(), 0u);
}

} // namespace
