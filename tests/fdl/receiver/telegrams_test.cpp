// SPDX-License-Identifier: Apache-2.0
/// The receiver by itself: octets in, telegrams and flaws out.
#include "fdl/receiver/receiver_bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

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

TEST_F(Receiver, LooksForNoTelegramInTheDataOfOneWithABadCharacter)
{
    const Octets within = sd2(kUs, kMaster, kSrdFcb0, sd1(kUs, kMaster, kFdlStatus));
    reads(Octets(within.begin(), within.begin() + 5));
    EXPECT_EQ(next(), "-");
    hears_a_bad_character();
    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    reads(joined({Octets(within.begin() + 6, within.end()), second}));

    EXPECT_EQ(next(), "49!");
    EXPECT_EQ(next(), "-");
}

TEST_F(Receiver, IsDoneWithATelegramWhoseLastCharacterIsBad)
{
    reads(Octets(first.begin(), first.end() - 1));
    EXPECT_EQ(next(), "-");
    hears_a_bad_character();

    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    EXPECT_EQ(receiver.judged(), first.size());
    EXPECT_EQ(receiver.next_deadline(), kNever);
}

TEST_F(Receiver, SaysWhereTelegramsAndFlawsLieAmongAllCharactersHeard)
{
    hears_a_bad_character();
    EXPECT_EQ(next_with_its_place(), "1 bad character");
    reads(joined({second, octets("FF FF"), second}));
    EXPECT_EQ(next_with_its_place(), "1..7 49");
    EXPECT_EQ(next_with_its_place(), "7 start delimiter");
    EXPECT_EQ(next_with_its_place(), "9..15 49");
    EXPECT_EQ(next_with_its_place(), "-");
    EXPECT_EQ(receiver.judged(), 15u);

    reads(joined({octets("10 05 02 49 51 16"), octets("68 05")})); // a wrong checksum, and a stump
    EXPECT_EQ(next_with_its_place(), "15 checksum");
    EXPECT_EQ(next_with_its_place(), "-");
    EXPECT_EQ(receiver.judged(), 21u);
}

TEST_F(Receiver, TakesTheLastTelegramOfALongReadForTheNewestAndNoOther)
{
    // 85 of them fill the buffer to its end.
    const std::vector<Octets> many(86, second);
    reads(joined(many));

    for (int i = 0; i < 85; ++i) ASSERT_EQ(next(), "49") << i;
    EXPECT_EQ(next(), "49!");
    EXPECT_EQ(next(), "-");
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
