// SPDX-License-Identifier: Apache-2.0
/// The process data by themselves: no telegram, no state, no master.
#include "bench.hpp"

#include "dpslave/dp/process_data.hpp"

namespace test {
namespace {

using dpslave::dp::Switch;

/// One input word, one output word.
class ProcessData : public testing::Test {
protected:
    ProcessData()
    {
        dpslave::dp::Configuration configuration;
        configuration.in_length = configuration.out_length = 2;
        configuration.reads = true;
        configuration.layout.count = 2;
        configuration.layout.parameters[0] = {.tag = 1, .reads = true};
        configuration.layout.parameters[1] = {.tag = 2, .writes = true};
        data.begin(configuration, kBegin);
    }
    bool input_is(std::uint16_t word, bool tried = true)
    {
        dpslave::InputImage image{.generation = data.configuration().layout.generation,
                                  .every_input_tried = tried};
        image.words[0] = word;
        return data.set_inputs(image) == dpslave::dp::ProcessData::Readiness::ready;
    }
    std::string inputs() const
    {
        dpslave::ByteBuffer<244> reply;
        data.append_inputs(reply);
        return show({reply.bytes().begin(), reply.bytes().end()});
    }
    std::string outputs() const
    {
        dpslave::ByteBuffer<244> reply;
        data.append_outputs(reply);
        return show({reply.bytes().begin(), reply.bytes().end()});
    }

    static constexpr dpslave::Instant kBegin{std::chrono::seconds{7}};
    dpslave::dp::Personality device = example_device();
    dpslave::dp::ProcessData data{device};
};

TEST_F(ProcessData, HoldTheOutputsUnderSyncUntilSyncOrUnsync)
{
    data.receive(octets("00 01"), {});
    EXPECT_TRUE(data.set_sync(Switch::on));
    data.receive(octets("00 02"), {});
    EXPECT_EQ(outputs(), "00 01");
    EXPECT_FALSE(data.set_sync(Switch::on)); // as before, and what came is taken
    EXPECT_EQ(outputs(), "00 02");
    data.receive(octets("00 03"), {});
    EXPECT_FALSE(data.set_sync(Switch::keep));
    EXPECT_EQ(outputs(), "00 02");
    EXPECT_TRUE(data.set_sync(Switch::off));
    EXPECT_EQ(outputs(), "00 03");
}

/// Outputs in force are 0 then, and no master has sent that 0.
TEST_F(ProcessData, WriteNothingUnderSyncUntilOutputsOfTheMasterAreInForce)
{
    data.set_sync(Switch::on);
    data.receive(octets("00 02"), {});
    EXPECT_FALSE(data.take_outputs()->may_write);

    data.set_sync(Switch::on);
    const auto outputs = data.take_outputs();
    ASSERT_TRUE(outputs);
    EXPECT_TRUE(outputs->may_write);
    EXPECT_EQ(outputs->words[1], 2);
}

TEST_F(ProcessData, WriteNothingBecauseOfSyncAlone)
{
    data.set_sync(Switch::on);
    data.set_sync(Switch::off);

    EXPECT_FALSE(data.take_outputs()->may_write);
}

TEST_F(ProcessData, HoldTheInputsUnderFreezeUntilFreezeOrUnfreeze)
{
    input_is(0x1111);
    EXPECT_TRUE(data.set_freeze(Switch::on));
    input_is(0x2222);
    EXPECT_EQ(inputs(), "11 11");
    EXPECT_FALSE(data.set_freeze(Switch::on));
    EXPECT_EQ(inputs(), "22 22");
    input_is(0x3333);
    EXPECT_TRUE(data.set_freeze(Switch::off));
    EXPECT_EQ(inputs(), "33 33");
}

TEST_F(ProcessData, ClearIsTheFirstOneOnlyAfterAControlWithout)
{
    data.receive(octets("00 01"), {});

    EXPECT_TRUE(data.set_clear(true));
    EXPECT_EQ(outputs(), "00 00");
    EXPECT_FALSE(data.set_clear(true));
    EXPECT_FALSE(data.set_clear(false));
    EXPECT_TRUE(data.set_clear(true));
}

TEST_F(ProcessData, ClearGoesThroughSync)
{
    data.receive(octets("00 01"), {});
    data.set_sync(Switch::on);

    data.set_clear(true);

    EXPECT_EQ(outputs(), "00 00");
    EXPECT_TRUE(data.sync());
}

TEST_F(ProcessData, StatDiagMayEndWhenEveryInputWasTriedOrHadItsTime)
{
    EXPECT_TRUE(data.stat_diag());
    EXPECT_FALSE(input_is(0x1111, false));
    EXPECT_EQ(data.ready_by(), kBegin + std::chrono::seconds{1});
    EXPECT_TRUE(input_is(0x1111, true));
    EXPECT_TRUE(data.give_up_waiting());
    EXPECT_TRUE(input_is(0x1111, false));

    data.set_stat_diag(false);

    EXPECT_FALSE(data.stat_diag());
    EXPECT_EQ(data.ready_by(), dpslave::kNever);
    EXPECT_FALSE(input_is(0x1111, true));
}

TEST_F(ProcessData, EndIsReportedToTheDriveSideByOrderAndByImage)
{
    const auto generation = data.configuration().layout.generation;
    data.receive(octets("00 01"), {});
    EXPECT_TRUE(data.take_outputs()->may_write);
    EXPECT_FALSE(data.take_outputs());

    data.end();

    EXPECT_EQ(data.take_left()->generation, generation);
    EXPECT_FALSE(data.take_left());
    const auto after = data.take_outputs();
    EXPECT_FALSE(after->may_write);
    EXPECT_EQ(after->layout.generation, 0u);
    EXPECT_EQ(after->words[1], 0);
    EXPECT_EQ(data.configuration().out_length, 0u);
}

/// Demand Data and no parameter.
class DemandOrders : public testing::Test {
protected:
    DemandOrders() { begins({.demand = true, .in_length = 8, .out_length = 8}); }

    void begins(const dpslave::dp::Configuration& configuration)
    {
        data.begin(configuration, dpslave::Instant{});
    }
    /// The order that the master gives by these registers.
    dpslave::DemandOrder order_by(std::string_view registers)
    {
        data.receive(octets(registers), {});
        const auto order = data.take_demand_order();
        EXPECT_TRUE(order) << "no order";
        return order.value_or(dpslave::DemandOrder{});
    }
    dpslave::DemandOrder shown() const
    {
        dpslave::dp::Snapshot snapshot;
        data.fill(snapshot);
        return snapshot.demand_order;
    }

    dpslave::dp::Personality board = option_board();
    dpslave::dp::ProcessData data{board};
};

TEST_F(DemandOrders, AreNumberedOneByOne)
{
    const auto first = order_by("10 37 00 00 00 00 00 00");
    const auto second = order_by("10 38 00 00 00 00 00 00");

    EXPECT_EQ(second.number, first.number + 1);
}

TEST_F(DemandOrders, AreShownAsLongAsTheyStand)
{
    const auto read = order_by("10 37 00 00 00 00 00 00");
    EXPECT_EQ(shown().kind, dpslave::DemandOrder::Kind::read);
    EXPECT_EQ(shown().tag, 55);
    EXPECT_EQ(shown().number, read.number);

    data.end();

    EXPECT_EQ(shown().kind, dpslave::DemandOrder::Kind::cancel);
}

TEST_F(DemandOrders, ThatEndUnfetchedKeepTheirGenerationThroughALayoutWithoutDemandData)
{
    const auto read = order_by("10 37 00 00 00 00 00 00");
    data.end();

    begins({.reads = true, .in_length = 2});
    data.end();

    const auto cancel = data.take_demand_order();
    ASSERT_TRUE(cancel);
    EXPECT_EQ(cancel->kind, dpslave::DemandOrder::Kind::cancel);
    EXPECT_EQ(cancel->generation, read.generation);
    EXPECT_FALSE(data.take_demand_order());
}

TEST(DemandReply, IsZeroWhenALayoutBegins)
{
    const auto board = option_board();
    dpslave::dp::DemandData demand_data{board};
    demand_data.begin(1);
    demand_data.request({0xF037, 0, 0, 0}); // rejected at once
    ASSERT_EQ(demand_data.reply(), (dpslave::dp::DemandRegisters{0x7037, 0, 0, 0}));

    demand_data.begin(2);

    EXPECT_EQ(demand_data.reply(), dpslave::dp::DemandRegisters{});
}

} // namespace
} // namespace test
