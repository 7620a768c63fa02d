// SPDX-License-Identifier: Apache-2.0
/// 2408f/2404f handbook ch. 7: Demand Data with tags of 14 bits, and both worked examples with the numbers as
/// they are printed, decimal (C-060 to C-070, X-10, X-19 to ).
#include "demand_bench.hpp"

#include <map>
#include <set>

namespace test {
namespace {

using dpslave::AccessError;
using dpslave::DemandOrder;
using Kind = DemandOrder::Kind;

/// 2408f/2404f handbook ch. 7: commands 3 and 4 with the tag in register 2.
class ExtendedDemandData : public DemandBench {
protected:
    explicit ExtendedDemandData(dpslave::dp::Personality device = controller())
        : DemandBench(std::move(device))
    {
        start_up("88 14 01 0B 24 08 01", "73");
    }
};

TEST_F(ExtendedDemandData, ReadsTagsOf14Bits)
{
    exchange({0x3000, 8328, 0, 77});
    const DemandOrder read = order();
    EXPECT_EQ(read.kind, Kind::read);
    EXPECT_EQ(read.tag, 8328);
    answer(read, 5);

    EXPECT_EQ(exchange({0x3000, 8328, 0, 77}), "10 00 20 88 00 00 00 05");
}

TEST_F(ExtendedDemandData, WritesTagsOf14Bits)
{
    exchange({0x4000, 16'383, 0, 77});
    const DemandOrder write = order();
    EXPECT_EQ(write.kind, Kind::write);
    EXPECT_EQ(write.tag, 16'383);
    EXPECT_EQ(write.value, 77);
    refuse(write, AccessError::out_of_range);

    EXPECT_EQ(exchange({0x4000, 16'383, 0, 77}), "70 00 3F FF 00 00 00 02");
}

TEST_F(ExtendedDemandData, RejectsATagFieldThatIsNotZeroAndTagsAbove14Bits)
{
    EXPECT_EQ(exchange({0x3001, 8328, 0, 0}), "70 00 20 88 00 00 00 00");
    EXPECT_EQ(exchange({0x4000, 16'384, 0, 0}), "70 00 40 00 00 00 00 00");
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(ExtendedDemandData, AnswersEightOctetsInFrontOfTheParameters)
{
    master.set_prm("40 00 00 00 24 08 00");
    start_up("88 14 01 0B 24 08 01 00 01 00 18", "73 50 60"); // PV to the master, setpoint 1 from it
    inputs_are({0x0102});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("30 00 20 88 00 00 00 00 03 04"), "DL 00 00 00 00 00 00 00 00 01 02");
    EXPECT_EQ(order().tag, 8328);
    EXPECT_EQ(seen().outputs[1], 0x0304);
}

TEST_F(ExtendedDemandData, TheTagOfAStandardCommandIsItsTagFieldAlone)
{
    exchange({0x17FF, 8328, 0, 0}); // 2047, the highest of eleven bits: the 2048 of the text is a slip
    const DemandOrder read = order();
    EXPECT_EQ(read.tag, 2047);
    answer(read, 1);

    EXPECT_EQ(exchange({0x17FF, 8328, 0, 0}), "17 FF 00 00 00 00 00 01");
}

TEST_F(ExtendedDemandData, AnotherTagInRegister2IsANewOrder)
{
    exchange({0x3000, 8328, 0, 0});
    answer(order(), 5);
    EXPECT_EQ(exchange({0x3000, 8329, 0, 0}), "10 00 20 88 00 00 00 05"); // the echo says whose answer it is
    EXPECT_EQ(order().tag, 8329);
}

TEST_F(ExtendedDemandData, OtherCommandsAreRejectedWithCode0)
{
    for (unsigned command = 5; command < 16; ++command) {
        const auto word = static_cast<std::uint16_t>(command << 12 | 0x037);
        EXPECT_EQ(exchange({word, 8328, 0, 5}), "70 37 00 00 00 00 00 00") << command;
    }
    EXPECT_FALSE(slave.take_demand_order());
}

TEST_F(ExtendedDemandData, WhatTheControllerRefusesInHoldOrHasNotIsReportedByItsCode)
{
    exchange({0x4000, 8192, 0, 7}); // program 0 while it runs
    refuse(order(), AccessError::not_stopped);
    EXPECT_EQ(exchange({0x4000, 8192, 0, 7}), "70 00 20 00 00 00 00 01");
    exchange({0x3000, 8600, 0, 0}); // program 3 of an instrument that has one
    refuse(order(), AccessError::invalid_tag);
    EXPECT_EQ(exchange({0x3000, 8600, 0, 0}), "70 00 21 98 00 00 00 00");
}

using Registers = std::vector<std::uint16_t>;

/// A controller behind the slave and the PLC program of the handbook before it. "Anything" is a word that
/// must not matter.
class WorkedExamples : public ExtendedDemandData {
protected:
    using ExtendedDemandData::ExtendedDemandData;
    static constexpr std::uint16_t kAnything = 0x5A5A;

    /// What the master reads once the drive side has done what it was asked for.
    Registers response_to(const Registers& request)
    {
        exchange(request);
        serve();
        return words(exchange(request));
    }
    /// The drive side: does what it was asked for last, a standing read at every call.
    void serve()
    {
        while (const auto newest = slave.take_demand_order()) {
            standing_ = *newest;
            if (newest->kind == Kind::write) ++writes;
        }
        if (standing_.kind == Kind::cancel) return;
        dpslave::DemandAnswer said{.number = standing_.number};
        if (instrument.count(standing_.tag) == 0)
            said.error = AccessError::invalid_tag;
        else if (standing_.kind == Kind::write && read_only.count(standing_.tag) != 0)
            said.error = AccessError::read_only;
        else if (standing_.kind == Kind::write && standing_.value > 9999)
            said.error = AccessError::out_of_range;
        else if (standing_.kind == Kind::write)
            instrument[standing_.tag] = said.value = standing_.value;
        else
            said.value = instrument[standing_.tag];
        slave.set_demand_answer(said);
    }

    std::map<std::uint16_t, std::uint16_t> instrument;
    std::set<std::uint16_t> read_only;
    int writes = 0;

private:
    static Registers words(const std::string& shown)
    {
        const Octets all = octets(shown);
        Registers four;
        for (std::size_t i = 0; i + 2 <= all.size(); i += 2)
            four.push_back(static_cast<std::uint16_t>(all[i] * 256u + all[i + 1]));
        return four;
    }
    DemandOrder standing_{};
};

TEST_F(WorkedExamples, Example1StartsAnAutotuneAndPollsUntilItsBitClears)
{
    instrument = {{270, 0}, {76, 0}};
    EXPECT_EQ(response_to({0, kAnything, kAnything, kAnything})[0], 0); // request 1: clear

    EXPECT_EQ(response_to({8462, kAnything, kAnything, 1})[0], 4366); // request 2: autotune on
    EXPECT_EQ(instrument[270], 1);
    instrument[76] = 0x1000; // bit 12: autotune enabled

    const Registers poll{4172, kAnything, kAnything, kAnything}; // request 3, a read for all its label
    EXPECT_EQ(response_to(poll), (Registers{4172, 0, 0, 0x1000}));
    for (int cycle = 0; cycle < 20; ++cycle) {
        if (cycle == 15) instrument[76] = 0x0000; // done
        serve();
        EXPECT_EQ(response_to(poll), (Registers{4172, 0, 0, instrument[76]})) << cycle;
    }
    EXPECT_EQ(seen().counters.demand_orders, 2u); // the value is refreshed without another request
    EXPECT_EQ(writes, 1);
}

TEST_F(WorkedExamples, Example1SeesTheSelfTuneFailByBit3)
{
    instrument = {{270, 0}, {76, 0x1000}};
    response_to({0, 0, 0, 0});
    response_to({8462, 0, 0, 1});
    const Registers poll{4172, kAnything, kAnything, kAnything};
    response_to(poll);
    instrument[76] = 0x1008;
    serve();

    EXPECT_EQ(response_to(poll), (Registers{4172, 0, 0, 0x1008}));
}

TEST_F(WorkedExamples, Example1ReportsAnErrorAs28942AndItsCode)
{
    EXPECT_EQ(response_to({8462, kAnything, kAnything, 1}), (Registers{28942, 0, 0, 0})); // no such tag
    response_to({0, 0, 0, 0});
    instrument = {{270, 0}};
    read_only = {270};
    EXPECT_EQ(response_to({8462, kAnything, kAnything, 1}), (Registers{28942, 0, 0, 1}));
    response_to({0, 0, 0, 0});
    read_only = {};
    EXPECT_EQ(response_to({8462, kAnything, kAnything, 10'000}), (Registers{28942, 0, 0, 2}));
}

TEST_F(WorkedExamples, Example2UploadsProgram1From8328To8463)
{
    for (std::uint16_t tag = 8328; tag <= 8463; ++tag) instrument[tag] = static_cast<std::uint16_t>(tag * 7);
    EXPECT_EQ(response_to({0, kAnything, kAnything, kAnything})[0], 0);

    for (std::uint16_t tag = 8328; tag <= 8463; ++tag)
        EXPECT_EQ(response_to({12288, tag, kAnything, kAnything}),
                  (Registers{4096, tag, 0, static_cast<std::uint16_t>(tag * 7)}));

    EXPECT_EQ(seen().counters.demand_orders, 136u); // one value a request
    EXPECT_EQ(response_to({12288, 8464, kAnything, kAnything}), (Registers{28672, 8464, 0, 0}));
}

TEST_F(WorkedExamples, Example2DownloadsProgram1WithExtendedWrites)
{
    for (std::uint16_t tag = 8328; tag <= 8463; ++tag) instrument[tag] = 0;
    EXPECT_EQ(response_to({0, 0, 0, 0})[0], 0);

    for (std::uint16_t tag = 8328; tag <= 8463; ++tag)
        EXPECT_EQ(response_to({16384, tag, kAnything, static_cast<std::uint16_t>(tag - 8000)})[0], 4096);

    EXPECT_EQ(writes, 136);
    for (const auto& [tag, value] : instrument) EXPECT_EQ(value, tag - 8000) << tag;
    EXPECT_EQ(response_to({16384, 8463, kAnything, 10'000}), (Registers{28672, 8463, 0, 2})); // out of range
}

/// extended_reply = "example": answers for a PLC program written from worked example 2.
class AsInTheExample : public WorkedExamples {
protected:
    AsInTheExample() : WorkedExamples(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = controller();
        device.extended_reply = dpslave::dp::ExtendedReply::example;
        return device;
    }
};

TEST_F(AsInTheExample, AReadIsAnswered12288WithItsTagAndValue)
{
    for (std::uint16_t tag = 8328; tag <= 8463; ++tag) instrument[tag] = static_cast<std::uint16_t>(tag - 5);

    EXPECT_EQ(response_to({0, kAnything, kAnything, kAnything}), (Registers{0, 0, 0, 0}));
    for (std::uint16_t tag = 8328; tag <= 8463; ++tag)
        EXPECT_EQ(response_to({12288, tag, kAnything, kAnything}),
                  (Registers{12288, tag, 0, static_cast<std::uint16_t>(tag - 5)}));
}

TEST_F(AsInTheExample, ARefusedReadIsAnswered37000)
{
    EXPECT_EQ(response_to({12288, 8328, kAnything, kAnything}), (Registers{37000, 8328, 0, 0}));
}

TEST_F(AsInTheExample, AWriteIsAnsweredInTheSameWay)
{
    instrument = {{8328, 0}, {8329, 0}};
    read_only = {8329};

    EXPECT_EQ(response_to({16384, 8328, kAnything, 77}), (Registers{16384, 8328, 0, 77}));
    EXPECT_EQ(response_to({16384, 8329, kAnything, 77}), (Registers{37001, 8329, 0, 1}));
    EXPECT_EQ(seen().counters.demand_rejects, 1u);
}

TEST_F(AsInTheExample, TheSumStaysInTheWordUpToTheHighestTag)
{
    EXPECT_EQ(response_to({12288, 16'383, 0, 0}), (Registers{45'055, 16'383, 0, 0}));
    EXPECT_EQ(response_to({12288, 16'384, 0, 0}),
              (Registers{28'672, 16'384, 0, 0})); // no tag: nothing is added
    EXPECT_EQ(response_to({12288, 65'535, 0, 0}), (Registers{28'672, 65'535, 0, 0}));
}

TEST_F(AsInTheExample, TheStandardCommandsAreAsInExample1)
{
    instrument = {{270, 0}};

    EXPECT_EQ(response_to({8462, 0, 0, 1}), (Registers{4366, 0, 0, 1}));
    EXPECT_EQ(response_to({4172, 0, 0, 0}), (Registers{28748, 0, 0, 0})); // 7000h + 76
}

TEST_F(AsInTheExample, ADeviceWithoutExtendedCommandsRejectsThemAsTheTableSays)
{
    auto board = option_board();
    board.extended_reply = dpslave::dp::ExtendedReply::example;
    dpslave::dp::DemandData demand_data{board};
    demand_data.begin(1);
    demand_data.request({0x3037, 8328, 0, 0});

    EXPECT_EQ(demand_data.reply(), (dpslave::dp::DemandRegisters{0x7037, 0, 0, 0}));
}

} // namespace
} // namespace test
