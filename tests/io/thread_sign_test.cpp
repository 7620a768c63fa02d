// SPDX-License-Identifier: Apache-2.0
/// The signs of a thread that uses ports, and its calls that stall.
#include "pty.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"
#include "dpslave/io/tty.hpp"

#include <gtest/gtest.h>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;

constexpr Instant kBegin{1h};

TEST(ThreadSign, IsGivenAtBothEndsOfACall)
{
    ThreadSign sign;
    sign.enter(PortCall::write, kBegin);
    EXPECT_EQ(sign.last(), kBegin);
    EXPECT_EQ(sign.call(), PortCall::write);
    sign.leave(kBegin + 10ms);
    EXPECT_EQ(sign.last(), kBegin + 10ms);
    EXPECT_EQ(sign.call(), PortCall::none);
    EXPECT_FALSE(sign.stall());
}

TEST(ThreadSign, OfACallThatTakesLongIsAStallUntilItIsCleared)
{
    ThreadSign sign;
    sign.enter(PortCall::drain, kBegin);
    sign.leave(kBegin + ThreadSign::kStall);
    sign.enter(PortCall::write, kBegin + 1s);
    sign.leave(kBegin + 3s);
    ASSERT_TRUE(sign.stall());
    EXPECT_EQ(sign.stall()->call, PortCall::drain) << "the first";
    EXPECT_EQ(sign.stall()->length, ThreadSign::kStall);
    sign.clear_stall();
    EXPECT_FALSE(sign.stall());
}

TEST(ThreadSign, OfAMachineThatHadNoTimeIsNoStall)
{
    ThreadSign sign;
    sign.give(kBegin);
    sign.give(kBegin + 60s);
    EXPECT_FALSE(sign.stall());
    EXPECT_EQ(sign.last(), kBegin + 60s);
}

class SignsOfThisThread : public testing::Test {
protected:
    SignsOfThisThread() { set_sign_of_this_thread(&sign); }
    ~SignsOfThisThread() override { set_sign_of_this_thread(nullptr); }
    void stalls()
    {
        sign.enter(PortCall::write, kBegin);
        sign.leave(kBegin + 1s);
    }
    ThreadSign sign;
    Pty pty;
};

TEST_F(SignsOfThisThread, ComeWhileItWaitsForOctets)
{
    auto tty = Tty::open(pty.path(), {.baud = 9600});
    ASSERT_TRUE(tty) << tty.error();
    const Instant before = sign.last();
    EXPECT_FALSE(tty->wait_readable(1ms));
    EXPECT_GT(sign.last(), before);
}

TEST_F(SignsOfThisThread, EndTheWaitOfAThreadThatStalled)
{
    auto tty = Tty::open(pty.path(), {.baud = 9600});
    ASSERT_TRUE(tty) << tty.error();
    stalls();
    const Instant before = monotonic_now();
    EXPECT_FALSE(tty->wait_readable(24h));
    EXPECT_LT(monotonic_now() - before, 12h);
    EXPECT_TRUE(this_thread_stalled());
}

TEST_F(SignsOfThisThread, LetItWriteNothingBehindACallThatStalled)
{
    EXPECT_TRUE(this_thread_may_write());
    stalls();
    EXPECT_FALSE(this_thread_may_write()) << "what it would write now is older than the call";
    sign.clear_stall();
    EXPECT_TRUE(this_thread_may_write());
}

TEST_F(SignsOfThisThread, AreThoseOfNobodyWhereNoneIsSet)
{
    set_sign_of_this_thread(nullptr);
    const Instant before = sign.last();
    give_sign();
    EXPECT_EQ(sign.last(), before);
    EXPECT_FALSE(this_thread_stalled());
}

} // namespace
} // namespace dpslave::io
