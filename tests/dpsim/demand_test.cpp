// SPDX-License-Identifier: Apache-2.0
// Demand Data registers: HA389815 chapter 7; extended commands and worked examples: 2408f/2404f handbook
// chapter 7.
#include "dpsim/master/demand.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {

bool operator==(const DemandWords& a, const DemandWords& b)
{
    return a.command == b.command && a.tag == b.tag && a.value == b.value;
}

namespace {

using testing::ElementsAre;

TEST(DemandData, LiesInTheFirstEightOctets)
{
    MasterSettings s;
    s.cfg = wire("73 50 60");
    Master master{s};
    EXPECT_TRUE(has_demand(s));
    EXPECT_FALSE(demand_inputs(master)) << "nothing was heard yet";
    set_demand_outputs(master, {0x4000, 8328, 0, 0xFFFE});
    EXPECT_EQ(hex(master.outputs()), "40 00 20 88 00 00 FF FE 00 00");
    EXPECT_THAT(demand_outputs(master), ElementsAre(0x4000, 8328, 0, 0xFFFE));
}

TEST(DemandData, MakesTheRegistersOfTheWorkedExamples)
{
    EXPECT_THAT(registers_of({DemandCommand::write, 270, 1}), ElementsAre(8462, 0, 0, 1));
    EXPECT_THAT(registers_of({DemandCommand::read, 76, 0}), ElementsAre(4172, 0, 0, 0));
    EXPECT_THAT(registers_of({DemandCommand::extended_read, 8328, 0}), ElementsAre(12288, 8328, 0, 0));
    EXPECT_THAT(registers_of({DemandCommand::extended_write, 8463, 5}), ElementsAre(16384, 8463, 0, 5));
    EXPECT_THAT(registers_of({}), ElementsAre(0, 0, 0, 0));
}

TEST(DemandData, ReadsTheAnswersToStandardCommands)
{
    const DemandRegisters write{8462, 0, 0, 1};
    EXPECT_EQ(read_demand(write, {4366, 0, 0, 1}), (DemandWords{DemandCommand::read, 270, 1}));
    EXPECT_EQ(read_demand(write, {28942, 0, 0, 2}), (DemandWords{DemandCommand::reject, 270, 2}));
    EXPECT_EQ(read_demand(write, {0, 0, 0, 0}), (DemandWords{}));
}

TEST(DemandData, ReadsTheAnswersToExtendedCommandsInBothForms)
{
    const DemandRegisters read{0x3000, 8328, 0, 0};
    const DemandWords done{DemandCommand::read, 8328, 42}, rejected{DemandCommand::reject, 8328, 1};
    EXPECT_EQ(read_demand(read, {0x1000, 8328, 0, 42}), done) << "by the table";
    EXPECT_EQ(read_demand(read, {12288, 8328, 0, 42}), done) << "by worked example 2";
    EXPECT_EQ(read_demand(read, {0x7000, 8328, 0, 1}), rejected) << "by the table";
    EXPECT_EQ(read_demand(read, {37000, 0, 0, 1}), rejected) << "by worked example 2";
    EXPECT_EQ(read_demand(read, {0x1000, 8327, 0, 42}).tag, 8327) << "the answer to the one before";
    EXPECT_EQ(read_demand(read, {4172, 8328, 0, 42}), (DemandWords{DemandCommand::read, 76, 42}))
        << "the answer to a standard read";
}

TEST(DemandData, IsShownInWords)
{
    EXPECT_EQ(show_demand({DemandCommand::read, 270, 30000}), "tag 270 = 30000 (0x7530)");
    EXPECT_EQ(show_demand({DemandCommand::reject, 55, 1}), "tag 55 rejected, 1: read-only parameter");
    EXPECT_EQ(show_demand({}), "no command");
    EXPECT_EQ(show_registers({0x110E, 0, 0x0001, 0xFFFF}), "110E 0000 0001 FFFF");
}

} // namespace
} // namespace dpslave::sim
