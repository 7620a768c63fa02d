// SPDX-License-Identifier: Apache-2.0
// Tests how the daemon starts, does not start, and ends; what it reports to the service manager.
// Only here: processes that start and end, their sockets, ports and messages to systemd.
#include "gateway.hpp"
#include "service_manager.hpp"
#include "support/paths.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(End, BySigtermZeroesTheOutputsRemovesTheSocketAndIsASuccess)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));

    EXPECT_EQ(gateway.daemon().end(), 0);
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00"));
    EXPECT_FALSE(std::filesystem::exists(gateway.socket()));
    EXPECT_TRUE(master.does("wait 60s for state not data-exchange"));

    gateway.start_daemon();
    EXPECT_TRUE(master.does("wait 60s for state data-exchange")) << "and it can be started again at once";
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
}

TEST(Notify, ReportsReadinessStatesTheWatchdogAndTheEnd)
{
    const Folder folder;
    ServiceManager manager{folder / "notify"};
    Gateway gateway{{.environment = {{"NOTIFY_SOCKET", folder / "notify"}, {"WATCHDOG_USEC", "400000"}}}};
    EXPECT_TRUE(manager.hears("READY=1"));
    EXPECT_TRUE(manager.hears("STATUS=0 of 1 in Data_Exch; unwinder: Wait_Prm"));
    Master master{gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(manager.hears("STATUS=1 of 1 in Data_Exch; unwinder: Data_Exch with master 2"));
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(manager.hears("WATCHDOG=1"));
    gateway.drive().send_line("silence");
    EXPECT_TRUE(manager.hears("drive silent"));
    EXPECT_EQ(gateway.daemon().end(), 0);
    EXPECT_TRUE(manager.hears("STOPPING=1"));
}

TEST(Notify, ReportsThatAReloadBeginsAndIsOverAlsoWhenItIsRefused)
{
    const Folder folder;
    ServiceManager manager{folder / "notify"};
    Gateway gateway{{.environment = {{"NOTIFY_SOCKET", folder / "notify"}}}};
    EXPECT_TRUE(manager.hears("READY=1"));
    for (const char* const more : {"# nothing new\n", "[[line]]\n"}) {
        write_file(gateway.config(), gateway.config_text() + more);
        gateway.daemon().send(SIGHUP);
        EXPECT_TRUE(manager.hears("RELOADING=1"));
        EXPECT_TRUE(manager.hears("MONOTONIC_USEC="));
        EXPECT_TRUE(manager.hears("READY=1"));
    }
}

TEST(Start, WithoutStandardDescriptorsPutsNoOctetOnTheBus)
{
    for (const char* const closed : {"<&-", ">&- 2>&-", "<&- 2>&-", "<&- >&- 2>&-"}) {
        Gateway gateway{{.started = false}};
        Arguments command = gateway.daemon_command();
        command.insert(command.begin(), {"/bin/sh", "-c", std::string{R"(exec "$0" "$@" )"} + closed});
        const Process daemon{command};
        ASSERT_TRUE(eventually([&] { return gateway.dpctl({"status"}).status == 0; })) << closed;

        for (const int descriptor : {0, 1, 2}) {
            const std::string link =
                std::filesystem::read_symlink(fmt::format("/proc/{}/fd/{}", daemon.pid(), descriptor));
            EXPECT_TRUE(link == "/dev/null" || link.starts_with("pipe:")) << closed << ": " << link;
        }
        EXPECT_EQ(gateway.spoken_on_the_bus(), "b to a: 0 octets") << closed;
    }
}

TEST(Log, ShowsForeignTextWithoutWhatATerminalExecutes)
{
    Gateway gateway{{.started = false}};
    const auto file = gateway.folder("Z\u00FCrich\x1B[2J\u202E.toml");
    write_file(file, gateway.config_text());
    Arguments command = gateway.daemon_command();
    command.at(2) = file;
    Process daemon{command};
    ASSERT_TRUE(daemon.says("station(s) on"));

    daemon.send(SIGHUP);

    EXPECT_TRUE(daemon.says("Z\u00FCrich\\x1B[2J\\u202E.toml again"));
    EXPECT_FALSE(daemon.ever_said("\x1B"));
    EXPECT_FALSE(daemon.ever_said("\u202E"));
    EXPECT_EQ(daemon.end(), 0);
}

TEST(BadStart, NamesAllFaultsOfTheConfigurationInOneRunAndOpensNothing)
{
    Gateway gateway{{.units = {"00", "01"}, .started = false}};
    std::string text = gateway.config_text();
    text.replace(text.find("address = 6"), 11, "address = 5");
    text.replace(text.rfind("\"590\""), 5, "\"591\"");
    text += "adress = 7\n";
    const auto tags = text.rfind("tags = ");
    text.replace(tags, text.find('\n', tags) - tags, "tags = \"wrong.csv\"");
    write_file(gateway.config(), text);
    write_file(gateway.folder("wrong.csv"), "tag,name,type\n55,speed,INT\n56,setpoint,INTEGER\n");

    for (const Outcome& outcome : {gateway.run_daemon(), gateway.run_daemon({"--check"})}) {
        EXPECT_EQ(outcome.status, 1);
        EXPECT_THAT(outcome.err, HasSubstr("adress"));
        EXPECT_THAT(outcome.err, HasSubstr("address 5 is already on line"));
        EXPECT_THAT(outcome.err, HasSubstr("there is no profile \"591\""));
        EXPECT_THAT(outcome.err, HasSubstr("wrong.csv:3"));
        std::istringstream lines{outcome.err};
        for (std::string line; std::getline(lines, line);)
            EXPECT_THAT(line, StartsWith(gateway.folder("").string())) << "each fault with file and line";
    }
    EXPECT_FALSE(std::filesystem::exists(gateway.socket()));
    EXPECT_EQ(gateway.spoken_on_the_bus(), "b to a: 0 octets");
}

TEST(BadStart, WithoutConfigurationFileSaysWhichOneIsMissing)
{
    const Gateway gateway{{.started = false}};
    std::filesystem::remove(gateway.config());
    const Outcome outcome = gateway.run_daemon();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr(gateway.config().string()));
}

TEST(BadStart, ByWrongUsageEndsWithTwo)
{
    const Gateway gateway{{.started = false}};
    EXPECT_EQ(gateway.run_daemon({"--no-such-option"}).status, 2);
    EXPECT_EQ(gateway.run_daemon({"something"}).status, 2);
    EXPECT_EQ(run({program_path("dpslaved"), "--help"}).status, 0);
    EXPECT_EQ(run({program_path("dpslaved"), "--version"}).status, 0);
}

TEST(StartWithoutTheBusPort, IsSilentAndNamesItUntilThePortHasCome)
{
    Gateway gateway{{.profile = "590plus", .keys = "ident = 0x0A0C\n", .started = false}};
    gateway.unplug_bus();
    gateway.start_daemon();

    EXPECT_TRUE(gateway.daemon().says("bus-gateway is not there"));
    const auto is_open = [&] { return gateway.json({"status"}).at("bus").at("port_open").get<bool>(); };
    EXPECT_TRUE(eventually([&] { return !is_open(); }));
    constexpr int kHardware = 4;
    EXPECT_TRUE(eventually([&] { return gateway.tec("FAULT") == kHardware; }));
    EXPECT_THAT(gateway.dpctl({"doctor"}).out, HasSubstr("bus-gateway"));

    gateway.plug_bus();
    EXPECT_TRUE(eventually(is_open));
    EXPECT_TRUE(eventually([&] { return gateway.tec("FAULT") == 0; }));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("state") == "Wait_Prm"; }));
}

TEST(StartWithoutADrivePort, CostsItsOwnStationsOnlyUntilThePortAppears)
{
    Gateway gateway{{.started = false}};
    gateway.unplug_drive();
    gateway.start_daemon();

    EXPECT_TRUE(gateway.daemon().says("drive-gateway is not there"));
    EXPECT_TRUE(gateway.daemon().ever_said("its drives count as silent until it can be opened"));
    EXPECT_TRUE(eventually([&] { return !gateway.station().at("drive").at("port_open").get<bool>(); }));
    EXPECT_THAT(gateway.dpctl({"doctor"}).out, HasSubstr("of line p3 is not there, or cannot be opened"));
    EXPECT_THAT(gateway.dpctl({"events"}).out,
                HasSubstr("its drives count as silent until it can be opened"));

    gateway.plug_drive();
    EXPECT_TRUE(gateway.daemon().says("drive-gateway is open"));
    gateway.drive().send_line("set 55 12.50");
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(gateway.station().at("drive").at("port_open"));
}

TEST(BadStart, NextToARunningDaemonEndsWithThreeAndDoesNotDisturbIt)
{
    Gateway running;
    Master master{running, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));

    const Outcome same_socket = running.run_daemon();
    EXPECT_EQ(same_socket.status, 3);
    EXPECT_THAT(same_socket.err, HasSubstr("another dpslaved is running"));

    EXPECT_TRUE(running.exchange_ends_with(0));
    EXPECT_EQ(running.station().at("left_count"), 0);
}

TEST(StartAtABusPortInUse, WaitsUntilTheOtherProgramHasEndedAndDoesNotDisturbIt)
{
    Gateway running;
    Master master{running, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    Gateway second{{.started = false}};
    std::string text = second.config_text();
    const std::string own = second.folder("bus-gateway").string();
    write_file(second.config(),
               text.replace(text.find(own), own.size(), running.folder("bus-gateway").string()));
    second.start_daemon();
    EXPECT_TRUE(second.daemon().says("is used by another program"));
    EXPECT_TRUE(running.exchange_ends_with(0));
    EXPECT_EQ(running.station().at("left_count"), 0);

    EXPECT_EQ(running.daemon().end(SIGTERM), 0);
    EXPECT_TRUE(eventually([&] { return second.json({"status"}).at("bus").at("port_open").get<bool>(); }));
}

TEST(Start, AfterACrashTakesTheSocketThatWasLeftBehind)
{
    Gateway gateway;
    EXPECT_EQ(gateway.daemon().end(SIGKILL), 128 + SIGKILL);
    EXPECT_TRUE(std::filesystem::exists(gateway.socket()));
    gateway.start_daemon();
    EXPECT_EQ(gateway.dpctl({"status"}).status, 0);
}

TEST(Check, PassesAGoodConfigurationWithoutOpeningAnything)
{
    const Gateway gateway{{.started = false}};
    const Outcome outcome = gateway.run_daemon({"--check"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, Not(HasSubstr("cannot")));
    EXPECT_FALSE(std::filesystem::exists(gateway.socket()));
}

} // namespace
} // namespace dpslave::test
