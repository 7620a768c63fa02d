// SPDX-License-Identifier: Apache-2.0
/// A station that searches its rate, on a bus whose masters have one (wire reference 7; C-24).
#include "fdl/bench.hpp"

#include <numeric>

using namespace dpslave;
using namespace test;
using fdl::BaudState;
using fdl::Supervision;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

class Searching : public testing::Test {
protected:
    Searching()
    {
        station.attach(kUs, user, kClassMaxTsdr);
        bus.advance({});
    }

    /// A master that polls slave 5 once in 20 ms, as long as `limit` or until the station knows the rate.
    void poll_until_found(std::chrono::nanoseconds limit)
    {
        const Instant end = bus.now() + limit;
        while (bus.now() < end && station.baud_state() == BaudState::baud_search) {
            bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
            bus.line_is_idle_for(milliseconds{20});
        }
    }

    RecordingUser user;
    fdl::Layer2 station{{.baud = Baud::k1500, .search = fdl::BaudSearchSettings{}, .start_up_latency = {}}};
    Bus bus{station, {.baud = Baud::k1500, .min_tsdr = 11_tbit, .max_tsdr = {}}};
};

TEST_F(Searching, StationIsSilentAndTheTelegramThatEndsTheSearchIsNotAnsweredYet)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    EXPECT_FALSE(bus.reply());
    EXPECT_TRUE(user.heards.empty());
    EXPECT_EQ(station.baud_state(), BaudState::baud_control);

    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    EXPECT_TRUE(bus.reply());
}

TEST_F(Searching, TokensAndShortAcknowledgesAreNoEvidence)
{
    bus.master_sends(token(3, 2));
    bus.master_sends(sc());

    EXPECT_EQ(station.baud_state(), BaudState::baud_search);
}

TEST_F(Searching, WhatIsNoTelegramAtARateThatIsTriedIsNoFlawOfTheLine)
{
    const auto flaws = [this] {
        const auto& each = station.counters().flaws;
        return std::accumulate(each.begin(), each.end(), std::uint64_t{0});
    };
    bus.master_sends(octets("11 12"));
    EXPECT_EQ(flaws(), 0u);
    EXPECT_EQ(station.counters().search_flaws, 1u);

    bus.master_sends(sd1(kUs, kMaster, kFdlStatus)); // the search has ended
    bus.master_sends(octets("11 12"));
    EXPECT_EQ(flaws(), 1u);
    EXPECT_EQ(station.counters().search_flaws, 1u);
}

TEST_F(Searching, TelegramThatComesInPiecesIsEvidenceToo)
{
    bus.arrives_octet_by_octet(sd2(kMaster, kOther, 0x08, {1, 2}));

    EXPECT_EQ(station.baud_state(), BaudState::baud_control);
    EXPECT_EQ(station.counters().search_flaws, 0u);
}

TEST_F(Searching, BrokenTelegramsAreNoEvidence)
{
    bus.master_sends(octets("10 05 02 49 51 16"));

    EXPECT_EQ(station.baud_state(), BaudState::baud_search);
}

TEST_F(Searching, TrafficOfTwoOtherStationsIsEvidence)
{
    bus.master_sends(sd2(kMaster, kOther, 0x08, {1, 2}));

    EXPECT_EQ(station.baud_state(), BaudState::baud_control);
}

TEST_F(Searching, SilentLineIsSearchedDownwards)
{
    EXPECT_EQ(bus.take_baud_changes(), std::vector<Baud>{Baud::k1500}) << "where the search begins";
    bus.advance(milliseconds{2100});
    EXPECT_EQ(bus.take_baud_changes(), std::vector<Baud>{Baud::k500});
    bus.advance(seconds{14});

    EXPECT_EQ(bus.take_baud_changes(),
              (std::vector<Baud>{Baud::k187_5, Baud::k93_75, Baud::k19_2, Baud::k9_6, Baud::k1500}));
}

TEST_F(Searching, FixedRateIsNeverLeft)
{
    fdl::Layer2 fixed{{.baud = Baud::k45_45, .search = {}, .start_up_latency = {}}};
    Bus line{fixed, {.baud = Baud::k45_45, .min_tsdr = 11_tbit, .max_tsdr = {}}};
    line.advance(seconds{100});

    EXPECT_EQ(fixed.baud_state(), BaudState::fixed);
    EXPECT_TRUE(line.take_baud_changes().empty());
    EXPECT_EQ(fixed.next_deadline(), kNever);
}

class EverySearchedRate : public Searching, public testing::WithParamInterface<Baud> {};

TEST_P(EverySearchedRate, IsFoundAndThenAnswered)
{
    bus.set_baud(GetParam());
    poll_until_found(seconds{30});

    ASSERT_EQ(station.baud(), GetParam());
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    EXPECT_EQ(bus.reply(), octets("10 02 05 00 07 16"));
}

TEST_P(EverySearchedRate, IsFoundAgainAfterTheMasterChangedToIt)
{
    poll_until_found(seconds{1});
    ASSERT_EQ(station.baud(), Baud::k1500);
    bus.set_baud(GetParam());
    bus.line_is_idle_for(milliseconds{2400}); // T_BC, and a dwell at the rate that was right
    ASSERT_EQ(station.baud_state(), BaudState::baud_search);
    poll_until_found(seconds{30});

    EXPECT_EQ(station.baud(), GetParam());
}

/// On a line whose UART marks nothing (a pty; a USB adapter without error marks) each wrong rate costs its
/// whole dwell. The bound of the search: its dwells and one telegram, and not more than 1.25 of that.
TEST_P(EverySearchedRate, IsFoundWithinTheDwellsOfTheRatesBeforeItAndOneTelegram)
{
    constexpr std::array kOrder{Baud::k1500, Baud::k500, Baud::k187_5, Baud::k93_75, Baud::k19_2, Baud::k9_6};
    const Octets ask = sd1(kUs, kMaster, kFdlStatus);
    const auto telegram = duration_of(Tbit{11 * static_cast<std::uint32_t>(ask.size())}, GetParam());
    const auto cycle = telegram + milliseconds{20}; // of the master that asks for us
    std::chrono::nanoseconds dwells{0};
    for (const Baud wrong : kOrder) {
        if (wrong == GetParam()) break;
        dwells += wrong >= Baud::k93_75 ? seconds{2} : seconds{4};
    }
    const Instant begin = bus.now();
    Instant now = begin;
    while (station.baud_state() == BaudState::baud_search && now - begin < seconds{30}) {
        now += cycle;
        while (station.next_deadline() <= now) {
            station.on_time(station.next_deadline());
            static_cast<void>(station.take_baud_change());
        }
        // At a wrong rate octets come that mean nothing, and none of them is marked as bad.
        station.on_bytes(station.baud() == GetParam() ? ask : Octets(ask.size(), 0), now);
        station.on_time(now);
    }

    EXPECT_EQ(station.baud(), GetParam());
    EXPECT_GE(now - begin, dwells);
    EXPECT_LE(now - begin, dwells + 2 * cycle); // a change in the middle of a telegram costs this one
    EXPECT_LE(now - begin, std::max((dwells + cycle) * 5 / 4, 2 * cycle));
}

INSTANTIATE_TEST_SUITE_P(A006, EverySearchedRate,
                         testing::Values(Baud::k9_6, Baud::k19_2, Baud::k93_75, Baud::k187_5, Baud::k500,
                                         Baud::k1500));

TEST_F(Searching, RateOf45_45IsNotFound)
{
    bus.set_baud(Baud::k45_45);
    poll_until_found(seconds{100});

    EXPECT_EQ(station.baud_state(), BaudState::baud_search);
    EXPECT_EQ(station.counters().telegrams, 0u);
}

TEST_F(Searching, UntilTheEdgeHasSetTheFirstRateNothingIsListenedTo)
{
    fdl::Layer2 fresh{{.baud = Baud::k187_5, .search = fdl::BaudSearchSettings{}, .start_up_latency = {}}};
    const Octets ask = sd1(kUs, kMaster, kFdlStatus);
    fresh.on_bytes(ask, bus.now());
    EXPECT_EQ(fresh.counters().telegrams, 0u);

    EXPECT_EQ(fresh.take_baud_change(), Baud::k187_5);
    EXPECT_EQ(fresh.take_baud_change(), std::nullopt);
    fresh.on_bytes(ask, bus.now());
    EXPECT_EQ(fresh.counters().telegrams, 1u);
}

TEST_F(Searching, StationBeginsAtTheHighestRateThatTheUartCanDo)
{
    fdl::BaudSearchSettings some;
    some.rates.reset(index_of(Baud::k1500));
    some.rates.reset(index_of(Baud::k500));
    fdl::Layer2 other{{.baud = Baud::k1500, .search = some, .start_up_latency = {}}};

    EXPECT_EQ(other.take_baud_change(), Baud::k187_5);
}

TEST_F(Searching, WrongRateWithTrafficIsLeftBeforeItsDwellIsOver)
{
    bus.set_baud(Baud::k187_5);
    const Instant begin = bus.now();
    poll_until_found(seconds{30});

    EXPECT_EQ(station.baud(), Baud::k187_5);
    EXPECT_LT(bus.now() - begin, milliseconds{500}); // two rates of 2 s each were cut short
}

TEST_F(Searching, LossOfTheMasterLeadsBackToTheSearchAndTheFrameCountIsForgotten)
{
    poll_until_found(seconds{1});
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    ASSERT_TRUE(bus.reply());
    bus.line_is_idle_for(milliseconds{2400});
    EXPECT_EQ(station.baud_state(), BaudState::baud_search);
    EXPECT_TRUE(user.times.empty()); // DP does not get it

    poll_until_found(seconds{30});
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(user.srds.size(), 2u); // executed anew
}

TEST_F(Searching, WatchdogOfASlaveKeepsTheRate)
{
    poll_until_found(seconds{1});
    user.level = Supervision::supervised; // Set_Prm with WD_On
    user.deadline = bus.now() + seconds{5};
    user.level_after_on_time = Supervision::unowned;
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, Saps{61, 62}, {1}));
    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(station.baud_state(), BaudState::dp_control);
    bus.line_is_idle_for(seconds{4});
    EXPECT_EQ(station.baud_state(), BaudState::dp_control);
    bus.line_is_idle_for(milliseconds{1100});
    EXPECT_EQ(user.times.size(), 1u);
    EXPECT_EQ(station.baud_state(), BaudState::baud_control);
    bus.line_is_idle_for(milliseconds{2320});

    EXPECT_EQ(station.baud_state(), BaudState::baud_search);
}

TEST_F(Searching, QuietBusWithoutWatchdogLosesNoRequestAndShowsNoChange)
{
    poll_until_found(seconds{1});
    user.level = Supervision::owned; // Set_Prm without WD_On
    bus.take_baud_changes();
    for (int i = 0; i < 50; ++i) {
        bus.master_sends(sd2(kUs, kMaster, i % 2 == 0 ? kSrdFcb1 : kSrdFcb0, {1}));
        EXPECT_TRUE(bus.reply()) << i;
        for (int pause = 0; pause < 40; ++pause) {
            bus.line_is_idle_for(milliseconds{10});
            ASSERT_EQ(station.baud_state(), BaudState::baud_control);
        }
    }
    EXPECT_EQ(user.srds.size(), 50u);
    EXPECT_TRUE(bus.take_baud_changes().empty());
}

TEST_F(Searching, RetryBehindASilenceThatRaisedDoubtIsStillARetry)
{
    poll_until_found(seconds{1});
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    ASSERT_TRUE(bus.reply());
    bus.line_is_idle_for(milliseconds{2000});
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));

    EXPECT_TRUE(bus.reply());
    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().retries, 1u);
}

TEST_F(Searching, WhatIsNoTelegramIsNoFlawOfTheLineWhileTheRateIsInDoubt)
{
    poll_until_found(seconds{1});
    const auto before = station.counters().search_flaws;
    bus.line_is_idle_for(milliseconds{400});
    bus.master_sends(octets("11 12"));

    EXPECT_EQ(station.counters().flaws[static_cast<std::size_t>(fdl::Flaw::start_delimiter)], 0u);
    EXPECT_EQ(station.counters().search_flaws, before + 1);
}

TEST_F(Searching, ReplyThatWaitsIsDroppedWhenTheSearchBegins)
{
    fdl::BaudSearchSettings hasty;
    hasty.baud_control = hasty.dwell_slow = milliseconds{1};
    fdl::Layer2 slow{{.baud = Baud::k9_6, .search = hasty, .start_up_latency = {}}};
    slow.attach(kUs, user, kClassMaxTsdr);
    user.min_tsdr_bits = 50_tbit; // 5.2 ms
    const Octets ask = sd1(kUs, kMaster, kFdlStatus);
    slow.on_time(bus.now());
    ASSERT_EQ(slow.take_baud_change(), Baud::k9_6);
    slow.on_bytes(ask, bus.now());
    slow.on_bytes(ask, bus.now());
    ASSERT_TRUE(slow.reply_waits());
    slow.on_time(bus.now() + milliseconds{1});
    EXPECT_TRUE(slow.reply_waits());
    slow.on_time(bus.now() + milliseconds{2});

    EXPECT_EQ(slow.baud_state(), BaudState::baud_search);
    EXPECT_FALSE(slow.reply_waits());
    slow.on_time(bus.now() + milliseconds{6});
    EXPECT_EQ(slow.take_transmit(), std::nullopt);
}

TEST_F(Searching, ForeignTrafficKeepsTheRateAgainOnceTheOwnerHasGone)
{
    poll_until_found(seconds{1});
    user.level = Supervision::owned;
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, Saps{61, 62}, {1}));
    user.level = Supervision::unowned;
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb0, Saps{61, 62}, {1}));
    for (int i = 0; i < 20; ++i) {
        bus.master_sends(sd1(kOther, kMaster, kFdlStatus));
        EXPECT_EQ(station.next_deadline(), bus.now() + milliseconds{320}) << "T_BC runs since this telegram";
        bus.line_is_idle_for(milliseconds{300});
    }
}

TEST_F(Searching, PollsToOthersKeepTheRateUntilASlaveIsOwned)
{
    poll_until_found(seconds{1});
    for (int i = 0; i < 10; ++i) {
        bus.master_sends(sd1(kOther, kMaster, kFdlStatus));
        bus.line_is_idle_for(milliseconds{100});
    }
    EXPECT_EQ(station.baud_state(), BaudState::baud_control);

    user.level = Supervision::owned;
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, Saps{61, 62}, {1}));
    const Instant evidence = bus.now();
    bus.line_is_idle_for(milliseconds{200});
    bus.master_sends(sd1(kOther, kMaster, kFdlStatus));

    EXPECT_EQ(station.next_deadline(), evidence + milliseconds{320});
}

TEST_F(Searching, OctetsAtARateThatWasGivenUpAreNotLookedAt)
{
    const Instant now = bus.now();
    for (int i = 0; i < 20; ++i) station.on_character_error(now);
    station.on_bytes(octets("10 05 02 49 50 16"), now); // still heard at 1.5 Mbit/s
    EXPECT_EQ(station.baud_state(), BaudState::baud_search);
    EXPECT_EQ(station.counters().telegrams, 0u);

    EXPECT_EQ(station.take_baud_change(), Baud::k500);
    station.on_bytes(octets("10 05 02 49 50 16"), now);
    EXPECT_EQ(station.baud_state(), BaudState::baud_control);
}

} // namespace
