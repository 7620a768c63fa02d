// SPDX-License-Identifier: Apache-2.0
/// HA389815 ch. 7 and the acceptance rows: Demand Data in the first eight octets.
#include "demand_bench.hpp"

namespace test {
namespace {

using dpslave::AccessError;
using dpslave::DemandOrder;
using Kind = DemandOrder::Kind;

class DemandData : public DemandBench {
protected:
    explicit DemandData(dpslave::dp::Personality device = option_board()) : DemandBench(std::move(device))
    {
        start_up(board_prm({}, "B8 14 01 0B 05 33 01"), "73");
    }
};

TEST_F(DemandData, NoCommandIsAnsweredNothing)
{
    EXPECT_EQ(demand(0), kNothing);
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, IsReadBackInFrontOfTheOutputs)
{
    master.set_prm("40 00 00 00 05 33 00");
    start_up(board_prm({7, 8, 9}), "73 60 50 60");
    master.data_exchange("10 37 00 01 00 02 00 03 A5 01 5A 02");

    EXPECT_EQ(master.rd_outp(), "DL 10 37 00 01 00 02 00 03 A5 01 5A 02");
}

TEST_F(DemandData, NoCommandWithATagIsAnsweredNothingToo)
{
    EXPECT_EQ(demand(0x0037, 5), kNothing);
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, ReadIsOrderedAndAnsweredWithTagAndValue)
{
    EXPECT_EQ(demand(0x1037), kNothing); // the previous answer stays

    const DemandOrder read = order();
    EXPECT_EQ(read.kind, Kind::read);
    EXPECT_EQ(read.tag, 55);
    EXPECT_EQ(read.generation, generation());
    answer(read, 0x8ACE);
    EXPECT_EQ(demand(0x1037), "10 37 00 00 00 00 8A CE");
}

TEST_F(DemandData, AStandingReadIsRefreshedAndOrderedOnce)
{
    demand(0x1037);
    const DemandOrder read = order();
    answer(read, 1);
    EXPECT_EQ(demand(0x1037), "10 37 00 00 00 00 00 01");
    answer(read, 2);
    EXPECT_EQ(demand(0x1037), "10 37 00 00 00 00 00 02");
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, TheValueOfAReadDoesNotMatter)
{
    demand(0x1037, 1);
    order();
    demand(0x1037, 2);

    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, WriteIsOrderedOnceAndAcknowledged)
{
    demand(0x2110, 0x1234);

    const DemandOrder write = order();
    EXPECT_EQ(write.kind, Kind::write);
    EXPECT_EQ(write.tag, 0x110);
    EXPECT_EQ(write.value, 0x1234);
    answer(write, 0x1234);
    for (int cycle = 0; cycle < 3; ++cycle) EXPECT_EQ(demand(0x2110, 0x1234), "11 10 00 00 00 00 12 34");
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, WriteIsExecutedAgainWhenAnythingChanges)
{
    demand(0x2110, 1);
    order();
    demand(0x2110, 2); // another value
    EXPECT_EQ(order().value, 2);
    demand(0x2111, 2); // another tag
    EXPECT_EQ(order().tag, 0x111);
    demand(0x1111, 2); // another command
    EXPECT_EQ(order().kind, Kind::read);
    demand(0x2111, 2);
    EXPECT_EQ(order().kind, Kind::write);
}

TEST_F(DemandData, NoCommandArmsAWriteAgain)
{
    demand(0x2110, 1);
    order();
    demand(0);
    EXPECT_EQ(order().kind, Kind::cancel);
    demand(0x2110, 1);
    EXPECT_EQ(order().kind, Kind::write);
}

TEST_F(DemandData, ReservedRegistersAndBit11DoNotMatterAndAreAnswered0)
{
    exchange({0x1837, 0x1111, 0x2222, 0});
    const DemandOrder read = order();
    EXPECT_EQ(read.tag, 0x037);
    exchange({0x1037, 0, 0, 0});
    EXPECT_FALSE(slave.take_demand_order());
    answer(read, 7);
    EXPECT_EQ(exchange({0x1837, 0x1111, 0x2222, 0}), "10 37 00 00 00 00 00 07");
}

TEST_F(DemandData, TagsGoFrom0To2047)
{
    demand(0x17FF);
    const DemandOrder highest = order();
    EXPECT_EQ(highest.tag, 2047);
    answer(highest, 1);
    EXPECT_EQ(demand(0x17FF), "17 FF 00 00 00 00 00 01");
    demand(0x1000);
    EXPECT_EQ(order().tag, 0);
}

TEST_F(DemandData, ARejectedReadIsAnswered7AndItsCodeUntilItSucceeds)
{
    demand(0x1037);
    const DemandOrder read = order();
    refuse(read, AccessError::read_only);
    EXPECT_EQ(demand(0x1037), "70 37 00 00 00 00 00 01");
    answer(read, 0xFFFE);
    EXPECT_EQ(demand(0x1037), "10 37 00 00 00 00 FF FE");
}

TEST_F(DemandData, NoCommandIsAnsweredAtOnceAndLateAnswersAreDropped)
{
    demand(0x1037);
    const DemandOrder read = order();
    answer(read, 1);
    demand(0x1037);

    EXPECT_EQ(demand(0), kNothing);
    answer(read, 2);
    EXPECT_EQ(demand(0), kNothing);
}

TEST_F(DemandData, ThePreviousAnswerStaysUntilTheNewOneIsReady)
{
    demand(0x1037);
    const DemandOrder first = order();
    answer(first, 1);
    EXPECT_EQ(demand(0x1038), "10 37 00 00 00 00 00 01");
    const DemandOrder second = order();
    answer(first, 9); // for an order that no longer stands
    EXPECT_EQ(demand(0x1038), "10 37 00 00 00 00 00 01");
    answer(second, 2);
    EXPECT_EQ(demand(0x1038), "10 38 00 00 00 00 00 02");
}

TEST_F(DemandData, ADriveThatIsSilentOrDoesNotUnderstandHasNoCodeSoThePreviousAnswerStays)
{
    demand(0x1037);
    const DemandOrder read = order();
    answer(read, 1);
    refuse(read, AccessError::no_answer);
    refuse(read, AccessError::not_understood);

    EXPECT_EQ(demand(0x1037), "10 37 00 00 00 00 00 01");
}

TEST_F(DemandData, OtherCommandsAreRejectedAtOnceWithCode0)
{
    for (unsigned command = 3; command < 16; ++command) {
        const auto word = static_cast<std::uint16_t>(command << 12 | 0x037);
        EXPECT_EQ(demand(word, 5), "70 37 00 00 00 00 00 00") << command;
        EXPECT_FALSE(slave.take_demand_order()) << command;
    }
    EXPECT_EQ(seen().counters.demand_rejects, 1u); // one reply, however many asked for it
}

TEST_F(DemandData, AnIllegalCommandEndsAStandingRead)
{
    demand(0x1037);
    const DemandOrder read = order();

    EXPECT_EQ(demand(0x3037), "70 37 00 00 00 00 00 00");
    EXPECT_EQ(order().kind, Kind::cancel);
    answer(read, 1);
    EXPECT_EQ(demand(0x3037), "70 37 00 00 00 00 00 00");
}

struct Code {
    const char* name;
    AccessError error;
    std::uint16_t code;
};

class DemandCodes : public DemandData, public testing::WithParamInterface<Code> {};

TEST_P(DemandCodes, AreThoseOfTheTable)
{
    demand(0x210E, 5);
    refuse(order(), GetParam().error);

    EXPECT_EQ(demand(0x210E, 5), "71 0E 00 00 00 00 00 0" + std::to_string(GetParam().code));
}

INSTANTIATE_TEST_SUITE_P(A066, DemandCodes,
                         testing::Values(Code{"InvalidTag", AccessError::invalid_tag, 0},
                                         Code{"UnsupportedType", AccessError::unsupported_type, 0},
                                         Code{"ReadOnly", AccessError::read_only, 1},
                                         Code{"NotStopped", AccessError::not_stopped, 1},
                                         Code{"NotConfigurationMode", AccessError::not_config_mode, 1},
                                         Code{"OutOfRange", AccessError::out_of_range, 2},
                                         Code{"ValueNotEncoded", AccessError::value_not_encoded, 2}),
                         [](const auto& one) { return std::string{one.param.name}; });

/// The drive has refused nothing: it holds another word, which a read shows.
TEST_F(DemandData, AWriteThatTheDriveTakesAndDoesNotKeepIsATransfer)
{
    demand(0x210E, 5);
    slave.set_demand_answer({order().number, AccessError::not_kept, 5});

    EXPECT_EQ(demand(0x210E, 5), "11 0E 00 00 00 00 00 05");
}

class DemandErrorBase : public DemandData {
protected:
    DemandErrorBase() : DemandData(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = option_board();
        device.demand_error_base = 1;
        return device;
    }
};

TEST_F(DemandErrorBase, CountsTheCodesFrom1)
{
    demand(0x2037, 5);
    refuse(order(), AccessError::out_of_range);

    EXPECT_EQ(demand(0x2037, 5), "70 37 00 00 00 00 00 03");
    EXPECT_EQ(demand(0xF037), "70 37 00 00 00 00 00 01");
}

TEST_F(DemandData, UnderSyncTheOrdersFollowTheOutputsInForce)
{
    master.control("20 00"); // Sync
    demand(0x2037, 5);
    EXPECT_FALSE(slave.take_demand_order());

    master.control("20 00");
    EXPECT_EQ(order().kind, Kind::write);
    demand(0x1037);
    EXPECT_FALSE(slave.take_demand_order());
    master.control("10 00"); // Unsync
    EXPECT_EQ(order().kind, Kind::read);
}

TEST_F(DemandData, UnderFreezeTheReplyStandsStill)
{
    demand(0x1037);
    const DemandOrder read = order();
    answer(read, 1);
    master.control("08 00"); // Freeze
    answer(read, 2);

    EXPECT_EQ(seen().demand_reply, (std::array<std::uint16_t, 4>{0x1037, 0, 0, 1}));
    EXPECT_EQ(demand(0x1037), "10 37 00 00 00 00 00 01");
    EXPECT_EQ(demand(0), "10 37 00 00 00 00 00 01");
    master.control("04 00");
    EXPECT_EQ(demand(0), kNothing);
}

TEST_F(DemandData, ClearDataWithdrawsTheCommand)
{
    demand(0x1037);
    order();

    master.control("02 00");

    EXPECT_EQ(order().kind, Kind::cancel);
    EXPECT_EQ(master.rd_inp(), "DL 00 00 00 00 00 00 00 00");
}

TEST_F(DemandData, LeavingTheExchangeCancelsUnderTheOldGeneration)
{
    demand(0x1037);
    const DemandOrder read = order();
    answer(read, 1);

    master.set_prm(board_prm({}, "40 00 00 00 05 33 00"));

    const DemandOrder cancel = order();
    EXPECT_EQ(cancel.kind, Kind::cancel);
    EXPECT_EQ(cancel.generation, read.generation);
    start_up(board_prm({}), "73");
    answer(read, 2); // of the time before
    EXPECT_EQ(demand(0), kNothing);
}

TEST_F(DemandData, AnOrderThatWasNotFetchedIsNotExecutedAfterTheExchange)
{
    demand(0x2037, 5);

    master.set_prm(board_prm({}, "40 00 00 00 05 33 00"));

    EXPECT_EQ(order().kind, Kind::cancel);
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, ACancelThatWasNotFetchedOutlivesTheExchange)
{
    demand(0x1037);
    order();   // the drive side reads now
    demand(0); // and is to stop
    master.set_prm(board_prm({}, "40 00 00 00 05 33 00"));

    EXPECT_EQ(order().kind, Kind::cancel);
}

TEST_F(DemandData, LeavingWithoutAnyOrderCancelsNothing)
{
    demand(0);
    master.set_prm(board_prm({}, "40 00 00 00 05 33 00"));

    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, ALayoutMayBeginWithACommand)
{
    demand(0x2037, 5);
    order();
    master.set_prm(board_prm({}, "40 00 00 00 05 33 00"));
    order(); // cancel
    start_up(board_prm({}), "73");

    EXPECT_EQ(demand(0x2037, 5), kNothing);
    const DemandOrder again = order();
    EXPECT_EQ(again.kind, Kind::write);
    EXPECT_EQ(again.generation, generation());
}

TEST_F(DemandData, OfOrdersThatWereNotFetchedEveryWriteAndTheNewestRemain)
{
    demand(0x1001);
    demand(0x2003, 1);
    demand(0x2003, 2);
    demand(0x1004);
    demand(0x1005);

    EXPECT_EQ(order().value, 1);
    EXPECT_EQ(order().value, 2);
    EXPECT_EQ(order().tag, 5);
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(DemandData, WritesBeyondEightThatWereNotFetchedLoseTheOldestAndAreCounted)
{
    for (std::uint16_t value = 1; value <= 10; ++value) demand(0x2037, value);

    EXPECT_EQ(seen().counters.orders_lost, 2u);
    EXPECT_EQ(order().value, 3);
}

TEST_F(DemandData, TheSnapshotShowsRequestAndReply)
{
    exchange({0x1037, 1, 2, 3});
    answer(order(), 0x55AA);

    EXPECT_EQ(seen().demand_request, (std::array<std::uint16_t, 4>{0x1037, 1, 2, 3}));
    EXPECT_EQ(seen().demand_reply, (std::array<std::uint16_t, 4>{0x1037, 0, 0, 0x55AA}));
    EXPECT_EQ(seen().counters.demand_orders, 1u);
}

TEST_F(DemandData, TheSnapshotShowsNoReplyOnceTheExchangeHasEnded)
{
    demand(0x1037);
    answer(order(), 0x55AA);

    master.set_prm(board_prm({}, "40 00 00 00 05 33 00"));

    EXPECT_EQ(seen().demand_request, (std::array<std::uint16_t, 4>{}));
    EXPECT_EQ(seen().demand_reply, (std::array<std::uint16_t, 4>{}));
}

} // namespace
} // namespace test
