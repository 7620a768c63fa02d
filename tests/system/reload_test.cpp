// SPDX-License-Identifier: Apache-2.0
// A new configuration for a daemon that serves: by dpctl reload and by SIGHUP.
// Only here: a set of stations that is changed under a running bus thread, by a signal or a call.
#include "gateway.hpp"
#include "support/paths.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <sstream>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// In `text` the first `from` behind `behind` becomes `to`.
std::string changed(std::string text, const std::string& behind, const std::string& from,
                    const std::string& to)
{
    const auto at = text.find(from, text.find(behind));
    if (at == std::string::npos) throw std::runtime_error(from + " does not stand behind " + behind);
    return text.replace(at, from.size(), to);
}

/// What dpctl printed, without the warnings: the bus of these tests has a max_tsdr that is one.
std::string changes_in(const Outcome& outcome)
{
    std::istringstream lines{outcome.out};
    std::string all;
    for (std::string line; std::getline(lines, line);)
        if (line.rfind("warning: ", 0) != 0) all += line + '\n';
    return all;
}

class Reload : public ::testing::Test {
protected:
    explicit Reload(Wiring wiring = {.units = {"00", "01"}}) : gateway{std::move(wiring)} {}

    Outcome reload(const std::string& wanted)
    {
        write_file(gateway.config(), wanted);
        return gateway.dpctl({"reload"});
    }
    /// The configuration without its last station.
    std::string without_rewinder() const { return text.substr(0, text.rfind("[[station]]")); }

    /// The rewinder's master goes on without a word, as one whose watchdog is off may.
    void rewinder_exchanges()
    {
        Master master{gateway, {"--tags", "55,56w", "--no-watchdog"}, 6};
        ASSERT_TRUE(master.does("start 60s"));
        EXPECT_TRUE(master.does("out 1 = 500"));
        EXPECT_TRUE(gateway.drive().says("unit 01: tag 56 written 5.00"));
        EXPECT_TRUE(master.does("stop"));
        EXPECT_TRUE(master.leaves());
    }

    Gateway gateway;
    const std::string text = gateway.config_text();
};

/// Two searches for the drive of the rewinder, of which one waits for the other, and a reload.
class ReloadWhileSearching : public Reload {
protected:
    void expect_that_both_end_with(const std::string& wanted)
    {
        const Arguments search = gateway.dpctl_command({"doctor", "--probe", "rewinder"});
        Process first{search}, second{search};
        EXPECT_TRUE(first.says("at most; Ctrl-C ends it"));
        EXPECT_TRUE(second.says("at most; Ctrl-C ends it"));

        EXPECT_EQ(reload(wanted).status, 0);

        for (Process* const one : {&first, &second}) {
            EXPECT_TRUE(one->says("was ended: the station was changed or removed by a reload"));
            EXPECT_EQ(one->wait(), 1);
        }
        EXPECT_EQ(reload(text).status, 0);
        Process next{gateway.dpctl_command({"doctor", "--probe", "unwinder"})};
        EXPECT_TRUE(next.says("at most; Ctrl-C ends it")) << "another search is possible";
        EXPECT_EQ(next.end(SIGINT), 1);
    }
    /// A line at another port, which is missing, has taken the place of the one there was.
    std::string with_another_line() const
    {
        const std::string moved = changed(text, "[[line]]", "port = \"", "port = \"/nowhere");
        return std::regex_replace(moved, std::regex{"\"p3\""}, "\"p4\"");
    }
};

TEST_F(ReloadWhileSearching, EndsTheSearchesForADriveWhoseStationLeaves)
{
    expect_that_both_end_with(without_rewinder());
}

TEST_F(ReloadWhileSearching, EndsTheSearchesForADriveWhoseLineLeaves)
{
    expect_that_both_end_with(with_another_line());
}

/// The unwinder in data exchange, with a word in each direction that is not zero.
class ReloadInService : public Reload {
protected:
    explicit ReloadInService(Wiring wiring = {.units = {"00", "01"}}) : Reload{std::move(wiring)}
    {
        gateway.drive().send_line("unit 00");
        gateway.drive().send_line("set 55 12.50");
        EXPECT_TRUE(master.does("start 60s"));
        EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
        EXPECT_TRUE(master.does("follow on"));
        EXPECT_TRUE(master.does("out 1 = 700"));
        EXPECT_TRUE(gateway.drive().says("unit 00: tag 56 written 7.00"));
        gateway.drive().skip();
    }
    /// Nothing of all that was noticed at address 5. What the slave counts is judged and not what the master
    /// misses: that also depends on what else the machine has to do.
    void unwinder_noticed_nothing()
    {
        EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
        EXPECT_FALSE(master.ever_said("in 1 is 0")) << "each change was shown since the start";
        EXPECT_TRUE(master.does("wait 60s for state data-exchange"));
        EXPECT_EQ(gateway.station(0).at("name"), "unwinder");
        EXPECT_EQ(gateway.station(0).at("left_count"), 0);
        EXPECT_EQ(gateway.drive().how_often("unit 00: tag 56 written 0.00"), 0U);
        gateway.drive().send_line("unit 00");
        gateway.drive().send_line("set 55 13.00");
        EXPECT_TRUE(master.does("wait 60s for in 1 = 1300")) << "and its drive is served";
        EXPECT_TRUE(master.does("out 1 = 800"));
        EXPECT_TRUE(gateway.drive().says("unit 00: tag 56 written 8.00"));
    }

    Master master{gateway, {"--tags", "55,56w"}, 5};
};

TEST_F(Reload, ZeroesTheOutputsOfAStationThatIsRemoved)
{
    rewinder_exchanges();
    const Outcome outcome = reload(without_rewinder());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(changes_in(outcome), "station rewinder removed\n");
    EXPECT_TRUE(gateway.drive().says("unit 01: tag 56 written 0.00"));
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 1U);
    Master master{gateway, {"--tags", "55"}, 6};
    EXPECT_FALSE(master.does("start 500ms") && master.does("expect state data-exchange"));
    EXPECT_TRUE(master.ever_said("station 6 does not answer"));
}

TEST_F(Reload, CarefullyRefusesToTakeAStationOutOfItsExchangeButTheUnitDoesIt)
{
    Master master{gateway, {"--tags", "55"}, 6};
    ASSERT_TRUE(master.does("start 60s"));
    write_file(gateway.config(), without_rewinder());

    const Outcome careful = gateway.dpctl({"reload", "--careful"});
    EXPECT_EQ(careful.status, 5);
    EXPECT_THAT(careful.err, HasSubstr("a master exchanges data with rewinder, which would leave the bus"));
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 2U);

    const std::string unit = content(source_path("systemd/dpslaved.service.in"));
    EXPECT_THAT(unit, HasSubstr("\nExecReload=!@BIN@/dpctl --socket @SOCKET@ reload\n"));
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0);
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 1U);
}

TEST_F(Reload, RemovesTheRightStationAlsoAfterTheirOrderWasAnother)
{
    const auto first = text.find("[[station]]"), second = text.rfind("[[station]]");
    const std::string turned =
        text.substr(0, first) + text.substr(second) + "\n" + text.substr(first, second - first);
    EXPECT_EQ(changes_in(reload(turned)), "lines or stations are in another order\n");

    EXPECT_EQ(changes_in(reload(without_rewinder())), "station rewinder removed\n");
    EXPECT_EQ(gateway.station().at("name"), "unwinder");
    Master master{gateway, {"--tags", "55"}};
    EXPECT_TRUE(master.does("start 60s"));
}

TEST_F(Reload, ZeroesTheOutputsOfAStationThatIsChangedAndStartsItAnew)
{
    rewinder_exchanges();
    const Outcome outcome =
        reload(changed(text, "rewinder", "output_refresh_s", "demand.error_base = 1\noutput_refresh_s"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(changes_in(outcome),
              "station rewinder changed: it leaves the bus and starts again at address 6 (its "
              "Demand Data or other abilities)\n");
    EXPECT_TRUE(gateway.drive().says("unit 01: tag 56 written 0.00"));
    Master master{gateway, {"--tags", "55,56w"}, 6};
    EXPECT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 300"));
    EXPECT_TRUE(gateway.drive().says("unit 01: tag 56 written 3.00"));
    EXPECT_EQ(gateway.drive().how_often("unit 01: tag 56 written 0.00"), 0U)
        << "no late zero comes behind it";
}

TEST_F(ReloadInService, OfOtherStationsOnTheSameLineIsNotNoticed)
{
    const std::string other =
        changed(text, "rewinder", "output_refresh_s", "demand.error_base = 1\noutput_refresh_s");
    EXPECT_THAT(reload(other).out, HasSubstr("rewinder changed"));
    EXPECT_THAT(reload(without_rewinder()).out, HasSubstr("rewinder removed"));
    EXPECT_THAT(reload(text).out, HasSubstr("station rewinder added at address 6"));
    unwinder_noticed_nothing();
}

TEST_F(ReloadInService, ThatAddsAndRemovesALineIsNotNoticed)
{
    Process line{{program_path("dpsim"), "line", "--baud", "38400", "--bits", "10", "--a",
                  gateway.folder("other-drive"), "--b", gateway.folder("other-gateway")}};
    ASSERT_TRUE(line.says("ready"));
    Process drive{{program_path("dpsim"), "drive", "--profile", "590", "--port",
                   gateway.folder("other-drive"), "--baud", "38400", "--log", "--table",
                   source_path("config/tags/example.csv"), "--unit", "00"}};
    ASSERT_TRUE(drive.says("ready"));

    std::string more = text;
    more += fmt::format(
        "[[line]]\nname = \"p4\"\nport = \"{}\"\nprotocol = \"ei-ascii\"\nbaud = 38400\n"
        "[[station]]\nname = \"dancer\"\naddress = 7\nprofile = \"590\"\nline = \"p4\"\nunit = \"00\"\n"
        "tags = \"{}/config/tags/example.csv\"\n",
        gateway.folder("other-gateway").string(), source_path());
    const Outcome added = reload(more);
    EXPECT_EQ(added.status, 0) << added.err;
    EXPECT_THAT(added.out, HasSubstr("line p4 added"));
    EXPECT_TRUE(gateway.daemon().says("dancer: the drive answers"));
    EXPECT_EQ(gateway.dpctl({"write", "56", "4.00", "--station", "dancer"}).status, 0);
    EXPECT_TRUE(drive.says("tag 56 written 4.00"));

    EXPECT_THAT(reload(text).out, HasSubstr("line p4 removed"));
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 2U);
    unwinder_noticed_nothing();
    EXPECT_THAT(reload(more).out, HasSubstr("line p4 added")) << "its port was let go";
    EXPECT_TRUE(gateway.daemon().says("dancer: the drive answers"));
}

TEST_F(ReloadInService, ThatSetsTheLineInAnotherWayKeepsItsStationsInDataExchange)
{
    const Outcome outcome = reload(changed(text, "[[line]]", "protocol", "timeout_ms = 250\nprotocol"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("line p3 changed"));
    unwinder_noticed_nothing();
}

TEST_F(ReloadInService, WithFaultsNamesThemAllAndTheOldConfigurationRunsOn)
{
    std::string faulty = changed(without_rewinder(), "unwinder", "\"590\"", "\"591\"");
    faulty += "adress = 7\n";
    const Outcome outcome = reload(faulty);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("there is no profile \"591\""));
    EXPECT_THAT(outcome.err, HasSubstr("adress"));
    EXPECT_THAT(outcome.err, HasSubstr("the old one stays in use"));
    EXPECT_TRUE(gateway.daemon().says("the new configuration is refused"));
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 2U);
    unwinder_noticed_nothing();
}

TEST_F(ReloadInService, WithALineThatCannotBeOpenedIsTakenWithAWarning)
{
    const Outcome outcome = reload(
        without_rewinder() + "[[line]]\nname = \"p4\"\nport = \"/dev/not-there\"\nprotocol = \"ei-ascii\"\n");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out + outcome.err, HasSubstr("/dev/not-there is not there"));
    EXPECT_THAT(outcome.out, HasSubstr("line p4 added"));
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 1U);
    unwinder_noticed_nothing();
}

TEST_F(ReloadInService, OfTheBusIsRefusedByTheNameOfTheKeys)
{
    const Outcome outcome = reload(changed(text, "[bus]", "baud = 187500", "baud = 93750"));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("[bus] baud cannot change while the bus is served"));
    EXPECT_THAT(outcome.err, HasSubstr("systemctl restart dpslaved"));
    unwinder_noticed_nothing();
}

TEST_F(ReloadInService, OfTheSameFileDoesNothingAlsoBySignal)
{
    EXPECT_EQ(changes_in(reload("# a comment\n" + text)), "Nothing has changed.\n");
    gateway.daemon().skip();
    gateway.daemon().send(SIGHUP);
    EXPECT_TRUE(gateway.daemon().says("nothing has changed"));
    unwinder_noticed_nothing();
}

TEST_F(ReloadInService, OfAnotherAddressOfAnOptionBoardIsPendingUntilTheNextStart)
{
    const Outcome outcome = reload(changed(text, "unwinder", "address = 5", "address = 7"));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out,
                HasSubstr("pending: station unwinder: address 7 takes effect at the next start"));
    EXPECT_TRUE(gateway.daemon().says("address 7 takes effect at the next start"));
    const Json info = gateway.json({"show", "unwinder"}).at("stations").at(0).at("info");
    EXPECT_EQ(info.at("address_active"), 5);
    EXPECT_EQ(info.at("address_pending"), 7);
    EXPECT_TRUE(master.does("wait 60s for state data-exchange"));
    EXPECT_EQ(gateway.station(0).at("left_count"), 0);

    EXPECT_EQ(changes_in(reload(text)), "Nothing has changed.\n") << "taken back";
    EXPECT_TRUE(
        gateway.json({"show", "unwinder"}).at("stations").at(0).at("info").at("address_pending").is_null());
}

TEST_F(Reload, BySignalAppliesWhatHasChanged)
{
    write_file(gateway.config(), without_rewinder());
    gateway.daemon().send(SIGHUP);
    EXPECT_TRUE(gateway.daemon().says("station rewinder removed"));
    EXPECT_TRUE(eventually([&] { return gateway.json({"status"}).at("stations").size() == 1; }));
}

TEST_F(Reload, BySeveralAtOnceIsAnsweredToEach)
{
    write_file(gateway.config(), without_rewinder());
    Process first{gateway.dpctl_command({"reload"})}, second{gateway.dpctl_command({"reload"})};
    EXPECT_EQ(first.wait(), 0);
    EXPECT_EQ(second.wait(), 0);
    EXPECT_EQ(gateway.json({"status"}).at("stations").size(), 1U);
}

TEST_F(Reload, ReportsARemovedStationToItsWatcher)
{
    Process watch{gateway.dpctl_command({"status", "rewinder", "--follow"})};
    Process all{gateway.dpctl_command({"status", "--follow", "--json"})};
    EXPECT_TRUE(watch.says("Wait_Prm"));
    EXPECT_TRUE(all.says("rewinder"));
    EXPECT_EQ(reload(without_rewinder()).status, 0);
    EXPECT_EQ(watch.wait(), 2) << "there is no such station";
    EXPECT_TRUE(watch.ever_said("rewinder"));
    EXPECT_EQ(reload(text).status, 0);
    EXPECT_TRUE(all.says("rewinder")) << "who watches all of them sees those who come";
}

/// Sends `calls` in one go, says "sent", and prints the replies, one a line.
std::vector<std::string> caller_of(const Gateway& gateway, const std::vector<std::string>& calls)
{
    const std::string script = "import socket, sys\n"
                               "s = socket.socket(socket.AF_UNIX)\n"
                               "s.connect(sys.argv[1])\n"
                               "s.sendall(b''.join(call.encode() + b'\\0' for call in sys.argv[2:]))\n"
                               "print('sent', flush=True)\n"
                               "got = b''\n"
                               "while got.count(b'\\0') < len(sys.argv) - 2:\n"
                               "    more = s.recv(65536)\n"
                               "    assert more, got\n"
                               "    got += more\n"
                               "for reply in got.split(b'\\0')[:-1]:\n"
                               "    print(reply.decode(), flush=True)\n";
    std::vector<std::string> command{"/usr/bin/python3", "-c", script, gateway.socket().string()};
    command.insert(command.end(), calls.begin(), calls.end());
    return command;
}

constexpr const char* kReadOfRewinder =
    R"({"method":"org.dpslaved.Control.ReadTag","parameters":{"station":"rewinder","tag":55}})";

/// A line that waits so long for its drives that a read still waits when the reload comes, on a busy machine
/// too.
class ReloadOfALineThatWaits : public Reload {
protected:
    ReloadOfALineThatWaits() : Reload{{.units = {"00", "01"}, .line_keys = "timeout_ms = 10000\n"}}
    {
        gateway.drive().send_line("unit 01");
        gateway.drive().send_line("slow 30s");
    }
};

TEST_F(ReloadOfALineThatWaits, RefusesAReadOfADriveWhoseStationLeaves)
{
    Process caller{caller_of(gateway, {kReadOfRewinder})};
    ASSERT_TRUE(caller.says("sent"));
    ASSERT_TRUE(eventually([this] { return gateway.json({"status"}).contains("pid"); })); // and it was heard

    EXPECT_EQ(reload(without_rewinder()).status, 0);
    EXPECT_TRUE(caller.says("org.dpslaved.Control.DriveRefused"));
    EXPECT_EQ(caller.wait(), 0);
}

/// Three calls in one go: the first is answered in the middle of the reload, and the others right behind it.
TEST_F(ReloadOfALineThatWaits, AnswersCallsBehindOneWhoseStationHasGoneOutOfTheNewConfiguration)
{
    Process caller{caller_of(gateway, {kReadOfRewinder, R"({"method":"org.dpslaved.Control.GetLeds"})",
                                       R"({"method":"org.dpslaved.Control.GetInfo"})"})};
    ASSERT_TRUE(caller.says("sent"));
    ASSERT_TRUE(eventually([this] { return gateway.json({"status"}).contains("pid"); })); // and it was heard

    write_file(gateway.config(), without_rewinder());
    EXPECT_EQ(gateway.dpctl({"reload", "--json"}).status, 0); // one call: the drive is given up soon
    EXPECT_EQ(caller.wait(), 0);
    EXPECT_FALSE(caller.ever_said("\"name\":\"rewinder\""));
    EXPECT_TRUE(caller.ever_said("\"name\":\"unwinder\""));
}

TEST_F(Reload, TakesOverOtherLamps)
{
    const std::string lamp = gateway.make_led("other");
    const Outcome outcome = reload(text + "[station.leds]\nred = \"led:other\"\n");
    EXPECT_EQ(changes_in(outcome), "station rewinder: other lamps\n");
    EXPECT_TRUE(eventually([&] { return content(lamp) == "1"; })) << "external fault: there is no master";
    EXPECT_EQ(reload(text).status, 0);
    EXPECT_TRUE(eventually([&] { return content(lamp) == "0"; }));
}

// ---- what is applied in the running exchange

class ReloadOfATable : public ReloadInService {
protected:
    static constexpr const char* kRows = "tag,name,type,decimals,min,max,access\n"
                                         "55,SPEED,REAL,2,,,\n"
                                         "56,SETPOINT,REAL,2,-200,200,\n";
    ReloadOfATable() : ReloadInService{{.units = {"00", "01"}, .table = kRows}} {}

    Outcome reload_rows(const std::string& rows)
    {
        write_file(gateway.folder("tags.csv"), rows);
        return gateway.dpctl({"reload"});
    }
};

TEST_F(ReloadOfATable, ThatRenamesATagAndAddsARowIsNotNoticed)
{
    std::string rows = kRows;
    rows.replace(rows.find("SPEED"), 5, "LINE SPEED");
    const Outcome outcome = reload_rows(rows + "57,CURRENT,REAL,1,,,\n");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(changes_in(outcome), "station unwinder: 2 rows of its tag table\n"
                                   "station rewinder: 2 rows of its tag table\n");
    EXPECT_TRUE(gateway.word_becomes(55, "name", "LINE SPEED"));
    EXPECT_EQ(gateway.dpctl({"read", "57", "--station", "unwinder"}).status, 5)
        << "the drive has no such tag";
    unwinder_noticed_nothing();
}

TEST_F(ReloadOfATable, NamesInADryRunTheStationsThatWouldLeaveTheBusAndDoesNothing)
{
    std::string rows = kRows;
    rows.replace(rows.find("SPEED,REAL,2"), 12, "SPEED,REAL,1");
    write_file(gateway.folder("tags.csv"), rows);
    const Outcome outcome = gateway.dpctl({"reload", "--dry-run"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("leaves the bus: unwinder (tag 55, which the master uses, would be "
                                       "another value)\n"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("leaves the bus: rewinder"))) << "no master uses it";
    EXPECT_THAT(outcome.out, HasSubstr("Nothing was changed"));
    write_file(gateway.folder("tags.csv"), kRows);
    EXPECT_EQ(changes_in(gateway.dpctl({"reload"})), "Nothing has changed.\n");
    unwinder_noticed_nothing();
}

TEST_F(ReloadOfATable, IsDoneAgainAndAgainWithoutALossOfTheExchange)
{
    const char* const often = std::getenv("RELOADS"); // RELOADS=200 for a longer run
    const int reloads = often != nullptr ? std::stoi(often) : 20;
    for (int i = 0; i < reloads; ++i) {
        write_file(gateway.folder("tags.csv"),
                   kRows + std::string{"57,CURRENT,REAL,"} + (i % 2 == 0 ? "1" : "2") + ",,,\n");
        const Outcome outcome = gateway.dpctl({"reload", "--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        ASSERT_THAT(outcome.out, HasSubstr("1 row of its tag table"));
    }
    unwinder_noticed_nothing();
}

// ---- another port

/// A second drive line, and on it a drive of its own.
class ReloadOfPorts : public Reload {
protected:
    ReloadOfPorts() : Reload{{.units = {"00"}}}
    {
        gateway.drive().send_line("set 55 12.50");
        EXPECT_TRUE(master.does("start 60s"));
        EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
        EXPECT_TRUE(master.does("out 1 = 700"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 7.00"));
        gateway.drive().skip();
        EXPECT_TRUE(is_joined);
        EXPECT_TRUE(drive.says("ready"));
        drive.send_line("set 55 33.00");
    }
    std::string port(const std::string& name) const { return gateway.folder(name).string(); }
    void no_fault_was_logged()
    {
        EXPECT_FALSE(gateway.daemon().ever_said(" error: "));
        EXPECT_FALSE(gateway.daemon().ever_said("does not answer"));
        EXPECT_FALSE(gateway.daemon().ever_said("another program"));
    }

    Master master{gateway, {"--tags", "55,56w"}, 5};
    Process line{{program_path("dpsim"), "line", "--baud", "38400", "--bits", "10", "--a",
                  gateway.folder("other-drive"), "--b", gateway.folder("other-gateway")}};
    bool is_joined = line.says("ready"); ///< before the drive opens its end
    Process drive{{program_path("dpsim"), "drive", "--profile", "590", "--port",
                   gateway.folder("other-drive"), "--baud", "38400", "--log", "--table",
                   source_path("config/tags/example.csv"), "--unit", "00"}};
};

TEST_F(ReloadOfPorts, WritesStandingOutputsAtTheNewOneAndLeavesTheOldDriveSafe)
{
    const Outcome outcome = reload(changed(text, "[[line]]", port("drive-gateway"), port("other-gateway")));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("line p3 moves from"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00"));
    EXPECT_TRUE(drive.says("tag 56 written 7.00"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 3300"));
    EXPECT_EQ(gateway.station(0).at("left_count"), 0);
    EXPECT_EQ(drive.how_often("tag 56 written 0.00"), 0U);
    no_fault_was_logged();
}

TEST_F(ReloadOfPorts, ToOneThatIsNotThereIsTakenWithAWarningAndOpenedWhenItAppears)
{
    write_file(gateway.config(), changed(text, "[[line]]", port("drive-gateway"), port("no-such-port")));
    const Outcome dry = gateway.dpctl({"reload", "--dry-run"});
    EXPECT_EQ(dry.status, 0);
    EXPECT_THAT(dry.out, HasSubstr("no-such-port is not there"));
    const Outcome real = gateway.dpctl({"reload"});
    EXPECT_EQ(real.status, 0);
    EXPECT_THAT(real.out, HasSubstr("no-such-port is not there"));
    EXPECT_TRUE(eventually([&] { return !gateway.station().at("drive").at("port_open").get<bool>(); }));

    std::filesystem::create_symlink(std::filesystem::canonical(port("drive-gateway")), port("no-such-port"));
    EXPECT_TRUE(gateway.daemon().says("no-such-port is open"));
    gateway.drive().send_line("set 55 21.00");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 2100"));
}

TEST_F(ReloadOfPorts, OfTwoLinesThatSwapThemIsWithoutAFault)
{
    std::string both = text;
    both += fmt::format(
        "[[line]]\nname = \"p4\"\nport = \"{}\"\nprotocol = \"ei-ascii\"\nbaud = 38400\n"
        "[[station]]\nname = \"dancer\"\naddress = 7\nprofile = \"590\"\nline = \"p4\"\nunit = \"00\"\n"
        "tags = \"{}/config/tags/example.csv\"\n",
        port("other-gateway"), source_path());
    ASSERT_EQ(reload(both).status, 0);
    const auto dancer_answers = [&] { return gateway.station(1).at("drive").at("link") == "answers"; };
    EXPECT_TRUE(eventually(dancer_answers));

    std::string swapped = changed(both, "[[line]]", port("drive-gateway"), "SWAP");
    swapped = changed(swapped, "\"p4\"", port("other-gateway"), port("drive-gateway"));
    const Outcome outcome = reload(changed(swapped, "[[line]]", "SWAP", port("other-gateway")));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(drive.says("tag 56 written 7.00"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 3300"));
    EXPECT_TRUE(eventually(dancer_answers));
    EXPECT_EQ(drive.how_often("tag 56 written 0.00"), 0U);
    EXPECT_EQ(gateway.drive().how_often("tag 56 written 0.00"), 0U);
    for (const std::size_t i : {0U, 1U}) EXPECT_EQ(gateway.station(i).at("left_count"), 0);
    no_fault_was_logged();
}

class ReloadOfBoxes : public Reload {
protected:
    ReloadOfBoxes() : Reload{{.profile = "605", .units = {"00", "01"}}} {}
};

TEST_F(ReloadOfBoxes, AppliesAnotherAddressAtOnceAndKeepsWhatWasSetByHandWhereNothingHasChanged)
{
    EXPECT_EQ(gateway.dpctl({"tec", "set", "EXT DIAGNOSTIC", "0x6AB5", "--station", "unwinder"}).status, 0);
    EXPECT_EQ(gateway.dpctl({"tec", "set", "ADDRESS", "20", "--station", "unwinder"}).status, 0);
    const Outcome outcome = reload(changed(text, "rewinder", "address = 6", "address = 8"));
    EXPECT_EQ(changes_in(outcome),
              "station rewinder changed: it leaves the bus and starts again at address 8 (address)\n");
    EXPECT_EQ(gateway.station(0).at("address"), 20);
    EXPECT_EQ(gateway.station(1).at("address"), 8);
    EXPECT_EQ(gateway.tec("EXT DIAGNOSTIC"), 0x6AB5);

    const Outcome taken = reload(changed(text, "rewinder", "address = 6", "address = 20"));
    EXPECT_EQ(taken.status, 1);
    EXPECT_THAT(taken.err,
                HasSubstr("address 20 is that of station unwinder now, to which it was set by hand"));
    EXPECT_EQ(gateway.station(1).at("address"), 8);
}

} // namespace
} // namespace dpslave::test
