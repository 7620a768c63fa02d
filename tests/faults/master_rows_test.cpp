// SPDX-License-Identifier: Apache-2.0
// Faults of the masters and of other stations on the bus.
// Only here: two masters in processes of their own on one line.
#include "fault_row.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class RowOfTheMaster : public FaultRow {
protected:
    /// Data exchange with 7 in the drive, then the master says nothing more, as if it had no power.
    void stops_at_seven(Wiring wiring, const Arguments& settings)
    {
        begins(std::move(wiring), settings);
        ASSERT_TRUE(master_wants(7));
        ASSERT_TRUE(drive_takes(7));
        master->end(SIGKILL);
    }
    /// It comes back, from the beginning, and wants 8.
    void returns_and_wants_eight()
    {
        fault_ends();
        master.emplace(*gateway, settings());
        ASSERT_TRUE(master->does("start 30s"));
        ASSERT_TRUE(master_wants(8));
        ASSERT_TRUE(drive_takes(8));
        recovered();
    }
};

TEST_F(RowOfTheMaster, F10_ThatStopsWithItsWatchdogOnLeavesZeroInTheDriveOnce)
{
    stops_at_seven(wiring_of("ei-ascii"), master_of("ei-ascii", {"--watchdog", "300ms"}));
    EXPECT_TRUE(gateway->daemon().says("the watchdog expired: the master is silent"));
    EXPECT_TRUE(drive_takes(0));
    EXPECT_TRUE(gateway->exchange_ends_with(1));
    const std::size_t zero = taken().size();
    for (int i = 0; i < 5; ++i)
        EXPECT_THAT(gateway->dpctl({"read", "56"}).out, HasSubstr("is 0")) << "it is still served";
    EXPECT_THAT(taken(zero), SizeIs(0)) << "zero is written once";
    EXPECT_EQ(gateway->station().at("left_because"), "the watchdog expired: the master is silent");
    EXPECT_TRUE(doctor_names("bus.silent"));

    returns_and_wants_eight();
}

TEST_F(RowOfTheMaster, F11_ThatStopsWithItsWatchdogOffLeavesItsLastValueInTheDrive)
{
    stops_at_seven(wiring_of("ei-ascii"), master_of("ei-ascii", {"--no-watchdog"}));
    EXPECT_TRUE(gateway->daemon().says("runs without watchdog"));
    EXPECT_TRUE(doctor_names("bus.silent"));
    const std::size_t before = taken().size();
    EXPECT_TRUE(eventually([&] { return taken().size() > before + 5; }));
    EXPECT_THAT(taken(before), Each(7)) << "a repeat carries the same value";
    EXPECT_EQ(gateway->station().at("state"), "Data_Exch");
    EXPECT_TRUE(gateway->station().at("watchdog_ms").is_null());

    const std::size_t held = taken().size();
    returns_and_wants_eight();
    EXPECT_THAT(taken(held), Each(AnyOf(7, 0, 8))) << "0 while the master starts up again";
}

TEST_F(RowOfTheMaster, F12_ThatStopsWhileRideThroughRunsLeavesItsLastValueInTheDriveAndThenZero)
{
    Wiring wiring = wiring_of("ei-ascii");
    wiring.profile = "605";
    wiring.keys = "[station.tec]\nride_through = 2\n";
    stops_at_seven(std::move(wiring), master_of("ei-ascii", {"--family", "technology-box", "--ident",
                                                             "0x1649", "--watchdog", "200ms"}));
    EXPECT_TRUE(gateway->daemon().says("the outputs keep their values for"));
    EXPECT_TRUE(doctor_names("station.ride_through"));
    EXPECT_EQ(taken().back(), 7);
    EXPECT_TRUE(gateway->daemon().says("RIDE THROUGH is over: the outputs are set to 0"));
    EXPECT_TRUE(drive_takes(0));
    EXPECT_THAT(gateway->dpctl({"events"}).out,
                AllOf(HasSubstr("the outputs keep their values for"), HasSubstr("RIDE THROUGH is over")));

    returns_and_wants_eight();
}

TEST_F(RowOfTheMaster, F13_IsNotDisturbedByASecondMasterThatWantsTheSlave)
{
    begins();
    // Station 3 has the token for these. Who has the token speaks, so both speak from one place.
    const auto second_master = [&](const std::string& telegram, const std::string& answer) {
        EXPECT_TRUE(master->does("send " + telegram));
        EXPECT_TRUE(master->does("expect reply " + answer));
    };
    for (int value = 2; value <= 5; ++value) {
        second_master("10 05 03 49 51 16", "10 03 05 00 08 16"); // FDL_Status
        // Slave_Diag: the slave belongs to master 2
        second_master("68 05 05 68 85 83 6D 3C 3E EF 16",
                      "68 0B 0B 68 83 85 08 3E 3C 00 0C 00 02 05 33 D0 16");
        // Set_Prm without parameters: acknowledged, as each Set_Prm is, and without effect
        second_master("68 0C 0C 68 85 83 5D 3D 3E 88 01 64 0B 05 33 01 11 16", "E5");
        drive_shows(value);
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(drive_takes(value));
        EXPECT_TRUE(master_sees(value));
        EXPECT_TRUE(master_stays_in_data_exchange());
    }
    EXPECT_EQ(gateway->station().at("master"), 2);
    EXPECT_EQ(gateway->counter("unwinder", "foreign_prm"), 4U);

    fault_ends();
    EXPECT_TRUE(master_wants(6));
    EXPECT_TRUE(drive_takes(6));
    recovered();
    EXPECT_TRUE(never_an_older_one(taken()));
    EXPECT_TRUE(never_an_older_one(seen()));
}

TEST_F(RowOfTheMaster, F14_KeepsItsSlaveAgainstTheSetPrmOfAnother)
{
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--no-watchdog"}));
    master_leaves_the_bus();
    {
        Master foreign{*gateway, master_of("ei-ascii", {"--master", "3"})};
        for (int i = 0; i < 3; ++i)
            EXPECT_TRUE(foreign.does("set-prm B8 01 64 0B 05 33 01" + std::string(48, '0')));
        EXPECT_TRUE(foreign.does("unlock"));
        EXPECT_TRUE(
            gateway->daemon().says("master 3 tried to parameterise a slave that another master owns"));
        EXPECT_TRUE(eventually([&] { return gateway->counter("unwinder", "foreign_prm") >= 3; }));
        EXPECT_EQ(gateway->station().at("master"), 2);
        EXPECT_EQ(gateway->station().at("state"), "Data_Exch");
        EXPECT_TRUE(foreign.leaves());
    }
    EXPECT_EQ(taken().back(), 1) << "the foreign one moved nothing";
    returns_and_wants_eight();
}

TEST_F(RowOfTheMaster, F15_IsServedOnWhileAnotherSlaveHasOurAddressAndIsQuicker)
{
    // The other one answers at once, and ours not before 255 bit times.
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--no-watchdog", "--min-tsdr", "255"}));
    master_leaves_the_bus();
    const std::uint64_t before = replies.replies();
    const std::uint64_t dropped = gateway->counter("bus", "overtaken");
    {
        Master wire{*gateway, master_of("ei-ascii")};
        for (int i = 0; i < 5; ++i) // Data_Exchange of 9, 9, and behind it the other slave's reply
            EXPECT_TRUE(wire.does("send 68 0F 0F 68 05 02 7D 00 00 00 00 00 00 00 00 00 09 00 09 96 16 "
                                  "68 05 05 68 02 05 08 00 01 10 16"));
        EXPECT_TRUE(eventually([&] { return gateway->counter("bus", "own_address") >= 5; }));
        EXPECT_TRUE(wire.leaves());
    }
    EXPECT_TRUE(doctor_names("bus.double_address"));
    EXPECT_TRUE(doctor_names("bus.echo", false));
    EXPECT_EQ(gateway->counter("bus", "overtaken"), dropped + 5);
    EXPECT_EQ(replies.replies(), before) << "it does not speak into the reply of another";
    EXPECT_EQ(gateway->station().at("state"), "Data_Exch");
    EXPECT_THAT(taken().back(), AnyOf(1, 9)) << "only what the master has sent";
    returns_and_wants_eight();
}

TEST_F(RowOfTheMaster, F15_AndItsDriveKeepTheirValuesWhileAnotherMasterHasOurAddress)
{
    begins(wiring_of("ei-ascii"), master_of("ei-ascii", {"--no-watchdog"}));
    master_leaves_the_bus();
    {
        Master other{*gateway, {"--master", "5", "--tags", "55", "--slot", "50ms"}, 9};
        other.send_line("start 100s"); // its telegrams have our address as sender
        EXPECT_TRUE(eventually([&] { return gateway->counter("bus", "own_address") > 50; }));
    }
    EXPECT_TRUE(doctor_names("bus.double_address"));
    EXPECT_TRUE(doctor_names("bus.echo", false));
    EXPECT_EQ(gateway->station().at("state"), "Data_Exch");
    EXPECT_EQ(taken().back(), 1);
    returns_and_wants_eight();
}

} // namespace
} // namespace dpslave::test
