// SPDX-License-Identifier: Apache-2.0
// The daemon dies, or one of its threads stands still; the driver enable fails.
// Only here: a process that dies, and a thread that stands still.
#include "fault_row.hpp"
#include "service_manager.hpp"
#include "stopped_thread.hpp"
#include "support/gpio_stand_in/chip.hpp"
#include "support/paths.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

namespace dpslave::test {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

class RowOfTheProcess : public FaultRow {
protected:
    /// The daemon ends by a signal that it cannot catch, and is started again as the service manager does.
    void is_killed_by(int signal)
    {
        begins();
        ASSERT_TRUE(master_wants(7));
        ASSERT_TRUE(drive_takes(7));
        EXPECT_EQ(gateway->daemon().end(signal), 128 + signal);
        const std::size_t held = taken().size();
        fault_ends();
        const Outcome asked = gateway->dpctl({"status"});
        EXPECT_EQ(asked.status, 3);
        EXPECT_THAT(asked.err, HasSubstr("nothing answers on " + gateway->socket().string()));
        restarts = true;
        gateway->start_daemon();
        EXPECT_TRUE(master->does("wait 60s for state data-exchange"));
        EXPECT_TRUE(eventually([&] { return taken().size() > held; }));
        drive_shows(8);
        EXPECT_TRUE(master_sees(8));
        recovered();
        EXPECT_THAT(taken(held), Each(7)) << "nothing but what the master wants is written";
    }
    /// The drive has its safe state, and the next daemon goes on.
    void ended_by_itself()
    {
        EXPECT_EQ(gateway->daemon().wait(), 3);
        EXPECT_EQ(taken().back(), 0) << "before it ended";
        fault_ends();
        restarts = true;
        gateway->start_daemon();
        EXPECT_TRUE(master->does("wait 60s for state data-exchange"));
        drive_shows(8);
        EXPECT_TRUE(master_sees(8));
        recovered();
    }
};

TEST_F(RowOfTheProcess, F16_ThatIsKilledWritesNothingUntilTheMasterHasItAgain)
{
    is_killed_by(SIGKILL);
}

TEST_F(RowOfTheProcess, F17_ThatCrashesWritesNothingUntilTheMasterHasItAgain)
{
    is_killed_by(SIGSEGV);
}

TEST_F(RowOfTheProcess, F18_WhoseBusThreadStandsStillSendsNoLateReplyAndIsReportedToTheServiceManager)
{
    ServiceManager manager{folder / "notify"};
    Wiring wiring = wiring_of("ei-ascii");
    wiring.environment = {{"NOTIFY_SOCKET", folder / "notify"}, {"WATCHDOG_USEC", "400000"}};
    begins(std::move(wiring), master_of("ei-ascii", {"--watchdog", "20s"}));
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    ASSERT_TRUE(manager.hears("WATCHDOG=1"));
    const std::uint64_t missed = gateway->counter("bus", "late") + gateway->counter("bus", "overtaken");
    {
        const StoppedThread bus{thread_of(gateway->daemon().pid(), "bus")};
        EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
        EXPECT_EQ(gateway->dpctl({"read", "55"}).status, 0) << "the other threads go on";
        const auto last = manager.last_sign_of_life();
        EXPECT_TRUE(master->does("wait 1s")); // ten times as long as between two signs of life
        EXPECT_EQ(manager.last_sign_of_life(), last);
        EXPECT_TRUE(eventually([&] { return taken().back() == 0; })) << "nobody heard the master any more";
    }
    fault_ends();
    EXPECT_TRUE(master->does("wait 30s for state data-exchange"));
    drive_shows(8);
    EXPECT_TRUE(master_sees(8));
    recovered();
    EXPECT_TRUE(manager.hears("WATCHDOG=1"));
    EXPECT_TRUE(eventually([&] {
        return gateway->counter("bus", "late") + gateway->counter("bus", "overtaken") > missed;
    })) << "what it heard too late is counted";
}

/// Behind the drive's safe state the service manager ends the program.
TEST_F(RowOfTheProcess, F38_WhoseMainThreadStallsLeavesTheBusAndTheDriveHasItsSafeState)
{
    ServiceManager manager{folder / "notify"};
    Wiring wiring = wiring_of("ei-ascii");
    wiring.environment = {{"NOTIFY_SOCKET", folder / "notify"}, {"WATCHDOG_USEC", "5000000"}};
    begins(std::move(wiring), master_of("ei-ascii"));
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    {
        const StoppedThread main{gateway->daemon().pid(), true};
        EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
        EXPECT_TRUE(eventually([&] { return taken().back() == 0; }));
    }
    fault_ends();
    EXPECT_TRUE(master->does("wait 30s for state data-exchange"));
    drive_shows(8);
    EXPECT_TRUE(master_sees(8));
    recovered();
}

TEST_F(RowOfTheProcess, F38_WhoseMainThreadStallsEndsItselfWhereNoServiceManagerDoes)
{
    begins();
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    {
        const StoppedThread main{gateway->daemon().pid(), true};
        EXPECT_TRUE(gateway->daemon().says("the main thread has stalled: the program ends"));
    }
    ended_by_itself();
}

TEST_F(RowOfTheProcess, F18_WhoseBusThreadStallsEndsItselfWhereNoServiceManagerDoes)
{
    begins();
    ASSERT_TRUE(master_wants(7));
    ASSERT_TRUE(drive_takes(7));
    {
        const StoppedThread bus{thread_of(gateway->daemon().pid(), "bus")};
        EXPECT_TRUE(gateway->daemon().says("the program ends without it"));
    }
    ended_by_itself();
}

/// The transceiver hangs on a line of a chip that is a file.
class RowOfTheDriverEnable : public FaultRow {
protected:
    void begins_with_gpio(unsigned baud)
    {
        Wiring wiring = wiring_of("ei-ascii");
        wiring.bus_baud = baud;
        wiring.direction = fmt::format("direction = \"gpio\"\ngpio_chip = \"{}\"\ngpio_line = {}\n",
                                       chip.path().string(), kLine);
        wiring.environment = {{"LD_LIBRARY_PATH", built_path("tests/gpio_stand_in")}};
        begins(std::move(wiring), master_of("ei-ascii", {"--watchdog", "20s"}));
    }
    /// `from`: what the drive takes from then on is never an older value.
    void goes_on(std::size_t from = 0)
    {
        EXPECT_TRUE(master->does("wait 30s for state data-exchange"));
        EXPECT_TRUE(master_wants(9));
        EXPECT_TRUE(drive_takes(9));
        recovered();
        EXPECT_TRUE(never_an_older_one(taken(from)));
    }

    static constexpr unsigned kLine = 5;
    stand_in::ChipFile chip{folder / "gpiochip0", "pl061"};
};

TEST_F(RowOfTheDriverEnable, F19_OfAStuckTransmitterIsReleasedByTheGuard)
{
    begins_with_gpio(9'600); // a reply takes long: much of the time the line is active
    const pid_t bus = thread_of(gateway->daemon().pid(), "bus");
    std::optional<StoppedThread> stopped;
    while (!stopped) {
        ASSERT_TRUE(eventually([&] { return chip.high(kLine); }));
        stopped.emplace(bus);
        if (!chip.high(kLine)) stopped.reset(); // the reply was over before the thread stood still
    }
    fault_ends();
    EXPECT_TRUE(eventually([&] { return !chip.high(kLine); }));
    recovered();
    EXPECT_TRUE(gateway->daemon().says("was active for longer than any telegram takes"));
    EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
    EXPECT_TRUE(eventually([&] { return taken().back() == 0; })) << "as F18";
    stopped.reset();
    fault_ends();
    goes_on(taken().size());
    EXPECT_TRUE(eventually([&] { return gateway->counter("bus", "overtaken") > 0; }))
        << "what the master asked meanwhile is counted";
}

TEST_F(RowOfTheDriverEnable, F20_WhoseChipIsPulledSilencesTheDaemonUntilItIsBack)
{
    begins_with_gpio(187'500);
    chip.remove();
    EXPECT_TRUE(gateway->daemon().says("cannot be switched: nothing is sent until it works again"));
    EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
    EXPECT_TRUE(doctor_names("bus.driver_gone"));
    EXPECT_GT(gateway->counter("bus", "unsent"), 0U);
    EXPECT_EQ(taken().back(), 1) << "its watchdog has not expired";

    chip.come_back();
    fault_ends();
    EXPECT_TRUE(gateway->daemon().says("works again"));
    goes_on();
}

TEST_F(RowOfTheDriverEnable, F21_ThatBecomesSlowCostsRepliesButMakesNoneLate)
{
    begins_with_gpio(187'500);
    chip.takes(std::chrono::milliseconds{18}); // longer than the window, and no case for the guard
    EXPECT_TRUE(eventually([&] { return gateway->counter("bus", "late") > 3; }));
    EXPECT_TRUE(master->does("wait 30s for state not data-exchange"));
    EXPECT_TRUE(doctor_names("bus.late"));
    EXPECT_EQ(taken().back(), 1);

    chip.takes(std::chrono::milliseconds{0});
    fault_ends();
    goes_on();
}

} // namespace
} // namespace dpslave::test
