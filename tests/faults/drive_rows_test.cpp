// SPDX-License-Identifier: Apache-2.0
// Faults of a drive and of its cable.
// Only here: the threads of the daemon during the fault.
#include "fault_row.hpp"
#include "stopped_thread.hpp"

#include <gmock/gmock.h>

#include <tuple>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

TEST_P(RowOfADrive, F01_WhoseCableIsPulledForAMomentHoldsTheLastValueAndNoOlderOneComesAfterIt)
{
    begins(GetParam());
    int value = 1;
    for (const char* const pulled : {"10ms", "100ms", "1s", "5s"}) {
        SCOPED_TRACE(pulled);
        const std::size_t before = taken().size();
        gateway->drive_line().send_line("cut");
        drive_shows(value + 1);
        EXPECT_TRUE(master_wants(value + 1));
        EXPECT_TRUE(master->does(std::string{"wait "} + pulled));
        EXPECT_TRUE(master_wants(value + 2));
        EXPECT_TRUE(master_stays_in_data_exchange());
        if (pulled == std::string{"5s"}) { // longer than any reading with its repeats
            EXPECT_TRUE(gateway->word_becomes(55, "state", "stale"));
            EXPECT_EQ(gateway->word(55).at("raw"), value);
            EXPECT_THAT(gateway->dpctl({"io"}).out, HasSubstr("stale"));
            EXPECT_THAT(gateway->dpctl({"diag"}).out, HasSubstr("the drive does not answer"));
            EXPECT_EQ(gateway->station().at("drive").at("link"), "silent");
        }
        gateway->drive_line().send_line("restore");
        fault_ends();
        value += 2;
        ASSERT_TRUE(drive_takes(value));
        drive_shows(value);
        ASSERT_TRUE(master_sees(value));
        recovered();
        EXPECT_TRUE(never_an_older_one(taken(before)));
    }
    EXPECT_TRUE(gateway->daemon().ever_said("unwinder: the drive does not answer"))
        << "the longest was noticed";
    EXPECT_TRUE(gateway->daemon().says("unwinder: the drive answers"));
    EXPECT_TRUE(gateway->word_becomes(55, "state", "good"));
    EXPECT_TRUE(eventually([&] { return gateway->dpctl({"io"}).out.find("stale") == std::string::npos; }));
    EXPECT_TRUE(never_an_older_one(taken()));
    EXPECT_TRUE(never_an_older_one(seen()));
}

/// Two drives on one line, and a master for the second one.
TEST_F(FaultRow, F01_OfOneDriveLeavesTheOtherOnItsLineAtWork)
{
    installs({.units = {"00", "01"}});
    Process& drive = gateway->drive();
    {
        Master first{*gateway, {"--tags", "55,56w", "--no-watchdog"}, 5}; // the slave keeps its last words
        ASSERT_TRUE(first.does("start 30s"));
        EXPECT_TRUE(first.does("out 1 = 500"));
        EXPECT_TRUE(drive.says("unit 00: tag 56 written 5.00"));
        EXPECT_TRUE(first.does("stop"));
        EXPECT_TRUE(first.leaves());
    }
    master.emplace(*gateway, Arguments{"--tags", "55,56w"}, 6);
    ASSERT_TRUE(master->does("start 30s"));
    EXPECT_TRUE(gateway->exchange_ends_with(0)) << "both are";

    drive.send_line("unit 00");
    drive.send_line("silence");
    EXPECT_TRUE(gateway->daemon().says("unwinder: the drive does not answer"));
    drive.send_line("unit 01");
    for (const char* const value : {"11", "12", "13", "14", "15"}) {
        drive.send_line(std::string{"set 55 "} + value);
        EXPECT_TRUE(master->does(std::string{"wait 30s for in 1 = "} + value + "00"));
        EXPECT_TRUE(master->does(std::string{"out 1 = "} + value + "00"));
        EXPECT_TRUE(drive.says(std::string{"unit 01: tag 56 written "} + value + ".00"));
    }
    EXPECT_EQ(gateway->station(0).at("drive").at("link"), "silent");
    EXPECT_EQ(gateway->station(0).at("state"), "Data_Exch");
    EXPECT_EQ(gateway->station(1).at("drive").at("link"), "answers");
    EXPECT_EQ(gateway->station(1).at("drive").at("losses"), 0);

    drive.skip();
    drive.send_line("unit 00");
    drive.send_line("ok");
    fault_ends();
    EXPECT_TRUE(drive.says("unit 00: tag 56 written 5.00"));
    recovered();
}

/// The same with the values of when_drive_lost by which something follows from it.
class RowOfALostDrive : public FaultRow,
                        public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {
protected:
    bool is_silent() const { return std::string{std::get<1>(GetParam())} == "silent"; }
    std::string state() const { return gateway->station().at("state"); }
};

TEST_P(RowOfALostDrive, F01_WhoseCableIsPulledForLongIsNoValuesForTheMasterUntilTheyAreReadAgain)
{
    const auto& [protocol, when_lost] = GetParam();
    Wiring wiring = wiring_of(protocol);
    wiring.when_drive_lost = when_lost;
    begins(std::move(wiring), master_of(protocol));
    for (const char* const pulled : {"10ms", "100ms", "1s"}) {
        SCOPED_TRACE(pulled);
        gateway->drive_line().send_line("cut");
        EXPECT_TRUE(master->does(std::string{"wait "} + pulled));
        gateway->drive_line().send_line("restore");
        EXPECT_TRUE(master->does("wait 500ms"));
        EXPECT_TRUE(master_stays_in_data_exchange());
    }
    gateway->drive_line().send_line("cut");
    drive_shows(2);
    EXPECT_TRUE(gateway->daemon().says("The drive is gone"));
    if (is_silent()) {
        EXPECT_TRUE(eventually([&] { return state() == "Power_On"; }));
        EXPECT_TRUE(master->does("try wait 1s for in 1 = 2"));
    } else {
        EXPECT_TRUE(master->does("wait 30s for diag stat-diag"));
        EXPECT_EQ(state(), "Data_Exch");
    }
    EXPECT_EQ(gateway->station().at("drive").at("link"), "gone");
    EXPECT_TRUE(doctor_names("drive.silent"));

    gateway->drive_line().send_line("restore");
    fault_ends();
    EXPECT_TRUE(exchange_is_back(is_silent()));
    EXPECT_TRUE(master_sees(2));
    EXPECT_TRUE(master_wants(3));
    EXPECT_TRUE(drive_takes(3));
    recovered();
    EXPECT_EQ(gateway->station().at("drive").at("link"), "answers");
    EXPECT_TRUE(never_an_older_one(seen()));
}

TEST_P(RowOfALostDrive, F37_WhoseLineStandsStillIsNoValuesForTheMasterUntilTheyAreReadAgain)
{
    const auto& [protocol, when_lost] = GetParam();
    Wiring wiring = wiring_of(protocol);
    wiring.when_drive_lost = when_lost;
    begins(std::move(wiring), master_of(protocol));
    {
        const StoppedThread line{thread_of(gateway->daemon().pid(), "drive")};
        if (is_silent()) {
            EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
            EXPECT_TRUE(eventually([&] { return state() == "Power_On"; }));
        } else {
            EXPECT_TRUE(master->does("wait 30s for diag stat-diag"));
            EXPECT_EQ(state(), "Data_Exch");
        }
        drive_shows(2);
        EXPECT_TRUE(master->does("try wait 1s for in 1 = 2"));
    }
    fault_ends();
    EXPECT_TRUE(exchange_is_back(is_silent()));
    EXPECT_TRUE(master_sees(2));
    EXPECT_TRUE(master_wants(3));
    EXPECT_TRUE(drive_takes(3));
    recovered();
    EXPECT_TRUE(never_an_older_one(seen()));
}

INSTANTIATE_TEST_SUITE_P(Over, RowOfALostDrive,
                         ::testing::Combine(::testing::Values("ei-ascii", "modbus-rtu"),
                                            ::testing::Values("silent", "diagnosis")),
                         [](const auto& one) {
                             const std::string protocol{std::get<0>(one.param)};
                             return protocol.substr(0, protocol.find('-')) + "_" + std::get<1>(one.param);
                         });

/// A fault of the answers while both sides change: what came through was true, and afterwards everything is.
class RowOfAnswers : public RowOfADrive {
protected:
    /// `fault`: what the drive is told, for each protocol; `told`: the rule by which the doctor names it.
    void goes_through(const char* of_ei_ascii, const char* of_modbus, const std::string& told)
    {
        begins(GetParam());
        gateway->drive().send_line(is_modbus() ? of_modbus : of_ei_ascii);
        for (int value = 2; value <= 5; ++value) {
            drive_shows(value);
            EXPECT_TRUE(master_wants(value));
            EXPECT_TRUE(master->does("wait 500ms"));
        }
        EXPECT_TRUE(doctor_names(told));
        EXPECT_TRUE(master_stays_in_data_exchange());

        gateway->drive().send_line("ok");
        fault_ends();
        drive_shows(6);
        EXPECT_TRUE(master_wants(6));
        EXPECT_TRUE(drive_takes(6));
        EXPECT_TRUE(master_sees(6));
        recovered();
        EXPECT_TRUE(never_an_older_one(taken()));
        EXPECT_TRUE(never_an_older_one(seen()));
        EXPECT_TRUE(eventually([&] { return gateway->word(55).at("state") == "good"; }));
    }
};

TEST_P(RowOfAnswers, F03_ThatAreLateAreNeverTakenForThoseToTheNextQuestion)
{
    goes_through("late 900ms", "late 1300ms", "drive.late");
}

TEST_P(RowOfAnswers, F04_ThatAreTruncatedAreNotRead)
{
    goes_through("instead 0237373132", "short", "drive.unreadable");
}

TEST_P(RowOfAnswers, F05_WithAWrongCheckAreNotRead)
{
    goes_through("bad-bcc", "bad-crc", "drive.unreadable");
}

INSTANTIATE_TEST_SUITE_P(Over, RowOfADrive, ::testing::Values("ei-ascii", "modbus-rtu"));
INSTANTIATE_TEST_SUITE_P(Over, RowOfAnswers, ::testing::Values("ei-ascii", "modbus-rtu"));

class RowOfRefusals : public RowOfADrive {};

TEST_P(RowOfRefusals, F06_OfADriveAreShownAndTheValueIsOfferedUntilItIsTaken)
{
    begins(GetParam());
    gateway->drive().send_line(is_modbus() ? "refuse 3" : "nak 08C8");
    EXPECT_TRUE(master_wants(2));
    EXPECT_TRUE(eventually([&] { return gateway->word(56).at("state") == "out_of_range"; }));
    EXPECT_TRUE(doctor_names("station.range"));
    EXPECT_THAT(gateway->dpctl({"diag"}).out, HasSubstr("tag 56: "));
    drive_shows(2);
    EXPECT_TRUE(master_sees(2)) << "what can be read is read";
    EXPECT_TRUE(master_stays_in_data_exchange());
    EXPECT_EQ(taken().back(), 1) << "the drive holds what it took last";

    EXPECT_TRUE(master_wants(3));
    gateway->drive().send_line("ok");
    fault_ends();
    EXPECT_TRUE(drive_takes(3));
    recovered();
    EXPECT_TRUE(never_an_older_one(taken()));
    EXPECT_TRUE(eventually([&] { return gateway->word(56).at("state") == "good"; }));
    EXPECT_TRUE(is_modbus() || eventually([&] { return gateway->diagnosis().at("trouble").empty(); }));
    EXPECT_TRUE(doctor_names("station.range", false));
}

INSTANTIATE_TEST_SUITE_P(Over, RowOfRefusals, ::testing::Values("ei-ascii", "modbus-rtu"));

class RowOfLostSettings : public RowOfADrive {};

TEST_P(RowOfLostSettings, F07_OfADriveThatWasResetAreWrittenAgainWithoutTheMaster)
{
    begins(GetParam());
    EXPECT_TRUE(master_wants(7));
    EXPECT_TRUE(drive_takes(7));
    const std::size_t before = taken().size();
    gateway->drive().send_line("set 56 0"); // its default, as after a reset
    fault_ends();
    EXPECT_TRUE(eventually([&] { return taken().size() > before; }));
    recovered();

    gateway->drive().send_line("silence"); // a reset with the power gone
    EXPECT_TRUE(gateway->daemon().says("unwinder: the drive does not answer"));
    EXPECT_TRUE(doctor_names("drive.silent"));
    gateway->drive().send_line("set 56 0");
    const std::size_t powered = taken().size();
    gateway->drive().send_line("ok");
    fault_ends();
    EXPECT_TRUE(eventually([&] { return taken().size() > powered; }));
    recovered();
    for (const int value : taken(before)) EXPECT_EQ(value, 7) << "a repeat carries the same value";
    EXPECT_TRUE(master_stays_in_data_exchange());
}

INSTANTIATE_TEST_SUITE_P(Over, RowOfLostSettings, ::testing::Values("ei-ascii", "modbus-rtu"));

} // namespace
} // namespace dpslave::test
