// SPDX-License-Identifier: Apache-2.0
// A call of a port does not come back, as that of a USB adapter that hangs.
// Only here: a call of the system that stalls.
#include "fault_row.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <thread>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

/// The daemon has a call of the port `port` ("drive-gateway", "bus-gateway") that stalls from stalls() to
/// comes_back().
class StalledCall : public FaultRow {
protected:
    Wiring wiring_with(const char* port, const char* call, const std::string& protocol = "ei-ascii")
    {
        Wiring wiring = wiring_of(protocol);
        port_ = port;
        wiring.environment = {{"STALLED_CALL", call}, {"STALLED_WHILE", file()}, {"STALLED_NOTE", note()}};
        return wiring;
    }
    /// As FaultRow::installs(), with the library between the daemon and its ports.
    void begins_with(Wiring wiring, const std::string& protocol = "ei-ascii")
    {
        installs_with(std::move(wiring));
        exchanges(master_of(protocol));
    }
    void installs_with(Wiring wiring)
    {
        wiring.environment["LD_PRELOAD"] = built_path("tests/libreply_watch_library.so") + ":" +
                                           built_path("tests/libstalled_call_library.so");
        wiring.environment["STALLED_PORT"] = link();
        installs(std::move(wiring));
        std::filesystem::create_symlink(gateway->folder(port_), link());
    }
    void stalls()
    {
        std::filesystem::remove(note());
        write_file(file(), "");
    }
    void comes_back() { std::filesystem::remove(file()); }
    ::testing::AssertionResult has_stalled()
    {
        return eventually([&] { return std::filesystem::exists(note()); });
    }
    void next_daemon_goes_on()
    {
        fault_ends();
        comes_back();
        restarts = true;
        gateway->start_daemon();
        EXPECT_TRUE(master->does("wait 60s for state data-exchange"));
        recovered();
    }
    void TearDown() override
    {
        comes_back();
        FaultRow::TearDown();
    }

private:
    std::string file() const { return (folder / "stalls").string(); }
    std::string note() const { return (folder / "stalled").string(); }
    std::string link() const { return (folder / "port").string(); }
    std::string port_;
};

struct Case {
    const char* protocol;
    const char* call;
    const char* when;
};

class RowOfAStalledCall : public StalledCall, public ::testing::WithParamInterface<Case> {};

TEST_P(RowOfAStalledCall, F39_OfADriveLineIsNoValuesNoOldOrderAndAllAgainBehindIt)
{
    const auto& [protocol, call, when] = GetParam();
    Wiring wiring = wiring_with("drive-gateway", call, protocol);
    wiring.when_drive_lost = when;
    begins_with(std::move(wiring), protocol);
    const bool is_silent = std::string{when} == "silent";
    const bool holds = std::string{when} == "hold";
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    stalls();
    if (std::string{call} != "write" && std::string{call} != "read") { // made when a port is opened
        gateway->unplug_drive();
        gateway->plug_drive();
    }
    ASSERT_TRUE(has_stalled());
    drive_shows(2);
    if (is_silent) {
        EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
    } else if (!holds) {
        EXPECT_TRUE(master->does("wait 30s for diag stat-diag"));
    }
    EXPECT_TRUE(status_says("line p3 has stalled in "));
    EXPECT_TRUE(doctor_names("drive.stalled"));
    if (holds) {
        EXPECT_TRUE(gateway->word_becomes(55, "state", "stale"));
    }
    const Outcome written = gateway->dpctl({"write", "58", "3", "--yes"});
    EXPECT_NE(written.status, 0);
    EXPECT_THAT(written.err, HasSubstr("has stalled"));
    if (holds) {
        EXPECT_TRUE(master_wants(8));
    }

    fault_ends();
    comes_back();
    if (!holds) {
        EXPECT_TRUE(exchange_is_back(is_silent));
    }
    EXPECT_TRUE(master_sees(2));
    EXPECT_TRUE(master_wants(9));
    EXPECT_TRUE(drive_takes(9));
    recovered();
    EXPECT_TRUE(doctor_names("drive.stalled", false));
    EXPECT_EQ(gateway->json({"read", "58"}).at("raw"), 0) << "it was refused";
    EXPECT_TRUE(never_an_older_one(seen()));
}

INSTANTIATE_TEST_SUITE_P(
    Over, RowOfAStalledCall,
    ::testing::Values(Case{"ei-ascii", "write", "silent"}, Case{"modbus-rtu", "write", "diagnosis"},
                      Case{"ei-ascii", "write", "hold"}, Case{"ei-ascii", "read", "silent"},
                      Case{"modbus-rtu", "read", "hold"}, Case{"modbus-rtu", "open", "silent"},
                      Case{"ei-ascii", "ioctl", "diagnosis"}),
    [](const auto& one) {
        const std::string protocol{one.param.protocol};
        return protocol.substr(0, protocol.find('-')) + "_" + one.param.call + "_" + one.param.when;
    });

class RowOfAStalledBusPort : public StalledCall {};

TEST_F(RowOfAStalledBusPort, F40_WhoseWriteDoesNotComeBackIsALossOfTheMaster)
{
    begins_with(wiring_with("bus-gateway", "write"));
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    stalls();
    EXPECT_TRUE(eventually([&] { return taken().back() == 0; }));
    EXPECT_TRUE(gateway->daemon().says("the bus thread has stalled"));
    EXPECT_EQ(gateway->dpctl({"events"}).status, 0) << "the other threads go on";
    EXPECT_TRUE(gateway->daemon().says("the program ends without it"));
    EXPECT_EQ(gateway->daemon().wait(), 3);
    next_daemon_goes_on();
}

TEST_F(RowOfAStalledBusPort, F40_WhoseOpenDoesNotComeBackKeepsNeitherDrivesNorCallsNorTheEnd)
{
    Wiring wiring = wiring_with("bus-gateway", "open");
    wiring.started = false;
    installs_with(std::move(wiring));
    stalls();
    gateway->start_daemon();
    EXPECT_TRUE(eventually([&] { return gateway->station().at("drive").at("link") == "answers"; }));
    EXPECT_FALSE(gateway->json({"status"}).at("bus").at("port_open"));
    EXPECT_EQ(gateway->dpctl({"read", "55"}).status, 0);
    EXPECT_EQ(gateway->daemon().end(SIGTERM), 0);
    EXPECT_TRUE(gateway->daemon().says("the program ends without it"));
    fault_ends();
    comes_back();
    gateway->start_daemon();
    restarts = true;
    exchanges(master_of("ei-ascii"));
    recovered();
}

TEST_F(StalledCall, F39_OfADriveLineIsNamedByEachReloadAndTheLineTakesTheNewestBehindIt)
{
    begins_with(wiring_with("drive-gateway", "write"));
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    const std::string before = gateway->config_text();
    const std::string key = "protocol = \"ei-ascii\"\n";
    stalls();
    ASSERT_TRUE(has_stalled());
    for (const char* const retries : {"retries = 1\n", "retries = 5\n"}) {
        std::string text = before;
        write_file(gateway->config(), text.insert(text.find(key), retries));
        const Outcome reload = gateway->dpctl({"reload"});
        EXPECT_EQ(reload.status, 0) << reload.err;
        EXPECT_THAT(reload.out, HasSubstr("line p3: retries"));
        EXPECT_THAT(reload.out, HasSubstr("line p3 has stalled in write for "));
        EXPECT_THAT(reload.out, HasSubstr("and has not taken the new configuration yet"));
    }

    fault_ends();
    comes_back();
    ASSERT_TRUE(master_wants(9));
    EXPECT_TRUE(drive_takes(9));
    recovered();
    const Outcome last = gateway->dpctl({"reload"});
    EXPECT_THAT(last.out, ::testing::Not(HasSubstr("has stalled")));
    EXPECT_TRUE(never_an_older_one(seen()));
}

TEST_F(StalledCall, F39_OfADriveLineWhosePortDoesNotCloseForAReloadIsThatOfTheOthers)
{
    Wiring wiring = wiring_with("drive-gateway", "close");
    wiring.when_drive_lost = "silent";
    begins_with(std::move(wiring));
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    std::string text = gateway->config_text();
    const std::string key = "protocol = \"ei-ascii\"\n";
    stalls();
    write_file(gateway->config(), text.insert(text.find(key), "settle_ms = 2500\n"));
    EXPECT_EQ(gateway->dpctl({"reload", "--yes"}).status, 0);
    ASSERT_TRUE(has_stalled());
    EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
    EXPECT_TRUE(status_says("line p3 has stalled in close for "));
    EXPECT_TRUE(doctor_names("drive.stalled"));

    fault_ends();
    comes_back();
    EXPECT_TRUE(exchange_is_back(true));
    ASSERT_TRUE(master_wants(9));
    EXPECT_TRUE(drive_takes(9));
    recovered();
    EXPECT_TRUE(doctor_names("drive.stalled", false));
    EXPECT_TRUE(never_an_older_one(seen()));
}

TEST_F(StalledCall, F41_OfADriveLineIsNamedAtTheEndWhichTheOtherLinesAndTheBusDoNotWaitFor)
{
    begins_with(wiring_with("drive-gateway", "write"));
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    stalls();
    ASSERT_TRUE(has_stalled());
    EXPECT_EQ(gateway->daemon().end(SIGTERM), 0);
    EXPECT_TRUE(gateway->daemon().ever_said("line p3 has stalled in write for "));
    EXPECT_TRUE(
        gateway->daemon().ever_said("whether these outputs have their safe state: tag 56, 57 of unwinder"));
    EXPECT_TRUE(gateway->daemon().ever_said("the program ends without it"));
    next_daemon_goes_on();
}

TEST_F(StalledCall, F42_OfTheLogOnADiskThatDoesNotAnswerKeepsNobodyAndNoStop)
{
    begins_with(wiring_with("drive-gateway", "log"));
    stalls();
    gateway->unplug_drive(); // a line of the log
    gateway->plug_drive();
    ASSERT_TRUE(has_stalled());
    EXPECT_TRUE(exchange_is_back(true));
    for (int value = 7; value <= 9; ++value) {
        ASSERT_TRUE(master_wants(value));
        ASSERT_TRUE(drive_takes(value));
    }
    EXPECT_EQ(gateway->dpctl({"status"}).status, 0);
    EXPECT_EQ(gateway->dpctl({"reload"}).status, 0);
    EXPECT_EQ(gateway->dpctl({"write", "58", "3", "--yes"}).status, 0);
    EXPECT_EQ(gateway->daemon().end(SIGTERM), 0);
    EXPECT_EQ(taken().back(), 0);
    next_daemon_goes_on();
}

} // namespace
} // namespace dpslave::test
