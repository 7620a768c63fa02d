// SPDX-License-Identifier: Apache-2.0
/// Several station addresses on one bus, at a cost that does not grow with their number.
#include "bench.hpp"

#include <memory>

using namespace dpslave;
using namespace test;

namespace {

class Addresses : public testing::Test {
protected:
    void attach(std::uint8_t first, std::uint8_t last)
    {
        for (unsigned a = first; a <= last; ++a) {
            users.push_back(std::make_unique<RecordingUser>());
            users.back()->inputs = {static_cast<std::uint8_t>(a)};
            station.attach(static_cast<std::uint8_t>(a), *users.back(), kClassMaxTsdr);
        }
        bus.advance({});
    }
    std::size_t deadline_questions() const
    {
        std::size_t sum = 0;
        for (const auto& user : users) sum += user->deadline_questions;
        return sum;
    }

    std::vector<std::unique_ptr<RecordingUser>> users;
    fdl::Layer2 station{fdl::Layer2Settings{}};
    Bus bus{station};
};

/// A slave at `address`, alone on its bus, answers there and nowhere else.
void expect_one_slave_at(std::uint8_t address)
{
    SCOPED_TRACE(static_cast<int>(address));
    const std::uint8_t master = address == 0 ? 1 : 0;
    fdl::Layer2 station{fdl::Layer2Settings{}};
    RecordingUser user;
    user.inputs = {address};
    station.attach(address, user, kClassMaxTsdr);
    Bus bus{station};
    bus.master_sends(sd2(address, master, kSrdFirst, Saps{60, 62}));
    EXPECT_EQ(bus.reply(), sd2(master, address, 0x08, Saps{62, 60}, {address}));

    for (std::uint8_t other = 0; other <= 126; ++other) {
        if (other == address || other == master) continue;
        bus.master_sends(sd1(other, master, kFdlStatus));
        EXPECT_FALSE(bus.reply()) << static_cast<int>(other);
    }
}

TEST(AllAddresses, From0To126CanBeTheOneOfASlave) // C-28, and the default address 126
{
    for (std::uint8_t address = 0; address <= 126; ++address) expect_one_slave_at(address);
}

TEST_F(Addresses, OnlyTheAddressedUserIsCalled)
{
    attach(3, 126); // 0, 1 and 2 are masters
    for (unsigned a = 3; a <= 126; ++a) {
        const auto da = static_cast<std::uint8_t>(a);
        bus.master_sends(sd2(da, kMaster, kSrdFirst, {da}));
        EXPECT_EQ(bus.reply(), sd2(kMaster, da, 0x08, {da}));
    }
    for (const auto& user : users) EXPECT_EQ(user->srds.size(), 1u);
}

TEST_F(Addresses, AddressesAbove126CannotBeAttached)
{
    RecordingUser user;
    EXPECT_TRUE(station.attach(126, user, kClassMaxTsdr));
    EXPECT_FALSE(station.attach(127, user, kClassMaxTsdr));
    EXPECT_FALSE(station.attach(255, user, kClassMaxTsdr));

    bus.master_sends(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}));
    EXPECT_EQ(user.sdns.size(), 1u);
}

TEST_F(Addresses, EachHasItsOwnFrameCount)
{
    attach(5, 6);
    bus.master_sends(sd2(5, kMaster, kSrdFcb1, {1}));
    ASSERT_TRUE(bus.reply());
    bus.master_sends(sd2(6, kMaster, kSrdFcb1, {1}));
    EXPECT_EQ(bus.reply(), sd2(kMaster, 6, 0x08, {6}));
    bus.master_sends(sd2(5, kMaster, kSrdFcb1, {1}));
    EXPECT_EQ(bus.reply(), sd2(kMaster, 5, 0x08, {5}));

    EXPECT_EQ(users[0]->srds.size(), 1u);
    EXPECT_EQ(users[1]->srds.size(), 1u);
    EXPECT_EQ(station.counters().retries, 1u);
}

TEST_F(Addresses, EachHasItsOwnMinTsdr)
{
    attach(5, 6);
    users[1]->min_tsdr_bits = 80_tbit;
    bus.master_sends(sd1(5, kMaster, kFdlStatus));
    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(bus.turnaround(), bus.bits(11));
    bus.set_min_tsdr(80_tbit);
    bus.master_sends(sd1(6, kMaster, kFdlStatus));
    ASSERT_TRUE(bus.reply());

    EXPECT_EQ(bus.turnaround(), bus.bits(80));
}

TEST_F(Addresses, SdnToAllReachesEveryUserOnce)
{
    attach(10, 20);
    bus.master_sends(octets("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16"));

    for (const auto& user : users) EXPECT_EQ(user->sdns.size(), 1u);
    EXPECT_EQ(station.take_touched().count(), 11u);
    EXPECT_EQ(station.counters().requests, 1u);
}

TEST_F(Addresses, OfRequestsToTwoOfUsInOneReadOnlyTheNewestIsAnswered)
{
    attach(5, 6);
    bus.arrives_in_one_read({sd2(5, kMaster, kSrdFcb1, {1}), sd2(6, kMaster, kSrdFcb1, {1})});

    EXPECT_EQ(bus.reply(), sd2(kMaster, 6, 0x08, {6}));
    EXPECT_TRUE(users[0]->srds.empty());
}

TEST_F(Addresses, ATelegramAsksNoOtherUserForItsDeadlineHoweverManyThereAre)
{
    attach(3, 125);
    const std::size_t before = deadline_questions();
    for (int i = 0; i < 1000; ++i) {
        bus.master_sends(sd2(77, kMaster, (i % 2) == 0 ? kSrdFcb0 : kSrdFcb1, {1}));
        ASSERT_TRUE(bus.reply());
    }

    EXPECT_EQ(deadline_questions() - before, 1000u); // the addressed user, once per telegram
}

TEST_F(Addresses, WatchdogsThatAreRetriggeredCostNoScanPerTelegram)
{
    attach(3, 125);
    const auto watchdog = std::chrono::milliseconds{300};
    const Instant start = bus.now();
    const std::size_t before = deadline_questions();
    int telegrams = 0;
    for (; bus.now() < start + std::chrono::seconds{1}; ++telegrams) {
        const auto da = static_cast<std::uint8_t>(3 + telegrams % 123);
        users[da - 3u]->deadline = bus.now() + watchdog; // what a DP slave does in srd()
        bus.master_sends(sd2(da, kMaster, kSrdFirst, {1}));
        ASSERT_TRUE(bus.reply());
    }

    for (const auto& user : users) EXPECT_TRUE(user->times.empty());
    const std::size_t scans = (deadline_questions() - before - static_cast<std::size_t>(telegrams)) / 123;
    EXPECT_GT(telegrams, 500);
    EXPECT_LE(scans, 20u); // a user is asked twice in a scan, and there is about one scan in a watchdog time
}

TEST_F(Addresses, OnlyTheUserIsWokenAtItsDeadline)
{
    attach(10, 20);
    bus.master_sends(sd2(15, kMaster, kSrdFirst, {1}));
    users[5]->deadline = bus.now() + std::chrono::milliseconds{7};
    const Instant due = users[5]->deadline;
    bus.master_sends(sd1(15, kMaster, kFdlStatus)); // a call after which the station asks again
    ASSERT_TRUE(bus.reply());
    EXPECT_EQ(station.next_deadline(), due);
    station.take_touched();
    bus.advance(std::chrono::milliseconds{20});

    ASSERT_EQ(users[5]->times.size(), 1u);
    EXPECT_EQ(users[5]->times[0], due);
    EXPECT_TRUE(users[4]->times.empty());
    EXPECT_EQ(station.take_touched(), std::bitset<128>{}.set(15));
    EXPECT_EQ(station.next_deadline(), kNever);
}

TEST_F(Addresses, UserThatWasAttachedWithADeadlineIsWokenToo)
{
    RecordingUser user;
    user.deadline = kRead;
    station.attach(5, user, kClassMaxTsdr);
    bus.advance(std::chrono::milliseconds{1}); // the bus is long past kRead

    EXPECT_EQ(user.times.size(), 1u);
}

} // namespace
