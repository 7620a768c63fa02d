// SPDX-License-Identifier: Apache-2.0
/// Of each request to one of our addresses that gets no reply layer 2 says why.
#include "fdl/bench.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace test;
using Why = fdl::Unanswered::Why;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

namespace {

class UnansweredRequests : public FdlStation {
protected:
    std::vector<std::pair<std::uint8_t, Why>> take()
    {
        std::vector<std::pair<std::uint8_t, Why>> all;
        while (const auto one = station.take_unanswered()) all.emplace_back(one->address, one->why);
        return all;
    }
};

TEST_F(UnansweredRequests, OneThatIsAnsweredIsNone)
{
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {0xAA}));

    EXPECT_TRUE(bus.reply());
    EXPECT_THAT(take(), IsEmpty());
}

TEST_F(UnansweredRequests, OneWithSomethingBehindItInTheSameReadIsOvertaken)
{
    bus.arrives_in_one_read({sd2(kUs, kMaster, kSrdFcb1, {0xAA}), sd2(kOther, kMaster, kSrdFcb1, {0xBB})});

    EXPECT_THAT(take(), ElementsAre(Pair(kUs, Why::overtaken)));
}

TEST_F(UnansweredRequests, OneWhoseReplyIsCancelledByAnOctetIsOvertaken)
{
    const Octets request = sd2(kUs, kMaster, kSrdFcb1, {0xAA});
    station.on_bytes(request, bus.now());
    station.on_bytes(octets("10"), bus.now());

    EXPECT_THAT(take(), ElementsAre(Pair(kUs, Why::overtaken)));
}

TEST_F(UnansweredRequests, OneWhoseWindowIsOverIsLate)
{
    const Octets request = sd2(kUs, kMaster, kSrdFcb1, {0xAA});
    station.on_bytes(request, bus.now());
    station.on_time(bus.now() + std::chrono::seconds{1});

    EXPECT_THAT(take(), ElementsAre(Pair(kUs, Why::late)));
}

TEST_F(UnansweredRequests, OneThatCarriesOurAddressAsSenderIsAnAddressConflict)
{
    station.on_bytes(sd2(kOther, kUs, kSrdFcb1, {0xAA}), bus.now());

    EXPECT_THAT(take(), ElementsAre(Pair(kUs, Why::own_address)));
}

TEST_F(UnansweredRequests, OneWithAFunctionThatNoSlaveAnswersSaysSo)
{
    station.on_bytes(sd1(kUs, kMaster, 0x40), bus.now()); // Time_Event
    station.on_bytes(sd1(kUs, kMaster, 0xC9), bus.now()); // the second code table

    EXPECT_THAT(take(), ElementsAre(Pair(kUs, Why::no_service), Pair(kUs, Why::no_service)));
}

TEST_F(UnansweredRequests, ThoseToOthersAndThoseThatNeedNoAnswerAreNone)
{
    station.on_bytes(sd2(kOther, kMaster, kSrdFcb1, {0xAA}), bus.now());
    station.on_bytes(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}), bus.now());

    EXPECT_THAT(take(), IsEmpty());
}

TEST_F(UnansweredRequests, TheOldestAreKeptWhenTheyAreNotTaken)
{
    station.on_bytes(sd1(kOther, kUs, kFdlStatus), bus.now());
    for (int i = 0; i < 20; ++i) station.on_bytes(sd1(kUs, kMaster, 0x40), bus.now());

    const auto all = take();

    EXPECT_EQ(all.size(), 8U);
    EXPECT_EQ(all.front().second, Why::own_address);
}

} // namespace
