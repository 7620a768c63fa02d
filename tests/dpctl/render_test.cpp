// SPDX-License-Identifier: Apache-2.0
#include "control/fixtures.hpp"
#include "control/lines.hpp"
#include "control/varlink_reader.hpp"
#include "dpctl/cli/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace dpslave::dpctl {
namespace {

using test::fixture;

TEST(DpctlFixtures, AreAsTheInterfaceDescribes)
{
    const auto& interface = test::control_varlink();
    for (const auto& [method, fields] : interface.outputs)
        EXPECT_EQ(test::schema_fault(interface, fields, fixture(method)), "") << method;
}

TEST(DpctlStatus, IsOneLineForTheBusAndOneForEachStation)
{
    EXPECT_EQ(render_status(fixture("GetStatus"), false), test::lines(R"(
bus       /dev/ttyS1, 187.5 kbit/s (DP_Control), last telegram 2 ms ago
stations  2, 1 in Data_Exch
daemon    process 812, running for 1 h 2 min

STATION   ADDRESS  PROFILE  STATE      MASTER  DRIVE    LINE
unwinder        5  590      Data_Exch       2  answers  p3
rewinder       16  590      Wait_Prm        -  silent   p3
)"));
}

TEST(DpctlStatus, SaysThatTheRateIsSearched)
{
    Json reply = fixture("GetStatus");
    reply["bus"]["baud_state"] = "Baud_Search";
    reply["bus"]["last_telegram_age_ms"] = nullptr;

    const std::string picture = render_status(reply, Look{false, 100});
    EXPECT_EQ(picture.substr(0, picture.find('\n')),
              "bus       /dev/ttyS1, searching the rate, now at 187.5 kbit/s, no telegram received yet");
}

TEST(DpctlStatus, ShowsStatesAndLinksInColour)
{
    const std::string picture = render_status(fixture("GetStatus"), true);

    EXPECT_NE(picture.find("\033[32mData_Exch\033[0m"), std::string::npos);
    EXPECT_NE(picture.find("\033[31msilent\033[0m"), std::string::npos);
}

TEST(DpctlStatus, NamesWhatLooksNormalAndIsNot)
{
    Json reply = fixture("GetStatus");
    reply["bus"]["port_open"] = false;
    Json& station = reply["stations"][0];
    station["clear"] = true;
    station["sync"] = station["freeze"] = true;
    station["ride"] = Json::parse(R"({"ends_in_ms":4200.0})");
    station["silent_because"] = "FAULT is PARAMETER, the station is silent on the bus.";
    station["drive"]["port_open"] = false;

    const std::string picture = render_status(reply, Look{false, 120});
    for (const char* said :
         {"/dev/ttyS1 is missing", "Data_Exch in Clear, Sync, Freeze, RIDE THROUGH", "port missing",
          "unwinder: Sync holds the outputs", "unwinder: Freeze holds the inputs",
          "unwinder: the master is in Clear: 0 goes to every output of the drive",
          "its outputs keep their values for 4.2 s more",
          "unwinder: FAULT is PARAMETER, the station is silent on the bus.",
          "the port of the drive line, /dev/ttyS2, is gone or cannot be opened"})
        EXPECT_NE(picture.find(said), std::string::npos) << said << '\n' << picture;
}

TEST(DpctlStatus, SaysOfAStationThatIsHeldThatItExchangesNothing)
{
    Json reply = fixture("GetStatus");
    reply["stations"][0]["held"] = true;
    reply["stations"][0]["held_because"] = "the scale of a tag is not known";

    const std::string picture = render_status(reply, Look{false, 120});
    EXPECT_NE(picture.find("Data_Exch, held"), std::string::npos) << picture;
    EXPECT_NE(picture.find("unwinder: held at the start: the scale of a tag is not known"),
              std::string::npos);
}

TEST(DpctlIo, DoesNotSayOfAMasterInClearThatItsOutputsGoToTheDrive)
{
    Json reply = fixture("GetIo");
    reply["stations"][0]["clear"] = true;

    EXPECT_EQ(render_io(reply, false).find("outputs go to the drive"), std::string::npos);
    EXPECT_NE(render_io(reply, false).find("the master is in Clear, 0 goes to every output"),
              std::string::npos);
}

TEST(DpctlIo, SaysWhichWordsSyncAndFreezeHold)
{
    Json reply = fixture("GetIo");
    reply["stations"][0]["sync"] = reply["stations"][0]["freeze"] = true;

    EXPECT_NE(render_io(reply, false).find("Sync holds the outputs; Freeze holds the inputs"),
              std::string::npos);
}

/// What `show` prints, of this station and the replies of the fixtures with `info`.
Json shown(std::size_t station, Json info = fixture("GetInfo")["stations"][0])
{
    Json one = {{"station", fixture("ListStations")["stations"][station]},
                {"info", std::move(info)},
                {"leds", fixture("GetLeds")["stations"][0]},
                {"tec", nullptr}};
    return {{"version", "9.8.7"}, {"stations", Json::array({std::move(one)})}};
}

/// The widest line of a picture, in characters.
std::size_t widest(const std::string& picture)
{
    std::istringstream lines{picture};
    std::size_t most = 0;
    for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
    return most;
}

TEST(DpctlPictures, Fit80ColumnsAndUseAWiderTerminal)
{
    Json io = fixture("GetIo"), diagnosis = fixture("GetDiagnosis"), counters = fixture("GetCounters"),
         status = fixture("GetStatus"), document = shown(0);
    const std::string many(30, 'W');
    const std::string words = many + ' ' + many + ' ' + many + ' ' + many;
    io["stations"][0]["words"][0]["name"] = words;
    diagnosis["stations"][0]["octets"][0]["meaning"] = words;
    diagnosis["stations"][0]["refusal"]["advice"] = words;
    diagnosis["stations"][0]["bits"] = Json::array({words, words});
    counters["groups"][0]["counters"][0]["meaning"] = words;
    status["stations"][0]["silent_because"] = words;
    io["stations"][0]["name"] = document["stations"][0]["station"]["name"] = many + many;
    document["stations"][0]["leds"]["meaning"] = words;
    status["bus"]["port"] = "/dev/serial/by-id/" + many + many;

    const Look wide{false, 160};
    EXPECT_LE(widest(render_status(status, false)), 80U);
    EXPECT_LE(widest(render_io(io, false)), 80U);
    EXPECT_LE(widest(render_diagnosis(diagnosis, false)), 80U);
    EXPECT_LE(widest(render_counters(counters, false)), 80U);
    EXPECT_LE(widest(render_show(document, false)), 80U);
    EXPECT_GT(widest(render_io(io, wide)), 80U);
    EXPECT_GT(widest(render_diagnosis(diagnosis, wide)), 80U);
    EXPECT_GT(widest(render_counters(counters, wide)), 80U);
    EXPECT_GT(widest(render_status(status, wide)), 80U);
}

TEST(DpctlShow, ShowsEverythingAboutAStation)
{
    EXPECT_EQ(render_show(shown(0), false), test::lines(R"(
unwinder, address 5
  device            590 with PROFIBUS-DP option board (profile 590)
  state             Data_Exch, master 2
  watchdog          100 ms
  min T_SDR         11 T_bit
  groups            1, 8
  Sync, Freeze      off, off
  diagnosis         nothing new
  parameters        2 and Demand Data
  left Data_Exch    1 time, the last time: watchdog expired
  drive             unit 00 on p3 (/dev/ttyS2, ei-ascii, direction none):
                    answers
                    a round takes 123 ms; 4000 reads, 1 write, 3 unanswered, 0
                    refused, lost 1 time

  order code        590 option digit 2
  OPTION VERSION    9.8.7
  host firmware     4.2 or later
  manual            HA389815
  Ident_Number      0x0533
  address           5 active, 7 pending: it is in the configuration file and
                    takes effect at the next start of dpslaved
  legal addresses   0 to 125
  at most           12 parameters, 32 octets in, 32 octets out, 6 octets of
                    diagnosis
  has Demand Data   yes
  has Sync, Freeze  yes, yes
  rates             9.6 kbit/s, answers within 60 T_bit
                    187.5 kbit/s, answers within 60 T_bit
                    1.5 Mbit/s, answers within 150 T_bit
  tag table         590.csv, 312 tags
  mnemonics         rule 590plus, assumed: 590+ formula

  lamps             data exchange with the master
  LED    NOW   PATTERN        SINK
  red    dark  off            gpio:23
  green  lit   flashing 2 Hz  led:dpslaved-green
)"));
}

TEST(DpctlShow, NamesALampThatCannotBeSwitchedInPlaceOfLit)
{
    Json document = shown(0);
    document["stations"][0]["leds"]["leds"][1]["trouble"] = "LED led:dpslaved-green: no such name";

    EXPECT_NE(render_show(document, false).find("green  cannot be switched  flashing 2 Hz"),
              std::string::npos)
        << render_show(document, false);
}

TEST(DpctlShow, ReportsAStationWithoutMasterAndASilentDrive)
{
    EXPECT_NE(render_show(shown(1), false).find(R"(rewinder, address 16
  device            590 with PROFIBUS-DP option board (profile 590)
  state             Wait_Prm, no master
  watchdog          off
  min T_SDR         11 T_bit
  groups            none
  Sync, Freeze      off, off
  diagnosis         static diagnosis: not ready for data yet; new, not yet read
                    by the master
  parameters        0
  left Data_Exch    never
  drive             unit 01 on p3 (/dev/ttyS2, ei-ascii, direction none): silent
                    0 reads, 0 writes, 12 unanswered, 0 refused, lost 0 times
                    last trouble: no answer

  order code )"),
              std::string::npos)
        << render_show(shown(1), false);
}

TEST(DpctlShow, HasTheFunctionBlockBelowTheLamps)
{
    Json document = shown(0);
    document["stations"][0]["tec"] = fixture("GetTec")["stations"][0];

    const std::string picture = render_show(document, false);

    const auto lamps = picture.find("  LED ");
    EXPECT_NE(lamps, std::string::npos);
    EXPECT_GT(picture.find("\n\nbooster: TEC OPTION\n"), lamps);
}

TEST(DpctlInfo, ShowsWhatIsEmulatedAndThePendingAddress)
{
    const std::string picture = render_show(shown(0), false);
    for (const char* line : {"590 with PROFIBUS-DP option board", "order code        590 option digit 2",
                             "OPTION VERSION    9.8.7", "address           5 active, 7 pending"})
        EXPECT_NE(picture.find(line), std::string::npos) << line;
}

TEST(DpctlInfo, SaysNothingOfAPendingAddressWhenThereIsNone)
{
    Json info = fixture("GetInfo")["stations"][0];
    info["address_pending"] = nullptr;

    EXPECT_NE(render_show(shown(0, info), {}).find("  address           5 active\n"), std::string::npos);
}

TEST(DpctlInfo, ShowsReleaseStatusAndResolutionWhereTheDeviceHasThem)
{
    Json info = fixture("GetInfo")["stations"][0];
    const std::string without = render_show(shown(0, info), {});
    EXPECT_EQ(without.find("option software"), std::string::npos);
    EXPECT_EQ(without.find("comms status"), std::string::npos);
    EXPECT_EQ(without.find("resolution"), std::string::npos);

    info["option_software"] = "Version 3.x";
    info["comms_status"] = "rdY";
    info["resolution"] = "full";
    const std::string picture = render_show(shown(0, info), {});
    EXPECT_NE(picture.find("\n  option software   Version 3.x\n"), std::string::npos) << picture;
    EXPECT_NE(picture.find("\n  comms status      rdY (ready to run)\n"), std::string::npos);
    EXPECT_NE(picture.find("\n  resolution        full\n"), std::string::npos);

    info["comms_status"] = "run";
    EXPECT_NE(render_show(shown(0, info), {}).find("\n  comms status      run (comms running)\n"),
              std::string::npos);
}

TEST(DpctlInfo, SaysThatAMnemonicRuleIsAssumedAndWhereItComesFrom)
{
    Json info = fixture("GetInfo")["stations"][0];
    EXPECT_NE(
        render_show(shown(0, info), {}).find("\n  mnemonics         rule 590plus, assumed: 590+ formula\n"),
        std::string::npos);

    info["mnemonics_assumed"] = false;
    EXPECT_NE(render_show(shown(0, info), {}).find("\n  mnemonics         rule 590plus: 590+ formula\n"),
              std::string::npos);

    info["mnemonic_rule"] = nullptr;
    EXPECT_EQ(render_show(shown(0, info), {}).find("mnemonics"), std::string::npos);
}

TEST(DpctlInfo, RepeatsWhatTheFunctionBlockWarnsOf)
{
    Json info = fixture("GetInfo")["stations"][0];
    info["notes"] = {"WARNING: it could compromise safety.", "ADDRESS 2: a master's."};

    EXPECT_NE(render_show(shown(0, info), {})
                  .find("  notes             WARNING: it could compromise safety.\n"
                        "                    ADDRESS 2: a master's.\n"),
              std::string::npos);
}

TEST(DpctlTec, ShowsTheFunctionBlockTripAndNotes)
{
    EXPECT_EQ(render_tec(report::read<report::Tec>(fixture("GetTec")["stations"][0]), false), test::lines(R"(
booster: TEC OPTION
          NAME            VALUE          NUMBER  RANGE
  input   TYPE            PROFIBUS DP         2  0 to 9
  input   ADDRESS         3                   3  0 to 125
  input   EXT DIAGNOSTIC  >6AB5           27317  0 to FFFF
  input   RIDE THROUGH    10 s               10  -1 to 60 s
  output  FAULT           NONE                0
  output  NETWORK STATE   DATA EXCHANGE       0
  trip 1: LINK OVERVOLTS
  WARNING: Setting the RIDE THROUGH parameter to anything other than zero could compromise safety.
)"));
}

TEST(DpctlTec, TakesTheNamesThatFitAnyOptionInTheGenericView)
{
    Json reply = fixture("GetTec");
    reply["stations"][0]["view"] = "generic";

    const std::string picture = render_tec(report::read<report::Tec>(reply["stations"][0]), false);

    EXPECT_EQ(picture.find("booster: TEC OPTION, with the general names of any option\n"), 0u);
    EXPECT_NE(picture.find("  input   INPUT 1   3"), std::string::npos) << picture;
    EXPECT_NE(picture.find("  output  OUTPUT 1  DATA EXCHANGE"), std::string::npos);
    EXPECT_EQ(picture.find("ADDRESS"), std::string::npos);
}

TEST(DpctlTec, SaysTheThreeStepsOfTheSetUpWhereItIsNotSetUp)
{
    for (const int fault : {1, 2}) { // PARAMETER, TYPE MISMATCH
        Json reply = fixture("GetTec");
        reply["stations"][0]["rows"][4]["value"] = fault;
        const std::string picture = render_tec(report::read<report::Tec>(reply["stations"][0]), false);

        const auto type =
            picture.find("    1. set TYPE to PROFIBUS DP:  dpctl tec set TYPE \"PROFIBUS DP\"\n");
        const auto address = picture.find(
            "    2. set ADDRESS, 0 to 125; 0 to 2 are usually masters:  dpctl tec set ADDRESS 3\n");
        const auto look = picture.find("    3. check FAULT: it must be NONE\n");
        EXPECT_LT(type, address);
        EXPECT_LT(address, look);
        EXPECT_NE(look, std::string::npos);
    }
    EXPECT_EQ(
        render_tec(report::read<report::Tec>(fixture("GetTec")["stations"][0]), false).find("three steps"),
        std::string::npos);
}

TEST(DpctlIo, ShowsEachWordRawAndScaledWithItsAge)
{
    EXPECT_EQ(render_io(fixture("GetIo"), false), test::lines(R"(
unwinder, address 5: Data_Exch; outputs go to the drive
  DIR  OCTET  WORD  TAG  NAME             VALUE            RAW  STATE        AGE
  in       8     1    7  SPEED FEEDBACK   50.00   5000 (1388h)  good       12 ms
  out      8     1   56                  -12.50  64286 (FB1Eh)  read only      -
  Demand Data  reads tag 7: answered
  request      0000 0000 1000 0007
  reply        0000 1388 1000 0007

rewinder, address 16: Wait_Prm; nothing is written to the drive
  no parameters: no master has chosen one

in: drive to master, out: master to drive; octet: place in the Data_Exchange
telegram, counted from 0; word: place among the words of its direction, counted
from 1 after Demand Data, as gsd make and dpsim count
)"));
}

TEST(DpctlDiag, CountsOctetsBothWaysAndExplainsTheRefusal)
{
    EXPECT_EQ(render_diagnosis(fixture("GetDiagnosis"), false), test::lines(R"(
rewinder: Station_Not_Ready, Cfg_Fault, Prm_Req
  OCTET  OFFSET  VALUE  MEANING
      1       0  0x06   Station_Not_Ready, Cfg_Fault
      2       1  0x05   Prm_Req
      3       2  0x00   -
      4       3  0xFF   no master
      5       4  0x05   Ident_Number high
      6       5  0x33   Ident_Number low
  Chk_Cfg refused, octet 3 (offset 2): no legal identifier
    expected    0x50 or 0x60
    came        0x51
    what to do  compare the modules chosen in the master with the GSD
  tag 999 is in no table
  Slave_Diag    06 05 00 FF 05 33
  last Set_Prm  88 01 0A 0B 05 33 00
  last Chk_Cfg  73 50 51

octet: counted from 1, as the PROFIBUS standard does; offset: counted from 0, as
PLC programs do
)"));
}

TEST(DpctlDiag, SaysWithoutAnOctetWhenTheTelegramAsAWholeIsWrong)
{
    Json reply = fixture("GetDiagnosis");
    Json& refusal = reply["stations"][0]["refusal"];
    refusal["octet"] = refusal["expected"] = refusal["got"] = nullptr;

    const std::string picture = render_diagnosis(reply, false);
    EXPECT_NE(picture.find("  Chk_Cfg refused: no legal identifier\n    what to do  compare"),
              std::string::npos)
        << picture;
}

TEST(DpctlDiag, IsQuietWhenNothingIsWrong)
{
    Json reply = fixture("GetDiagnosis");
    Json& station = reply["stations"][0];
    station["refusal"] = nullptr;
    station["bits"] = station["trouble"] = Json::array();

    const std::string picture = render_diagnosis(reply, false);
    EXPECT_EQ(picture.substr(0, picture.find('\n')), "rewinder: no bit set");
    EXPECT_EQ(picture.find("refused"), std::string::npos);
}

TEST(DpctlCounters, AreGroups)
{
    EXPECT_EQ(render_counters(fixture("GetCounters"), false), test::lines(R"(
bus
   COUNT  LAST MINUTE  OF              MEANING
  123456         3000  telegrams       valid telegrams heard
   60000         1500  checked         with a checksum
  900000        20000  octets          received
       3            0  flaw: checksum  FCS wrong

unwinder
  COUNT  LAST MINUTE  OF              MEANING
      7            7  data_exchange   Data_Exchange requests answered
   4000           60  drive_reads     transactions with the drive
    420            0  drive_delay_ms  of the late answers

control socket
  COUNT  LAST MINUTE  OF     MEANING
      9            1  calls

turnaround of 2000 replies, from the end of the request to the end of the write
                          us  T_bit
  half of them within     12      3
  99 %                    79     15
  99.9 %                 210     40
  the slowest          20000   3750

              us  REPLIES   SHARE
              12     1600  80.0 %  ################################
        64 to 79      399  19.9 %  ########
  14336 and more        1   0.1 %  #

         T_bit  REPLIES   SHARE
             3     1600  80.0 %  ################################
            14      399  19.9 %  ########
  3584 to 4095        1   0.1 %  #
)"));
}

TEST(DpctlCounters, SayThatNoReplyWasSentYet)
{
    Json reply = fixture("GetCounters");
    for (Json& one : reply["turnaround"]) {
        one["count"] = 0;
        one["p50"] = one["p99"] = one["p999"] = one["highest"] = nullptr;
        one["classes"] = Json::array();
    }
    const std::string picture = render_counters(reply, false);
    EXPECT_NE(picture.find("\nturnaround: no reply was sent yet\n"), std::string::npos);
    EXPECT_EQ(picture.find("T_bit"), std::string::npos);

    reply["turnaround"][0]["count"] = 1;
    EXPECT_NE(render_counters(reply, false).find("turnaround of 1 reply, from"), std::string::npos);
}

TEST(DpctlCounters, ShowARareClassAsMoreThanNothing)
{
    Json reply = fixture("GetCounters");
    reply["turnaround"][0]["count"] = 1'000'000;
    reply["turnaround"][0]["classes"] =
        Json::parse(R"([{"from":12,"to":12,"count":999999},{"from":64,"to":79,"count":1}])");

    EXPECT_NE(render_counters(reply, false).find("64 to 79        1  < 0.1 %  #\n"), std::string::npos);
}

TEST(DpctlCounters, AreExactWhereADoubleIsFull)
{
    Json reply = fixture("GetCounters");
    reply["groups"][0]["counters"][0]["value"] = std::uint64_t{9'007'199'254'740'993}; // 2^53 + 1

    const Json received = Json::parse(reply.dump());
    EXPECT_NE(render_counters(received, false).find("9007199254740993"), std::string::npos);
}

TEST(DpctlTag, IsOneLine)
{
    Json reply = fixture("ReadTag");
    EXPECT_EQ(render_tag(reply, "is"), "unwinder: tag 7 SPEED FEEDBACK is 50.00, raw 5000 (0x1388)\n");

    reply["name"] = nullptr;
    EXPECT_EQ(render_tag(reply, "is now"), "unwinder: tag 7 is now 50.00, raw 5000 (0x1388)\n");

    reply["master"] = 2;
    EXPECT_NE(render_tag(reply, "is now").find("master 2 writes this tag cyclically and will overwrite it"),
              std::string::npos);
}

TEST(DpctlFollowed, StatusIsBusAndStations)
{
    EXPECT_EQ(render_followed_status(fixture("Watch"), false), test::lines(R"(
/dev/ttyS1, 187.5 kbit/s (DP_Control), last telegram 2 ms ago

STATION   ADDRESS  PROFILE  STATE      MASTER  DRIVE    LINE
unwinder        5  590      Data_Exch       2  answers  p3
rewinder       16  590      Wait_Prm        -  silent   p3
)"));
}

TEST(DpctlFollowed, IoIsTheWordsOfEachStation)
{
    EXPECT_EQ(render_followed_io(fixture("Watch"), false), test::lines(R"(
unwinder, address 5: Data_Exch
  DIR  OCTET  WORD  TAG  NAME             VALUE            RAW  STATE        AGE
  in       8     1    7  SPEED FEEDBACK   50.00   5000 (1388h)  good       12 ms
  out      8     1   56                  -12.50  64286 (FB1Eh)  read only      -
)"));
}

/// A daemon of another version may leave fields out or change their types: that is shown, it is no crash.
Json damaged(const Json& value, int depth)
{
    if (value.is_object() && depth > 0) {
        Json result = Json::object();
        for (const auto& item : value.items()) result[item.key()] = damaged(item.value(), depth - 1);
        return result;
    }
    if (value.is_array() && depth > 0) {
        Json result = Json::array({nullptr, 7, "x"});
        for (const auto& item : value) result.push_back(damaged(item, depth - 1));
        return result;
    }
    return value.is_string() ? Json(17) : Json("odd");
}

/// What `show` would make of such replies.
Json odd_document(const Json& odd)
{
    Json document = {{"version", "9.8.7"}, {"stations", Json::array()}};
    const auto stations = odd.is_object() ? odd.find("stations") : odd.end();
    if (stations == odd.end() || !stations->is_array()) return document;
    for (const Json& one : *stations)
        document["stations"].push_back({{"station", one}, {"info", one}, {"leds", one}, {"tec", one}});
    return document;
}

TEST(DpctlRenderers, SurviveRepliesOfAnotherVersion)
{
    for (int depth = 0; depth < 6; ++depth)
        for (const char* method : {"GetStatus", "ListStations", "GetInfo", "GetIo", "GetDiagnosis",
                                   "GetCounters", "GetLeds", "GetTec", "Watch"}) {
            const Json odd = damaged(fixture(method), depth);
            EXPECT_NO_THROW({
                render_status(odd, false);
                render_show(odd, false);
                render_show(odd_document(odd), false);
                render_io(odd, false);
                render_diagnosis(odd, false);
                render_counters(odd, false);
                render_tec(report::read<report::Tec>(odd), false);
                render_tag(odd, "is");
                render_followed_status(odd, false);
                render_followed_io(odd, false);
                status_changes(odd, fixture("Watch"));
                status_changes(fixture("Watch"), odd);
                io_changes(odd, fixture("Watch"));
                io_changes(fixture("Watch"), odd);
            }) << method
               << depth;
        }
}

} // namespace
} // namespace dpslave::dpctl
