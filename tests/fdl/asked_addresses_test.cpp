// SPDX-License-Identifier: Apache-2.0
/// A master that asks for an address without a station: which address, which master.
#include "bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

class AskedAddresses : public testing::Test {
protected:
    AskedAddresses() { station.attach(5, user, kClassMaxTsdr); }
    std::vector<fdl::UnansweredAddress> unanswered() const
    {
        std::vector<fdl::UnansweredAddress> all;
        for (const fdl::UnansweredAddress& one : station.unanswered())
            if (one.requests != 0) all.push_back(one);
        return all;
    }

    fdl::Layer2 station{fdl::Layer2Settings{}};
    RecordingUser user;
    Bus bus{station};
};

TEST_F(AskedAddresses, AreReportedWithTheMasterThatAsksAndHowOften)
{
    for (int i = 0; i < 3; ++i) bus.master_sends(sd2(7, 2, kSrdFirst, Saps{61, 62}, {0x88}));
    bus.master_sends(sd2(9, 1, kSrdFirst, Saps{60, 62}));

    ASSERT_EQ(unanswered().size(), 2U);
    EXPECT_EQ(unanswered()[0].address, 7);
    EXPECT_EQ(unanswered()[0].master, 2);
    EXPECT_EQ(unanswered()[0].requests, 3U);
    EXPECT_EQ(unanswered()[1].address, 9);
    EXPECT_EQ(unanswered()[1].last, bus.now());
    EXPECT_LT(unanswered()[0].last, bus.now());
}

TEST_F(AskedAddresses, AreNotThoseThatAreOnlyAskedForTheirFdlStatus)
{
    for (std::uint8_t free = 10; free < 100; ++free) bus.master_sends(sd1(free, 2, kFdlStatus));

    EXPECT_TRUE(unanswered().empty());
}

TEST_F(AskedAddresses, AreNoLongerReportedWhenAStationAnswersThere)
{
    bus.master_sends(sd2(7, 2, kSrdFirst, Saps{60, 62}));
    bus.breaks_in_after(duration_of(Tbit{40}, Baud::k187_5), sd2(2, 7, 0x08, Saps{62, 60}, {0, 0}));
    bus.master_sends(sd2(8, 2, kSrdFirst, Saps{61, 62}, {0x88}));
    bus.breaks_in_after(duration_of(Tbit{40}, Baud::k187_5), sc());

    EXPECT_TRUE(unanswered().empty());
}

TEST_F(AskedAddresses, AreNeverOurOwn)
{
    bus.master_sends(sd2(5, 2, kSrdFirst, Saps{60, 62}));
    bus.reply();

    EXPECT_TRUE(unanswered().empty());
}

} // namespace
