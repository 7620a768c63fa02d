// SPDX-License-Identifier: Apache-2.0
/// The stations by themselves: a request in, its reply out, no line and no clock.
#include "bench.hpp"

#include "dpslave/fdl/stations.hpp"

using namespace dpslave;
using namespace test;

namespace {

class Stations : public testing::Test {
protected:
    Stations()
    {
        stations.attach(kUs, user, kClassMaxTsdr);
        stations.on_time(kStart);
    }
    /// FC and data of a request to us.
    fdl::Stations::Reply asks(std::uint8_t fc)
    {
        fdl::Telegram request;
        request.delimiter = fdl::kSD2;
        request.da = kUs;
        request.sa = kMaster;
        request.fc = fc;
        request.data = kData;
        return stations.on_request(request, kStart, Baud::k187_5);
    }
    /// A Global_Control with SDN.
    void orders(std::uint8_t address)
    {
        fdl::Telegram order;
        order.delimiter = fdl::kSD2;
        order.da = address;
        order.sa = kMaster;
        order.fc = kSdnHigh;
        order.data = kData;
        stations.on_sdn(order, kStart);
    }
    static std::string octets_of(const fdl::Stations::Reply& reply)
    {
        return show({reply.octets.begin(), reply.octets.end()});
    }

    static constexpr Instant kStart{std::chrono::seconds{4}};
    static constexpr std::array<std::uint8_t, 2> kData{0xAA, 0xBB};
    RecordingUser user;
    fdl::Stations stations;
};

TEST_F(Stations, PutTheAnswerOfTheUserOnTheWireForm)
{
    EXPECT_EQ(octets_of(asks(kSrdFirst)), show(sd2(kMaster, kUs, 0x08, {0x12, 0x34})));
    ASSERT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(user.srds[0].at, kStart);
}

TEST_F(Stations, GiveTheStoredReplyToARetryAndDoNotAskAgain)
{
    asks(kSrdFcb1);
    user.inputs = {0x56};

    const auto reply = asks(kSrdFcb1);

    EXPECT_TRUE(reply.repeated);
    EXPECT_EQ(octets_of(reply), show(sd2(kMaster, kUs, 0x08, {0x12, 0x34})));
    EXPECT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(user.heards.size(), 1u);
}

TEST_F(Stations, KnowNoRetryAfterTheRateHasChanged)
{
    asks(kSrdFcb1);

    stations.forget_requests();

    EXPECT_FALSE(asks(kSrdFcb1).repeated);
    EXPECT_EQ(user.srds.size(), 2u);
}

TEST_F(Stations, SayTheWindowAsItWasBeforeTheRequest)
{
    user.min_tsdr_after_srd = 90_tbit;

    const auto before = asks(kSrdFcb0);
    EXPECT_EQ(before.not_before, 11_tbit);
    EXPECT_EQ(before.not_after, 60_tbit);

    const auto after = asks(kSrdFcb1);
    EXPECT_EQ(after.not_before, 90_tbit);
    EXPECT_EQ(after.not_after, 139_tbit);
}

TEST_F(Stations, CountTheOwnedAndTheSupervisedOnes)
{
    EXPECT_FALSE(stations.any_owned());
    user.level = fdl::Supervision::supervised;
    asks(kSrdFirst);
    EXPECT_TRUE(stations.any_owned());
    EXPECT_TRUE(stations.any_supervised());

    stations.detach(kUs);

    EXPECT_FALSE(stations.any_owned());
    EXPECT_FALSE(stations.has(kUs));
    EXPECT_TRUE(stations.on_time(kStart)); // the search of the rate has to know
}

TEST_F(Stations, CallAUserWhenItIsDueAndNoSooner)
{
    user.deadline = kStart + std::chrono::milliseconds{5};
    asks(kSrdFirst);
    stations.take_touched();

    EXPECT_FALSE(stations.on_time(kStart + std::chrono::milliseconds{4}));
    EXPECT_TRUE(user.times.empty());
    EXPECT_TRUE(stations.on_time(user.deadline));
    EXPECT_EQ(user.times.size(), 1u);
    EXPECT_TRUE(stations.take_touched()[kUs]);
    EXPECT_EQ(stations.next_deadline(), kNever);
}

TEST_F(Stations, KeepTheFrameCountOverServicesThatAreNotCountedWhateverTheirBitsSay)
{
    asks(kSrdFcb1);
    for (const std::uint8_t fc : octets("79 7E 7F")) { // FDL status, ident and LSAP status, with FCB and FCV
        SCOPED_TRACE(static_cast<int>(fc));
        EXPECT_FALSE(asks(fc).repeated);

        EXPECT_TRUE(asks(kSrdFcb1).repeated);
    }
    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(Stations, GiveAnSdnToTheAddressedUserAloneAndAskItWhatItWaitsFor)
{
    RecordingUser other;
    stations.attach(kOther, other, kClassMaxTsdr);
    stations.on_time(kStart);
    stations.take_touched();
    user.deadline = kStart + std::chrono::milliseconds{5};

    orders(kUs);

    EXPECT_EQ(user.sdns.size(), 1u);
    EXPECT_TRUE(other.sdns.empty());
    EXPECT_EQ(stations.take_touched(), std::bitset<128>{}.set(kUs));
    EXPECT_EQ(stations.next_deadline(), user.deadline);
}

TEST_F(Stations, GiveAnSdnToAllOnceToAUserThatTookTheAddressOver)
{
    RecordingUser next;
    stations.attach(kUs, next, kClassMaxTsdr);

    orders(127);

    EXPECT_EQ(next.sdns.size(), 1u);
    EXPECT_TRUE(user.sdns.empty());
}

TEST_F(Stations, ForgetTheRequestsOfAllAddressesThereAre)
{
    for (std::uint8_t address = 0; address <= 126; ++address) stations.attach(address, user, kClassMaxTsdr);
    asks(kSrdFcb1);

    stations.forget_requests();

    EXPECT_FALSE(asks(kSrdFcb1).repeated);
}

} // namespace
