// SPDX-License-Identifier: Apache-2.0
// dpsim replay gives a capture to the real daemon. The drive frames of the capture are the drive.
#include "foreign.hpp"
#include "system/gateway.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace captures {
namespace {

using dpslave::test::Arguments;
using dpslave::test::Folder;
using dpslave::test::Outcome;
using dpslave::test::Process;
using testing::HasSubstr;

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    const std::size_t at = text.find(what);
    if (at == std::string::npos) throw std::runtime_error{"the configuration has no " + what};
    return text.replace(at, what.size(), by);
}

/// The daemon with the configuration of a capture, between two paced lines whose far ends are free.
class DaemonOfACapture {
public:
    explicit DaemonOfACapture(const Foreign& foreign)
    {
        EXPECT_TRUE(bus_.says("ready"));
        EXPECT_TRUE(drive_line_.says("ready"));
        std::string config = dpslave::test::content(folder_of_foreign() + foreign.family + ".toml");
        config = replaced(config, "@BUS@", path("bus-slave"));
        config = replaced(config, "@DRIVE@", path("drive-near"));
        config = replaced(config, "@SOCKET@", path("control.sock"));
        // The gateway may take 80 of the 100 ms that the replay waits, so that a loaded machine is no fault.
        config = replaced(config, "baud = 19200", "baud = 187500\nmax_tsdr = 15000");
        config = replaced(config, foreign.family + ".csv", folder_of_foreign() + foreign.family + ".csv");
        dpslave::test::write_file(path("dpslaved.toml"), config);
        daemon_ = std::make_unique<Process>(Arguments{DPSLAVED_PROGRAM, "--config", path("dpslaved.toml"),
                                                      "--profiles",
                                                      std::string{DPSLAVE_SOURCE_DIR} + "/config/profiles"});
        EXPECT_TRUE(daemon_->says("Wait_Prm"));
    }

    Outcome replay(const std::string& file, Arguments more) const
    {
        Arguments command{DPSIM_PROGRAM, "replay", file,        "--port", path("bus-master"),
                          "--baud",      "187500", "--slot-ms", "100"};
        command.insert(command.end(), more.begin(), more.end());
        return dpslave::test::run(command);
    }
    Arguments drive() const { return {"--drive", path("drive-end"), "--drive-baud", "115200"}; }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
    Folder folder_;
    Process bus_{
        {DPSIM_PROGRAM, "line", "--baud", "187500", "--a", path("bus-slave"), "--b", path("bus-master")}};
    Process drive_line_{{DPSIM_PROGRAM, "line", "--baud", "115200", "--bits", "10", "--a", path("drive-near"),
                         "--b", path("drive-end")}};
    std::unique_ptr<Process> daemon_;
};

std::string file_of(const std::string& name)
{
    return folder_of_foreign() + name + ".pcapng";
}

/// Whether there are packets of the drive line in it. In one capture the drive was not asked.
bool has_drive_frames(const std::string& name)
{
    const auto capture = read_foreign(name);
    return std::any_of(capture.packets.begin(), capture.packets.end(), [&](const auto& packet) {
        return capture.interfaces.at(packet.interface).name == "drive";
    });
}

class Replay : public testing::TestWithParam<Foreign> {};

TEST_P(Replay, ACaptureOfAForeignMasterHasNoDifference)
{
    const DaemonOfACapture daemon{GetParam()};

    if (const std::string& before = GetParam().before; !before.empty()) {
        ASSERT_EQ(daemon.replay(file_of(before), {"--fast"}).status, 0);
    }

    const Outcome outcome = daemon.replay(file_of(GetParam().name),
                                          has_drive_frames(GetParam().name) ? daemon.drive() : Arguments{});

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(": no difference"));
}

INSTANTIATE_TEST_SUITE_P(OfDaemon, Replay, testing::ValuesIn(all_foreign()),
                         [](const auto& one) { return test_name_of(one.param); });

TEST(ReplayOfDaemon, WithoutADriveNothingOfADriveIsCompared)
{
    const DaemonOfACapture daemon{all_foreign().front()};

    const Outcome outcome = daemon.replay(file_of(all_foreign().front().name), {"--fast"});

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(": no difference"));
}

TEST(ReplayOfDaemon, WithAnotherConfigurationNamesThePacketsThatDiffer)
{
    const auto& all = all_foreign();
    const DaemonOfACapture option_board{all.front()};
    const auto box =
        std::find_if(all.begin(), all.end(), [](const Foreign& one) { return one.family == "6053"; });

    const Outcome outcome = option_board.replay(file_of(box->name), {"--fast"});

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
    ASSERT_EQ(gateway.dpctl({"trace", "--write", file}).status, 0);

    const Outcome outcome =
        dpslave::test::run({DPSIM_PROGRAM, "replay", file, "--port", gateway.bus_end().string(), "--baud",
                            std::to_string(gateway.bus_baud())});

    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

TEST(ReplayOfDaemon, AFileThatIsNoCaptureIsAFaultOfUsage)
{
    const Folder folder;
    const std::string file = (folder / "none.pcapng").string();
    dpslave::test::write_file(file, "this is text, and not a capture of anything");

    const Outcome outcome =
        dpslave::test::run({DPSIM_PROGRAM, "replay", file, "--port", "/none", "--baud", "187500"});

    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, HasSubstr("none.pcapng: this is no pcapng file"));
}

} // namespace
} // namespace captures
