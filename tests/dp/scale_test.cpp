// SPDX-License-Identifier: Apache-2.0
/// a parameter that answers with a number of unknown scale holds the master at Stat_Diag.
#include "bench.hpp"

namespace test {
namespace {

using namespace std::chrono_literals;
using dpslave::InputImage;
using dpslave::StartHold;

class UnknownScale : public DpBench {
protected:
    UnknownScale() : DpBench(device()) {}
    static dpslave::dp::Personality device()
    {
        auto board = option_board();
        board.tries_outputs = true;
        return board;
    }
    /// What the drive side has found out about the parameters of the present layout.
    void drive_says(bool every_input_tried, bool scale_missing, std::uint16_t word = 0)
    {
        InputImage image{.generation = generation(),
                         .every_input_tried = every_input_tried,
                         .hold = scale_missing ? StartHold::unscaled : StartHold::none};
        image.words[0] = word;
        slave.set_inputs(image);
    }
    /// Not every parameter was tried, and the drive answers, or was not found silent.
    void drive_is_asked(bool answers)
    {
        slave.set_inputs({.generation = generation(), .drive_answers = answers});
    }
    bool may_write()
    {
        bool may = false;
        while (const auto outputs = slave.take_outputs()) may = outputs->may_write;
        return may;
    }
    /// Without a watchdog: time passes here.
    static std::string prm(const std::vector<std::uint16_t>& tags)
    {
        return board_prm(tags, "80 00 00 0B 05 33 01");
    }
    /// Octets 1 and 2 of Slave_Diag.
    std::string diag() { return master.slave_diag().substr(3, 5); }
};

TEST_F(UnknownScale, HoldsStatDiagWithTheStationReadyBehindTheSecondOfEveryStart)
{
    start_up(prm({55, 56}), "50 60");
    drive_says(true, true);
    EXPECT_EQ(diag(), "00 06") << "Stat_Diag 1, Station_Not_Ready 0";
    bus.advance(5min);
    EXPECT_EQ(diag(), "00 06");
    EXPECT_EQ(seen().hold, StartHold::unscaled);
}

TEST_F(UnknownScale, HoldsAlsoWhenItIsFoundBeforeEveryInputWasTried)
{
    start_up(prm({55, 56}), "50 50");
    drive_says(false, true);
    bus.advance(2s);
    EXPECT_EQ(diag(), "00 06");
}

/// At 300 bit/s one transaction may last longer than the second of C2.
TEST_F(UnknownScale, ADriveThatAnswersIsWaitedForAlsoBeforeItsFirstWordOfTheLayout)
{
    slave.set_inputs({.generation = 0, .drive_answers = true});
    start_up(prm({55, 56}), "50 60");
    bus.advance(5s);
    EXPECT_EQ(diag(), "00 06");
    drive_says(true, false);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, SilenceNeverHoldsBehindTheFirstSecond)
{
    start_up(prm({55, 56}), "50 60");
    bus.advance(999ms);
    EXPECT_EQ(diag(), "00 06");
    bus.advance(2ms);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, AnswersToAMasterThatExchangesAnywayAskForDiagnosisAndNothingIsWritten)
{
    start_up(prm({55, 56}), "50 60");
    drive_says(true, true);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(master.data_exchange("12 34"), "DH 00 00");
        diagnosis_is_read();
    }
    while (const auto outputs = slave.take_outputs()) EXPECT_FALSE(outputs->may_write);
    master.control("02 00"); // Clear
    while (const auto outputs = slave.take_outputs()) EXPECT_FALSE(outputs->may_write);
}

TEST_F(UnknownScale, GivesNoDemandDataToTheDriveWhileItHolds)
{
    start_up(prm({55}), "73 50");
    drive_says(true, true);
    master.data_exchange("20 37 00 00 00 00 00 05"); // write 5 to tag 55
    EXPECT_FALSE(slave.take_demand_order());

    drive_says(true, false, 7);
    master.data_exchange("20 37 00 00 00 00 00 05");
    const auto order = slave.take_demand_order();
    ASSERT_TRUE(order);
    EXPECT_EQ(order->tag, 55);
}

TEST_F(UnknownScale, AnAnswerInHexadecimalLetsTheExchangeBegin)
{
    start_up(prm({55, 56}), "50 60");
    drive_says(true, true);
    master.data_exchange("12 34");
    drive_says(true, false, 0xBEEF);

    EXPECT_FALSE(seen().stat_diag);
    EXPECT_EQ(diag(), "00 04");
    EXPECT_EQ(master.data_exchange("12 35"), "DL BE EF");
    const auto outputs = slave.take_outputs();
    ASSERT_TRUE(outputs);
    EXPECT_TRUE(outputs->may_write);
    EXPECT_EQ(outputs->words[1], 0x1235);
}

TEST_F(UnknownScale, EndsAlsoWhenTheOthersWereNeverTriedAndTheirTimeIsOver)
{
    start_up(prm({55, 56}), "50 50");
    drive_says(false, true);
    bus.advance(2s);
    drive_says(false, false);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, AnotherSetPrmEndsIt)
{
    start_up(prm({55}), "50");
    drive_says(true, true);
    start_up(prm({56}), "50");
    EXPECT_EQ(seen().hold, StartHold::none);
    drive_says(true, false);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, NeverStopsARunningExchange)
{
    start_up(prm({55, 56}), "50 60");
    drive_says(true, false, 5);
    diagnosis_is_read();
    ASSERT_EQ(master.data_exchange("12 34"), "DL 00 05");
    drive_says(true, true);

    EXPECT_EQ(master.data_exchange("12 34"), "DL 00 00");
    EXPECT_EQ(seen().hold, StartHold::none);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, WaitsForOutputsAsForInputsWhereTheyHaveToBeTried)
{
    start_up(prm({55}), "60");
    EXPECT_EQ(diag(), "00 06");
    drive_says(true, true);
    bus.advance(2s);
    EXPECT_EQ(diag(), "00 06");
    drive_says(true, false);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, ADriveThatAnswersIsWaitedForBehindTheFirstSecond)
{
    start_up(prm({55, 56}), "50 60");
    drive_is_asked(true);
    bus.advance(20s);
    EXPECT_EQ(diag(), "00 06") << "the line is slow";
    drive_says(true, false);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, ADriveThatIsFoundSilentBehindTheFirstSecondIsWaitedForNoLonger)
{
    start_up(prm({55, 56}), "50 60");
    drive_is_asked(true);
    bus.advance(3s);
    drive_is_asked(false);
    EXPECT_EQ(diag(), "00 04");
}

TEST_F(UnknownScale, OutputsThatCameMeanwhileAreWrittenAtItsEndIfTheyAreNotOlderThanTwoSeconds)
{
    start_up(prm({55, 56}), "50 60");
    drive_is_asked(true);
    master.data_exchange("12 34");
    EXPECT_FALSE(may_write());
    bus.advance(1990ms);
    drive_says(true, false);

    const auto outputs = slave.take_outputs();
    ASSERT_TRUE(outputs && outputs->may_write);
    EXPECT_EQ(outputs->words[1], 0x1234);
}

TEST_F(UnknownScale, OutputsThatAreTooOldAtItsEndAreWrittenWithTheNextDataExchange)
{
    start_up(prm({55, 56}), "50 60");
    drive_is_asked(true);
    master.data_exchange("12 34");
    bus.advance(2010ms);
    drive_says(true, false);
    EXPECT_FALSE(may_write());
    diagnosis_is_read();
    master.data_exchange("12 34");
    EXPECT_TRUE(may_write());
}

TEST_F(UnknownScale, WithoutADataExchangeMeanwhileNothingIsWrittenAtItsEnd)
{
    start_up(prm({55, 56}), "50 60");
    drive_is_asked(true);
    master.control("02 00"); // Clear
    drive_says(true, false);
    EXPECT_FALSE(may_write());
}

TEST_F(UnknownScale, AnOrderOfDemandDataThatCameMeanwhileIsGivenAtItsEnd)
{
    start_up(prm({55}), "73 50");
    drive_is_asked(true);
    master.data_exchange("20 37 00 00 00 00 00 05"); // write 5 to tag 55
    ASSERT_FALSE(slave.take_demand_order());
    drive_says(true, false);
    const auto order = slave.take_demand_order();
    ASSERT_TRUE(order);
    EXPECT_EQ(order->value, 5);
}

TEST_F(UnknownScale, DemandDataAloneIsNeverHeld)
{
    start_up(prm({}), "73");
    EXPECT_EQ(diag(), "00 04");
}

} // namespace
} // namespace test
