// SPDX-License-Identifier: Apache-2.0
/// The receiver by itself: octets in, telegrams and flaws out.
#include "bench.hpp"

#include "dpslave/fdl/receiver.hpp"

using namespace dpslave;
using namespace test;

namespace {

class Receiver : public testing::Test {
protected:
    void reads(const Octets& octets, bool more_follows = false)
    {
        receiver.begin_read(octets.size(), now);
        kept = octets;
        receiver.on_bytes(kept, more_follows);
    }
    /// "7D" for a telegram with this FC, "!" for one behind which nothing was heard, else the flaw.
    std::string next()
    {
        const auto* heard = receiver.next();
        if (heard == nullptr) return "-";
        if (!heard->telegram) return std::string{text(heard->telegram.error())};
        return show({heard->telegram->fc}) + (heard->newest ? "!" : "");
    }

    Instant now{std::chrono::seconds{3}};
    Octets kept;
    fdl::Receiver receiver{Baud::k187_5};
    const Octets first = sd2(kUs, kMaster, kSrdFcb0, {1, 2});
    const Octets second = sd1(kOther, kMaster, kFdlStatus);
};

TEST_F(Receiver, GivesTelegramsAndFlawsInTheOrderOfTheLine)
{
    reads(joined({first, octets("FF"), second}));

    EXPECT_EQ(next(), "5D");
    EXPECT_EQ(next(), "start delimiter");
    EXPECT_EQ(next(), "49!");
    EXPECT_EQ(next(), "-");
    EXPECT_EQ(receiver.next_deadline(), kNever);
}

TEST_F(Receiver, JoinsWhatComesInSeveralReads)
{
    reads(Octets(first.begin(), first.begin() + 4));
    EXPECT_EQ(next(), "-");
    EXPECT_NE(receiver.next_deadline(), kNever);
    reads(Octets(first.begin() + 4, first.end()));

    EXPECT_EQ(next(), "5D!");
}

TEST_F(Receiver, DoesNotTakeATelegramForTheNewestWhenMoreFollows)
{
    reads(first, true);

    EXPECT_EQ(next(), "5D");
}

TEST_F(Receiver, LeavesOutTheTelegramWithABadCharacter)
{
    reads(Octets(first.begin(), first.begin() + 7));
    EXPECT_EQ(next(), "-");
    receiver.begin_read(1, now);
    receiver.on_character_error();
    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    reads(joined({Octets(first.begin() + 8, first.end()), second}));

    EXPECT_EQ(next(), "49!");
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

    EXPECT_TRUE(receiver.on_time(receiver.next_deadline()));

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

TEST_F(Receiver, ReportsNothingOfWhatWasGivenUpAtAnotherRate)
{
    reads(Octets(first.begin(), first.begin() + 4));
    EXPECT_EQ(next(), "-");
    EXPECT_TRUE(receiver.on_time(receiver.next_deadline()));

    receiver.restart(Baud::k500);

    EXPECT_EQ(next(), "-");
}

TEST_F(Receiver, DropsTheRestOfAReadAtAnotherRate)
{
    reads(joined({first, second, first}));
    EXPECT_EQ(next(), "5D");

    receiver.restart(Baud::k500);

    EXPECT_EQ(next(), "-");
    reads(second);
    EXPECT_EQ(next(), "49!");
}

TEST_F(Receiver, CountsDamageAnewAtAnotherRate)
{
    reads(octets("00"));
    EXPECT_EQ(next(), "start delimiter");

    receiver.restart(Baud::k500);

    reads(octets("00"));
    EXPECT_EQ(next(), "start delimiter");
}

TEST_F(Receiver, DropsWhatWasHeardAtAnotherRate)
{
    reads(Octets(first.begin(), first.begin() + 4));
    EXPECT_EQ(next(), "-");

    receiver.restart(Baud::k500);

    EXPECT_EQ(receiver.next_deadline(), kNever);
    reads(second);
    EXPECT_EQ(next(), "49!");
}

} // namespace
