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

/// What `show` joins, of the fixtures; "booster", the only one with TEC OPTION there, is no station.
Json show_document()
{
    Json stations = Json::array();
    const Json infos = fixture("GetInfo");
    for (const Json& info : infos.at("stations")) {
        const auto named = [&](const char* method) {
            const Json reply = fixture(method);
            for (const Json& one : reply.at("stations"))
                if (one.at("name") == info.at("name")) return one;
            return Json{};
        };
        stations.push_back({{"station", named("ListStations")},
                            {"info", info},
                            {"leds", named("GetLeds")},
                            {"tec", named("GetTec")}});
    }
    return {{"version", "9.8.7"}, {"stations", stations}};
}

class DpctlProgram : public testing::Test {
protected:
    Ran run(std::vector<std::string> arguments, Dpctl::As user = Dpctl::As::this_user)
    {
        arguments.insert(arguments.begin(), {"--socket", daemon.socket()});
        return dpctl(std::move(arguments), user);
    }
    FixtureDaemon daemon;
};

// ---------------------------------------------------------------- text

TEST_F(DpctlProgram, PrintsWhatTheRenderersMakeWithoutColourIntoAPipe)
{
    EXPECT_EQ(run({"status"}).out, dpctl::render_status(fixture("GetStatus"), false));
    EXPECT_EQ(run({"show"}).out, dpctl::render_show(show_document(), false));
    EXPECT_EQ(run({"io", "unwinder"}).out, dpctl::render_io(fixture("GetIo"), false));
    EXPECT_EQ(run({"diag", "16"}).out, dpctl::render_diagnosis(fixture("GetDiagnosis"), false));
    EXPECT_EQ(run({"counters"}).out, dpctl::render_counters(fixture("GetCounters"), false));
    EXPECT_EQ(run({"read", "7", "--station", "unwinder"}).out,
              "unwinder: tag 7 SPEED FEEDBACK is 50.00, raw 5000 (0x1388)\n");
    EXPECT_EQ(run({"version"}).out, "dpctl " DPSLAVE_VERSION "\ndpslaved 9.8.7 (org.dpslaved.Control)\n");
}

TEST_F(DpctlProgram, EndsWith0WhenAllIsFine)
{
    for (const char* subcommand :
         {"status", "show", "io", "diag", "counters", "bus", "events", "metrics", "version"}) {
        const Ran ran = run({subcommand});
        EXPECT_EQ(ran.exit, 0) << subcommand;
        EXPECT_EQ(ran.err, "") << subcommand;
    }
}

/// The first character that a terminal would execute, other than the ends of our own lines.
std::string executed_in(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0) return "no UTF-8";
        if (text[0] != '\n' && is_control(text.substr(0, length))) return printable(text.substr(0, length));
        text.remove_prefix(length);
    }
    return "";
}

TEST(DpctlOfAHostileReply, PrintsNothingThatATerminalExecutesAndKeepsOtherText)
{
    const FixtureDaemon daemon{" Z\u00FCrich\x1B[2J\u009B31m\u202E\r\n"};
    for (const char* words : {"status", "show", "io", "diag", "counters", "bus", "events", "metrics", "top",
                              "version", "doctor", "reload", "read 7", "read 1"}) {
        std::string word;
        std::vector<std::string> arguments{"--socket", daemon.socket()};
        for (std::istringstream all{words}; all >> word;) arguments.push_back(word);
        if (word == "7" || word == "1") arguments.insert(arguments.end(), {"--station", "unwinder"});
        for (const bool json : {false, true}) {
            if (json) arguments.push_back("--json");
            const Ran ran = dpctl(arguments);
            EXPECT_EQ(executed_in(ran.out), "") << words;
            EXPECT_EQ(executed_in(ran.err), "") << words;
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

INSTANTIATE_TEST_SUITE_P(EachSubcommand, DpctlJson,
                         testing::Values(JsonRow{"GetStatus", {"status"}}, JsonRow{"GetIo", {"io"}},
                                         JsonRow{"GetDiagnosis", {"diag"}},
                                         JsonRow{"GetCounters", {"counters"}}, JsonRow{"GetBus", {"bus"}},
                                         JsonRow{"GetEvents", {"events"}},
                                         JsonRow{"ReadTag", {"read", "7", "--station", "5"}},
                                         JsonRow{"WriteTag", {"write", "7", "50", "--station", "5"}},
                                         JsonRow{"SetTec", {"tec", "set", "TYPE", "2"}},
                                         JsonRow{"GetVersion", {"version"}}),
                         [](const auto& row) { return std::string{row.param.arguments[0]}; });

TEST_F(DpctlProgram, TakesItsOptionsBeforeAndBehindTheSubcommand)
{
    EXPECT_EQ(run({"--json", "status"}).out, run({"status", "--json"}).out);
}

TEST_F(DpctlProgram, PrintsARefusalAsJsonToo)
{
    const Ran ran = run({"read", "1", "--station", "5", "--json"});

    EXPECT_EQ(ran.exit, 5);
    EXPECT_EQ(
        Json::parse(ran.out),
        Json::parse(
            R"({"error":"org.dpslaved.Control.DriveRefused","parameters":{"tag":1,"reason":"read only","code":1}})"));
    EXPECT_EQ(ran.err, "dpctl: tag 1: read only (Demand Data: error code 1)\n");
}

TEST_F(DpctlProgram, AloneShowsTheStatus)
{
    EXPECT_EQ(run({}).exit, 0);
    EXPECT_EQ(run({}).out, run({"status"}).out);
    EXPECT_EQ(run({"--json"}).out, run({"status", "-j"}).out);
}

TEST_F(DpctlProgram, ShowsOneStationOfStatus)
{
    EXPECT_EQ(run({"status", "-s", "16"}).out, run({"status", "16"}).out);
    const Ran one = run({"status", "16"});
    EXPECT_EQ(one.exit, 0);
    EXPECT_THAT(one.out, HasSubstr("rewinder"));
    EXPECT_THAT(one.out, Not(HasSubstr("unwinder")));
    EXPECT_EQ(Json::parse(run({"status", "unwinder", "--json"}).out).at("stations"),
              Json::array({fixture("GetStatus").at("stations").at(0)}));
}

TEST_F(DpctlProgram, JoinsWhatIsKnownOfAStationInTheJsonOfShow)
{
    const Ran ran = run({"show", "--json"});

    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json, show_document());
    for (const auto& [method, key] :
         {std::pair{"ListStations", "station"}, {"GetInfo", "info"}, {"GetLeds", "leds"}})
        EXPECT_EQ(schema_fault(control_varlink(), control_varlink().outputs.at(method),
                               {{"stations", Json::array({json.at("stations").at(0).at(key)})}}),
                  "");
    EXPECT_EQ(ran.exit, 0);
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
              "unwinder: tag 7 SPEED FEEDBACK is 50.00, raw 5000 (0x1388)\n"
              "unwinder: tag 7 SPEED FEEDBACK is now 50.00, raw 5000 (0x1388)\n");
}

TEST_F(DpctlProgram, WritesByNumberOrByAWholeNameOnly)
{
    for (const char* tag : {"7", "007", "0x7", "speed feedback", "SPEED FEEDBACK"}) {
        EXPECT_EQ(run({"write", tag, "50", "--station", "5"}).exit, 0) << tag;
        EXPECT_EQ(daemon.written().at("tag"), 7) << tag;
    }
    for (const char* tag : {"speed", "speed f", "torq", "colour"}) {
        const Ran ran = run({"write", tag, "99", "--station", "5"});
        EXPECT_EQ(ran.exit, 2) << tag;
        EXPECT_EQ(ran.out, "") << tag;
        EXPECT_THAT(ran.err, StartsWith("dpctl: no tag of unwinder is called '" + std::string{tag} +
                                        "': write the number, or the whole name\n"));
    }
    EXPECT_EQ(run({"write", "7-8", "99", "--station", "5"}).exit, 2);
    EXPECT_EQ(run({"write", "7,8", "99", "--station", "5"}).exit, 2);
    EXPECT_EQ(daemon.written().at("value"), "50") << "nothing else was written";
}

TEST_F(DpctlProgram, OnATerminalAsksBeforeItWrites)
{
    Dpctl no{{"--socket", daemon.socket(), "write", "7", "50", "--station", "5"}, Dpctl::As::this_user, true};
    EXPECT_TRUE(no.prints("tag 7 SPEED FEEDBACK is 50.00"));
    no.type("n\n");
    const Ran refused = no.wait();
    EXPECT_EQ(refused.exit, 1);
    EXPECT_EQ(refused.err, "Write 50? [y/N] dpctl: nothing was written\n");
    EXPECT_TRUE(daemon.written().empty());

    Dpctl yes{
        {"--socket", daemon.socket(), "write", "7", "50", "--station", "5"}, Dpctl::As::this_user, true};
    yes.type("y\n");
    EXPECT_EQ(yes.wait().exit, 0);
    EXPECT_EQ(daemon.written().at("tag"), 7);

    Dpctl at_once{{"--socket", daemon.socket(), "write", "8", "50", "--station", "5", "--yes"},
                  Dpctl::As::this_user,
                  true};
    EXPECT_EQ(at_once.wait().exit, 0);
    EXPECT_EQ(daemon.written().at("tag"), 8);
}

TEST_F(DpctlProgram, EndsWith5AndAReasonWhenItIsRefused)
{
    const Ran station = run({"show", "winder"});
    EXPECT_EQ(station.exit, 2) << "apart from what is refused";
    EXPECT_EQ(station.err, "dpctl: there is no station 'winder'; there are: unwinder, rewinder\n");

    const Ran which = run({"read", "7"});
    EXPECT_EQ(which.exit, 2);
    EXPECT_EQ(which.err, "dpctl: there are several stations, name one: unwinder, rewinder\n"
                         "Add its name to the command, for example: --station unwinder\n");

    const Ran drive = run({"write", "1", "5", "--station", "5"});
    EXPECT_EQ(drive.exit, 5);
    EXPECT_THAT(drive.out, StartsWith("its value is not known: tag 1: read only"));
    EXPECT_EQ(drive.err, "dpctl: tag 1: read only (Demand Data: error code 1)\n");
}

TEST_F(DpctlProgram, LetsAnOrdinaryUserReadButNotWrite)
{
    if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";

    EXPECT_EQ(run({"read", "7", "--station", "5"}, Dpctl::As::unprivileged).exit, 0);
    const Ran ran = run({"write", "7", "5", "--station", "5"}, Dpctl::As::unprivileged);
    EXPECT_EQ(ran.exit, 5);
    EXPECT_THAT(ran.err, StartsWith("dpctl: only root and members of the group 'dpslaved' may do this"));
}

TEST_F(DpctlProgram, EndsWith4WhenTheDaemonIsSilent)
{
    const Ran ran = run({"read", "2", "--station", "5", "--timeout", "0.1"});

    EXPECT_EQ(ran.exit, 4);
    EXPECT_THAT(ran.err, HasSubstr("no answer within 100 ms"));
}

// ---------------------------------------------------------------- reload

TEST_F(DpctlProgram, ReloadsForOperatorsOnly)
{
    const Ran ran = run({"reload"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.out, dpctl::render_reload(report::read<report::ReloadReply>(fixture("Reload")), false));
    EXPECT_EQ(Json::parse(run({"reload", "--json"}).out), fixture("Reload"));
    if (::geteuid() == 0) {
        EXPECT_EQ(run({"reload"}, Dpctl::As::unprivileged).exit, 5);
    }
}

TEST_F(DpctlProgram, ReloadsWithoutATerminalButCarefullyRefusesToTakeAStationOutOfItsExchange)
{
    daemon.set_state("rewinder", "Data_Exch"); // the plan takes it off the bus
    EXPECT_EQ(run({"reload"}).exit, 0) << "as a service does";
    const Ran ran = run({"reload", "--careful"});
    EXPECT_EQ(ran.exit, 5);
    EXPECT_THAT(ran.err,
                HasSubstr("not reloaded: a master exchanges data with rewinder, which would leave the bus"));
    EXPECT_EQ(run({"reload", "--careful", "--json"}).exit, 5);

    daemon.set_state("rewinder", "Wait_Prm");
    EXPECT_EQ(run({"reload", "--careful"}).exit, 0);
}

TEST_F(DpctlProgram, OnATerminalAsksBeforeAReloadTakesAStationOutOfItsExchange)
{
    const auto reload = [&](const std::string& typed, const std::string& option = "--timeout=5") {
        Dpctl running{{"--socket", daemon.socket(), "reload", option}, Dpctl::As::this_user, true};
        if (!typed.empty()) running.type(typed);
        return running.wait();
    };
    daemon.set_state("rewinder", "Data_Exch");
    const Ran no = reload("n\n");
    EXPECT_EQ(no.exit, 1);
    EXPECT_THAT(no.err, HasSubstr("A master exchanges data with rewinder, which would leave the bus. Reload? "
                                  "[y/N] dpctl: nothing was changed\n"));
    EXPECT_EQ(reload("y\n").exit, 0);
    EXPECT_EQ(reload("", "--yes").exit, 0);

    daemon.set_state("rewinder", "Wait_Prm");
    EXPECT_EQ(reload("").exit, 0) << "it is not asked";
}

// ---------------------------------------------------------------- TEC OPTION

TEST_F(DpctlProgram, SetsAnInputOfTheFunctionBlock)
{
    const Json wanted = Json::object({{"station", "5"}, {"parameter", "RIDE THROUGH"}, {"value", "-1"}});

    const Ran ran = run({"tec", "set", "RIDE THROUGH", "-1", "--station", "5"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(daemon.written(), wanted);
    EXPECT_THAT(ran.out, HasSubstr("anything other than zero could compromise safety.\n"));

    EXPECT_EQ(Json::parse(run({"tec", "set", "TYPE", "PROFIBUS DP", "--json"}).out), fixture("SetTec"));
    EXPECT_EQ(daemon.written(), Json::object({{"parameter", "TYPE"}, {"value", "PROFIBUS DP"}}));
}

TEST_F(DpctlProgram, SaysWhyAnInputOfTheFunctionBlockCannotBeSet)
{
    const Ran ran = run({"tec", "set", "FAULT", "1"});

    EXPECT_EQ(ran.exit, 5);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "dpctl: FAULT cannot be set to '1': it is an output\n");
}

// ---------------------------------------------------------------- no daemon

TEST(DpctlWithoutDaemon, EndsWith3AndSaysWhatToDo)
{
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"status"},
                                               {"status", "--follow"},
                                               {"status", "--wait", "30", "--quiet"},
                                               {"io"},
                                               {"io", "--follow"},
                                               {"diag"},
                                               {"counters"},
                                               {"metrics"},
                                               {"bus"},
                                               {"tec", "set", "TYPE", "2"},
                                               {"read", "7"},
                                               {"write", "7", "1"}}) {
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"--socket", "/nonexistent/control.sock"});
        const Ran ran = dpctl(all);
        EXPECT_EQ(ran.exit, 3) << arguments[0];
        EXPECT_EQ(ran.out, "") << arguments[0];
        EXPECT_EQ(
            ran.err,
            "dpctl: nothing answers on /nonexistent/control.sock (No such file or directory)\n"
            "Check whether dpslaved runs: systemctl status dpslaved. Or start it: dpslaved --config FILE\n"
            "journalctl -u dpslaved says why it does not start.\n"
            "Without dpslaved no station is on the bus: the lamps are off, as without power.\n")
            << arguments[0];
    }
}

TEST(DpctlWithoutDaemon, ShowReadsOptionVersionZero)
{
    const Ran ran = dpctl({"show", "--socket", "/nonexistent/control.sock"});

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

TEST(DpctlWithoutDaemon, ASocketThatTheUserMayNotReachCountsAsNoDaemon)
{
    if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "closed");
    std::filesystem::permissions(folder.path() / "closed", std::filesystem::perms::owner_all);

    const Ran ran = dpctl({"status", "--socket", folder.path() / "closed" / "s"}, Dpctl::As::unprivileged);

    EXPECT_EQ(ran.exit, 3);
    EXPECT_THAT(ran.err, HasSubstr("Permission denied"));
}

} // namespace
} // namespace dpslave::test
