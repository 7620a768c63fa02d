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
    station.on_bytes(sd1(kOther, kMaster, 0xC9), bus.now()); // nor is its function ours to judge
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

/// The first telegram that a station hears while it searches the rate.
class UnansweredWhileSearching : public testing::Test {
protected:
    static std::vector<Why> reasons_after(const Octets& telegram)
    {
        RecordingUser user;
        fdl::Layer2 station{
            {.baud = Baud::k187_5, .search = fdl::BaudSearchSettings{}, .start_up_latency = {}}};
        station.attach(kUs, user, kClassMaxTsdr);
        station.take_baud_change();
        station.on_bytes(telegram, kRead);
        EXPECT_EQ(station.baud_state(), fdl::BaudState::baud_control);
        std::vector<Why> all;
        while (const auto one = station.take_unanswered()) {
            EXPECT_EQ(one->address, kUs);
            EXPECT_EQ(one->at, kRead);
            all.push_back(one->why);
        }
        return all;
    }
};

TEST_F(UnansweredWhileSearching, ARequestToUsIsOne)
{
    EXPECT_THAT(reasons_after(sd1(kUs, kMaster, kFdlStatus)), ElementsAre(Why::searching));
}

TEST_F(UnansweredWhileSearching, ARequestToAnotherAndAReplyToOurAddressAreNone)
{
    EXPECT_THAT(reasons_after(sd1(kOther, kMaster, kFdlStatus)), IsEmpty());
    EXPECT_THAT(reasons_after(sd1(kUs, kOther, 0x00)), IsEmpty());
    EXPECT_THAT(reasons_after(sd1(kMaster, kOther, 0x00)), IsEmpty());
}

TEST(UnansweredReasons, HaveTheirNames)
{
    const std::vector<std::pair<Why, std::string_view>> names{
        {Why::overtaken, "overtaken"},   {Why::late, "late"},           {Why::own_address, "own_address"},
        {Why::no_service, "no_service"}, {Why::searching, "searching"}, {Why::unsent, "unsent"}};
    ASSERT_EQ(names.size(), fdl::kUnansweredReasons);

    for (const auto& [why, name] : names) EXPECT_EQ(text(why), name);
}

} // namespace
