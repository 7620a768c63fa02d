// SPDX-License-Identifier: Apache-2.0
/// Only the newest request heard is answered (wire reference 1.5, stale-request rule).
#include "bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

using NewestRequest = FdlStation;

TEST_F(NewestRequest, IsSilentWhenTheMasterHasAlreadyGoneOn)
{
    bus.arrives_in_one_read({sd2(kUs, kMaster, kSrdFcb1, {0xAA}), sd2(kOther, kMaster, kSrdFcb1, {0xBB})});

    EXPECT_FALSE(bus.reply());
}

TEST_F(NewestRequest, OvertakenOneIsDroppedWholeSoThatItsRetryIsNew)
{
    bus.arrives_in_one_read({sd2(kUs, kMaster, kSrdFcb1, {0xAA}), token(3, kMaster)});
    EXPECT_TRUE(user.srds.empty());
    EXPECT_TRUE(user.heards.empty());
    EXPECT_EQ(station.counters().overtaken, 1u);

    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {0xAA}));
    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().retries, 0u);
}

TEST_F(NewestRequest, OfARequestAndItsRetryInOneReadOnlyTheRetryIsExecuted)
{
    const Octets request = sd2(kUs, kMaster, kSrdFcb1, {0xAA});
    bus.arrives_in_one_read({request, request});

    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().overtaken, 1u);
}

TEST_F(NewestRequest, EverySdnInOneReadIsCarriedOut)
{
    bus.arrives_in_one_read({sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0x08, 0}),
                             sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0x04, 0}),
                             sd2(kUs, kMaster, kSrdFcb1, {1})});

    EXPECT_TRUE(bus.reply());
    ASSERT_EQ(user.sdns.size(), 2u);
    EXPECT_EQ(user.sdns[0].data, octets("08 00"));
    EXPECT_EQ(user.sdns[1].data, octets("04 00"));
    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(NewestRequest, AtTheEndOfAPieceOfOneReadIsDroppedWhole)
{
    const Octets request = sd2(kUs, kMaster, kSrdFcb1, {0xAA});
    station.on_bytes(request, bus.now(),
                     true); // the edge has more of the same read: a bad character, the rest
    station.on_character_error(bus.now());

    EXPECT_TRUE(user.srds.empty());
    EXPECT_EQ(station.counters().overtaken, 1u);
}

TEST_F(NewestRequest, OvertakenFdlStatusIsNotAnswered)
{
    bus.arrives_in_one_read({sd1(kUs, kMaster, kFdlStatus), sd1(kOther, kMaster, kFdlStatus)});

    EXPECT_FALSE(bus.reply());
    EXPECT_TRUE(user.heards.empty());
}

TEST_F(NewestRequest, OneOctetBehindARequestIsEnough)
{
    bus.arrives_in_one_read({sd2(kUs, kMaster, kSrdFcb1, {1}), {0x10}});

    EXPECT_FALSE(bus.reply());
    EXPECT_TRUE(user.srds.empty());
}

TEST_F(NewestRequest, ReadThatEndsOneTelegramAndBringsAnotherDropsTheFirst)
{
    const Octets first = sd2(kUs, kMaster, kSrdFcb1, {1, 2, 3});
    const Octets half(first.begin(), first.begin() + 6);
    Octets rest(first.begin() + 6, first.end());
    const Octets next = sd1(kOther, kMaster, kFdlStatus);
    rest.insert(rest.end(), next.begin(), next.end());
    bus.breaks_in_after(bus.bits(33), half);
    bus.breaks_in_after(bus.bits(0), rest);

    EXPECT_FALSE(bus.reply());
    EXPECT_TRUE(user.srds.empty());
}

TEST_F(NewestRequest, OctetsThatArriveLaterCancelTheReplyButNotWhatWasDone)
{
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    bus.breaks_in_after(bus.bits(3), {0x16});

    EXPECT_FALSE(bus.reply());
    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().overtaken, 1u);
    EXPECT_EQ(station.counters().replies, 0u);
}

TEST_F(NewestRequest, BadCharacterThatArrivesLaterCancelsTheReplyToo)
{
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    station.on_character_error(bus.now());

    EXPECT_FALSE(bus.reply());
    EXPECT_EQ(station.counters().overtaken, 1u);
}

TEST_F(NewestRequest, IsAnsweredBehindTheReplyOfAnotherSlaveInTheSameRead)
{
    bus.arrives_in_one_read(
        {sd2(kMaster, kOther, 0x08, {0xE5, 0x10, 0x68}), sd2(kUs, kMaster, kSrdFcb1, {1})});

    EXPECT_TRUE(bus.reply());
}

TEST_F(NewestRequest, IsAnsweredHoweverManyTelegramsTheReaderSleptThrough)
{
    std::vector<Octets> telegrams(40, sd2(kMaster, kOther, 0x08, Octets(200, 0x68)));
    telegrams.push_back(sd2(kUs, kMaster, kSrdFcb1, {1}));
    bus.arrives_in_one_read(telegrams);

    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(station.counters().telegrams, 41u);
}

} // namespace
