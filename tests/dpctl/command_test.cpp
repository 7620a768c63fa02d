// SPDX-License-Identifier: Apache-2.0
// The program dpctl against a server: each subcommand, each exit code, each --json.
#include "control/fixtures.hpp"
#include "control/varlink_reader.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl_bench.hpp"

#include "dpslave/base/printable.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <sstream>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class DpctlProgram : public testing::Test {
protected:
    Ran run(std::vector<std::string> arguments, Dpctl::As user = Dpctl::As::this_user)
    {
        arguments.insert(arguments.begin(), {"--socket", daemon.socket()});
        return dpctl(std::move(arguments), user);
    }
    FixtureDaemon daemon;
};

// ---------------------------------------------------------------- for people

TEST_F(DpctlProgram, PrintsWhatTheRenderersMakeWithoutColourIntoAPipe)
{
    EXPECT_EQ(run({"status"}).out, dpctl::render_status(fixture("GetStatus"), false));
    EXPECT_EQ(run({"stations"}).out, dpctl::render_stations(fixture("ListStations"), false));
    EXPECT_EQ(run({"info"}).out, dpctl::render_info(fixture("GetInfo"), "9.8.7", false));
    EXPECT_EQ(run({"io", "unwinder"}).out, dpctl::render_io(fixture("GetIo"), false));
    EXPECT_EQ(run({"diag", "16"}).out, dpctl::render_diagnosis(fixture("GetDiagnosis"), false));
    EXPECT_EQ(run({"counters"}).out, dpctl::render_counters(fixture("GetCounters"), false));
    EXPECT_EQ(run({"leds"}).out, dpctl::render_leds(fixture("GetLeds"), false));
    EXPECT_EQ(run({"tec"}).out, dpctl::render_tec(fixture("GetTec"), false));
    EXPECT_EQ(run({"read", "7", "--station", "unwinder"}).out,
              "unwinder: tag 7 SPEED FEEDBACK is 50.00, raw 5000 (0x1388)\n");
    EXPECT_EQ(run({"version"}).out, "dpctl " DPSLAVE_VERSION "\ndpslaved 9.8.7 (org.dpslaved.Control)\n");
}

TEST_F(DpctlProgram, EndsWith0WhenAllIsFine)
{
    for (const char* subcommand :
         {"status", "stations", "info", "io", "diag", "counters", "leds", "tec", "version"}) {
        const Ran ran = run({subcommand});
        EXPECT_EQ(ran.exit, 0) << subcommand;
        EXPECT_EQ(ran.err, "") << subcommand;
    }
}

/// The first character that a terminal would obey, but the ends of our own lines.
std::string obeyed_in(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0) return "no UTF-8";
        if (text[0] != '\n' && is_control(text.substr(0, length))) return printable(text.substr(0, length));
        text.remove_prefix(length);
    }
    return "";
}

TEST(DpctlOfAHostileReply, PrintsNothingThatATerminalObeysAndLeavesOtherTextAlone)
{
    const FixtureDaemon daemon{" Z\u00FCrich\x1B[2J\u009B31m\u202E\r\n"};
    for (const char* words : {"status", "stations", "info", "io", "diag", "counters", "leds", "tec",
                              "version", "doctor", "reload", "read 7", "read 1"}) {
        std::string word;
        std::vector<std::string> arguments{"--socket", daemon.socket()};
        for (std::istringstream all{words}; all >> word;) arguments.push_back(word);
        if (word == "7" || word == "1") arguments.insert(arguments.end(), {"--station", "unwinder"});
        for (const bool json : {false, true}) {
            if (json) arguments.push_back("--json");
            const Ran ran = dpctl(arguments);
            EXPECT_EQ(obeyed_in(ran.out), "") << words;
            EXPECT_EQ(obeyed_in(ran.err), "") << words;
            if (words != std::string{"counters"} && words != std::string{"doctor"}) {
                EXPECT_THAT(ran.out + ran.err, HasSubstr("Z\u00FCrich")) << words;
            }
        }
    }
}

// ---------------------------------------------------------------- for scripts

struct JsonRow {
    const char* method;
    std::vector<std::string> arguments;
};
class DpctlJson : public testing::TestWithParam<JsonRow> {};

TEST_P(DpctlJson, IsTheReplyOfTheMethodAsTheSchemaDescribesIt)
{
    const FixtureDaemon daemon;
    std::vector<std::string> arguments = GetParam().arguments;
    arguments.insert(arguments.end(), {"--json", "--socket", daemon.socket()});

    const Ran ran = dpctl(arguments);

    const Json json = Json::parse(ran.out, nullptr, false);
    EXPECT_EQ(json, fixture(GetParam().method));
    EXPECT_EQ(schema_fault(control_varlink(), control_varlink().outputs.at(GetParam().method), json), "");
    EXPECT_EQ(ran.err, "");
}

INSTANTIATE_TEST_SUITE_P(
    EachSubcommand, DpctlJson,
    testing::Values(JsonRow{"GetStatus", {"status"}}, JsonRow{"ListStations", {"stations"}},
                    JsonRow{"GetInfo", {"info"}}, JsonRow{"GetIo", {"io"}}, JsonRow{"GetDiagnosis", {"diag"}},
                    JsonRow{"GetCounters", {"counters"}}, JsonRow{"ReadTag", {"read", "7", "--station", "5"}},
                    JsonRow{"WriteTag", {"write", "7", "50", "--station", "5"}}, JsonRow{"GetLeds", {"leds"}},
                    JsonRow{"GetTec", {"tec"}}, JsonRow{"GetVersion", {"version"}},
                    JsonRow{"ListStations", {"is-exchanging"}}),
    [](const auto& row) {
        std::string name = row.param.arguments[0];
        return name.replace(std::min(name.find('-'), name.size()), name.find('-') != std::string::npos, "");
    });

TEST_F(DpctlProgram, TakesItsOptionsBeforeAndBehindTheSubcommand)
{
    EXPECT_EQ(run({"--json", "status"}).out, run({"status", "--json"}).out);
}

TEST_F(DpctlProgram, PrintsARefusalAsJsonToo)
{
    const Ran ran = run({"read", "1", "--station", "5", "--json"});

    EXPECT_EQ(ran.exit, 1);
    EXPECT_EQ(
        Json::parse(ran.out),
        Json::parse(
            R"({"error":"org.dpslaved.Control.DriveRefused","parameters":{"tag":1,"reason":"read only","code":1}})"));
    EXPECT_EQ(ran.err, "dpctl: tag 1: read only (Demand Data: error code 1)\n");
}

TEST_F(DpctlProgram, AnswersWhetherStationsExchangeData)
{
    const Ran all = run({"is-exchanging"});
    EXPECT_EQ(all.exit, 1);
    EXPECT_EQ(all.out, "unwinder (address 5): Data_Exch, drive answers\n"
                       "rewinder (address 16): Wait_Prm, drive silent\n");
    EXPECT_EQ(run({"is-exchanging", "unwinder", "--healthy"}).exit, 0);
    EXPECT_EQ(run({"is-exchanging", "unwinder"}).exit, 0);
    EXPECT_EQ(run({"is-exchanging", "5"}).exit, 0);
    EXPECT_EQ(run({"is-exchanging", "16"}).exit, 1);
    const Ran unknown = run({"is-exchanging", "winder"});
    EXPECT_EQ(unknown.exit, 2);
    EXPECT_EQ(unknown.err, "dpctl: there is no station 'winder'\n");
}

// ---------------------------------------------------------------- read and write

TEST_F(DpctlProgram, WritesNegativeValuesWithoutAnyMark)
{
    for (const char* value : {"-12.5", "-7", "-.5", "12.5", "0x00FF", "TRUE"}) {
        const Ran ran = run({"write", "56", value, "--station", "unwinder"});
        EXPECT_EQ(ran.exit, 0) << value << ran.err;
        EXPECT_EQ(daemon.written(), Json::object({{"tag", 56},
                                                  {"station", "unwinder"},
                                                  {"value", value == std::string{"-.5"} ? "-0.5" : value}}));
    }
    EXPECT_EQ(run({"write", "--station", "5", "56", "-1"}).exit, 0);
    EXPECT_EQ(run({"write", "--station", "5", "--", "56", "-1"}).exit, 0);
}

TEST_F(DpctlProgram, SaysWhatWasWritten)
{
    EXPECT_EQ(run({"write", "7", "50", "--station", "5"}).out,
              "unwinder: tag 7 SPEED FEEDBACK is now 50.00, raw 5000 (0x1388)\n");
}

TEST_F(DpctlProgram, EndsWith1AndAReasonWhenItIsRefused)
{
    const Ran station = run({"info", "winder"});
    EXPECT_EQ(station.exit, 2) << "apart from what is refused";
    EXPECT_EQ(station.err, "dpctl: there is no station 'winder'; there are: unwinder, rewinder\n");

    const Ran which = run({"read", "7"});
    EXPECT_EQ(which.exit, 1);
    EXPECT_EQ(which.err, "dpctl: there are several stations, say which one: unwinder, rewinder\n"
                         "Add its name to the command, for example: --station unwinder\n");

    const Ran drive = run({"write", "1", "5", "--station", "5"});
    EXPECT_EQ(drive.exit, 1);
    EXPECT_EQ(drive.out, "");
    EXPECT_EQ(drive.err, "dpctl: tag 1: read only (Demand Data: error code 1)\n");
}

TEST_F(DpctlProgram, LetsAnOrdinaryUserReadButNotWrite)
{
    if (::geteuid() != 0) GTEST_SKIP() << "only root can become somebody else";

    EXPECT_EQ(run({"read", "7", "--station", "5"}, Dpctl::As::nobody).exit, 0);
    const Ran ran = run({"write", "7", "5", "--station", "5"}, Dpctl::As::nobody);
    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.err, StartsWith("dpctl: only root and members of the group 'dpslaved' may do this"));
}

TEST_F(DpctlProgram, EndsWith1WhenTheDaemonIsSilent)
{
    const Ran ran = run({"read", "2", "--station", "5", "--timeout", "0.1"});

    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.err, HasSubstr("no answer within 100 ms"));
}

// ---------------------------------------------------------------- reload

TEST_F(DpctlProgram, ReloadsForOperatorsOnly)
{
    const Ran ran = run({"reload"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.out, dpctl::render_reload(fixture("Reload"), false));
    EXPECT_EQ(Json::parse(run({"reload", "--json"}).out), fixture("Reload"));
    if (::geteuid() == 0) {
        EXPECT_EQ(run({"reload"}, Dpctl::As::nobody).exit, 1);
    }
}

// ---------------------------------------------------------------- TEC OPTION

TEST_F(DpctlProgram, SetsAnInputOfTheFunctionBlockInEitherShape)
{
    const Json wanted = Json::object({{"station", "5"}, {"parameter", "RIDE THROUGH"}, {"value", "-1"}});

    const Ran ran = run({"tec", "set", "RIDE THROUGH", "-1", "--station", "5"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(daemon.written(), wanted);
    EXPECT_THAT(ran.out, HasSubstr("anything other than zero could compromise safety.\n"));

    EXPECT_EQ(run({"tec", "5", "set", "RIDE THROUGH", "-1"}).exit, 0);
    EXPECT_EQ(daemon.written(), wanted);

    EXPECT_EQ(Json::parse(run({"tec", "set", "TYPE", "PROFIBUS DP", "--json"}).out), fixture("SetTec"));
    EXPECT_EQ(daemon.written(), Json::object({{"parameter", "TYPE"}, {"value", "PROFIBUS DP"}}));
}

TEST_F(DpctlProgram, SaysWhyAnInputOfTheFunctionBlockCannotBeSet)
{
    const Ran ran = run({"tec", "set", "FAULT", "1"});

    EXPECT_EQ(ran.exit, 1);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "dpctl: FAULT cannot be set to '1': it is an output\n");
}

// ---------------------------------------------------------------- usage

class DpctlUsage : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(DpctlUsage, EndsWith2AndAHint)
{
    const Ran ran = dpctl(GetParam());

    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("--help"));
}

INSTANTIATE_TEST_SUITE_P(
    All, DpctlUsage,
    testing::Values(std::vector<std::string>{}, std::vector<std::string>{"explode"},
                    std::vector<std::string>{"status", "--loud"}, std::vector<std::string>{"status", "extra"},
                    std::vector<std::string>{"read"}, std::vector<std::string>{"read", "speed"},
                    std::vector<std::string>{"read", "-1"}, std::vector<std::string>{"read", "65536"},
                    std::vector<std::string>{"read", "7", "8"}, std::vector<std::string>{"write", "56"},
                    std::vector<std::string>{"write", "56", "1", "2"},
                    std::vector<std::string>{"tec", "set", "TYPE"}, std::vector<std::string>{"hex"},
                    std::vector<std::string>{"decode"},
                    std::vector<std::string>{"tag", "7", "--table", "x.csv", "--profile", "590"},
                    std::vector<std::string>{"status", "--timeout", "0"},
                    std::vector<std::string>{"status", "--socket"}));

TEST(DpctlHelp, SuggestsTheCommandThatIsNearest)
{
    EXPECT_THAT(dpctl({"stauts"}).err, HasSubstr("there is no command 'stauts'; did you mean 'status'?"));
    EXPECT_THAT(dpctl({"gsd", "chek", "x"}).err, HasSubstr("did you mean 'check'?"));
    EXPECT_THAT(dpctl({"--json", "docter"}).err, HasSubstr("did you mean 'doctor'?"));
    EXPECT_THAT(dpctl({"is-exchange"}).err, HasSubstr("did you mean 'is-exchanging'?"));
    EXPECT_THAT(dpctl({"foo"}).err, Not(HasSubstr("did you mean"))) << "io is not near to it";
    EXPECT_THAT(dpctl({"entirely-else"}).err, Not(HasSubstr("did you mean")));
    EXPECT_THAT(dpctl({"status", "--nonsense"}).err, Not(HasSubstr("did you mean")));
    EXPECT_EQ(dpctl({"stauts"}).exit, 2);
}

TEST(DpctlHelp, TellsTheVersion)
{
    EXPECT_EQ(dpctl({"--version"}).out, "dpctl " DPSLAVE_VERSION "\n");
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"status", "--version"},
                                               {"read", "--version"},
                                               {"gsd", "--version"},
                                               {"gsd", "check", "--version"},
                                               {"tec", "set", "--version"}}) {
        EXPECT_EQ(dpctl(words).out, "dpctl " DPSLAVE_VERSION "\n") << words.front();
        EXPECT_EQ(dpctl(words).exit, 0) << words.front();
    }
    EXPECT_EQ(dpctl({"--version"}).exit, 0);
}

TEST(DpctlHelp, TellsExitCodesAndWhereTheSchemaIs)
{
    const Ran ran = dpctl({"--help"});

    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, HasSubstr("  0  fine\n"));
    EXPECT_THAT(ran.out,
                HasSubstr("  1  refused by the daemon or the drive, a faulty answer or input, not found, "
                          "or not so (is-exchanging, doctor, survey, tune)\n"));
    EXPECT_THAT(ran.out, HasSubstr("  2  usage, or there is no such station\n"));
    EXPECT_THAT(ran.out, HasSubstr("  3  no daemon"));
    EXPECT_THAT(ran.out, HasSubstr("org.dpslaved.Control.varlink"));
}

TEST(DpctlHelp, TellsForEachSubcommandItsExitCodesAndWhatJsonPrints)
{
    const std::string all = dpctl({"--help"}).out;
    for (const char* subcommand : {"status", "stations", "info", "io", "diag", "counters", "read", "write",
                                   "tec", "leds", "watch", "version", "is-exchanging"}) {
        EXPECT_THAT(all, HasSubstr(std::string{"\n  "} + subcommand + " "));
        const std::string own = dpctl({subcommand, "--help"}).out;
        EXPECT_THAT(
            own,
            HasSubstr(
                "Exit codes: 0 fine, 1 refused, faulty or not so, 2 usage or no such station, 3 no daemon."));
        EXPECT_THAT(own, HasSubstr("--json prints the reply of "));
    }
    for (const char* subcommand : {"tag", "hex", "decode"}) {
        EXPECT_THAT(all, HasSubstr(std::string{"\n  "} + subcommand + " "));
        const std::string own = dpctl({subcommand, "--help"}).out;
        EXPECT_THAT(own,
                    HasSubstr("Exit codes: 0 fine, 1 not found or faulty, 2 usage; no daemon is needed."));
        EXPECT_THAT(own, HasSubstr("--json prints {\""));
        EXPECT_THAT(own, HasSubstr(std::string{"Examples:\n  dpctl "} + subcommand));
    }
    EXPECT_THAT(
        dpctl({"doctor", "--help"}).out,
        HasSubstr(
            "Exit codes: 0 all is well, 1 something was found, 2 usage or no such station, 3 no daemon."));
}

// ---------------------------------------------------------------- no daemon

TEST(DpctlWithoutDaemon, EndsWith3AndSaysWhatToDo)
{
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"status"},
                                               {"stations"},
                                               {"io"},
                                               {"diag"},
                                               {"counters"},
                                               {"leds"},
                                               {"tec"},
                                               {"tec", "set", "TYPE", "2"},
                                               {"watch"},
                                               {"is-exchanging"},
                                               {"read", "7"},
                                               {"write", "7", "1"}}) {
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"--socket", "/nonexistent/control.sock"});
        const Ran ran = dpctl(all);
        EXPECT_EQ(ran.exit, 3) << arguments[0];
        EXPECT_EQ(ran.out, "") << arguments[0];
        EXPECT_EQ(ran.err,
                  "dpctl: nothing answers on /nonexistent/control.sock (No such file or directory)\n"
                  "Is dpslaved running? Ask: systemctl status dpslaved, or start it: dpslaved --config FILE\n"
                  "journalctl -u dpslaved says why it does not start.\n"
                  "Without dpslaved no station is on the bus: the lamps are off, as without power.\n")
            << arguments[0];
    }
}

TEST(DpctlWithoutDaemon, InfoReadsOptionVersionZero)
{
    const Ran ran = dpctl({"info", "--socket", "/nonexistent/control.sock"});

    EXPECT_EQ(ran.exit, 3);
    EXPECT_THAT(ran.err, HasSubstr("systemctl status dpslaved"));
    EXPECT_THAT(ran.err, HasSubstr("OPTION VERSION 0.00"));
}

TEST(DpctlWithoutDaemon, VersionWorks)
{
    const Ran ran = dpctl({"version", "--socket", "/nonexistent/control.sock"});
    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.out,
              "dpctl " DPSLAVE_VERSION
              "\nno daemon: nothing answers on /nonexistent/control.sock (No such file or directory)\n");

    const Json json = Json::parse(dpctl({"version", "--json", "--socket", "/nonexistent/control.sock"}).out);
    EXPECT_EQ(schema_fault(control_varlink(), control_varlink().outputs.at("GetVersion"), json), "");
    EXPECT_EQ(json.at("program"), "dpctl");
}

TEST(DpctlWithoutDaemon, ASocketThatTheUserMayNotReachIsNoDaemonForHim)
{
    if (::geteuid() != 0) GTEST_SKIP() << "only root can become somebody else";
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "closed");
    std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::owner_all);

    const Ran ran = dpctl({"status", "--socket", folder.path() / "closed" / "s"}, Dpctl::As::nobody);

    EXPECT_EQ(ran.exit, 3);
    EXPECT_THAT(ran.err, HasSubstr("Permission denied"));
}

} // namespace
} // namespace dpslave::test
