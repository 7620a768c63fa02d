// SPDX-License-Identifier: Apache-2.0
/// The receiver and silence: when an unfinished telegram is given up, and what is found behind a stump.
#include "fdl/receiver/receiver_bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

TEST_F(Receiver, GivesASingleOctetUpAtItsDeadline)
{
    reads(octets("68"));
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(receiver.on_time(receiver.next_deadline()));

    EXPECT_EQ(next(), "unfinished");
}

TEST_F(Receiver, GivesAnUnfinishedTelegramUpAtItsDeadline)
{
    reads(Octets(first.begin(), first.begin() + 4));
    EXPECT_EQ(next(), "-");
    const Instant deadline = receiver.next_deadline();

    EXPECT_FALSE(receiver.on_time(deadline - std::chrono::nanoseconds{1}));
    EXPECT_TRUE(receiver.on_time(deadline));

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "-");
    EXPECT_FALSE(receiver.on_time(deadline));
}

TEST_F(Receiver, FindsTheTelegramBehindAStump)
{
    reads(octets("68 20 20 68 05"));
    EXPECT_EQ(next(), "-");
    now += duration_of(Tbit{33 + 11 * 6}, Baud::k187_5);
    reads(second);
    EXPECT_EQ(next(), "-");

    const Instant syn_ends = now + duration_of(33_tbit, Baud::k187_5);
    EXPECT_EQ(receiver.next_deadline(), syn_ends);
    EXPECT_FALSE(receiver.on_time(syn_ends - std::chrono::nanoseconds{1}));
    EXPECT_TRUE(receiver.on_time(syn_ends));

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "49!");
}

TEST_F(Receiver, LooksForNoTelegramBehindAStumpThatIsGone)
{
    reads(octets("10 05"));
    EXPECT_EQ(next(), "-");
    now += duration_of(Tbit{33 + 11 * 7}, Baud::k187_5);
    reads(Octets(first.begin(), first.begin() + 7));
    EXPECT_EQ(next(), "end delimiter");
    EXPECT_EQ(next(), "-");

    EXPECT_EQ(receiver.next_deadline(),
              now + fdl::silence_limit(Baud::k187_5) + duration_of(Tbit{64 * 11}, Baud::k187_5))
        << "nothing but the end of the second one is waited for";
}

/// A stump of five octets that says it is 38 long, and a pause behind which a telegram may begin.
class BehindAStump : public Receiver {
protected:
    BehindAStump()
    {
        reads(octets("68 20 20 68 05"));
        EXPECT_EQ(next(), "-");
    }
    /// T_SYN, and the time of so many octets.
    void pauses_before(std::uint32_t octets) { now += duration_of(Tbit{33 + 11 * octets}, Baud::k187_5); }
    bool hunts() { return receiver.on_time(now + duration_of(33_tbit, Baud::k187_5)); }
};

TEST_F(BehindAStump, ATelegramIsTheNewestWhenNothingFollowedItForTsyn)
{
    pauses_before(6);
    reads(second, true);
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(hunts());

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "49!");
}

TEST_F(BehindAStump, HalfATelegramIsNotFound)
{
    pauses_before(3);
    reads(Octets(second.begin(), second.begin() + 3));
    EXPECT_EQ(next(), "-");

    EXPECT_FALSE(hunts());

    EXPECT_EQ(next(), "-");
    EXPECT_EQ(receiver.judged(), 0u);
}

TEST_F(BehindAStump, ATelegramWithABadCharacterIsNotFoundEvenIfItWouldBeRightWithAZeroThere)
{
    const Octets with_zero = sd2(kUs, kMaster, kSrdFcb0, {0, 1});
    pauses_before(7);
    reads(Octets(with_zero.begin(), with_zero.begin() + 7));
    EXPECT_EQ(next(), "-");
    hears_a_bad_character();
    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    reads(Octets(with_zero.begin() + 8, with_zero.end()));
    EXPECT_EQ(next(), "-");

    EXPECT_FALSE(hunts());

    EXPECT_EQ(next(), "-");
}

TEST_F(BehindAStump, ThatEndsWithABadCharacterATelegramIsFound)
{
    hears_a_bad_character();
    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    pauses_before(6);
    reads(second);
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(hunts());

    EXPECT_EQ(next(), "49!");
    EXPECT_EQ(next(), "-");
}

TEST_F(Receiver, FindsTheTelegramBehindAStumpAlsoWhenTheStumpEndedWithABadCharacterOfItsRead)
{
    reads(octets("68 20 20 68 05"), true);
    EXPECT_EQ(next(), "-");
    hears_a_bad_character();
    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    now += duration_of(Tbit{33 + 11 * 6}, Baud::k187_5);
    reads(second);
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(receiver.on_time(now + duration_of(33_tbit, Baud::k187_5)));

    EXPECT_EQ(next(), "49!");
}

TEST_F(BehindAStump, OctetsOfTheFailedTelegramAreCountedOnceAlsoBehindOneThatWasFoundInIt)
{
    pauses_before(33);
    reads(joined({second, Octets(27, 0x00)})); // 38 octets with the stump, and no end delimiter

    EXPECT_EQ(next(), "end delimiter");
    EXPECT_EQ(next(), "49");
    EXPECT_EQ(next(), "-");
    EXPECT_EQ(receiver.judged(), 38u);
}

TEST_F(BehindAStump, ThatWasGivenUpNothingIsLookedForInTheNextTelegram)
{
    pauses_before(2);
    reads(octets("01 02"));
    EXPECT_EQ(next(), "-");
    EXPECT_FALSE(hunts());
    EXPECT_TRUE(receiver.on_time(receiver.next_deadline()));
    EXPECT_EQ(next_with_its_place(), "7 unfinished");
    EXPECT_EQ(receiver.judged(), 7u);

    reads(Octets(first.begin(), first.begin() + 7));
    EXPECT_EQ(next(), "-");

    EXPECT_EQ(receiver.next_deadline(),
              now + fdl::silence_limit(Baud::k187_5) + duration_of(Tbit{64 * 11}, Baud::k187_5));
}

TEST_F(Receiver, WaitsForTheRestAsLongAsTheNewRateSays)
{
    receiver.restart(Baud::k500);

    reads(octets("68"));
    EXPECT_EQ(next(), "-");

    EXPECT_EQ(receiver.next_deadline(),
              now + fdl::silence_limit(Baud::k500) + duration_of(Tbit{64 * 11}, Baud::k500));
}

TEST_F(Receiver, CountsWhatItDropsAtAnotherRateAsHeard)
{
    reads(joined(std::vector<Octets>(86, second))); // more than its buffer holds
    EXPECT_EQ(next(), "49");

    receiver.restart(Baud::k500);

    EXPECT_EQ(receiver.judged(), 86u * 6);
}

} // namespace
