// SPDX-License-Identifier: Apache-2.0
/// A station address that is given up while the bus runs: silence there, and nothing else changes.
#include "bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

constexpr std::uint8_t kNeighbour = 6;

class Detach : public FdlStation {
protected:
    Detach()
    {
        neighbour.inputs = {0x66};
        station.attach(kNeighbour, neighbour, kClassMaxTsdr);
        bus.advance({});
    }
    void detach(std::uint8_t address)
    {
        station.detach(address);
        bus.advance({}); // on_time(), as the edge does
    }
    /// The neighbour is asked and answers.
    void expect_neighbour_answers(std::uint8_t fc)
    {
        bus.master_sends(sd2(kNeighbour, kMaster, fc, {1}));
        EXPECT_EQ(bus.reply(), sd2(kMaster, kNeighbour, 0x08, {0x66}));
    }

    RecordingUser neighbour;
};

TEST_F(Detach, TheAddressIsSilentAndItsUserIsCalledNoMore)
{
    detach(kUs);

    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, {1}));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}));
    EXPECT_TRUE(user.srds.empty());
    EXPECT_TRUE(user.heards.empty());
    EXPECT_TRUE(user.sdns.empty());
    EXPECT_EQ(neighbour.sdns.size(), 1u);
}

TEST_F(Detach, TheOthersGoOnInTheirFrameCountSequence)
{
    expect_neighbour_answers(kSrdFcb1);

    detach(kUs);

    expect_neighbour_answers(kSrdFcb1); // a retry, answered from memory
    EXPECT_EQ(neighbour.srds.size(), 1u);
    expect_neighbour_answers(kSrdFcb0);
    EXPECT_EQ(neighbour.srds.size(), 2u);
}

TEST_F(Detach, TwiceOrAtAFreeAddressDoesNothing)
{
    detach(kUs);
    detach(kUs);
    detach(99);
    detach(127);
    detach(255);

    expect_neighbour_answers(kSrdFirst);
}

TEST_F(Detach, AReplyUnderWayIsDropped)
{
    station.on_bytes(sd2(kUs, kMaster, kSrdFirst, {1}), bus.now());
    station.detach(kUs);
    station.on_time(bus.now() + bus.bits(20)); // the window would be open

    EXPECT_FALSE(station.take_transmit());
    EXPECT_EQ(station.counters().replies, 0u);
}

TEST_F(Detach, AReplyUnderWayOfAnotherIsGiven)
{
    station.on_bytes(sd2(kNeighbour, kMaster, kSrdFirst, {1}), bus.now());
    station.detach(kUs);
    station.on_time(bus.now() + bus.bits(20));

    const auto reply = station.take_transmit();
    ASSERT_TRUE(reply);
    EXPECT_EQ((Octets{reply->begin(), reply->end()}), sd2(kMaster, kNeighbour, 0x08, {0x66}));
}

TEST_F(Detach, OctetsThatAreBeingWrittenStayAsTheyAre)
{
    station.on_bytes(sd2(kUs, kMaster, kSrdFcb1, {1}), bus.now());
    station.on_time(bus.now() + bus.bits(20));
    const auto reply = station.take_transmit();
    ASSERT_TRUE(reply);

    station.detach(kUs);

    EXPECT_EQ((Octets{reply->begin(), reply->end()}), sd2(kMaster, kUs, 0x08, {0x12, 0x34}));
}

TEST_F(Detach, TheUserAttachedThereNextBeginsANewFrameCountSequence)
{
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    ASSERT_TRUE(bus.reply());
    detach(kUs);
    RecordingUser next;
    next.inputs = {0x77};
    station.attach(kUs, next, kClassMaxTsdr);
    bus.advance({});

    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));

    EXPECT_EQ(bus.reply(), sd2(kMaster, kUs, 0x08, {0x77})); // not the memory of the one before
    EXPECT_EQ(next.srds.size(), 1u);
}

TEST_F(Detach, AUserCanMoveToAnotherAddress)
{
    detach(kUs);
    station.attach(77, user, kClassMaxTsdr);
    bus.advance({});

    bus.master_sends(sd2(77, kMaster, kSrdFirst, {1}));
    EXPECT_EQ(bus.reply(), sd2(kMaster, 77, 0x08, {0x12, 0x34}));
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    EXPECT_FALSE(bus.reply());
}

TEST_F(Detach, TheUserIsWokenNoMoreAndTheOthersAre)
{
    user.deadline = neighbour.deadline = bus.now() + std::chrono::milliseconds{5};
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus)); // calls after which the station asks for deadlines
    bus.master_sends(sd1(kNeighbour, kMaster, kFdlStatus));
    detach(kUs);
    bus.advance(std::chrono::milliseconds{20});

    EXPECT_TRUE(user.times.empty());
    EXPECT_EQ(neighbour.times.size(), 1u);
}

TEST_F(Detach, NothingOfItIsLeftToBePublished)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    bus.master_sends(sd1(kNeighbour, kMaster, kFdlStatus));

    detach(kUs);

    EXPECT_EQ(station.take_touched(), std::bitset<128>{}.set(kNeighbour));
}

TEST_F(Detach, AnotherStationMayHaveTheAddressWithoutAConflict)
{
    bus.breaks_in_after(bus.bits(100), sd2(kMaster, kUs, 0x08, {1}));
    EXPECT_EQ(station.counters().own_address, 1u);
    detach(kUs);
    bus.breaks_in_after(bus.bits(100), sd2(kMaster, kUs, 0x08, {1}));

    EXPECT_EQ(station.counters().own_address, 1u);
}

TEST_F(Detach, EveryAddressCanComeAndGoForEver)
{
    RecordingUser guest;
    guest.inputs = {1};
    for (unsigned round = 0; round < 3; ++round)
        for (std::uint8_t address = 7; address <= 126; ++address) {
            ASSERT_TRUE(station.attach(address, guest, kClassMaxTsdr));
            bus.advance({});
            bus.master_sends(sd2(address, kMaster, kSrdFirst, {1}));
            ASSERT_EQ(bus.reply(), sd2(kMaster, address, 0x08, {1}));
            detach(address);
        }

    EXPECT_EQ(guest.srds.size(), 360u);
    expect_neighbour_answers(kSrdFirst);
}

/// With the rate searched, a watchdog that guards the line keeps the rate: not for ever when its slave is
/// gone.
TEST(DetachWhileSearching, TheWatchdogOfADetachedSlaveKeepsTheRateNoMore)
{
    RecordingUser user;
    fdl::Layer2 station{{.baud = Baud::k187_5, .search = fdl::BaudSearchSettings{}, .start_up_latency = {}}};
    Bus bus{station};
    station.attach(kUs, user, kClassMaxTsdr);
    bus.advance({});
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus)); // ends the search
    user.level = fdl::Supervision::supervised;
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    ASSERT_TRUE(bus.reply());
    ASSERT_EQ(station.baud_state(), fdl::BaudState::dp_control);

    station.detach(kUs);
    bus.advance({});
    EXPECT_EQ(station.baud_state(), fdl::BaudState::baud_control);

    bus.advance(std::chrono::milliseconds{2320}); // T_BC, and a dwell
    EXPECT_EQ(station.baud_state(), fdl::BaudState::baud_search);
}

} // namespace
