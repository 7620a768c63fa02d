// SPDX-License-Identifier: Apache-2.0
/// A station that searches its rate, call by call: what a change of the rate or of the state does at once.
#include "fdl/bench.hpp"

using namespace dpslave;
using namespace test;
using fdl::BaudState;
using fdl::Supervision;

namespace {

class RateChange : public testing::Test {
protected:
    RateChange()
    {
        station.attach(kUs, user, kClassMaxTsdr);
        station.on_time(kRead);
        station.take_baud_change();
    }
    void bad_characters(int count)
    {
        for (int i = 0; i < count; ++i) station.on_character_error(kRead);
    }
    void finds_the_rate()
    {
        station.on_bytes(sd1(kUs, kMaster, kFdlStatus), kRead);
        ASSERT_EQ(station.baud_state(), BaudState::baud_control);
    }

    RecordingUser user;
    fdl::Layer2 station{{.baud = Baud::k1500, .search = fdl::BaudSearchSettings{}, .start_up_latency = {}}};
};

TEST_F(RateChange, BeginsInBaudSearch)
{
    EXPECT_EQ(fdl::Layer2(fdl::Layer2Settings{Baud::k1500, fdl::BaudSearchSettings{}, {}}).baud_state(),
              BaudState::baud_search);
}

TEST_F(RateChange, ToTheRateThatTheSearchBeginsWithCountsForTheSilenceToo)
{
    fdl::BaudSearchSettings only;
    only.rates.reset();
    only.rates.set(index_of(Baud::k9_6));
    fdl::Layer2 slow{fdl::Layer2Settings{Baud::k1500, only, {}}};
    ASSERT_EQ(slow.take_baud_change(), Baud::k9_6);
    slow.on_time(kRead);

    slow.on_bytes(octets("68"), kRead);

    EXPECT_EQ(slow.next_deadline(),
              kRead + fdl::silence_limit(Baud::k9_6) + duration_of(Tbit{64 * 11}, Baud::k9_6));
}

TEST_F(RateChange, NeedsTwentyCharactersThatAreHeard)
{
    bad_characters(19);
    EXPECT_EQ(station.take_baud_change(), std::nullopt);

    bad_characters(1);

    EXPECT_EQ(station.take_baud_change(), Baud::k500);
    EXPECT_EQ(station.counters().search_flaws, 1u) << "one piece of noise";
}

TEST_F(RateChange, IsNotFollowedByAnotherBeforeTheEdgeHasSetTheRate)
{
    bad_characters(20);
    bad_characters(40); // still heard at the old rate

    EXPECT_EQ(station.take_baud_change(), Baud::k500);
    bad_characters(19);
    EXPECT_EQ(station.take_baud_change(), std::nullopt);
    bad_characters(1);
    EXPECT_EQ(station.take_baud_change(), Baud::k187_5);
}

TEST_F(RateChange, DropsTheTelegramThatBeganAtTheOldRate)
{
    bad_characters(9);
    station.on_bytes(octets("68 20 20 68 05 02 5D 01 02 03"), kRead);
    station.on_bytes(octets("04"), kRead);
    ASSERT_EQ(station.take_baud_change(), Baud::k500);

    station.on_bytes(sd1(kOther, kMaster, kFdlStatus), kRead);

    EXPECT_EQ(station.counters().telegrams, 1u);
}

TEST_F(RateChange, CountsTheStumpThatWasHeardBeforeIt)
{
    bad_characters(9);
    EXPECT_EQ(station.counters().search_flaws, 1u);
    station.on_bytes(octets("68"), kRead + std::chrono::milliseconds{1}); // behind a pause: not that noise

    station.on_bytes(Octets(10, 0x00), kRead + std::chrono::seconds{1});

    ASSERT_EQ(station.take_baud_change(), Baud::k500);
    EXPECT_EQ(station.counters().search_flaws, 2u);
}

TEST_F(RateChange, ToDpControlFollowsTheTelegramThatBeginsTheSupervisionAndItsRetryStaysOne)
{
    finds_the_rate();
    user.level = Supervision::supervised;

    station.on_bytes(sd2(kUs, kMaster, kSrdFcb1, {1}), kRead);
    EXPECT_EQ(station.baud_state(), BaudState::dp_control);
    EXPECT_TRUE(station.reply_waits());

    station.on_bytes(sd2(kUs, kMaster, kSrdFcb1, {1}), kRead);
    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(station.counters().retries, 1u);
}

TEST_F(RateChange, ToBaudControlFollowsAnSdnThatFindsTheWatchdogExpired)
{
    finds_the_rate();
    user.level = Supervision::supervised;
    station.on_bytes(sd2(kUs, kMaster, kSrdFcb1, {1}), kRead);
    ASSERT_EQ(station.baud_state(), BaudState::dp_control);
    user.level = Supervision::unowned;

    station.on_bytes(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}), kRead);

    EXPECT_EQ(station.baud_state(), BaudState::baud_control);
}

} // namespace
