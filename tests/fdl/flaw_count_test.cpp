// SPDX-License-Identifier: Apache-2.0
/// Tests how often what is no telegram counts: one damaged piece of the stream is one flaw, however many
/// octets it has. `dpctl doctor` judges the line by it.
#include "bench.hpp"

using namespace dpslave;
using namespace test;
using std::chrono::milliseconds;

namespace {

class DamagedTelegram : public testing::TestWithParam<const char*> {
protected:
    /// Wherever it is damaged and however it is read, with a good request behind it.
    template <class Hear>
    void is_one_flaw(Hear hear)
    {
        for (const Baud baud : {Baud::k9_6, Baud::k187_5, Baud::k1500})
            for (const std::size_t bunch : kBunches)
                for (std::size_t place = 0; place < request.size(); ++place) {
                    Line line{baud};
                    hear(line.bus, place, bunch);
                    line.bus.line_is_idle_for(line.bus.bits(100)); // the least slot time
                    line.bus.arrives_in_bunches(request, bunch);
                    ASSERT_TRUE(line.bus.reply());
                    EXPECT_EQ(line.flaws(), 1u) << show(request) << "\nat octet " << place
                                                << ", in bunches of " << bunch << ", at " << bits(baud);
                }
    }
    static unsigned bits(Baud baud) { return static_cast<unsigned>(baud); }

    const Octets request = sd2(kUs, kMaster, kSrdFcb1, octets(GetParam()));
};

TEST_P(DamagedTelegram, ThatLostAnOctetIsOneFlaw)
{
    is_one_flaw([this](Bus& bus, std::size_t place, std::size_t bunch) {
        bus.arrives_in_bunches(without(request, place), bunch);
    });
}

TEST_P(DamagedTelegram, ThatLostItsBeginningIsOneFlaw)
{
    is_one_flaw([this](Bus& bus, std::size_t place, std::size_t bunch) {
        if (place == 0) return bus.arrives_in_bunches({0x00}, bunch); // nothing of it is lost: noise instead
        bus.arrives_in_bunches({request.begin() + static_cast<std::ptrdiff_t>(place), request.end()}, bunch);
    });
}

TEST_P(DamagedTelegram, ThatLostItsEndIsOneFlaw)
{
    is_one_flaw([this](Bus& bus, std::size_t place, std::size_t bunch) {
        if (place == 0) return bus.arrives_in_bunches({0x00}, bunch);
        bus.arrives_in_bunches({request.begin(), request.begin() + static_cast<std::ptrdiff_t>(place)},
                               bunch);
    });
}

TEST_P(DamagedTelegram, WithABadCharacterIsOneFlaw)
{
    is_one_flaw(
        [this](Bus& bus, std::size_t place, std::size_t) { bus.arrives_with_bad_character(request, place); });
}

TEST_P(DamagedTelegram, WithAWrongBitIsOneFlaw)
{
    is_one_flaw([this](Bus& bus, std::size_t place, std::size_t bunch) {
        Octets wrong = request;
        wrong[place] ^= 0x04;
        bus.arrives_in_bunches(wrong, bunch);
    });
}

INSTANTIATE_TEST_SUITE_P(Data, DamagedTelegram,
                         testing::Values("01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F 11", "00 00 8C",
                                         "00 00 00 00 00 00 00 00", "68 68 68 68 68 68 68 68",
                                         "10 10 10 10 10 10 10 10 10", "E5 E5 E5 E5 E5 E5",
                                         "A2 00 00 00 00 00 00 00", "00 00 00 00 00 DC 00"));

class DamagedPiece : public testing::Test {
protected:
    Line line{Baud::k187_5};
};

TEST_F(DamagedPiece, OfOctetsThatCanBeginNothingIsOneFlaw)
{
    line.bus.arrives_in_one_read({joined({octets("00 FF 16 49"), kAsk})});

    EXPECT_TRUE(line.bus.reply());
    EXPECT_EQ(line.flaws(), 1u);
}

TEST_F(DamagedPiece, BehindAGoodTelegramIsAFlawOfItsOwn)
{
    line.bus.arrives_in_one_read({joined({octets("00 FF"), kAsk, octets("00 FF"), kAsk})});

    EXPECT_EQ(line.flaws(), 2u);
}

TEST_F(DamagedPiece, BehindAPauseIsAFlawOfItsOwn)
{
    for (unsigned pieces = 1; pieces < 4; ++pieces) {
        line.bus.line_is_idle_for(line.bus.bits(100));
        line.bus.arrives_octet_by_octet(octets("00 FF 16 49"));
        EXPECT_EQ(line.flaws(), pieces);
    }
}

/// It is in noise by chance, and in the data of a telegram whose beginning was lost.
TEST_F(DamagedPiece, GoesOnBehindAShortAcknowledgeAndBehindAToken)
{
    line.bus.arrives_in_one_read({octets("00 E5 FF DC 01 02 00")});

    EXPECT_EQ(line.flaws(), 1u);
}

TEST_F(DamagedPiece, ThatAFifoHeldBackForFourCharactersIsOneFlaw)
{
    Instant now{std::chrono::seconds{5}};
    for (const char* const bunch : {"00 01 02 03", "04 05 06 07", "08"}) {
        const Octets heard = octets(bunch);
        now += line.bus.bits(11 * static_cast<std::uint32_t>(heard.size()) + 44);
        line.station.on_bytes(heard, now);
        line.station.on_time(now);
    }

    EXPECT_EQ(line.flaws(), 1u);
}

TEST_F(DamagedPiece, EndsWithAPauseOf77BitTimes)
{
    Instant now{std::chrono::seconds{5}};
    for (const std::uint32_t pause : {0u, 76u, 77u}) {
        now += line.bus.bits(11 + pause);
        line.station.on_bytes(octets("00"), now);
        EXPECT_EQ(line.flaws(), pause < 77 ? 1u : 2u) << pause;
    }
}

TEST_F(DamagedPiece, WhoseEndIsGivenUpIsNotCountedOnceMore)
{
    line.bus.master_sends(octets("00 FF 68 20 20 68 05"));
    line.bus.line_is_idle_for(milliseconds{50});

    EXPECT_EQ(line.flaws(), 1u);
}

TEST_F(DamagedPiece, OfWhichAStumpIsLeftIsNotCountedOnceMoreBehindThePause)
{
    line.bus.master_sends(octets("00 FF 10 05"));
    line.bus.line_is_idle_for(line.bus.bits(100));
    line.bus.master_sends(kAsk);

    EXPECT_TRUE(line.bus.reply());
    EXPECT_EQ(line.flaws(), 1u);

    line.bus.master_sends(octets("00"));
    EXPECT_EQ(line.flaws(), 2u) << "but what comes behind the good telegram is";
}

TEST_F(DamagedPiece, BehindAStumpThatWasGivenUpIsAFlawOfItsOwn)
{
    line.bus.master_sends(octets("00 FF 10 05"));
    line.bus.line_is_idle_for(line.bus.bits(100));
    line.bus.master_sends(octets("06"));
    line.bus.line_is_idle_for(milliseconds{50});
    EXPECT_EQ(line.flaws(), 1u);

    line.bus.master_sends(octets("10 05"));
    line.bus.line_is_idle_for(milliseconds{50});
    EXPECT_EQ(line.flaws(), 2u);
}

TEST_F(DamagedPiece, BehindAStumpThatIsCountedIsAFlawOfItsOwn)
{
    line.bus.master_sends(octets("00 FF 10 05"));
    line.bus.line_is_idle_for(line.bus.bits(100));
    line.bus.master_sends(octets("00 FF 00 FF 00 FF"));

    EXPECT_EQ(line.flaws(), 2u);
}

TEST_F(DamagedPiece, OfBadCharactersIsOneFlaw)
{
    line.bus.advance(milliseconds{1});
    for (int i = 0; i < 12; ++i) {
        line.bus.advance(line.bus.bits(11));
        line.station.on_character_error(line.bus.now());
        line.station.on_time(line.bus.now());
    }

    EXPECT_EQ(line.flaws(), 1u);
    EXPECT_EQ(line.station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::character)], 1u);
}

TEST_F(DamagedPiece, IsEndedByATelegramThatIsNotUnderstood)
{
    const Octets foreign = octets("68 05 05 68 85 82 6D 7C 3E 2E 16"); // good, with an unknown extension
    line.bus.arrives_in_one_read({joined({foreign, foreign})});
    line.bus.arrives_in_one_read({joined({octets("00 00"), foreign, octets("00 00")})});

    EXPECT_EQ(line.station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::extension)], 3u);
    EXPECT_EQ(line.flaws(), 5u);
}

} // namespace
