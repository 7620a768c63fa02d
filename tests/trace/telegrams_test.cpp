// SPDX-License-Identifier: Apache-2.0
#include "support/wire.hpp"

#include "dpslave/trace/telegrams.hpp"

#include <gmock/gmock.h>

#include <random>

using namespace dpslave;
using namespace dpslave::trace;
using namespace std::chrono_literals;
using test::Octets;
using testing::ElementsAre;
using What = Entry::What;

namespace {

constexpr std::uint8_t k19_2 = 1;
constexpr Baud kBaud = kBauds[k19_2];
constexpr Instant kStart{1s};

std::chrono::nanoseconds characters(std::uint32_t count)
{
    return duration_of(Tbit{11 * count}, kBaud);
}

class TraceTelegrams : public testing::Test {
protected:
    void hear(const Octets& octets, Instant at, bool more_follows = false)
    {
        Record record{.head = {.kind = Kind::heard, .rate = k19_2, .more_follows = more_follows, .at = at}};
        record.octets.assign(octets);
        telegrams.add(record);
    }
    void hear_bad_character(Instant at)
    {
        telegrams.add({.head = {.kind = Kind::bad_character, .rate = k19_2, .at = at}});
    }
    std::vector<Entry> take()
    {
        std::vector<Entry> all;
        while (auto one = telegrams.take()) all.push_back(std::move(*one));
        return all;
    }

    Telegrams telegrams{500us};
    const Octets request = test::sd2(5, 2, 0x5D, {0x12, 0x34});
};

TEST_F(TraceTelegrams, ATelegramIsOneEntryWithItsOctets)
{
    hear(request, kStart);

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].what, What::telegram);
    EXPECT_EQ(all[0].octets, request);
    EXPECT_EQ(all[0].at, kStart);
    EXPECT_EQ(all[0].baud, kBaud);
}

TEST_F(TraceTelegrams, FirstAndLastCharacterAreComputedFromTheRead)
{
    hear(request, kStart);

    const auto all = take();

    EXPECT_EQ(all.at(0).last, kStart);
    EXPECT_EQ(all.at(0).first, kStart - characters(static_cast<std::uint32_t>(request.size())));
    EXPECT_EQ(all.at(0).uncertainty, 500us) << "the line was idle before: what the port may hold back";
}

TEST_F(TraceTelegrams, ATelegramInTheMiddleOfAReadEndedEarlierThanTheRead)
{
    Octets both = request;
    const Octets reply = test::sc();
    both.insert(both.end(), reply.begin(), reply.end());
    hear(both, kStart);

    const auto all = take();

    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].last, kStart - characters(1));
    EXPECT_EQ(all[1].first, all[0].last);
}

TEST_F(TraceTelegrams, OctetsThatCameRightBehindEachOtherLeaveLittleUncertainty)
{
    hear({request.begin(), request.begin() + 4}, kStart);
    hear({request.begin() + 4, request.end()},
         kStart + characters(static_cast<std::uint32_t>(request.size()) - 4) + 7us);

    EXPECT_EQ(take().at(0).uncertainty, 7us);
}

TEST_F(TraceTelegrams, ATelegramInSeveralReadsIsOneEntry)
{
    hear({request.begin(), request.begin() + 3}, kStart);
    hear({request.begin() + 3, request.end()}, kStart + 5ms);

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].octets, request);
    EXPECT_EQ(all[0].first, kStart - characters(3));
    EXPECT_EQ(all[0].last, kStart + 5ms);
}

TEST_F(TraceTelegrams, WhatIsNoTelegramIsAPieceWithItsFlaw)
{
    Octets wrong = request;
    wrong[wrong.size() - 2] ^= 1;
    hear(wrong, kStart);
    hear(request, kStart + 1s);

    const auto all = take();

    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].what, What::piece);
    EXPECT_EQ(all[0].flaw, fdl::Flaw::checksum);
    EXPECT_EQ(all[0].octets, wrong);
    EXPECT_EQ(all[1].what, What::telegram);
}

TEST_F(TraceTelegrams, OctetsBeforeATelegramInTheSameReadAreAPiece)
{
    Octets noisy{0x00, 0xFF};
    noisy.insert(noisy.end(), request.begin(), request.end());
    hear(noisy, kStart);

    const auto all = take();

    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].flaw, fdl::Flaw::start_delimiter);
    EXPECT_THAT(all[0].octets, ElementsAre(0x00, 0xFF));
    EXPECT_EQ(all[1].octets, request);
}

TEST_F(TraceTelegrams, AStumpIsAPieceWhenTheLineHasFallenSilent)
{
    hear({request.begin(), request.begin() + 5}, kStart);
    EXPECT_TRUE(take().empty());
    telegrams.pass_time(kStart + 1s);

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].flaw, fdl::Flaw::unfinished);
    EXPECT_EQ(all[0].octets.size(), 5U);
}

/// More octets than a FIFO holds, read at once: the reader was late, and the line was not silent.
TEST_F(TraceTelegrams, ATelegramWhoseRestWasReadLateIsOneEntryAsForLayer2)
{
    const Octets longest = test::sd2(5, 2, 0x5D, Octets(200, 0x12));
    const Octets rest{longest.begin() + 5, longest.end()};
    hear({longest.begin(), longest.begin() + 5}, kStart);
    hear(rest, kStart + characters(static_cast<std::uint32_t>(rest.size())));

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].what, What::telegram);
    EXPECT_EQ(all[0].octets, longest);
}

TEST_F(TraceTelegrams, WhatLayer2GaveUpIsAPieceThoughItsRestCameAtOnceBehindIt)
{
    const Octets longest = test::sd2(5, 2, 0x5D, Octets(200, 0x12));
    const Octets rest{longest.begin() + 5, longest.end()};
    const Instant read_at = kStart + characters(static_cast<std::uint32_t>(rest.size()));
    hear({longest.begin(), longest.begin() + 5}, kStart);
    telegrams.add({.head = {.kind = Kind::silence, .rate = k19_2, .at = read_at - 1us}});
    hear(rest, read_at);
    telegrams.pass_time(read_at + 1s);

    const auto all = take();

    ASSERT_GE(all.size(), 2U);
    EXPECT_EQ(all[0].flaw, fdl::Flaw::unfinished);
    EXPECT_EQ(all[0].octets.size(), 5U);
}

TEST_F(TraceTelegrams, BadCharactersAreCountedInTheirPiece)
{
    hear({request.begin(), request.begin() + 6}, kStart, true);
    hear_bad_character(kStart);
    hear({request.begin() + 7, request.end()}, kStart + 3ms);

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].flaw, fdl::Flaw::character);
    EXPECT_EQ(all[0].bad_characters, 1U);
    EXPECT_EQ(all[0].octets.size(), request.size());
}

TEST_F(TraceTelegrams, AReplyBeginsWithItsWriteAndEndsByItsLength)
{
    Record sent{.head = {.kind = Kind::sent, .rate = k19_2, .at = kStart + 3us, .begun = kStart}};
    sent.octets.assign(test::sc());
    telegrams.add(sent);

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].what, What::reply);
    EXPECT_EQ(all[0].first, kStart);
    EXPECT_EQ(all[0].last, kStart + characters(1));
    EXPECT_EQ(all[0].uncertainty, 3us);
}

TEST_F(TraceTelegrams, AnUnansweredRequestSaysWhoWasAskedAndWhy)
{
    telegrams.add({.head = {.kind = Kind::unanswered,
                            .detail = static_cast<std::uint8_t>(fdl::Unanswered::Why::late),
                            .rate = k19_2,
                            .address = 7,
                            .at = kStart}});

    const auto all = take();

    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].what, What::unanswered);
    EXPECT_EQ(all[0].why, fdl::Unanswered::Why::late);
    EXPECT_EQ(all[0].address, 7);
}

TEST_F(TraceTelegrams, AGapInTheRecordsEndsWhatWasUnfinished)
{
    hear({request.begin(), request.begin() + 5}, kStart);
    telegrams.lost(12, kStart + 1ms);
    hear(request, kStart + 2ms);

    const auto all = take();

    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].what, What::cut);
    EXPECT_EQ(all[1].what, What::lost);
    EXPECT_EQ(all[1].count, 12U);
    EXPECT_EQ(all[2].what, What::telegram);
}

TEST_F(TraceTelegrams, AnotherRateEndsWhatWasUnfinished)
{
    hear({request.begin(), request.begin() + 5}, kStart);
    telegrams.add({.head = {.kind = Kind::rate, .rate = 4, .at = kStart + 1ms}});

    const auto all = take();

    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].what, What::piece);
    EXPECT_EQ(all[1].what, What::rate);
    EXPECT_EQ(all[1].baud, Baud::k187_5);
}

/// Whatever comes: every octet is in exactly one entry, in its order.
TEST_F(TraceTelegrams, NoOctetIsLostOrDoubledInRandomTraffic)
{
    std::mt19937 random{20240611};
    const auto chance = [&random](unsigned among) { return random() % among == 0; };
    Octets all;
    Instant now = kStart;
    for (int i = 0; i < 20'000; ++i) {
        Octets some = chance(3) ? test::token(2, 3) : chance(3) ? test::sc() : request;
        if (chance(4)) some[random() % some.size()] = static_cast<std::uint8_t>(random());
        if (chance(4)) some.resize(1 + random() % some.size());
        const bool bad = chance(10);
        now += std::chrono::microseconds{random() % 30'000};
        hear(some, now, bad);
        all.insert(all.end(), some.begin(), some.end());
        if (bad) {
            hear_bad_character(now);
            all.push_back(0);
        }
        if (chance(10)) telegrams.pass_time(now += std::chrono::milliseconds{random() % 100});
    }
    telegrams.pass_time(now + 1h);

    Octets found;
    std::size_t telegrams_found = 0;
    for (const Entry& one : take()) {
        found.insert(found.end(), one.octets.begin(), one.octets.end());
        telegrams_found += one.what == What::telegram ? 1 : 0;
        EXPECT_LE(one.first, one.last);
    }

    EXPECT_EQ(found, all);
    EXPECT_GT(telegrams_found, 5'000U);
}

} // namespace
