// SPDX-License-Identifier: Apache-2.0
// dpsim replay gives a capture to the real daemon. The drive frames of the capture are the drive.
// Only here: recorded octets through the tty of the daemon.
#include "scenario.hpp"
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace captures {
namespace {

using dpslave::test::Arguments;
using dpslave::test::Folder;
using dpslave::test::Outcome;
using dpslave::test::Process;
using testing::HasSubstr;
using testing::Not;

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    const std::size_t at = text.find(what);
    if (at == std::string::npos) throw std::runtime_error{"the configuration has no " + what};
    return text.replace(at, what.size(), by);
}

/// Whether a process has this file open.
bool has_open(pid_t process, const std::string& file)
{
    const auto there = std::filesystem::canonical(file);
    std::error_code ignored; // a file may be closed while they are listed
    for (const auto& one :
         std::filesystem::directory_iterator{"/proc/" + std::to_string(process) + "/fd", ignored})
        if (std::filesystem::read_symlink(one, ignored) == there) return true;
    return false;
}

/// The daemon with the configuration of a capture, between two paced lines whose far ends are free.
class DaemonOfACapture {
public:
    explicit DaemonOfACapture(const Station& station) : station_(station)
    {
        EXPECT_TRUE(bus_.says("ready"));
        EXPECT_TRUE(drive_line_.says("ready"));
        std::string config = dpslave::test::content(folder_of_stations() + station.name + ".toml");
        config = replaced(config, "@BUS@", path("bus-slave"));
        config = replaced(config, "@DRIVE@", path("drive-near"));
        config = replaced(config, "@SOCKET@", path("control.sock"));
        // The gateway may take 80 of the 300 ms that the replay waits, so that a loaded machine is no fault.
        config = replaced(config, "baud = 19200", "baud = 187500\nmax_tsdr = 15000");
        config =
            replaced(config, station.name + ".csv", folder_of_stations() + "tags/" + station.name + ".csv");
        dpslave::test::write_file(path("dpslaved.toml"), config);
    }

    void start()
    {
        daemon_ =
            std::make_unique<Process>(Arguments{dpslave::test::program_path("dpslaved"), "--config",
                                                path("dpslaved.toml"), "--profiles", station_.profiles});
        EXPECT_TRUE(daemon_->says("Wait_Prm"));
    }

    /// Of the daemon that runs; its drive is not there.
    Outcome replay(const std::string& file) const { return dpslave::test::run(command(file, {"--fast"})); }

    /// The drive is there before the daemon, so that no question to it is lost. Until the daemon runs, the
    /// first telegram is repeated.
    Outcome replay_with_drive(const std::string& file)
    {
        Process replay{
            command(file, {"--drive-port", path("drive-end"), "--drive-baud", "115200", "--retries", "15"})};
        EXPECT_TRUE(dpslave::test::eventually([&] { return has_open(replay.pid(), path("drive-end")); }));
        start();
        Outcome outcome;
        outcome.status = replay.wait().value_or(-1);
        for (const std::string& line : replay.transcript().lines()) outcome.out += line + "\n";
        return outcome;
    }

private:
    Arguments command(const std::string& file, const Arguments& more) const
    {
        Arguments all{dpslave::test::program_path("dpsim"),
                      "replay",
                      file,
                      "--port",
                      path("bus-master"),
                      "--baud",
                      "187500",
                      "--slot",
                      "300ms"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    Station station_;
    Folder folder_;
    Process bus_{{dpslave::test::program_path("dpsim"), "line", "--baud", "187500", "--a", path("bus-slave"),
                  "--b", path("bus-master")}};
    Process drive_line_{{dpslave::test::program_path("dpsim"), "line", "--baud", "115200", "--bits", "10",
                         "--a", path("drive-near"), "--b", path("drive-end")}};
    std::unique_ptr<Process> daemon_;
};

/// Whether there are packets of the drive line in it. In some captures the drive is not asked.
bool has_drive_frames(const Scenario& scenario)
{
    const auto capture = read_capture(scenario.path());
    return std::any_of(capture.packets.begin(), capture.packets.end(), [&](const auto& packet) {
        return capture.interfaces.at(packet.interface).name == "drive";
    });
}

class Replay : public testing::TestWithParam<Scenario> {};

TEST_P(Replay, OfACaptureHasNoDifference)
{
    DaemonOfACapture daemon{GetParam().station};

    const Outcome outcome = daemon.replay_with_drive(GetParam().path());

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(": no difference"));
    // What make.py writes has an answer to each request to the drive: another request is a fault. One that
    // does not begin with EOT or the unit came in pieces, on a machine that was too busy for it.
    if (!GetParam().is_recorded()) {
        EXPECT_THAT(outcome.out, Not(HasSubstr("the capture has no answer to: 0")));
    }
}

/// One recorded exchange of each station, and what was found on a drive line: on the simulated clock
/// (simulated_test.cpp) every capture is judged, but what DP makes of a drive only.
std::vector<Scenario> scenarios_of_the_daemon()
{
    std::vector<Scenario> some;
    for (const Scenario& one : all_scenarios())
        if (one.name.ends_with("-demand-input-output") || (one.folder == "found" && has_drive_frames(one)))
            some.push_back(one);
    return some;
}

INSTANTIATE_TEST_SUITE_P(OfDaemon, Replay, testing::ValuesIn(scenarios_of_the_daemon()),
                         [](const auto& one) { return test_name_of(one.param); });

TEST(ReplayOfDaemon, WithoutADriveNothingOfADriveIsCompared)
{
    const Scenario& demand = scenario("590-demand-input-output");
    DaemonOfACapture daemon{demand.station};
    daemon.start();

    const Outcome outcome = daemon.replay(demand.path());

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(": no difference"));
}

TEST(ReplayOfDaemon, WithAnotherConfigurationNamesThePacketsThatDiffer)
{
    DaemonOfACapture option_board{scenario("590-demand-input-output").station};
    option_board.start();

    const Outcome outcome = option_board.replay(scenario("6053-demand-input-output").path());

    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out,
                HasSubstr("the answer to Slave_Diag request 2 to 8 differs: it has 17 octets, there 21"));
    EXPECT_THAT(outcome.out, HasSubstr("  in the capture  68 0F 0F 68 82 88 08 3E 3C"));
    EXPECT_THAT(outcome.out, HasSubstr(" differences"));
}

TEST(ReplayOfDaemon, ACaptureOfDpctlIsOneToo)
{
    dpslave::test::Gateway gateway;
    dpslave::test::Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    ASSERT_TRUE(master.does("get-cfg"));
    ASSERT_TRUE(master.does("unlock"));
    ASSERT_TRUE(master.leaves());
    const std::string file = gateway.folder("bus.pcapng").string();
    ASSERT_EQ(gateway.dpctl({"trace", "--output", file}).status, 0);

    const Outcome outcome =
        dpslave::test::run({dpslave::test::program_path("dpsim"), "replay", file, "--port",
                            gateway.bus_end().string(), "--baud", std::to_string(gateway.bus_baud())});

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

/// The bus of a capture as a pcap file, which has no directions: written here octet by octet.
std::string as_pcap(const std::string& path)
{
    const auto capture = read_capture(path);
    std::string file;
    const auto number = [&file](std::uint64_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) file += static_cast<char>(value >> shift & 0xFF);
    };
    for (const std::uint32_t word : {0xA1B23C4DU, 0x00020004U, 0U, 0U, 65'535U, 257U}) number(word);
    for (const auto& packet : capture.packets) {
        if (capture.interfaces.at(packet.interface).link_type != 257) continue;
        number(static_cast<std::uint64_t>(packet.unix_ns) / 1'000'000'000);
        number(static_cast<std::uint64_t>(packet.unix_ns) % 1'000'000'000);
        for (int i = 0; i < 2; ++i) number(packet.octets.size());
        file.append(packet.octets.begin(), packet.octets.end());
    }
    return file;
}

TEST(ReplayOfDaemon, ACaptureWithoutDirectionsIsSentByBitSixOfTheFunctionCodeAndSaysSo)
{
    const Scenario& start_up = scenario("example-start-up");
    DaemonOfACapture daemon{start_up.station};
    daemon.start();
    const Folder folder;
    const std::string file = (folder / "foreign.pcap").string();
    dpslave::test::write_file(file, as_pcap(start_up.path()));

    const Outcome outcome = daemon.replay(file);

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(": no difference"));
    EXPECT_THAT(outcome.err, HasSubstr("foreign.pcap: no direction is recorded with"));
    EXPECT_THAT(outcome.err, HasSubstr("Its stations are then 5\n"));
}

TEST(ReplayOfDaemon, AFileThatIsNoCaptureIsAFaultyInput)
{
    const Folder folder;
    const std::string file = (folder / "none.pcapng").string();
    dpslave::test::write_file(file, "this is text, and not a capture of anything");

    const Outcome outcome = dpslave::test::run(
        {dpslave::test::program_path("dpsim"), "replay", file, "--port", "/none", "--baud", "187500"});

    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("none.pcapng: it is no capture"));
}

} // namespace
} // namespace captures
