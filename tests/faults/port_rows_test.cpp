// SPDX-License-Identifier: Apache-2.0
// Serial adapters that are pulled and come back, also under another name.
// Only here: a tty that hangs up under a thread that waits for it.
#include "fault_row.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>

namespace dpslave::test {
namespace {

/// Keeps a terminal open, so that its number is not given to what is plugged next.
class KeptOpen {
public:
    explicit KeptOpen(const std::filesystem::path& terminal)
        : fd_(::open(terminal.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC))
    {
        EXPECT_GE(fd_, 0);
    }
    ~KeptOpen() { ::close(fd_); }
    KeptOpen(const KeptOpen&) = delete;
    KeptOpen& operator=(const KeptOpen&) = delete;

private:
    int fd_;
};

class RowOfAPort : public FaultRow {
protected:
    std::filesystem::path terminal_of(const char* end) const
    {
        return std::filesystem::read_symlink(gateway->folder(end));
    }
    /// The adapter of the bus is pulled, and comes back; the master with it.
    void bus_comes_back()
    {
        gateway->plug_bus();
        fault_ends();
        EXPECT_TRUE(gateway->daemon().says("bus-gateway is back"));
        master.emplace(*gateway, master_of("ei-ascii"));
        ASSERT_TRUE(master->does("start 30s"));
        ASSERT_TRUE(master_wants(9));
        EXPECT_TRUE(drive_takes(9));
        recovered();
        EXPECT_TRUE(doctor_names("bus.gone", false));
    }
    void drive_line_comes_back()
    {
        gateway->plug_drive();
        fault_ends();
        drive_shows(9);
        EXPECT_TRUE(drive_takes(5)) << "what the master wanted meanwhile";
        EXPECT_TRUE(master_sees(9));
        recovered();
        EXPECT_TRUE(never_an_older_one(taken()));
        EXPECT_TRUE(never_an_older_one(seen()));
        EXPECT_TRUE(doctor_names("drive.gone", false));
        EXPECT_TRUE(master_stays_in_data_exchange());
    }
};

TEST_F(RowOfAPort, F22_OfTheBusThatHangsUpIsOpenedAgainAndTheWatchdogWorksMeanwhile)
{
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--watchdog", "500ms"}));
    gateway->unplug_bus();
    EXPECT_TRUE(gateway->daemon().says("bus-gateway is missing"));
    EXPECT_TRUE(drive_takes(0)) << "the watchdog works without a port as well";
    EXPECT_TRUE(doctor_names("bus.gone"));
    bus_comes_back();
}

TEST_F(RowOfAPort, F23_OfADriveLineThatHangsUpIsOpenedAgain)
{
    begins();
    gateway->unplug_drive();
    EXPECT_TRUE(master_wants(5));
    EXPECT_TRUE(gateway->daemon().says("drive-gateway is missing"));
    EXPECT_TRUE(doctor_names("drive.gone"));
    EXPECT_TRUE(master_still_sees(1));
    drive_line_comes_back();
}

/// With the values of when_drive_lost by which something follows from it.
class RowOfALostLine : public RowOfAPort, public ::testing::WithParamInterface<const char*> {
protected:
    bool is_silent() const { return std::string{GetParam()} == "silent"; }
    std::string state() const { return gateway->station().at("state"); }
};

TEST_P(RowOfALostLine, F23_ThatHangsUpIsNoValuesForTheMasterUntilTheyAreReadAgain)
{
    Wiring wiring = wiring_of("ei-ascii");
    wiring.when_drive_lost = GetParam();
    begins(std::move(wiring), master_of("ei-ascii"));
    gateway->unplug_drive();
    EXPECT_TRUE(gateway->daemon().says("drive-gateway is missing"));
    EXPECT_TRUE(gateway->daemon().says("The drive is gone"));
    EXPECT_TRUE(eventually([&] { return state() == (is_silent() ? "Power_On" : "Data_Exch"); }));
    EXPECT_TRUE(is_silent() || master->does("wait 30s for diag stat-diag"));
    EXPECT_TRUE(doctor_names("drive.gone"));
    gateway->plug_drive();
    fault_ends();
    drive_shows(9);
    EXPECT_TRUE(exchange_is_back(is_silent()));
    EXPECT_TRUE(master_sees(9));
    EXPECT_TRUE(master_wants(5));
    EXPECT_TRUE(drive_takes(5));
    recovered();
    EXPECT_TRUE(never_an_older_one(seen()));
    EXPECT_TRUE(doctor_names("drive.gone", false));
}

INSTANTIATE_TEST_SUITE_P(When, RowOfALostLine, ::testing::Values("silent", "diagnosis"),
                         [](const auto& one) { return std::string{one.param}; });

TEST_F(RowOfAPort, F24_ThatComesBackAsAnotherTerminalBehindTheSameLinkIsOpenedAgain)
{
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--watchdog", "500ms"}));
    const auto bus_before = terminal_of("bus-gateway"), drive_before = terminal_of("drive-gateway");
    const KeptOpen old_bus{bus_before}, old_drive_line{drive_before};
    gateway->unplug_drive();
    gateway->unplug_bus();
    EXPECT_TRUE(gateway->daemon().says("bus-gateway is missing"));
    EXPECT_TRUE(doctor_names("bus.gone"));
    gateway->plug_drive();
    bus_comes_back();
    EXPECT_NE(terminal_of("bus-gateway"), bus_before);
    EXPECT_NE(terminal_of("drive-gateway"), drive_before);
}

/// A command of a shell, with the terminal behind it.
void run_with(const std::string& command, const std::filesystem::path& terminal)
{
    ASSERT_EQ(std::system((command + " <" + terminal.string()).c_str()), 0) << command;
}

TEST_F(RowOfAPort, F43_OfADriveLineThatAnotherProgramHasIsSetAgainAndTheProgramIsNamed)
{
    begins();
    {
        const KeptOpen other{terminal_of("drive-gateway")};
        run_with("stty sane", terminal_of("drive-gateway"));
        EXPECT_TRUE(doctor_names("drive.settings"));
        EXPECT_TRUE(doctor_names("drive.shared"));
        EXPECT_THAT(gateway->dpctl({"doctor"}).out, ::testing::HasSubstr("(test_faults)"));
        EXPECT_THAT(gateway->dpctl({"tune", terminal_of("drive-gateway")}).out,
                    ::testing::HasSubstr("(test_faults)"));
    }
    fault_ends();
    EXPECT_TRUE(doctor_names("drive.shared", false));
    drive_shows(9);
    EXPECT_TRUE(exchange_is_back(true));
    EXPECT_TRUE(master_wants(9));
    EXPECT_TRUE(drive_takes(9));
    EXPECT_TRUE(master_sees(9));
    recovered();
    EXPECT_TRUE(never_an_older_one(seen()));
}

TEST_F(RowOfAPort, F43_OfTheBusThatAnotherProgramHasIsSetAgainAndTheProgramIsNamed)
{
    begins();
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    {
        const KeptOpen other{terminal_of("bus-gateway")};
        run_with("stty sane", terminal_of("bus-gateway"));
        EXPECT_TRUE(doctor_names("bus.settings"));
        EXPECT_TRUE(doctor_names("bus.shared"));
    }
    fault_ends();
    EXPECT_TRUE(doctor_names("bus.shared", false));
    EXPECT_TRUE(master->does("start 30s"));
    EXPECT_TRUE(master_wants(9));
    EXPECT_TRUE(drive_takes(9));
    recovered();
    EXPECT_EQ(taken().back(), 9);
}

} // namespace
} // namespace dpslave::test
