// SPDX-License-Identifier: Apache-2.0
// Each row of the troubleshooting tables: HA389815 ch. 9, HA463561U002 "Troubleshooting", 2408f/2404f
// handbook ch. 6.
#include "doctor_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(Doctor, OfADaemonThatOnlyListensHasANoteAndMissesNoStation)
{
    bus().listens = true;
    bus().unanswered = {{.address = 9, .master = 2, .requests = 50, .age_ms = 100}};
    replies.status.stations.clear();
    replies.counters.groups.pop_back();

    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), ElementsAre("bus.listens"));
    EXPECT_THAT(render_doctor(replies, diagnose(replies, ""), {}, "", false), Not(HasSubstr("STATION")));

    replies.counters.groups[0].counters.clear();
    bus().last_telegram_age_ms = std::nullopt;
    EXPECT_THAT(found(), ElementsAre("bus.silent"));
}

TEST_F(Doctor, FindsNothingWhereAllIsWell)
{
    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), IsEmpty());
}

// ---------------------------------------------------------------- HA389815 chapter 9

TEST_F(Doctor, NamesALampThatCannotBeSwitched)
{
    replies.leds.stations[0].leds[0].trouble = "LED gpio:23: no such line";

    EXPECT_THAT(found(), ElementsAre("station.lamp"));
    EXPECT_EQ(evidence("station.lamp"), "lamp red: LED gpio:23: no such line");
}

TEST_F(Doctor, NamesTheSilentBusAndThenTheExternalFaultOfAnOptionBoard)
{
    station().state = "Wait_Prm";
    never_heard_anything();

    EXPECT_THAT(found(), ElementsAre("bus.silent", "board.external"));
    EXPECT_EQ(evidence("bus.silent"), "not one octet has been received from the bus");
    EXPECT_THAT(steps("board.external"),
                AllOf(HasSubstr("terminal connections"), HasSubstr("D-sub 8 and 3"),
                      HasSubstr("1.5 Mbaud or less"), HasSubstr("OPTION ADDRESS"),
                      HasSubstr("no other PROFIBUS-DP slave or master has the same address")));
}

TEST_F(Doctor, NamesACableThatIsCutWithinSeconds)
{
    station().state = "Wait_Prm";
    hears_nothing_for(4'000);

    EXPECT_EQ(found().front(), "bus.silent");
    EXPECT_EQ(evidence("bus.silent"), "the last octet from the bus was received 4.0 s ago");
}

TEST_F(Doctor, DistinguishesAWrongRateFromSilenceAndSaysWhichOneIsConfigured)
{
    station().state = "Wait_Prm";
    is_not_asked();
    bus().configured_baud = 500'000;
    set_count(0, "octets", 9'000, 600, 500.0);
    set_count(0, "checked", 0, 0, std::nullopt);
    bus().last_telegram_age_ms = std::nullopt;

    EXPECT_THAT(found(), ElementsAre("bus.rate", "board.external"));
    EXPECT_EQ(evidence("bus.rate"),
              "600 octets came in the last minute, but never a telegram with a checksum; "
              "the rate is fixed at 500 kbit/s ([bus] baud)");

    set_count(0, "checked", 40, 0, 300'000.0);
    EXPECT_THAT(evidence("bus.rate"), HasSubstr("the last telegram with a checksum was received 5 min ago"));
}

TEST_F(Doctor, SaysWhichRateTheSearchLeavesOut)
{
    station().state = "Wait_Prm";
    never_heard_anything();
    bus().configured_baud = std::nullopt;
    bus().baud_state = "Baud_Search";
    set_count(0, "octets", 9'000, 600, 500.0);

    EXPECT_EQ(found().front(), "bus.rate");
    EXPECT_THAT(evidence("bus.rate"), HasSubstr("all but 45.45 kbit/s"));
    EXPECT_THAT(steps("bus.rate"), HasSubstr("baud = 45450"));
}

TEST_F(Doctor, BlamesNothingBeforeAMasterCanHaveAsked)
{
    station().state = "Wait_Prm";
    is_not_asked();
    replies.status.uptime_ms = 1'500;
    EXPECT_THAT(found(), ElementsAre("station.just_started"));
    EXPECT_EQ(evidence("station.just_started"),
              "no master has asked address 5 yet; dpslaved has run for 1.5 s");

    never_heard_anything();
    EXPECT_THAT(found(), ElementsAre("station.just_started")) << "not a telegram was heard either";

    is_technology_box(0, "NONE", 4);
    EXPECT_THAT(found(), ElementsAre("station.just_started")) << "NETWORK STATE is BAUD SEARCH";

    replies.tec.stations.clear();
    is_controller();
    EXPECT_THAT(found(), ElementsAre("station.just_started"));

    replies.status.uptime_ms = 20'000;
    EXPECT_EQ(found().front(), "bus.silent");
}

TEST_F(Doctor, AcceptsATelegramThatTheCountersDoNotHaveYet)
{
    hears_nothing_for(20'000);
    bus().last_telegram_age_ms = 5.0;
    station().watchdog_ms = 100;

    EXPECT_THAT(found(), IsEmpty()) << "the master has just come back";
}

TEST_F(Doctor, DoesNotSayThatOutputsOfAnExchangeThatHasJustBegunStand)
{
    station().watchdog_ms = std::nullopt;
    set_count(1, "data_exchange", 0, 0, std::nullopt);

    EXPECT_THAT(found(), IsEmpty());
}

TEST_F(Doctor, NamesTwoMastersThatWantTheSameSlave)
{
    count_of_station("foreign_prm", 3);

    EXPECT_THAT(found(), ElementsAre("station.two_masters"));
    EXPECT_EQ(evidence("station.two_masters"),
              "master 2 has this slave, and another master sent 3 Set_Prm in the last minute");
}

TEST_F(Doctor, NamesTheAddressThatTheMasterAsksForInThePlaceOfOurs)
{
    station().state = "Wait_Prm";
    bus().unanswered = {{.address = 7, .master = 2, .requests = 40, .age_ms = 80.0}};
    EXPECT_THAT(found(), Not(Contains("bus.other_address"))) << "ours is asked";

    is_not_asked();
    EXPECT_EQ(found().front(), "bus.other_address");
    EXPECT_EQ(evidence("bus.other_address"),
              "master 2 asks for address 7 (40 times) and gets no answer; no master asks for ours: 5");

    bus().unanswered[0].age_ms = 60'000.0;
    EXPECT_THAT(found(), Not(Contains("bus.other_address"))) << "it has stopped asking";
}

TEST_F(Doctor, NamesAStationThatNoMasterAsks)
{
    station().state = "Wait_Prm";
    is_not_asked();
    EXPECT_THAT(found(), ElementsAre("station.not_asked", "board.external"));
    EXPECT_EQ(evidence("board.external"), "telegrams are received, but no master asks for address 5");

    station().state = "Wait_Cfg";
    EXPECT_EQ(evidence("board.external"), "the master has parameterised address 5 and sends no Chk_Cfg");
}

TEST_F(Doctor, NamesAMasterThatOnlyReadsTheDiagnosis)
{
    station().state = "Wait_Prm";
    count_of_station("slave_diag", 12);

    EXPECT_EQ(found().front(), "station.asked_only");
}

TEST_F(Doctor, NamesTheRefusedTelegramAndThenTheConfigurationFault)
{
    station().state = "Wait_Prm";
    refuse("Set_Prm", "the Ident_Number is that of another device");
    count_of_station("set_prm", 12);

    EXPECT_THAT(found(), ElementsAre("station.prm_refused", "board.configuration"));
    EXPECT_EQ(evidence("station.prm_refused"),
              "Set_Prm was refused, octet 5: the Ident_Number is that of another device; use the GSD");
    EXPECT_THAT(steps("board.configuration"),
                AllOf(HasSubstr("Usr_Prm_Data"), HasSubstr("Cfg_Data"), HasSubstr("station status octets")));
}

TEST_F(Doctor, NamesTheDriveThatWasNeverHeardInOneCauseWithAProbe)
{
    drive_was_never_heard();

    EXPECT_THAT(found(), ElementsAre("drive.never", "board.internal"));
    EXPECT_EQ(evidence("drive.never"), "ei-ascii unit 00 on p3: /dev/ttyS2 at 9.6 kbit/s, 7E1, direction "
                                       "none; 3 requests and never an answer");
    EXPECT_THAT(steps("drive.never"), HasSubstr("dpctl doctor --probe"));
    EXPECT_THAT(steps("board.internal"),
                AllOf(HasSubstr("PROTOCOL"), HasSubstr("OPTION"), HasSubstr("0 to 125 (620: 1 to 125)"),
                      HasSubstr("620: check the connections")));
}

TEST_F(Doctor, DistinguishesADriveThatFellSilentFromOneThatWasNeverHeard)
{
    station().drive.link = "silent";
    set_count(1, "drive_losses", 1, 1, 90'000.0);

    EXPECT_THAT(found(), ElementsAre("drive.silent", "board.internal"));
    EXPECT_THAT(evidence("drive.silent"), HasSubstr("it does not answer since 1 min"));
}

TEST_F(Doctor, NamesALineThatStallsAndNotADriveThatCannotBeAsked)
{
    station().drive.link = "gone";
    station().drive.stalled_ms = 12'000;
    station().drive.stalled_in = "write";
    set_count(1, "drive_losses", 1, 1, 12'000.0);

    EXPECT_EQ(found().front(), "drive.stalled");
    EXPECT_EQ(evidence("drive.stalled"), "line p3 has stalled in write for 12.0 s");
    EXPECT_THAT(found(), Not(Contains("drive.silent")));
}

TEST_F(Doctor, NamesWhatAnotherProgramHasChangedOfAPort)
{
    bus().port_settings = "ECHO is on, 9600 instead of 187500 bit/s";
    count("settings_changed", 2);
    station().drive.port_settings = "ISTRIP is on";
    count_of_station("line_settings_changed", 1);

    EXPECT_THAT(found(), ElementsAre("bus.settings", "drive.settings"));
    EXPECT_EQ(
        evidence("bus.settings"),
        "settings of /dev/ttyS1 were changed 2 times in the last minute: ECHO is on, 9600 instead of 187500 bit/s");
    EXPECT_EQ(evidence("drive.settings"),
              "settings of /dev/ttyS2 were changed 1 time in the last minute: ISTRIP is on");
}

TEST_F(Doctor, NamesWhoElseHasThePortsBeforeWhatFollowsFromIt)
{
    replies.ports = {{.port = "/dev/ttyS1", .users = {}, .is_console = true},
                     {.port = "/dev/ttyS2", .users = {{812, "agetty"}, {90, "cat"}}},
                     {.port = "/dev/ttyS3", .users = {{7, "minicom"}}}};
    drive_was_never_heard();
    EXPECT_THAT(found(), ElementsAre("bus.shared", "drive.shared", "drive.never", "board.internal"));
    EXPECT_EQ(evidence("bus.shared"), "/dev/ttyS1: it is the console of the kernel");
    EXPECT_EQ(evidence("drive.shared"), "/dev/ttyS2: process 812 (agetty), process 90 (cat)");
}

TEST_F(Doctor, SaysThatItMayNotSeeWhoHasAPort)
{
    replies.ports = {{.port = "/dev/ttyS1", .users = {}, .hidden = 31},
                     {.port = "/dev/ttyS2", .users = {}, .hidden = 31}};
    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), ElementsAre("bus.not_seen")) << "a note";
    EXPECT_EQ(evidence("bus.not_seen"), "the files of 31 processes of other users cannot be seen");
}

TEST_F(Doctor, SaysWhyTheBusPortCannotBeHad)
{
    bus().port_open = false;
    bus().trouble = "/dev/ttyS1 is used by another program; it is tried again";
    EXPECT_EQ(found().front(), "bus.gone");
    EXPECT_EQ(evidence("bus.gone"), *bus().trouble);
}

TEST_F(Doctor, PutsAPortThatHasVanishedBeforeAllElse)
{
    drive_was_never_heard();
    station().drive.port_open = false;
    EXPECT_EQ(found().front(), "drive.gone");
    EXPECT_THAT(found(), Not(Contains("drive.never")));

    hears_nothing_for(20'000);
    bus().port_open = false;
    EXPECT_EQ(found().front(), "bus.gone");
    EXPECT_THAT(found(), Not(Contains("bus.silent")));
}

TEST_F(Doctor, NamesTheMajorFaultWhereTheStationIsNotServed)
{
    station().state = "Power_On";

    EXPECT_THAT(found(), ElementsAre("board.dark"));
}

TEST_F(Doctor, FindsAnAddressThatIsUsedTwice)
{
    count("own_address", 2);

    EXPECT_THAT(found(), ElementsAre("bus.double_address"));
    EXPECT_EQ(evidence("bus.double_address"),
              "2 telegrams of another device with one of our addresses as the sender in the last minute");
}

TEST_F(Doctor, DistinguishesATransceiverThatHearsItselfFromAnAddressThatIsUsedTwice)
{
    count("replies", 400);
    count("own_address", 398);
    count("came_back", 398);
    EXPECT_THAT(found(), ElementsAre("bus.echo"));
    EXPECT_EQ(evidence("bus.echo"),
              "398 of 400 replies came back to the gateway in the last minute, and the master goes on");
    EXPECT_THAT(steps("bus.echo"), HasSubstr("echo = \"on\" under [bus]"));

    count("retries", 200);
    EXPECT_EQ(found().front(), "bus.double_address") << "another device spoils the replies";
}

TEST_F(Doctor, FindsAnAddressThatIsUsedTwiceHoweverManyRepliesThereWere)
{
    count("replies", 400);
    count("own_address", 398);
    EXPECT_THAT(found(), ElementsAre("bus.double_address")) << "none of them was a reply of the gateway";

    count("own_address", 403);
    count("came_back", 400);
    EXPECT_THAT(found(), ElementsAre("bus.echo", "bus.double_address"));
    EXPECT_THAT(evidence("bus.double_address"), HasSubstr("3 telegrams of another device"));
}

TEST_F(Doctor, NamesAnEchoThatDoesNotComeAndNotTheFlawsThatFollowFromIt)
{
    count("echo_missing", 700);
    count("flaw: start delimiter", 650);

    EXPECT_THAT(found(), ElementsAre("bus.no_echo"));
    EXPECT_EQ(evidence("bus.no_echo"), "the echo of 700 replies did not come in the last minute");
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
    station().state = row.fault != 0                         ? "Power_On"
                      : row.network == 0 || row.network == 1 ? "Data_Exch"
                      : row.network == 2                     ? "Wait_Cfg"
                                                             : "Wait_Prm";
    if (row.network == 3) count_of_station("set_prm", 3);
    is_technology_box(row.fault, row.fault_shown, row.network);

    const bool works = std::string{row.rule} == "box.works";
    EXPECT_THAT(found(works), Contains(row.rule));
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
    station().state = "Wait_Prm";
    hears_nothing_for(60'000);
    is_technology_box(0, "NONE", 3);

    EXPECT_THAT(found(), ElementsAre("bus.silent", "box.no_communications"));
}

TEST_F(Doctor, ReportsWhichTelegramABoxRefused)
{
    station().state = "Wait_Prm";
    refuse("Chk_Cfg", "Cfg_Data is empty");
    is_technology_box(0, "NONE", 3);

    EXPECT_EQ(evidence("box.wait_param"),
              "NETWORK STATE is WAIT PARAM; Chk_Cfg was refused, octet 5: Cfg_Data is empty; use the GSD");
}

TEST_F(Doctor, ReportsTheTripOfTheDrive)
{
    is_technology_box(0, "NONE", 0);
    report::Tec& tec = replies.tec.stations[0];
    tec.trip = "0: NO TRIP";
    tec.tripped = false;
    EXPECT_THAT(found(), IsEmpty());
    tec.trip = "unknown: tag 4 was never read";
    tec.tripped = std::nullopt;
    EXPECT_THAT(found(), IsEmpty());

    tec.trip = "1: LINK OVERVOLTS";
    tec.tripped = true;
    EXPECT_THAT(found(), ElementsAre("box.trip"));
    EXPECT_EQ(evidence("box.trip"), "trip 1: LINK OVERVOLTS");
}

TEST_F(Doctor, RepeatsWhatTheFunctionBlockWarnsOf)
{
    is_technology_box(0, "NONE", 0);
    replies.tec.stations[0].notes = {"RIDE THROUGH other than 0 could compromise safety."};

    EXPECT_THAT(found(true), ElementsAre("box.works", "station.tec_notes"));
    EXPECT_EQ(evidence("station.tec_notes"), "RIDE THROUGH other than 0 could compromise safety.");
}

// ---------------------------------------------------------------- 2408f/2404f handbook chapter 6

TEST_F(Doctor, GoesThroughTheListOfNoCommunicationsOfAController)
{
    is_controller();
    station().state = "Wait_Prm";
    is_not_asked();

    EXPECT_THAT(found(), ElementsAre("station.not_asked", "controller.no_communications"));
    EXPECT_THAT(steps("controller.no_communications"),
                AllOf(HasSubstr("continuity of A (HE) and B (HD)"), HasSubstr("slot H"),
                      HasSubstr("node address"), HasSubstr("transmitted to the master"),
                      HasSubstr("GSD file is correct"), HasSubstr("Never use more than 1.5 Mbaud"),
                      HasSubstr("no device but those at the ends"), HasSubstr("duplicate")));
}

TEST_F(Doctor, FindsAnIntermittentFailureOfAController)
{
    is_controller();
    count_of_station("left_data_exchange", 5);
    station().left_because = "the watchdog expired: the master is silent";

    EXPECT_THAT(found(), ElementsAre("controller.intermittent"));
    EXPECT_EQ(evidence("controller.intermittent"),
              "Data_Exch was left 5 times in the last minute, the last time: the "
              "watchdog expired: the master is silent");
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
    station().drive.link = "silent";

    EXPECT_THAT(found(), ElementsAre("drive.silent"));
}

// ---------------------------------------------------------------- what the counters show

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
    const report::GetCountersReply before = replies.counters;
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
            "requests dropped because something followed them, in the last minute"},
        Counted{
            "WrittenLate", "too_late", 100, 99, "bus.late",
            "0 replies were suppressed because MaxTsdr had passed, 100 begun in time and written too late, 0 "
            "requests dropped because something followed them, in the last minute"},
        Counted{"Settings", "settings_changed", 1, 0, "bus.settings",
                "settings of /dev/ttyS1 were changed 1 time in the last minute: dpslaved does not say which"},
        Counted{
            "Raised", "driver_raised", 2, 0, "bus.settings",
            "RTS of /dev/ttyS1 was raised by another program 2 times in the last minute: the bus was blocked"},
        Counted{"DriverFails", "driver_errors", 1, 0, "bus.driver",
                "1 edge failed, and the guard released the driver 0 times in the last minute"},
        Counted{"DriverStays", "driver_guarded", 1, 0, "bus.driver",
                "0 edges failed, and the guard released the driver 1 time in the last minute"},
        Counted{"Flaws", "flaw: checksum", 5, 4, "bus.flaws",
                "5 flaws (damaged telegrams, or noise between them) beside 100000 valid telegrams in "
                "the last minute"},
        Counted{"Retries", "retries", 100, 99, "bus.retries",
                "the master asked again 100 times in 100000 requests in the last minute"},
        Counted{"Port", "write_errors", 3, 0, "bus.port",
                "the port did not accept 3 replies in the last minute"}),
    [](const auto& row) { return row.param.name; });

TEST_F(Doctor, NoiseThatGoesOnIsNotLostAmongGoodTelegramsAndSaysSinceWhen)
{
    set_count(0, "telegrams", 110'000, 30'000, 500.0);
    count("flaw: checksum", 12);
    replies.counters.groups[0].counters.back().since_age_ms = 720'000.0;

    EXPECT_THAT(found(), ElementsAre("bus.flaws"));
    EXPECT_EQ(evidence("bus.flaws"), "12 flaws (damaged telegrams, or noise between them) beside "
                                     "30000 valid telegrams in the last minute, since 12 min");
}

TEST_F(Doctor, FlawsBeforeTheFirstTelegramAreNoDisturbedLine)
{
    station().state = "Wait_Prm";
    never_heard_anything();
    replies.status.uptime_ms = 4'000;
    count("octets", 600);
    count("flaw: bad character", 300);

    EXPECT_THAT(found(), ElementsAre("station.just_started"));
}

TEST_F(Doctor, OneBurstOfFlawsIsAPlugOrASwitchAndNoDisturbedLine)
{
    set_count(0, "flaw: start delimiter", 60, 60, 20'000.0);
    replies.counters.groups[0].counters.back().since_age_ms = 21'000.0;
    EXPECT_THAT(found(), IsEmpty());

    replies.counters.groups[0].counters.back().since_age_ms = 22'000.0;
    EXPECT_THAT(found(), ElementsAre("bus.flaws"));
}

TEST_F(Doctor, TelegramsThatAreNotUnderstoodAreNoDisturbanceOfTheLine)
{
    for (const char* const name :
         {"flaw: missing SAP", "flaw: unknown address extension", "flaw: source address"}) {
        count(name, 50);
        EXPECT_THAT(found(), IsEmpty()) << name;
    }
}

TEST_F(Doctor, WhatIsOverIsOneLineWithCountAndAge)
{
    set_count(0, "flaw: checksum", 400, 0, 300'000.0);
    set_count(0, "own_address", 3, 0, 600'000.0);
    set_count(1, "left_data_exchange", 5, 0, 1'200'000.0);

    EXPECT_THAT(found(), IsEmpty());
    const auto earlier = earlier_troubles(replies, "");
    ASSERT_EQ(earlier.size(), 3U);
    EXPECT_EQ(earlier[0].what, "telegrams of another device with one of our addresses");
    EXPECT_EQ(earlier[1].count, 400);
    EXPECT_EQ(earlier[2].station, "unwinder");
    EXPECT_EQ(earlier[2].age_ms, 1'200'000.0);
}

TEST_F(Doctor, AnExchangeThatTheMasterEndsByItselfIsNoFaultOfTheCable)
{
    count_of_station("left_data_exchange", 6);
    for (const char* const code : {"unlock", "new_parameters"}) {
        station().left_code = code;
        EXPECT_THAT(found(), ElementsAre("station.restarts")) << code;
    }
    station().left_code = "output_length";
    EXPECT_THAT(found(), ElementsAre("station.output_length"));

    is_controller();
    EXPECT_THAT(found(), ElementsAre("station.output_length"));
}

TEST_F(Doctor, AStationThatLeavesMoreThanOnceInAMinuteIsRestless)
{
    station().left_because = "the watchdog expired";
    station().left_code = "watchdog";
    count_of_station("left_data_exchange", 1);
    EXPECT_THAT(found(), IsEmpty());

    count_of_station("left_data_exchange", 2);
    EXPECT_THAT(found(), ElementsAre("station.restless"));
}

TEST_F(Doctor, AWatchdogThatExpiresAndAMasterThatComesBackIsAWatchdogTooShort)
{
    count_of_station("left_data_exchange", 6);
    count_of_station("watchdog_expired", 6);
    count_of_station("set_prm", 7);

    EXPECT_THAT(found(), ElementsAre("station.watchdog"));
    EXPECT_EQ(evidence("station.watchdog"),
              "it expired 6 times in the last minute, and each time the master came back; it is 100 ms");
}

TEST_F(Doctor, AMasterInClearIsNamed)
{
    station().clear = true;

    EXPECT_THAT(found(), ElementsAre("station.clear"));
    EXPECT_EQ(evidence("station.clear"), "master 2 is in Clear: 0 goes to every output of the drive");
}

TEST_F(Doctor, RideThroughIsNamedWithWhatIsLeftOfIt)
{
    station().ride = report::Ride{4200.0};

    EXPECT_THAT(found(), ElementsAre("station.ride_through"));
    EXPECT_EQ(evidence("station.ride_through"), "the outputs keep their values for 4.2 s more");
}

// ---------------------------------------------------------------- the tags

struct RefusedTag {
    const char* name;
    const char* word;
    const char* code;
    const char* rule;
};
class DoctorTag : public Doctor, public testing::WithParamInterface<RefusedTag> {};

TEST_P(DoctorTag, IsNamedByTheStateOfItsWordOrByTheCodeOfTheRefusal)
{
    if (*GetParam().word != '\0') {
        word_is(1, GetParam().word);
        EXPECT_THAT(found(), ElementsAre(GetParam().rule));
        EXPECT_EQ(evidence(GetParam().rule), "tag 56 = -12.50 (out octet 8)");
        word_is(1, "good");
    }
    if (*GetParam().code != '\0') {
        drive_refuses(999, GetParam().code, "what the drive said");
        EXPECT_THAT(found(), ElementsAre(GetParam().rule));
        EXPECT_EQ(evidence(GetParam().rule), "what the drive said");
    }
}

INSTANTIATE_TEST_SUITE_P(
    States, DoctorTag,
    testing::Values(RefusedTag{"ReadOnlyAsAnOutput", "read_only", "read_only", "station.read_only"},
                    RefusedTag{"OutOfRange", "out_of_range", "out_of_range", "station.range"},
                    RefusedTag{"TheDrivesOwnValue", "", "does_not_fit", "drive.value"},
                    RefusedTag{"Unknown", "invalid_tag", "invalid_tag", "station.tags"},
                    RefusedTag{"OnlyStopped", "", "not_stopped", "station.not_now"},
                    RefusedTag{"OnlyInConfiguration", "", "not_config_mode", "station.not_now"},
                    RefusedTag{"Refused", "refused", "unsupported_type", "station.refused"}),
    [](const auto& row) { return row.param.name; });

TEST_F(Doctor, ADriveThatHasNoneOfTheTagsIsAnotherOne)
{
    word_is(0, "invalid_tag");
    EXPECT_THAT(found(), ElementsAre("station.tags")) << "one tag alone may be a wrong number";

    drive_refuses(75, "invalid_tag", "tag 75: exception 2 (illegal data address)");
    EXPECT_THAT(found(), ElementsAre("station.other_device"));
    EXPECT_THAT(steps("station.other_device"), AllOf(HasSubstr("profile"), HasSubstr("tag table")));

    word_is(0, "good");
    EXPECT_THAT(found(), ElementsAre("station.tags"));
}

TEST_F(Doctor, AnAnswerThatDoesNotFitItsRowIsAFaultOfTheTable)
{
    word_is(0, "refused");
    replies.io.stations[0].words[0].answer = "12.5";

    EXPECT_THAT(found(), ElementsAre("station.other_type"));
    EXPECT_THAT(evidence("station.other_type"),
                AllOf(HasSubstr("answers '12.5'"), HasSubstr("the table is 590.csv")));
}

// ---------------------------------------------------------------- the line of the drive

struct DriveCount {
    const char* name;
    const char* counter;
    const char* rule;
    const char* evidence;
};
class DoctorDrive : public Doctor, public testing::WithParamInterface<DriveCount> {};

TEST_P(DoctorDrive, NamesWhatWasCountedThreeTimesInAMinute)
{
    count_of_station(GetParam().counter, 2);
    EXPECT_THAT(found(), IsEmpty());

    count_of_station(GetParam().counter, 23);
    EXPECT_THAT(found(), ElementsAre(GetParam().rule));
    EXPECT_EQ(evidence(GetParam().rule), GetParam().evidence);
}

INSTANTIATE_TEST_SUITE_P(
    Counters, DoctorDrive,
    testing::Values(DriveCount{"Silences", "drive_silences", "drive.noise",
                               "23 of 523 requests were not answered in the last minute"},
                    DriveCount{"Damaged", "drive_damaged", "drive.damaged",
                               "23 answers could not be read in the last minute, beside 500 good ones"},
                    DriveCount{"Foreign", "drive_foreign", "drive.foreign",
                               "23 answers were not to what was asked, in the last minute"},
                    DriveCount{"NotUnderstood", "drive_not_understood", "drive.not_understood",
                               "the drive could not take 23 requests in the last minute"},
                    DriveCount{"NotAccepted", "drive_not_accepted", "drive.not_accepted",
                               "the drive refused 23 writes for a wrong checksum (EE 02) in the last minute"},
                    DriveCount{
                        "LateRelease", "line_late_releases", "drive.late_release",
                        "the transceiver of line p3 (direction none) was released late 23 times in the "
                        "last minute"},
                    DriveCount{"DriverErrors", "line_driver_errors", "drive.driver",
                               "line p3 (direction none): 23 edges failed, and the guard released the driver "
                               "0 times in the last minute"},
                    DriveCount{"Late", "drive_late", "drive.late",
                               "23 answers came after timeout_ms = 200 in the last minute"}),
    [](const auto& row) { return row.param.name; });

TEST_F(Doctor, AnOutputThatWasNotZeroWhenTheDriveCameBackIsNamed)
{
    station().drive.not_zeroed = 100;

    EXPECT_THAT(found(), ElementsAre("drive.not_zeroed"));
    EXPECT_EQ(evidence("drive.not_zeroed"), "tag 100 was not set to 0 when the drive came back");
}

TEST_F(Doctor, ADriveThatIsAlwaysLateIsReportedWithTheTimeThatItNeeds)
{
    drive_was_never_heard();
    count_of_station("drive_late", 23);
    count_of_station("drive_delay_ms", 310);
    count_of_station("drive_needs_timeout_ms", 388);

    EXPECT_EQ(found().front(), "drive.late");
    EXPECT_THAT(found(), Not(Contains("drive.never")));
    EXPECT_THAT(evidence("drive.late"), HasSubstr("the slowest took 310 ms: set timeout_ms = 388 at least"));
}

TEST_F(Doctor, ADriveWhoseAnswersCannotBeReadIsNotCalledSilent)
{
    station().drive.link = "silent";
    count_of_station("drive_damaged", 23);
    count_of_station("drive_bad_checksum", 20);

    EXPECT_THAT(found(), ElementsAre("drive.unreadable", "board.internal"));
    EXPECT_THAT(
        evidence("drive.unreadable"),
        HasSubstr("23 answers could not be read in the last minute, 20 of them only for a wrong checksum, "
                  "and it answered well before"));
    EXPECT_THAT(steps("drive.unreadable"),
                AllOf(HasSubstr("rate and format"), HasSubstr("dpctl doctor --probe")));
}

TEST_F(Doctor, ADriveThatWasNeverReadableIsNotSaidToHaveNeverAnswered)
{
    drive_was_never_heard();
    count_of_station("drive_damaged", 23);
    count_of_station("drive_bad_checksum", 23);

    EXPECT_EQ(found().front(), "drive.unreadable");
    EXPECT_THAT(evidence("drive.unreadable"),
                AllOf(HasSubstr("all of them only for a wrong checksum"), HasSubstr("none was ever good")));
}

TEST_F(Doctor, SaysOfEachFaultOfADriveLineWhereToLook)
{
    EXPECT_THAT(steps("drive.damaged"), HasSubstr("screen"));
    EXPECT_THAT(steps("drive.echo"), HasSubstr("in the [[line]] of this drive"));
    EXPECT_THAT(steps("drive.not_accepted"), HasSubstr("from the gateway to the drive"));
    EXPECT_THAT(steps("drive.gone"), HasSubstr("/dev/serial/by-id"));
    EXPECT_THAT(steps("drive.unsteady"), HasSubstr("plugs at both ends"));
}

TEST_F(Doctor, ALineThatHearsItselfIsNeitherSilentNorUnreadable)
{
    drive_was_never_heard();
    count_of_station("drive_came_back", 23);
    count_of_station("drive_damaged", 40);
    count_of_station("drive_foreign", 12);

    EXPECT_EQ(found().front(), "drive.echo");
    EXPECT_THAT(found(), Not(Contains(testing::AnyOf("drive.never", "drive.unreadable", "drive.foreign"))));
    EXPECT_THAT(evidence("drive.echo"), HasSubstr("23 requests came back in the last minute"));
    EXPECT_THAT(steps("drive.echo"), HasSubstr("echo = \"on\""));
}

TEST_F(Doctor, NoiseBeforeTheAnswersNamesBiasResistorsAndTheDirection)
{
    count_of_station("drive_noise", 23);

    EXPECT_THAT(found(), Contains("drive.noise_before"));
    EXPECT_THAT(evidence("drive.noise_before"),
                HasSubstr("noise came before or instead of 23 answers in the last minute"));
    EXPECT_THAT(steps("drive.noise_before"), HasSubstr("bias resistors"));
    EXPECT_THAT(steps("drive.noise_before"), HasSubstr("direction"));
}

TEST_F(Doctor, ADriveThatWasLateAWhileAgoMayBeSilentNow)
{
    station().drive.link = "silent";
    set_count(1, "drive_late", 23, 23, 40'000.0);

    EXPECT_EQ(found().front(), "drive.silent");
}

TEST_F(Doctor, ADriveThatComesAndGoesIsOneCauseWhetherItAnswersNowOrNot)
{
    set_count(1, "drive_losses", 4, 4, 6'000.0);
    count_of_station("drive_silences", 200);
    EXPECT_THAT(found(), ElementsAre("drive.unsteady"));
    EXPECT_THAT(evidence("drive.unsteady"), HasSubstr("it was lost 4 times in the last minute"));

    station().drive.link = "silent";
    EXPECT_THAT(found(), ElementsAre("drive.unsteady", "board.internal"));

    set_count(1, "drive_losses", 4, 4, 40'000.0);
    EXPECT_EQ(found().front(), "drive.silent") << "it did not come back";
}

TEST_F(Doctor, NamesTheOnlyTagThatADriveDoesNotAnswer)
{
    set_count(1, "drive_losses", 4, 4, 6'000.0);
    auto& words = replies.io.stations[0].words;
    const report::Word once_more = words[0];
    words.push_back(once_more);
    words.back().tag = 57;
    words.back().age_ms = 14'600.0;
    words[0].age_ms = 40.0;

    EXPECT_THAT(evidence("drive.unsteady"), HasSubstr("; tag 57 was not read for 14.6 s"));
}

TEST_F(Doctor, ARequestThatWasSpoiltOnItsWaySaysNothingAboutItsTag)
{
    word_is(0, "refused");
    const std::int64_t tag = replies.io.stations[0].words[0].tag;
    EXPECT_EQ(found().front(), "station.refused");

    drive_refuses(tag, "not_understood", "tag 7: NAK, EE >02C2 (checksum (BCC) error)");
    count_of_station("drive_not_understood", 23);
    count_of_station("drive_not_accepted", 23);
    EXPECT_THAT(found(), ElementsAre("drive.not_accepted"));
}

TEST_F(Doctor, SaysThatOutputsStandWhereTheMasterIsGoneAndTheWatchdogIsOff)
{
    hears_nothing_for(20'000);
    station().watchdog_ms = std::nullopt;
    set_count(1, "data_exchange", 50'000, 100, 20'000.0);

    EXPECT_THAT(found(), ElementsAre("bus.silent", "station.stands"));
    EXPECT_EQ(evidence("station.stands"), "its watchdog is off, and the last Data_Exchange was 20.0 s ago");
    EXPECT_THAT(steps("station.stands"), HasSubstr("Keep clear"));
}

TEST_F(Doctor, NotesSyncAndFreezeThatHoldTheData)
{
    station().sync = true;
    station().freeze = true;

    EXPECT_THAT(found(), IsEmpty());
    EXPECT_THAT(found(true), ElementsAre("station.sync", "station.freeze"));
}

TEST_F(Doctor, NamesThreeCausesForAStationAtMost)
{
    drive_was_never_heard();
    station().clear = true;
    word_is(1, "read_only");
    word_is(0, "invalid_tag");
    count_of_station("left_data_exchange", 9);

    EXPECT_THAT(found(), ElementsAre("drive.never", "station.clear", "station.read_only"));
}

TEST_F(Doctor, RemindsOfAPendingAddressAndOfTheAddressesOfMasters)
{
    info().address_pending = 7;
    station().address = 2;

    EXPECT_THAT(found(true), ElementsAre("station.address_pending", "station.low_address"));
    EXPECT_EQ(evidence("station.address_pending"), "address 5 is active, the configuration file has 7");
}

// ---------------------------------------------------------------- what no table knows

TEST_F(Doctor, NamesTheTagsWithoutAScaleAndTheirAnswers)
{
    replies.diagnosis.stations[0].held = true;
    replies.diagnosis.stations[0].unscaled = {{55, "in", "12.5", false}, {56, "in", "12.34", true}};

    EXPECT_THAT(found(), ElementsAre("station.unscaled"));
    EXPECT_EQ(evidence("station.unscaled"), "tag 55 answers '12.5', tag 56 answers '12.34', more decimals "
                                            "than its row has; the table is 590.csv; the "
                                            "master is held at the start");
}

TEST_F(Doctor, SaysThatAStationHasNoTagTable)
{
    info().tags_in_table = 0;
    EXPECT_THAT(found(true), testing::Contains("station.no_table"));
}

TEST_F(Doctor, SaysThatTripsAreNotKnown)
{
    is_technology_box(0, "NONE", 0);
    EXPECT_THAT(found(true), Not(testing::Contains("station.no_trip")));

    replies.tec.stations[0].trip_tag = std::nullopt;
    EXPECT_THAT(found(true), testing::Contains("station.no_trip"));
}

} // namespace
} // namespace dpslave::dpctl
