// SPDX-License-Identifier: Apache-2.0
// Faults of a drive and of its cable.
#include "fault_row.hpp"

#include <gmock/gmock.h>

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
            EXPECT_THAT(gateway->dpctl({"io"}).out, HasSubstr("stale"));
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
    goes_through("late 900", "late 1300", "drive.late");
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
