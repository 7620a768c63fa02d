// SPDX-License-Identifier: Apache-2.0
/// A telegram with a silence in it: a real one that was read late, or a stump that makes one by chance with
/// what came behind it. The checksum and the end delimiter say nothing then; what begins behind the silence
/// does.
#include "fdl/receiver/receiver_bench.hpp"

using namespace dpslave;
using namespace test;
using std::chrono::nanoseconds;

namespace {

TEST_F(SilenceInATelegram, StumpThatEndsLikeTheTelegramBehindItIsUnfinished)
{
    reads(stump);
    EXPECT_EQ(next(), "-");

    reads_behind_silence(behind);

    EXPECT_EQ(next_with_its_place(), "0 unfinished");
    EXPECT_EQ(next_with_its_place(), "8..14 49");
    EXPECT_EQ(next(), "-");
}

TEST_F(SilenceInATelegram, StumpThatEndsWithinTheTelegramBehindItIsUnfinished)
{
    // 05 + 02 + 5D, then 68 06 06 68 05 02 5D = 134: together 98, and ED behind it.
    reads(octets("68 0A 0A 68 05 02 5D"));
    EXPECT_EQ(next(), "-");
    falls_silent_before(9);
    reads(octets("68 06 06 68 05 02 5D A4 16"));
    EXPECT_EQ(next(), "-") << "one telegram seems to be whole, the other one may become so";

    goes_on(octets("33 51 16"));

    EXPECT_EQ(next_with_its_place(), "0 unfinished");
    EXPECT_EQ(next_with_its_place(), "7..19 5D");
}

TEST_F(SilenceInATelegram, StumpBehindWhichSeveralTelegramsComeIsUnfinished)
{
    // The end of the second one is the end of the stump: F0 and the 10 09 02 49 54 16 of the first are BE.
    reads(octets("68 0E 0E 68 05 02 5D BE"));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(joined({behind, behind}));

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "49");
    EXPECT_EQ(next(), "49!");
}

TEST_F(SilenceInATelegram, TwentyThreeBitsAreASilence)
{
    reads(stump);
    EXPECT_EQ(next(), "-");
    falls_silent_before(6, 23);
    reads(behind);

    EXPECT_EQ(next(), "unfinished");
}

TEST_F(SilenceInATelegram, TwentyTwoBitsAreNone)
{
    reads(stump);
    EXPECT_EQ(next(), "-");
    falls_silent_before(6, 22);
    reads(behind);

    EXPECT_EQ(next(), "5D!") << "the next read may have been late by that much";
}

TEST_F(SilenceInATelegram, WhatBeganBeforeTheSilenceIsSkippedWithTheStump)
{
    // 05 + 02 + E5 + 04 = F0. A read begins with the E5, without a silence.
    reads(octets("68 08 08 68 05 02"));
    EXPECT_EQ(next(), "-");
    now += duration_of(33_tbit, Baud::k187_5);
    reads(octets("E5 04"));
    EXPECT_EQ(next(), "-");
    falls_silent_before(6);
    reads(behind);

    EXPECT_EQ(next_with_its_place(), "0 unfinished");
    EXPECT_EQ(next_with_its_place(), "8..14 49") << "no SC before it";
}

TEST_F(SilenceInATelegram, TelegramIsGoodWhenOnlyAPartOfWhatBeginsBehindTheSilenceIsOne)
{
    const Octets whole = sd2(kUs, kMaster, kSrdFcb0, joined({behind, octets("01 02")}));
    reads(Octets(whole.begin(), whole.begin() + 7));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(Octets(whole.begin() + 7, whole.end()));

    EXPECT_EQ(next(), "5D!");
}

TEST_F(SilenceInATelegram, TelegramIsGoodWhenATokenEndsLikeIt)
{
    const Octets whole = sd2(kUs, kMaster, kSrdFcb0, octets("01 DC"));
    reads(Octets(whole.begin(), whole.end() - 3));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(Octets(whole.end() - 3, whole.end()));

    EXPECT_EQ(next(), "5D!") << "a token has no checksum";
}

TEST_F(SilenceInATelegram, TokenThatGoesOnInTheNextReadIsNoneAlsoWithoutASilence)
{
    reads(octets("DC 16"));
    EXPECT_EQ(next(), "-");

    goes_on(first);

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "5D!");
}

TEST_F(SilenceInATelegram, DoubtStaysWhenNothingBeginsBehindAnotherSilence)
{
    // 05 + 02 + 5D + 10 + 01 = 75
    reads(octets("68 05 05 68 05 02 5D"));
    EXPECT_EQ(next(), "-");
    reads_behind_silence(octets("10"));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(octets("01 75 16"));

    EXPECT_EQ(next(), "-");
    EXPECT_TRUE(stays_silent(33));
    EXPECT_EQ(next(), "5D!");
}

TEST_F(SilenceInATelegram, EndOfTheDoubtLeavesTheBeginningOfTheNextTelegram)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");
    goes_on(octets("68"));
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(stays_silent(33));

    EXPECT_EQ(next(), "5D");
    EXPECT_EQ(next(), "-");
    EXPECT_GT(receiver.next_deadline(), now) << "only the rest is waited for";
}

TEST_F(SilenceInATelegram, TelegramBehindAStumpIsFoundAlsoWhenABadCharacterEndedADoubt)
{
    const Octets whole = sd2(kUs, kMaster, kSrdFcb0, octets("68 20 20 68")); // 38 octets may begin in it
    reads(Octets(whole.begin(), whole.begin() + 7));
    EXPECT_EQ(next(), "-");
    reads_behind_silence(Octets(whole.begin() + 7, whole.end()));
    EXPECT_EQ(next(), "-");
    now += duration_of(11_tbit, Baud::k187_5);
    hears_a_bad_character();
    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    reads_behind_silence(behind);
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(stays_silent(33));

    EXPECT_EQ(next(), "49!");
}

TEST_F(SilenceInATelegram, TelegramIsHeardAtOnceWhenNothingBeginsBehindTheSilence)
{
    reads(Octets(first.begin(), first.begin() + 7));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(Octets(first.begin() + 7, first.end()));

    EXPECT_EQ(next(), "5D!");
}

TEST_F(SilenceInATelegram, TelegramIsHeardAtOnceWhenWhatBeginsBehindTheSilenceFails)
{
    const Octets whole = sd2(kUs, kMaster, kSrdFcb0, octets("10 09 02 49 55 16"));
    reads(Octets(whole.begin(), whole.begin() + 7));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(Octets(whole.begin() + 7, whole.end()));

    EXPECT_EQ(next(), "5D!");
}

TEST_F(SilenceInATelegram, TelegramInDoubtIsHeardAsTheNewestAfterTsyn)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");
    EXPECT_EQ(receiver.next_deadline(), now + duration_of(33_tbit, Baud::k187_5));
    EXPECT_FALSE(receiver.on_time(receiver.next_deadline() - nanoseconds{1}));

    EXPECT_TRUE(receiver.on_time(receiver.next_deadline()));

    EXPECT_EQ(next(), "5D!");
    EXPECT_EQ(next(), "-");
    EXPECT_EQ(receiver.next_deadline(), kNever);
}

TEST_F(SilenceInATelegram, TelegramInDoubtIsHeardWhenWhatFollowsFails)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");

    goes_on(behind); // 10 09 7E 16 10 09: no telegram

    EXPECT_EQ(next(), "5D");
    EXPECT_EQ(next(), "49!");
}

TEST_F(SilenceInATelegram, TelegramInDoubtIsHeardWhenTheNextSilenceIsSeenWithWhatCameBehindIt)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");

    reads_behind_silence(octets("02 16")); // would make 10 09 7E 16 02 16 of it: no checksum of that is right

    EXPECT_EQ(next(), "5D");
    EXPECT_EQ(next(), "start delimiter");
}

TEST_F(SilenceInATelegram, NothingBecomesWholeAcrossTheNextSilence)
{
    // 05 + 02 + 5D + 10 + 09 = 7D; 10 09 7D 16 9C 16 would be a telegram: 09 + 7D + 16 = 9C.
    reads(octets("68 05 05 68 05 02 5D"));
    EXPECT_EQ(next(), "-");
    reads_behind_silence(octets("10 09 7D 16"));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(octets("9C 16"));

    EXPECT_EQ(next(), "5D");
}

TEST_F(SilenceInATelegram, TelegramInDoubtIsHeardAlsoWhenTheTimeIsLookedAtTooLate)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");
    EXPECT_TRUE(receiver.is_in_doubt());

    falls_silent_before(6, 10'000);
    reads(behind);

    EXPECT_EQ(next(), "5D");
    EXPECT_EQ(next(), "49!");
    EXPECT_EQ(next(), "-");
    EXPECT_FALSE(receiver.is_in_doubt());
}

TEST_F(SilenceInATelegram, NothingIsInDoubtAtAnotherRate)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");

    receiver.restart(Baud::k500);

    EXPECT_FALSE(receiver.is_in_doubt());
}

TEST_F(SilenceInATelegram, TelegramInDoubtIsGivenUpWithABadCharacterBehindIt)
{
    reads(begun);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(rest);
    EXPECT_EQ(next(), "-");
    now += duration_of(11_tbit, Baud::k187_5);

    hears_a_bad_character();

    EXPECT_EQ(next(), "bad character");
    EXPECT_EQ(next(), "-");
    EXPECT_FALSE(stays_silent(33)) << "it is not known what it was";
}

} // namespace
