// SPDX-License-Identifier: Apache-2.0
// Each row of the troubleshooting tables: HA389815 ch. 9, HA463561U002 "Troubleshooting", 2408f/2404f
// handbook ch. 6.
#include "doctor_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(Doctor, FindsNothingWhereAllIsWell)
{
    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), IsEmpty());
}

// ---------------------------------------------------------------- HA389815 chapter 9

TEST_F(Doctor, NamesTheExternalFaultOfAnOptionBoardOnASilentBus)
{
    station()["state"] = "Wait_Prm";
    bus()["last_telegram_age_ms"] = nullptr;
    replies.counters["groups"][0]["counters"].clear();

    EXPECT_THAT(found(), ElementsAre("board.external"));
    EXPECT_EQ(evidence("board.external"), "not one octet has been received from the bus");
    EXPECT_THAT(steps("board.external"),
                AllOf(HasSubstr("terminal connections"), HasSubstr("1.5 Mbaud or less"),
                      HasSubstr("OPTION ADDRESS"),
                      HasSubstr("no other PROFIBUS-DP slave or master has the same address")));
}

TEST_F(Doctor, TellsNoiseFromSilence)
{
    station()["state"] = "Wait_Prm";
    bus()["baud_state"] = "Baud_Search";
    bus()["last_telegram_age_ms"] = nullptr;
    EXPECT_EQ(evidence("board.external"), "9000000 octets have been received, but not one valid telegram");

    bus()["last_telegram_age_ms"] = 300'000.0;
    EXPECT_EQ(evidence("board.external"), "the last valid telegram on the bus was heard 5 min ago");
}

TEST_F(Doctor, NamesTheExternalFaultWhereTheMasterLeavesTheStationAlone)
{
    station()["state"] = "Wait_Prm";
    EXPECT_THAT(found(), ElementsAre("board.external"));
    EXPECT_EQ(evidence("board.external"), "telegrams are heard, but no master parameterises address 5");

    station()["state"] = "Wait_Cfg";
    EXPECT_EQ(evidence("board.external"), "the master has parameterised address 5 and sends no Chk_Cfg");
}

TEST_F(Doctor, NamesTheConfigurationFaultWhereATelegramWasRefused)
{
    station()["state"] = "Wait_Prm";
    refuse("Set_Prm", "the Ident_Number is that of another device");

    EXPECT_THAT(found(), ElementsAre("board.configuration"));
    EXPECT_EQ(evidence("board.configuration"),
              "Set_Prm was refused, octet 5: the Ident_Number is that of another device; use the GSD");
    EXPECT_THAT(steps("board.configuration"),
                AllOf(HasSubstr("Usr_Prm_Data"), HasSubstr("Cfg_Data"), HasSubstr("station status octets")));
}

TEST_F(Doctor, NamesTheInternalFaultWhereTheDriveIsSilent)
{
    station()["drive"]["link"] = "silent";

    EXPECT_THAT(found(), ElementsAre("board.internal"));
    EXPECT_EQ(evidence("board.internal"),
              "unit 00 on p3 (/dev/ttyS2, ei-ascii) does not answer: 3 requests unanswered");
    EXPECT_THAT(steps("board.internal"),
                AllOf(HasSubstr("PROTOCOL"), HasSubstr("OPTION"), HasSubstr("0 to 125 (620: 1 to 125)"),
                      HasSubstr("620: check the connections")));
}

TEST_F(Doctor, NamesTheMajorFaultWhereTheStationIsNotServed)
{
    station()["state"] = "Power_On";

    EXPECT_THAT(found(), ElementsAre("board.dark"));
}

TEST_F(Doctor, FindsAnAddressThatIsUsedTwice)
{
    count("own_address", 2);

    EXPECT_THAT(found(), ElementsAre("bus.double_address"));
    EXPECT_EQ(evidence("bus.double_address"),
              "2 telegrams of somebody else with one of our addresses as the sender");
}

// ---------------------------------------------------------------- HA463561U002, Troubleshooting

struct MatrixRow {
    const char* name;
    int fault;
    const char* fault_shown;
    int network;
    const char* rule;
    const char* lamps;
    const char* remedy;
};
class DoctorMatrix : public Doctor, public testing::WithParamInterface<MatrixRow> {};

TEST_P(DoctorMatrix, NamesTheCauseOfThesePatternsOfNetworkAndModule)
{
    const MatrixRow& row = GetParam();
    station()["state"] = row.network == 0 || row.network == 1 ? "Data_Exch" : "Wait_Prm";
    is_technology_box(row.fault, row.fault_shown, row.network);

    const bool works = std::string{row.rule} == "box.works";
    EXPECT_THAT(found(works), ElementsAre(row.rule));
    EXPECT_EQ(found(!works).size(), 0u);
    EXPECT_THAT(steps(row.rule), HasSubstr(row.remedy));
    for (const Rule& rule : rules())
        if (rule.name == row.rule) {
            EXPECT_EQ(rule.condition.substr(0, std::string_view{row.lamps}.size()), row.lamps);
        }
}

INSTANTIATE_TEST_SUITE_P(
    B090, DoctorMatrix,
    testing::Values(MatrixRow{"Hardware", 4, "HARDWARE", 5, "box.no_power", "NETWORK off, MODULE off",
                              "apply power to the drive"},
                    MatrixRow{"Missing", 5, "MISSING", 5, "box.no_power", "NETWORK off, MODULE off",
                              "the ribbon cable"},
                    MatrixRow{"SelfTest", 3, "SELF TEST", 5, "box.self_test",
                              "NETWORK off, MODULE short flash", "replace the box"},
                    MatrixRow{"Type", 2, "TYPE MISMATCH", 5, "box.type", "NETWORK off, MODULE flash",
                              "dpctl tec set TYPE"},
                    MatrixRow{"Parameter", 1, "PARAMETER", 5, "box.parameter",
                              "NETWORK off, MODULE long flash", "Select a legal value"},
                    MatrixRow{"BaudSearch", 0, "NONE", 4, "box.no_communications", "NETWORK off, MODULE on",
                              "maximum line length for the baud rate"},
                    MatrixRow{"Disabled", 0, "NONE", 5, "box.no_communications", "NETWORK off, MODULE on",
                              "terminated correctly"},
                    MatrixRow{"WaitParam", 0, "NONE", 3, "box.wait_param", "NETWORK short flash, MODULE on",
                              "Check that it is unique"},
                    MatrixRow{"WaitConfig", 0, "NONE", 2, "box.wait_config", "NETWORK flash, MODULE on",
                              "internal diagnostics"},
                    MatrixRow{"DataExError", 0, "NONE", 1, "box.read_write", "NETWORK long flash, MODULE on",
                              "INT DIAG SELECT 300"},
                    MatrixRow{"DataExchange", 0, "NONE", 0, "box.works", "NETWORK on, MODULE on",
                              "check your tag numbers"}),
    [](const auto& row) { return row.param.name; });

TEST_F(Doctor, LooksForTheLineWhereABoxWaitsOnASilentBus)
{
    station()["state"] = "Wait_Prm";
    bus()["last_telegram_age_ms"] = 60'000.0;
    is_technology_box(0, "NONE", 3);

    EXPECT_THAT(found(), ElementsAre("box.no_communications"));
}

TEST_F(Doctor, TellsWhichTelegramABoxRefused)
{
    station()["state"] = "Wait_Prm";
    refuse("Chk_Cfg", "Cfg_Data is empty");
    is_technology_box(0, "NONE", 3);

    EXPECT_EQ(evidence("box.wait_param"),
              "NETWORK STATE is WAIT PARAM; Chk_Cfg was refused, octet 5: Cfg_Data is empty; use the GSD");
}

TEST_F(Doctor, TellsTheTripOfTheDrive)
{
    is_technology_box(0, "NONE", 0);
    Json& tec = replies.tec["stations"][0];
    tec["trip"] = "0: NO TRIP";
    tec["tripped"] = false;
    EXPECT_THAT(found(), IsEmpty());
    tec["trip"] = "unknown: tag 4 was never read";
    tec["tripped"] = nullptr;
    EXPECT_THAT(found(), IsEmpty());

    tec["trip"] = "1: LINK OVERVOLTS";
    tec["tripped"] = true;
    EXPECT_THAT(found(), ElementsAre("box.trip"));
    EXPECT_EQ(evidence("box.trip"), "trip 1: LINK OVERVOLTS");
}

TEST_F(Doctor, RepeatsWhatTheFunctionBlockWarnsOf)
{
    is_technology_box(0, "NONE", 0);
    replies.tec["stations"][0]["notes"] =
        Json::parse(R"(["RIDE THROUGH other than 0 could compromise safety."])");

    EXPECT_THAT(found(true), ElementsAre("box.works", "station.tec_notes"));
    EXPECT_EQ(evidence("station.tec_notes"), "RIDE THROUGH other than 0 could compromise safety.");
}

// ---------------------------------------------------------------- 2408f/2404f handbook chapter 6

TEST_F(Doctor, GoesThroughTheListOfNoCommunicationsOfAController)
{
    is_controller();
    station()["state"] = "Wait_Prm";

    EXPECT_THAT(found(), ElementsAre("controller.no_communications"));
    EXPECT_THAT(steps("controller.no_communications"),
                AllOf(HasSubstr("continuity of A (HE) and B (HD)"), HasSubstr("slot H"),
                      HasSubstr("node address"), HasSubstr("transmitted to the master"),
                      HasSubstr("GSD file is correct"), HasSubstr("never more than 1.5 Mbaud"),
                      HasSubstr("no device but those at the ends"), HasSubstr("duplicate")));
}

TEST_F(Doctor, FindsAnIntermittentFailureOfAController)
{
    is_controller();
    station()["left_count"] = 5;
    station()["left_because"] = "the watchdog expired: the master is silent";

    EXPECT_THAT(found(), ElementsAre("controller.intermittent"));
    EXPECT_EQ(
        evidence("controller.intermittent"),
        "Data_Exch was left 5 times in 1 h 2 min, the last time: the watchdog expired: the master is silent");
    EXPECT_THAT(
        steps("controller.intermittent"),
        AllOf(HasSubstr("screening"), HasSubstr("32 input and 32 output words"), HasSubstr("terminated")));
}

TEST_F(Doctor, ExplainsValuesThatSeemJammedOrInAWrongFormat)
{
    is_controller();

    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), ElementsAre("controller.jammed", "controller.format"));
    EXPECT_EQ(evidence("controller.jammed"), "outputs of the master: 56");
    EXPECT_EQ(evidence("controller.format"), "resolution is full");
    EXPECT_THAT(steps("controller.jammed"),
                AllOf(HasSubstr("Demand Data"), HasSubstr("SP2"), HasSubstr("front panel regains control")));
    EXPECT_THAT(steps("controller.format"), HasSubstr("GSD file"));
}

TEST_F(Doctor, ASilentInstrumentIsTheLinkAndNotTheBus)
{
    is_controller();
    station()["drive"]["link"] = "silent";

    EXPECT_THAT(found(), ElementsAre("station.drive"));
}

// ---------------------------------------------------------------- what the counters tell

struct Counted {
    const char* name;
    const char* counter;
    std::int64_t enough, too_few;
    const char* rule;
    const char* evidence;
};
class DoctorCounter : public Doctor, public testing::WithParamInterface<Counted> {};

TEST_P(DoctorCounter, FromThisNumberOnIsAFinding)
{
    const Json before = replies.counters;
    count(GetParam().counter, GetParam().too_few);
    EXPECT_THAT(found(), IsEmpty());

    replies.counters = before;
    count(GetParam().counter, GetParam().enough);
    EXPECT_THAT(found(), ElementsAre(GetParam().rule));
    EXPECT_EQ(evidence(GetParam().rule), GetParam().evidence);
}

INSTANTIATE_TEST_SUITE_P(
    Bus, DoctorCounter,
    testing::Values(
        Counted{
            "Late", "late", 100, 99, "bus.late",
            "100 replies were suppressed because MaxTsdr had passed, 0 begun in time and written too late, 0 "
            "requests dropped because something followed them"},
        Counted{
            "WrittenLate", "too_late", 100, 99, "bus.late",
            "0 replies were suppressed because MaxTsdr had passed, 100 begun in time and written too late, 0 "
            "requests dropped because something followed them"},
        Counted{"DriverFails", "driver_errors", 1, 0, "bus.driver",
                "1 edge failed, and the guard let the driver go 0 times"},
        Counted{"DriverStays", "driver_guarded", 1, 0, "bus.driver",
                "0 edges failed, and the guard let the driver go 1 time"},
        Counted{"Flaws", "flaw: checksum", 100, 99, "bus.flaws",
                "100 bad telegrams beside 100000 valid ones"},
        Counted{"Retries", "retries", 100, 99, "bus.retries",
                "the master asked again 100 times in 100000 requests"},
        Counted{"Port", "write_errors", 3, 0, "bus.port", "the port did not take 3 replies"}),
    [](const auto& row) { return row.param.name; });

TEST_F(Doctor, AStationThatLeavesMoreThanOnceInAnHourIsRestless)
{
    station()["left_count"] = 2;
    station()["left_because"] = "the master released the slave";
    EXPECT_THAT(found(), ElementsAre("station.restless")); // in 62 minutes

    replies.status["uptime_ms"] = 7'200'000;
    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), ElementsAre("station.left"));
}

TEST_F(Doctor, NamesTagsThatAreRefused)
{
    replies.diagnosis["stations"][0]["trouble"] = Json::parse(
        R"(["the drive does not answer: its inputs are held and marked stale", "tag 999 is in no table"])");

    EXPECT_THAT(found(), ElementsAre("station.tags"));
    EXPECT_EQ(evidence("station.tags"), "tag 999 is in no table");
}

TEST_F(Doctor, RemindsOfAPendingAddressAndOfTheAddressesOfMasters)
{
    info()["address_pending"] = 7;
    station()["address"] = 2;

    EXPECT_THAT(found(true), ElementsAre("station.address_pending", "station.low_address"));
    EXPECT_EQ(evidence("station.address_pending"), "address 5 is active, the configuration file has 7");
}

// ---------------------------------------------------------------- what no table knows (X-49, X-50)

TEST_F(Doctor, NamesTheTagsWithoutAScaleAndTheirAnswers)
{
    replies.diagnosis["stations"][0]["held"] = true;
    replies.diagnosis["stations"][0]["unscaled"] =
        Json::array({{{"tag", 55}, {"direction", "in"}, {"answer", "12.5"}, {"contradicted", false}},
                     {{"tag", 56}, {"direction", "in"}, {"answer", "12.34"}, {"contradicted", true}}});

    EXPECT_THAT(found(), ElementsAre("station.unscaled"));
    EXPECT_EQ(evidence("station.unscaled"), "tag 55 answers '12.5', tag 56 answers '12.34', more decimals "
                                            "than its row has; the master is held at "
                                            "the start");
}

TEST_F(Doctor, SaysThatAStationHasNoTagTable)
{
    info()["tags_in_table"] = 0;
    EXPECT_THAT(found(true), testing::Contains("station.no_table"));
}

TEST_F(Doctor, SaysThatTripsAreNotKnown)
{
    is_technology_box(0, "NONE", 0);
    replies.tec["stations"][0]["trip"] = "not known: no tag tells it";
    EXPECT_THAT(found(true), testing::Contains("station.no_trip"));
}

} // namespace
} // namespace dpslave::dpctl
