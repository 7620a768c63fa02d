// SPDX-License-Identifier: Apache-2.0
/// Layer 2 as its edge sees it: what it counts, whose reply it gives, and when it heard the line fall silent.
#include "bench.hpp"

using namespace dpslave;
using namespace test;
using fdl::Flaw;
using std::chrono::nanoseconds;

namespace {

class Edge : public testing::Test {
protected:
    Edge()
    {
        station.attach(kUs, user, kClassMaxTsdr);
        station.on_time(kRead);
    }
    std::uint64_t flaws(Flaw flaw) const { return station.counters().flaws[static_cast<std::size_t>(flaw)]; }
    static nanoseconds bits(std::uint32_t count) { return duration_of(Tbit{count}, Baud::k187_5); }

    RecordingUser user;
    fdl::Layer2 station{{.baud = Baud::k187_5, .search = {}, .start_up_latency = {}}};
    const Octets ask = sd1(kUs, kMaster, kFdlStatus);
    const Octets stump = octets("68 20 20 68 05");
};

TEST_F(Edge, CountsABadCharacterAsAnOctet)
{
    station.on_bytes(ask, kRead);
    station.on_character_error(kRead);

    EXPECT_EQ(station.counters().octets, ask.size() + 1);
}

TEST_F(Edge, CountsTelegramsWithAChecksumApart)
{
    station.on_bytes(joined({ask, token(kMaster, kMaster), sc(), sd1(kMaster, kOther, 0x00)}), kRead);

    EXPECT_EQ(station.counters().telegrams, 4u);
    EXPECT_EQ(station.counters().checked, 2u);
}

TEST_F(Edge, KeepsTheReplyWhenAReadBringsNothing)
{
    station.on_bytes(ask, kRead);
    station.on_bytes({}, kRead);
    station.on_time(kRead + bits(11));

    EXPECT_TRUE(station.take_transmit());
}

/// Its last octets behind a silence begin like a telegram (tests/fdl/receiver/doubt_test.cpp).
TEST_F(Edge, AnswersARequestInDoubtAfterTsynWithinItsWindow)
{
    const Octets request = sd2(kUs, kMaster, kSrdFirst, octets("01 10 09"));
    station.on_bytes(Bytes{request}.first(8), kRead);
    const Instant end = kRead + bits(33 + 11 * 4);
    station.on_bytes(Bytes{request}.subspan(8), end);
    station.on_time(end);
    EXPECT_TRUE(station.reply_waits()) << "what can be put off is put off";
    EXPECT_EQ(station.next_deadline(), end + bits(33));

    station.on_time(end + bits(33));

    EXPECT_TRUE(station.take_transmit());
    EXPECT_EQ(station.window_ended(), end + bits(60));
}

TEST_F(Edge, SaysWhoseReplyItGaveLast)
{
    RecordingUser other;
    station.attach(kOther, other, kClassMaxTsdr);
    for (const std::uint8_t address : {kUs, kOther}) {
        station.on_bytes(sd1(address, kMaster, kFdlStatus), kRead);
        station.on_time(kRead + bits(11));
        ASSERT_TRUE(station.take_transmit());

        EXPECT_EQ(station.sent()->sa, address);
    }
}

TEST_F(Edge, SaysOnceWhenItGaveAnUnfinishedTelegramUp)
{
    station.on_bytes(stump, kRead);
    const Instant silent = station.next_deadline();
    station.on_time(silent - nanoseconds{1});
    EXPECT_EQ(station.take_silence(), std::nullopt);

    station.on_time(silent);

    EXPECT_EQ(station.take_silence(), silent);
    EXPECT_EQ(station.take_silence(), std::nullopt);
}

TEST_F(Edge, CountsAStumpAndTheBadCharacterBehindALongSilenceBoth)
{
    station.on_bytes(stump, kRead);
    station.on_character_error(kRead + std::chrono::seconds{1});

    EXPECT_EQ(flaws(Flaw::unfinished), 1u);
    EXPECT_EQ(flaws(Flaw::character), 1u);
}

TEST_F(Edge, DoesNotCountTheTimeOfABadCharacterAsSilence)
{
    const Instant silent = kRead + fdl::silence_limit(Baud::k187_5) + bits(11);
    station.on_bytes(stump, kRead);
    station.on_character_error(silent - nanoseconds{1});
    EXPECT_EQ(flaws(Flaw::unfinished), 0u);

    station.on_bytes(ask, silent + std::chrono::seconds{1}); // ends the damage
    station.on_bytes(stump, kRead);
    station.on_character_error(silent);
    EXPECT_EQ(flaws(Flaw::unfinished), 1u);
}

} // namespace
