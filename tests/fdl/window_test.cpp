// SPDX-License-Identifier: Apache-2.0
/// Tests when a reply may start: not before min T_SDR, not after the deadline (wire reference 1.3, 1.5).
#include "bench.hpp"

using namespace dpslave;
using namespace test;
using std::chrono::nanoseconds;

namespace {

TEST_F(FdlStation, WaitsMinTsdrBeforeItAnswers)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));

    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(bus.turnaround(), duration_of(11_tbit, Baud::k187_5));
}

class MinTsdr : public FdlStation, public testing::WithParamInterface<std::uint32_t> {};

TEST_P(MinTsdr, OfTheUserIsKept)
{
    const std::uint32_t effective = std::max(GetParam(), 11u);
    user.min_tsdr_bits = Tbit{GetParam()};
    bus.set_min_tsdr(Tbit{effective});
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));

    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(bus.turnaround(), bus.bits(effective));
}

INSTANTIATE_TEST_SUITE_P(C22, MinTsdr, testing::Values(0u, 5u, 11u, 12u, 59u, 60u, 61u, 100u, 255u));

TEST_F(FdlStation, NewMinTsdrBeginsWithTheReplyAfterTheAcknowledgeOfItsOwnSetPrm)
{
    user.answer = fdl::Answer::sc;
    user.min_tsdr_after_srd = 100_tbit;
    bus.master_sends(octets("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 64 47 11 01 39 16"));
    ASSERT_EQ(bus.reply(), octets("E5"));
    EXPECT_EQ(bus.turnaround(), bus.bits(11));

    bus.set_min_tsdr(100_tbit);
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(bus.turnaround(), bus.bits(100));
}

/// Without the bus: the exact edges of the window.
class ReplyWindow : public testing::Test {
protected:
    fdl::Layer2& station_with(Tbit max_tsdr, nanoseconds start_up_latency = {}, nanoseconds unread = {})
    {
        station.emplace(fdl::Layer2Settings{Baud::k187_5, {}, start_up_latency});
        std::array<Tbit, kBauds.size()> all{};
        all[index_of(Baud::k187_5)] = max_tsdr;
        station->attach(kUs, user, all);
        station->on_time(kRead);
        station->assume_backlog(unread);
        station->on_bytes(octets("10 05 02 49 50 16"), kRead);
        return *station;
    }
    static nanoseconds bits(std::uint32_t count) { return duration_of(Tbit{count}, Baud::k187_5); }

    RecordingUser user;
    std::optional<fdl::Layer2> station;
};

TEST_F(ReplyWindow, IsClosedOneNanosecondBeforeMinTsdr)
{
    fdl::Layer2& s = station_with(60_tbit);
    s.on_time(kRead + bits(11) - nanoseconds{1});

    EXPECT_FALSE(s.take_transmit());
}

TEST_F(ReplyWindow, OpensAtMinTsdrAndSaysSoAsDeadline)
{
    fdl::Layer2& s = station_with(60_tbit);
    EXPECT_EQ(s.next_deadline(), kRead + bits(11));
    s.on_time(kRead + bits(11));

    EXPECT_TRUE(s.take_transmit());
    EXPECT_FALSE(s.take_transmit()); // a reply is given once
}

/// Given a reader that stood still: how old the request is it does not know, only how old it may be.
TEST_F(ReplyWindow, EndsEarlierByTheTimeForWhichTheRequestMayHaveLainUnread)
{
    fdl::Layer2& s = station_with(100_tbit, {}, bits(30));
    s.on_time(kRead + bits(70));
    EXPECT_TRUE(s.take_transmit());

    fdl::Layer2& later = station_with(100_tbit, {}, bits(30));
    later.on_time(kRead + bits(70) + nanoseconds{1});
    EXPECT_FALSE(later.take_transmit());
    EXPECT_EQ(later.counters().late, 1u);
}

TEST_F(ReplyWindow, OpensNoEarlierForARequestThatMayHaveLainUnread)
{
    fdl::Layer2& s = station_with(100_tbit, {}, bits(30));
    s.on_time(kRead + bits(11) - nanoseconds{1});
    EXPECT_FALSE(s.take_transmit());
    s.on_time(kRead + bits(11));
    EXPECT_TRUE(s.take_transmit());
}

TEST_F(ReplyWindow, HasPassedWhereTheRequestMayHaveLainLonger)
{
    fdl::Layer2& s = station_with(100_tbit, {}, std::chrono::seconds{1});
    s.on_time(kRead + bits(11));

    EXPECT_FALSE(s.take_transmit());
    EXPECT_EQ(s.counters().late, 1u);
}

TEST_F(ReplyWindow, IsWholeAgainForWhatIsReadInTime)
{
    fdl::Layer2& s = station_with(100_tbit, {}, std::chrono::seconds{1});
    s.assume_backlog({});
    s.on_bytes(octets("10 05 02 49 50 16"), kRead + bits(500));
    s.on_time(kRead + bits(600));

    EXPECT_TRUE(s.take_transmit());
}

TEST_F(ReplyWindow, IsOpenUntilMaxTsdr)
{
    fdl::Layer2& s = station_with(100_tbit);
    s.on_time(kRead + bits(100));

    EXPECT_TRUE(s.take_transmit());
    EXPECT_EQ(s.counters().late, 0u);
}

TEST_F(ReplyWindow, OfTheReplyHandedOutIsKnownAfterwards)
{
    fdl::Layer2& s = station_with(100_tbit);
    s.on_time(kRead + bits(20));
    ASSERT_TRUE(s.take_transmit());

    EXPECT_EQ(s.window_ended(), kRead + bits(100)); // a write that ends later was too late
}

TEST_F(ReplyWindow, IsClosedAfterMaxTsdrAndTheReplyIsCounted)
{
    fdl::Layer2& s = station_with(100_tbit);
    s.on_time(kRead + bits(100) + nanoseconds{1});

    EXPECT_FALSE(s.take_transmit());
    EXPECT_EQ(s.counters().late, 1u);
    EXPECT_EQ(s.counters().replies, 0u);
    EXPECT_EQ(s.next_deadline(), kNever);
}

TEST_F(ReplyWindow, OfTheDefaultMinTsdrNeverOutlastsTheMaxTsdrOfItsClass)
{
    fdl::Layer2& s = station_with(60_tbit);
    s.on_time(kRead + bits(60) + nanoseconds{1});

    EXPECT_FALSE(s.take_transmit());
}

TEST_F(ReplyWindow, IsAtLeast49BitsWideBehindALongMinTsdr)
{
    user.min_tsdr_bits = 200_tbit;
    fdl::Layer2& s = station_with(60_tbit);
    s.on_time(kRead + bits(249));

    EXPECT_TRUE(s.take_transmit());
}

TEST_F(ReplyWindow, EndsAtMinTsdrPlus49WhenThatIsLater)
{
    user.min_tsdr_bits = 200_tbit;
    fdl::Layer2& s = station_with(60_tbit);
    s.on_time(kRead + bits(249) + nanoseconds{1});

    EXPECT_FALSE(s.take_transmit());
}

TEST_F(ReplyWindow, EndsEarlierByTheStartUpLatencyOfTheTransmitter)
{
    fdl::Layer2& in_time = station_with(100_tbit, nanoseconds{20'000});
    in_time.on_time(kRead + bits(100) - nanoseconds{20'000});
    EXPECT_TRUE(in_time.take_transmit());

    fdl::Layer2& late = station_with(100_tbit, nanoseconds{20'000});
    late.on_time(kRead + bits(100) - nanoseconds{19'999});
    EXPECT_FALSE(late.take_transmit());
}

TEST_F(ReplyWindow, ReplyThatWasNotTakenInTimeIsLate)
{
    fdl::Layer2& s = station_with(100_tbit);
    s.on_time(kRead + bits(20));
    s.on_time(kRead + bits(101));

    EXPECT_FALSE(s.take_transmit());
    EXPECT_EQ(s.counters().late, 1u);
}

TEST_F(FdlStation, LateReplyIsSuppressedButItsRetryGetsIt)
{
    bus.edge_is_late_by(bus.bits(55)); // min T_SDR 11 + 55 is behind 60
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    EXPECT_FALSE(bus.reply());
    bus.advance(bus.bits(10)); // the edge wakes up behind the slot time
    EXPECT_EQ(station.counters().late, 1u);

    bus.edge_is_late_by({});
    user.inputs = {0x99};
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    EXPECT_EQ(bus.reply(), octets("68 05 05 68 02 05 08 12 34 55 16"));
    EXPECT_EQ(user.srds.size(), 1u);
}

class EveryRate : public testing::TestWithParam<Baud> {};

TEST_P(EveryRate, IsAnsweredInItsWindow)
{
    RecordingUser user;
    fdl::Layer2 station{{.baud = GetParam(), .search = {}, .start_up_latency = {}}};
    station.attach(kUs, user, kClassMaxTsdr);
    Bus bus{station, {.baud = GetParam(), .min_tsdr = 11_tbit, .max_tsdr = {}}};
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));

    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(bus.turnaround(), duration_of(11_tbit, GetParam()));
}

TEST_P(EveryRate, HasItsOwnMaxTsdr)
{
    RecordingUser user;
    fdl::Layer2 station{{.baud = GetParam(), .search = {}, .start_up_latency = {}}};
    std::array<Tbit, kBauds.size()> max_tsdr{};
    for (std::size_t i = 0; i < kBauds.size(); ++i)
        max_tsdr[i] = Tbit{static_cast<std::uint32_t>(100 + 10 * i)};
    station.attach(kUs, user, max_tsdr);
    const Tbit mine = max_tsdr[index_of(GetParam())];
    station.on_time(kRead);
    station.on_bytes(octets("10 05 02 49 50 16"), kRead);
    station.on_time(kRead + duration_of(mine, GetParam()));
    EXPECT_TRUE(station.take_transmit());
    station.on_bytes(octets("10 05 02 49 50 16"), kRead);
    station.on_time(kRead + duration_of(mine, GetParam()) + nanoseconds{1});
    EXPECT_FALSE(station.take_transmit());
}

INSTANTIATE_TEST_SUITE_P(Rates, EveryRate, testing::ValuesIn(kBauds));

TEST_F(ReplyWindow, IsWaitedForUntilTheReplyIsTaken)
{
    fdl::Layer2& asked = station_with(60_tbit);
    EXPECT_TRUE(asked.reply_waits());
    asked.on_time(kRead + bits(11));
    EXPECT_TRUE(asked.reply_waits());
    ASSERT_TRUE(asked.take_transmit());
    EXPECT_FALSE(asked.reply_waits());
}

} // namespace
