// SPDX-License-Identifier: Apache-2.0
/// A telegram that comes in several reads, or a read in several pieces: where a silence was, and where
/// something may have begun.
#include "fdl/receiver/receiver_bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

TEST_F(SilenceInATelegram, PlacesOfSilencesMoveWithWhatIsDropped)
{
    reads(octets("68 20 20 68 05"));
    EXPECT_EQ(next(), "-");
    reads_behind_silence(stump);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(behind);
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(stays_silent(33));

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next_with_its_place(), "13..19 49");
}

TEST_F(SilenceInATelegram, NoPlaceIsLeftOfATelegramThatWasGivenUp)
{
    reads(octets("68 20 20 68 05"));
    EXPECT_EQ(next(), "-");
    reads_behind_silence(octets("01 02"));
    EXPECT_EQ(next(), "-");
    EXPECT_TRUE(stays_silent(5000));
    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "-");

    const Octets good = joined({octets("68 05 05 68 F0"), behind}); // F0 + 10 + 09 + 02 + 49 = 54
    reads(Octets(good.begin(), good.begin() + 2));
    EXPECT_EQ(next(), "-");
    goes_on(Octets(good.begin() + 2, good.end()));
    EXPECT_EQ(next(), "09!");
    EXPECT_EQ(next(), "-");

    Octets bad = good;
    bad[4] = 0xF1;
    reads(Octets(bad.begin(), bad.begin() + 2));
    EXPECT_EQ(next(), "-");
    goes_on(Octets(bad.begin() + 2, bad.end()));
    EXPECT_EQ(next(), "checksum");
    EXPECT_EQ(next(), "-") << "it is not searched where the one before had its pause";
}

/// Behind octets that begin like an SD3, without a pause, stands what looks like a request.
TEST_F(SilenceInATelegram, FailedTelegramIsSearchedAlikeWhenItsEndComesOctetByOctet)
{
    const Octets noise = octets("A2 05 30 80 02 0E A2 05 10 02 06 50");
    const Octets request = octets("68 10 05 02 49 50 16"); // the SD3 ends behind the 10
    const auto all_of = [this] {
        std::vector<std::string> all;
        for (std::string one = next(); one != "-"; one = next()) all.push_back(one);
        return all;
    };
    reads(noise);
    EXPECT_EQ(next(), "-");
    reads_behind_silence(request);
    const auto in_one_read = all_of();

    stays_silent(5000);
    all_of();
    reads(noise);
    EXPECT_EQ(next(), "-");
    std::vector<std::string> in_pieces;
    falls_silent_before(request.size());
    for (std::size_t i = 0; i < request.size(); ++i) {
        reads({request[i]}, i + 1 < request.size());
        for (const std::string& one : all_of()) in_pieces.push_back(one);
    }
    EXPECT_EQ(in_pieces, in_one_read);
}

TEST_F(SilenceInATelegram, FailedTelegramIsSearchedOnlyWhereAReadBegan)
{
    Octets bad = sd2(kUs, kMaster, kSrdFcb0, joined({octets("01 02"), behind}));
    bad[bad.size() - 2] ^= 0x01;
    reads(Octets(bad.begin(), bad.begin() + 7));
    EXPECT_EQ(next(), "-");

    reads_behind_silence(Octets(bad.begin() + 7, bad.end()));

    EXPECT_EQ(next(), "checksum");
    EXPECT_EQ(next(), "-") << "01 02 begins nothing, and what is behind it are its data";
}

TEST_F(SilenceInATelegram, SecondFlawBehindADamagedBeginningIsCounted)
{
    reads(octets("00"));
    EXPECT_EQ(next(), "start delimiter");
    goes_on(octets("68 08 08 68 05"));
    EXPECT_EQ(next(), "-");
    falls_silent_before(9, 77);
    reads(octets("68 20 20 68 01 01 01 01 01")); // the end of the first one, and the beginning of another
    EXPECT_EQ(next(), "-") << "the flaw is reported";

    goes_on(Octets(29, 0x01));

    EXPECT_EQ(next(), "end delimiter");
}

TEST_F(SilenceInATelegram, ReadsInPiecesAreNoSilence)
{
    reads(begun);
    EXPECT_EQ(next(), "-");

    goes_on(rest);

    EXPECT_EQ(next(), "5D!");
}

/// What is read at one moment came one octet behind the other: the silence ended with the first of them.
TEST_F(SilenceInATelegram, SilenceIsThatBeforeTheWholeReadAlsoWhereTheReadComesInPieces)
{
    reads(stump);
    EXPECT_EQ(next(), "-");

    now += duration_of(Tbit{11 * 12}, Baud::k187_5); // no pause
    reads(behind, true);
    EXPECT_EQ(next(), "-") << "it is not known yet when the read began";
    reads(behind);

    EXPECT_EQ(next_with_its_place(), "0..14 5D");
    EXPECT_EQ(next_with_its_place(), "14..20 49");
}

TEST_F(SilenceInATelegram, ReadThatComesInPiecesBehindASilenceIsJudgedWithItsLastPiece)
{
    reads(stump);
    EXPECT_EQ(next(), "-");

    falls_silent_before(12);
    reads(behind, true);
    EXPECT_EQ(next(), "-");
    reads(behind);

    EXPECT_EQ(next_with_its_place(), "0 unfinished");
    EXPECT_EQ(next_with_its_place(), "8..14 49");
    EXPECT_EQ(next_with_its_place(), "14..20 49");
}

TEST_F(SilenceInATelegram, PieceThatWasReadLateMakesNone)
{
    reads(octets("68 05 05 68 F0"));
    EXPECT_EQ(next(), "-");
    now += duration_of(33_tbit, Baud::k187_5); // 22 of them are the two octets
    reads(octets("10 09"), true);
    EXPECT_EQ(next(), "-");
    now += duration_of(100_tbit, Baud::k187_5); // the thread was taken off the processor
    reads(octets("02 49 54 16"));

    EXPECT_EQ(next(), "09!");
}

TEST_F(SilenceInATelegram, PieceThatWasReadLateIsNoPlaceToSearchAt)
{
    reads(octets("68 05 05 68 F1"));
    EXPECT_EQ(next(), "-");
    now += duration_of(22_tbit, Baud::k187_5);
    reads(octets("10 09"), true);
    EXPECT_EQ(next(), "-");
    now += duration_of(100_tbit, Baud::k187_5);
    reads(octets("02 49 54 16"));

    EXPECT_EQ(next(), "checksum");
    EXPECT_EQ(next(), "-");
}

TEST_F(SilenceInATelegram, GoodTelegramIsHeardAlsoWhenABadCharacterFollowsInTheSameRead)
{
    reads(Octets(first.begin(), first.begin() + 7));
    EXPECT_EQ(next(), "-");
    now += duration_of(Tbit{11 * 4}, Baud::k187_5);
    reads(Octets(first.begin() + 7, first.end()), true);

    EXPECT_EQ(next(), "5D");
    hears_a_bad_character();
    EXPECT_EQ(next(), "bad character");
}

TEST_F(SilenceInATelegram, PauseBehindAPieceThatWasTheLastIsSeen)
{
    reads(octets("68 20 20 68 05"), true);
    EXPECT_EQ(next(), "-");
    EXPECT_FALSE(receiver.on_time(now));

    reads_behind_silence(behind);
    EXPECT_EQ(next(), "-");
    EXPECT_TRUE(stays_silent(33));

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "49!");
}

TEST_F(SilenceInATelegram, BeforeAReadInPiecesIsNoneOfTheTelegramThatBeginsInIt)
{
    const Octets good = joined({octets("68 05 05 68 F0"), behind}); // F0 + 10 + 09 + 02 + 49 = 54
    reads(octets("68 05 05 68 05"));
    EXPECT_EQ(next(), "-");
    falls_silent_before(17);
    reads(joined({Octets(6, 0x00), Octets(good.begin(), good.begin() + 2)}), true);
    EXPECT_EQ(next(), "end delimiter");
    EXPECT_EQ(next(), "-");

    reads(Octets(good.begin() + 2, good.end()));

    EXPECT_EQ(next(), "09!");
}

TEST_F(SilenceInATelegram, LongReadInPiecesIsJudgedWhenThereIsNoRoomForMore)
{
    reads(stump);
    EXPECT_EQ(next(), "-");

    falls_silent_before(6 * 100);
    reads(joined(std::vector<Octets>(100, behind)), true);

    EXPECT_EQ(next_with_its_place(), "0 unfinished");
    for (int i = 0; i < 100; ++i) EXPECT_EQ(next(), "49") << i;
}

TEST_F(SilenceInATelegram, PieceBehindWhichNothingFollowsIsJudgedAfterTsyn)
{
    reads(stump);
    EXPECT_EQ(next(), "-");
    falls_silent_before(6);
    reads(behind, true);
    EXPECT_EQ(next(), "-");

    EXPECT_TRUE(stays_silent(33));

    EXPECT_EQ(next(), "unfinished");
    EXPECT_EQ(next(), "49!");
}

} // namespace
