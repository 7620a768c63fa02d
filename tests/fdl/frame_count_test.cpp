// SPDX-License-Identifier: Apache-2.0
/// The frame count bit, row by row (wire reference 2.6).
#include "bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

class FrameCount : public FdlStation {
protected:
    std::optional<Octets> ask(const Octets& request)
    {
        bus.master_sends(request);
        return bus.reply();
    }
    std::optional<Octets> ask(std::uint8_t fc) { return ask(sd2(kUs, kMaster, fc, {0x12, 0x34})); }
};

TEST_F(FrameCount, WorkedExampleOfALostReply)
{
    user.inputs = {0xAA, 0x55};
    EXPECT_EQ(ask(octets("68 05 05 68 05 02 7D 12 34 CA 16")), octets("68 05 05 68 02 05 08 AA 55 0E 16"));
    user.inputs = {0xAA, 0x56};
    EXPECT_EQ(ask(octets("68 05 05 68 05 02 7D 12 34 CA 16")), octets("68 05 05 68 02 05 08 AA 55 0E 16"));
    EXPECT_EQ(ask(octets("68 05 05 68 05 02 5D 12 35 AB 16")), octets("68 05 05 68 02 05 08 AA 56 0F 16"));

    ASSERT_EQ(user.srds.size(), 2u);
    EXPECT_EQ(user.srds[0].data, octets("12 34"));
    EXPECT_EQ(user.srds[1].data, octets("12 35"));
    EXPECT_EQ(station.counters().retries, 1u);
}

TEST_F(FrameCount, RetryIsASignOfLifeAndNoIndication)
{
    ask(kSrdFcb1);
    ask(kSrdFcb1);

    EXPECT_EQ(user.srds.size(), 1u);
    ASSERT_EQ(user.heards.size(), 1u);
    EXPECT_EQ(user.heards[0].sa, kMaster);
}

TEST_F(FrameCount, RetryIsRepeatedAsOftenAsTheMasterAsks)
{
    const auto first = ask(kSrdFcb1);
    user.inputs = {0x99};

    for (int i = 0; i < 5; ++i) EXPECT_EQ(ask(kSrdFcb1), first);
    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(FrameCount, ToggledBitIsTheNextRequest)
{
    ask(kSrdFirst);
    ask(kSrdFcb0);
    ask(kSrdFcb1);
    ask(kSrdFcb0);

    EXPECT_EQ(user.srds.size(), 4u);
}

TEST_F(FrameCount, FirstRequestIsExecutedEvenIfItLooksLikeTheLast)
{
    ask(kSrdFirst);
    ask(kSrdFirst);

    EXPECT_EQ(user.srds.size(), 2u);
}

TEST_F(FrameCount, FirstRequestBeginsASequenceWithOne)
{
    ask(kSrdFirst);
    ask(kSrdFcb1); // equal to FCBM := 1
    EXPECT_EQ(user.srds.size(), 1u);
    ask(kSrdFcb0);

    EXPECT_EQ(user.srds.size(), 2u);
}

TEST_F(FrameCount, BitMeansNothingBeforeTheFirstRequest)
{
    ask(kSrdFcb0);

    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(FrameCount, AnotherMasterIsNotMeasuredByTheBitOfTheFirst)
{
    ask(sd2(kUs, kMaster, kSrdFcb1, {1}));
    ask(sd2(kUs, kOtherMaster, kSrdFcb1, {2}));
    EXPECT_EQ(user.srds.size(), 2u);
    ask(sd2(kUs, kOtherMaster, kSrdFcb1, {2}));
    EXPECT_EQ(user.srds.size(), 2u); // the second master's retry
    ask(sd2(kUs, kMaster, kSrdFcb1, {1}));

    EXPECT_EQ(user.srds.size(), 3u); // the first is a new initiator again: one memory for the whole station
}

TEST_F(FrameCount, SameBitForAnotherSapIsANewRequest)
{
    ask(sd2(kUs, kMaster, kSrdFcb1, Saps{60, 62}));
    ask(sd2(kUs, kMaster, kSrdFcb1, Saps{59, 62}));
    ask(sd2(kUs, kMaster, kSrdFcb1, {1}));

    EXPECT_EQ(user.srds.size(), 3u);
}

TEST_F(FrameCount, SameBitForAnotherFunctionIsANewRequest)
{
    ask(sd2(kUs, kMaster, 0x7D, Saps{60, 62}));
    ask(sd2(kUs, kMaster, 0x7C, Saps{60, 62}));

    EXPECT_EQ(user.srds.size(), 2u);
}

TEST_F(FrameCount, UncountedSrdIsExecutedAndLeavesTheMemoryAlone)
{
    user.inputs = {0x01};
    const auto stored = ask(kSrdFcb1);
    user.inputs = {0x02};
    EXPECT_EQ(ask(kSrdUncounted), sd2(kMaster, kUs, 0x08, {0x02}));
    EXPECT_EQ(ask(kSrdUncounted), sd2(kMaster, kUs, 0x08, {0x02}));
    EXPECT_EQ(user.srds.size(), 3u);

    EXPECT_EQ(ask(kSrdFcb1), stored); // still a retry of the first
    EXPECT_EQ(user.srds.size(), 3u);
}

TEST_F(FrameCount, UncountedServicesLeaveTheMemoryAlone)
{
    const auto stored = ask(kSrdFcb1);
    ask(sd1(kUs, kMaster, kFdlStatus));
    ask(sd1(kUs, kMaster, 0x4E));
    ask(sd1(kUs, kMaster, 0x4F));
    ask(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}));
    ask(sd1(kOther, kMaster, kFdlStatus));
    user.inputs = {0x99};

    EXPECT_EQ(ask(kSrdFcb1), stored);
    EXPECT_EQ(user.srds.size(), 1u);
}

TEST_F(FrameCount, RepeatedGlobalControlIsExecutedAgain)
{
    ask(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0x08, 0}));
    ask(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0x08, 0}));

    EXPECT_EQ(user.sdns.size(), 2u);
}

TEST_F(FrameCount, RefusalsAndShortAcknowledgesAreStoredToo)
{
    user.answer = fdl::Answer::not_activated;
    EXPECT_EQ(ask(kSrdFcb1), octets("10 02 05 03 0A 16"));
    user.answer = fdl::Answer::sc;
    EXPECT_EQ(ask(kSrdFcb1), octets("10 02 05 03 0A 16"));
    EXPECT_EQ(ask(kSrdFcb0), octets("E5"));
    user.answer = fdl::Answer::low;

    EXPECT_EQ(ask(kSrdFcb0), octets("E5"));
}

TEST_F(FrameCount, RefusedSdaTakesPartInTheSequence)
{
    ask(kSrdFirst);
    EXPECT_EQ(ask(sd2(kUs, kMaster, 0x55, {1})), octets("10 02 05 03 0A 16")); // SDA high, FCB 0
    ask(kSrdFcb1);

    EXPECT_EQ(user.srds.size(), 2u);
}

TEST_F(FrameCount, AReplyThatWasDestroyedByTheNextOctetsIsRepeatedOnRetry)
{
    bus.master_sends(sd2(kUs, kMaster, kSrdFcb1, {1}));
    bus.breaks_in_after(bus.bits(5), {0x00}); // noise before the window opens
    EXPECT_FALSE(bus.reply());
    user.inputs = {0x99};

    EXPECT_EQ(ask(sd2(kUs, kMaster, kSrdFcb1, {1})), octets("68 05 05 68 02 05 08 12 34 55 16"));
    EXPECT_EQ(user.srds.size(), 1u);
}

} // namespace
