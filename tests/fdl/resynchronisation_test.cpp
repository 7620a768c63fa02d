// SPDX-License-Identifier: Apache-2.0
/// Tests what the receiver does with noise, with unfinished telegrams and with other slaves' replies (wire
/// reference 1.5).
#include "bench.hpp"

using namespace dpslave;
using namespace test;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

namespace {

using Resynchronisation = FdlStation;

TEST_F(Resynchronisation, ImpossibleOctetsAreSkippedOneByOne)
{
    bus.arrives_in_one_read({joined({octets("00 FF 16 49"), kAsk})});

    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::start_delimiter)], 1u);
}

TEST_F(Resynchronisation, HeaderThatContradictsItselfIsSkippedOctetByOctet)
{
    bus.arrives_in_one_read(
        {joined({octets("68 05 07"), kAsk})}); // 68 05 07 68: no header; the next 68 is one

    EXPECT_TRUE(bus.reply());
}

TEST_F(Resynchronisation, StartDelimiterHeardTwiceCostsOneOctet)
{
    bus.arrives_in_one_read({joined({octets("68"), kAsk})});

    EXPECT_TRUE(bus.reply());
}

TEST_F(Resynchronisation, WrongLeBeforeAGoodTelegramCostsOnlyTheHeader)
{
    bus.arrives_in_one_read({joined({octets("68 03 03 68"), kAsk})});

    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::length_range)], 1u);
}

TEST_F(Resynchronisation, TelegramWithWrongChecksumIsNotSearchedInside)
{
    Octets carrier = sd2(kMaster, kOther, 0x08, sd1(kUs, kMaster, kFdlStatus)); // a whole request as data
    carrier[carrier.size() - 2] ^= 0x01;
    bus.master_sends(carrier);

    EXPECT_FALSE(bus.reply());
    EXPECT_EQ(station.counters().telegrams, 0u);
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::checksum)], 1u);
}

TEST_F(Resynchronisation, TelegramWithWrongEndDelimiterIsNotSearchedInside)
{
    Octets carrier = sd2(kMaster, kOther, 0x08, sd1(kUs, kMaster, kFdlStatus));
    carrier.back() = 0x17;
    bus.master_sends(carrier);

    EXPECT_FALSE(bus.reply());
    EXPECT_EQ(station.counters().telegrams, 0u);
}

TEST_F(Resynchronisation, RequestBehindABrokenTelegramIsAnsweredWithoutSilenceBetween)
{
    Octets broken = sd2(kOther, kMaster, kSrdFcb1, {1, 2, 3, 4});
    broken[broken.size() - 2] ^= 0x80;
    bus.arrives_in_one_read({joined({broken, kAsk})});

    EXPECT_TRUE(bus.reply());
}

class ReplyOfAnotherSlave : public FdlStation, public testing::WithParamInterface<const char*> {};

TEST_P(ReplyOfAnotherSlave, IsSkippedAsATelegramWhateverItsDataLookLike)
{
    const Octets data = octets(GetParam());
    bus.arrives_octet_by_octet(sd2(kMaster, kOther, 0x08, data));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd2(kMaster, kOther, 0x08, Saps{62, 60}, data));
    EXPECT_FALSE(bus.reply());

    EXPECT_TRUE(user.srds.empty());
    EXPECT_EQ(station.counters().telegrams, 2u);
    EXPECT_EQ(station.counters().flaws, decltype(station.counters().flaws){});
    EXPECT_EQ(station.counters().requests, 0u);
}

INSTANTIATE_TEST_SUITE_P(Delimiters, ReplyOfAnotherSlave,
                         testing::Values("E5", "10 05 02 49 50 16", "68 05 05 68 85 82 6D 3C 3E EE 16",
                                         "A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16", "DC 05 02",
                                         "68 68 68 68 68 68", "10 E5 68 A2 DC 16"));

TEST_F(Resynchronisation, TelegramMayArriveOctetByOctet)
{
    bus.arrives_octet_by_octet(kAsk);

    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(Resynchronisation, TelegramMayArriveInAnyTwoPieces)
{
    for (std::size_t cut = 1; cut < kAsk.size(); ++cut) {
        bus.line_is_idle_for(bus.bits(33));
        bus.breaks_in_after(bus.bits(33), {kAsk.begin(), kAsk.begin() + static_cast<std::ptrdiff_t>(cut)});
        bus.breaks_in_after(bus.bits(0), {kAsk.begin() + static_cast<std::ptrdiff_t>(cut), kAsk.end()});
        station.on_time(bus.now());
        EXPECT_EQ(station.counters().requests, cut) << cut;
        bus.line_is_idle_for(bus.bits(100));
    }
}

TEST_F(Resynchronisation, PauseBelowTheGapLimitDoesNotSpoilATelegram)
{
    const auto gap_limit = bus.bits(33) + milliseconds{5};
    station.on_bytes(Bytes{kAsk}.first(6), kRead);
    station.on_time(kRead + gap_limit - nanoseconds{1});
    station.on_bytes(Bytes{kAsk}.subspan(6), kRead + gap_limit - nanoseconds{1});

    EXPECT_EQ(user.srds.size(), 1u);
}

/// Behind it may come what a FIFO of 64 characters held back.
TEST_F(Resynchronisation, UnfinishedTelegramIsThrownAwayAfterTheGapLimitAndAFullFifo)
{
    const auto gap_limit = bus.bits(33 + 64 * 11) + milliseconds{5};
    station.on_bytes(Bytes{kAsk}.first(6), kRead);
    EXPECT_EQ(station.next_deadline(), kRead + gap_limit);
    station.on_time(kRead + gap_limit);

    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 1u);
    EXPECT_EQ(station.next_deadline(), kNever);
    station.on_bytes(Bytes{kAsk}.subspan(6), kRead + gap_limit);
    EXPECT_TRUE(user.srds.empty());
}

TEST_F(Resynchronisation, SilenceIsSeenEvenWithoutACallMeanwhile)
{
    const auto gap_limit = bus.bits(33) + milliseconds{5};
    station.on_bytes(octets("68 20 20 68"), kRead);
    const Instant later = kRead + gap_limit + bus.bits(11 * 11);
    station.on_bytes(kAsk, later); // these octets began when the limit was over

    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 1u);
}

TEST_F(Resynchronisation, BadCharacterInThePlaceOfAZeroMakesItsTelegramInvalidToo)
{
    bus.arrives_with_bad_character(octets("68 05 05 68 05 02 5D 00 00 64 16"), 7);

    EXPECT_FALSE(bus.reply());
    EXPECT_TRUE(user.srds.empty());
}

TEST_F(Resynchronisation, BadCharacterAfterASilenceBelongsToTheNextTelegram)
{
    station.on_bytes(octets("68 20 20 68"), kRead);
    const Instant later = kRead + bus.bits(33 + 11) + milliseconds{5};
    station.on_character_error(later); // noise before the request
    station.on_bytes(kAsk, later);

    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(Resynchronisation, BadCharacterIsForgottenWithItsTelegramAfterASilence)
{
    station.on_bytes(octets("68 05 05 68 05"), kRead);
    station.on_character_error(kRead);
    const Instant later = kRead + bus.bits(33 + 64 * 11) + milliseconds{5};
    station.on_time(later);
    station.on_bytes(kAsk, later + milliseconds{1});

    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::character)], 1u);
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 0u) << "it is one";
}

TEST_F(Resynchronisation, BadCharacterInAnSd2HeaderEndsItsTelegramThere)
{
    for (std::size_t place = 1; place < 4; ++place) {
        SCOPED_TRACE(place);
        fdl::Layer2 fresh{{.baud = Baud::k187_5, .search = {}, .start_up_latency = {}}};
        RecordingUser own;
        fresh.attach(kUs, own, kClassMaxTsdr);
        fresh.on_bytes(Bytes{kAsk}.first(place), kRead, true);
        fresh.on_character_error(kRead);
        EXPECT_EQ(fresh.next_deadline(), Instant{}) << "nothing is unfinished, so nothing is waited for";
        fresh.on_time(kRead);
        EXPECT_EQ(fresh.next_deadline(), kNever);
        fresh.on_bytes(Bytes{kAsk}.subspan(place + 1), kRead, true);
        EXPECT_TRUE(own.srds.empty());
        fresh.on_bytes(kAsk, kRead);
        EXPECT_EQ(own.srds.size(), 1u);
        EXPECT_EQ(fresh.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 0u);
    }
}

TEST_F(Resynchronisation, OnlyTelegramsWithAChecksumAreASignOfLife)
{
    bus.master_sends(token(3, kMaster));
    bus.master_sends(sc());
    bus.master_sends(octets("10 05 02 49 51 16")); // and that has a wrong one
    EXPECT_EQ(station.last_telegram(), Instant{});
    EXPECT_EQ(station.counters().telegrams, 2u);

    bus.master_sends(sd1(kOther, kMaster, kFdlStatus));
    EXPECT_EQ(station.last_telegram(), bus.now());
}

TEST_F(Resynchronisation, AnUnfinishedTelegramIsForgottenAfterAnIdleLine)
{
    bus.master_sends({0x68, 0x05, 0x05});
    bus.line_is_idle_for(bus.bits(33) + milliseconds{5});
    bus.master_sends(kAsk);

    EXPECT_TRUE(bus.reply());
}

TEST_F(Resynchronisation, SlowRatesHaveALongerAllowance)
{
    fdl::Layer2 slow{{.baud = Baud::k19_2, .search = {}, .start_up_latency = {}}};
    slow.attach(kUs, user, kClassMaxTsdr);
    slow.on_time(kRead);
    slow.on_bytes(Bytes{kAsk}.first(6), kRead);

    EXPECT_EQ(slow.next_deadline(), kRead + duration_of(33_tbit, Baud::k19_2) + milliseconds{20} +
                                        duration_of(704_tbit, Baud::k19_2));
}

class HeldBack : public Resynchronisation, public testing::WithParamInterface<Baud> {};

/// A UART with a trigger of 48 hands them on so much later; on the wire they followed without a gap.
TEST_P(HeldBack, By48CharactersATelegramIsStillWhole)
{
    const Octets ask = sd2(kUs, kMaster, kSrdFirst, Octets(54, 7));
    ASSERT_EQ(ask.size(), 63u);
    fdl::Layer2 any{{.baud = GetParam(), .search = {}, .start_up_latency = {}}};
    any.attach(kUs, user, kClassMaxTsdr);
    const auto characters = [](std::uint32_t count) { return duration_of(Tbit{count * 11}, GetParam()); };
    any.on_bytes(Bytes{ask}.first(15), kRead);
    any.on_time(kRead + characters(47));                                            // they are not read yet
    any.on_bytes(Bytes{ask}.subspan(15), kRead + characters(48) + milliseconds{4}); // and the reader slept

    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(any.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 0u);
}
INSTANTIATE_TEST_SUITE_P(ByTheFifo, HeldBack, testing::ValuesIn(kBauds));

TEST_F(Resynchronisation, ASilenceBeforeWhatTheFifoHeldBackIsSeen)
{
    station.on_bytes(octets("68 20 20 68"), kRead);
    const auto silence = bus.bits(33) + milliseconds{5};
    const Instant later = kRead + silence + bus.bits(11 * static_cast<std::uint32_t>(kAsk.size()));
    station.on_time(later - nanoseconds{1}); // too early to give it up
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 0u);
    station.on_bytes(kAsk, later);

    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)], 1u);
}

TEST_F(Resynchronisation, BadCharacterMakesItsTelegramInvalidAndCostsNoOther)
{
    for (std::size_t bad = 0; bad < kAsk.size(); ++bad) {
        bus.arrives_with_bad_character(kAsk, bad);
        EXPECT_FALSE(bus.reply()) << bad;
        EXPECT_TRUE(user.srds.empty()) << bad;
        bus.line_is_idle_for(bus.bits(33) + milliseconds{5});
    }
    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::character)], kAsk.size());
    bus.master_sends(kAsk);
    EXPECT_TRUE(bus.reply());
}

TEST_F(Resynchronisation, TelegramWithABadCharacterIsDroppedWholeAndTheNextFollowsAtOnce)
{
    const Octets carrier = sd2(kMaster, kOther, 0x08, sd1(kUs, kMaster, kFdlStatus));
    station.on_bytes(Bytes{carrier}.first(7), kRead);
    station.on_character_error(kRead);
    station.on_bytes(Bytes{carrier}.subspan(8), kRead);
    EXPECT_TRUE(user.heards.empty());
    station.on_bytes(kAsk, kRead);

    EXPECT_EQ(user.srds.size(), 1u);
}

} // namespace
