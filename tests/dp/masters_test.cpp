// SPDX-License-Identifier: Apache-2.0
/// Several masters (conformance tests C-15 and C-16 of wire reference 10; table 4.12).
#include "bench.hpp"

namespace test {
namespace {

using dpslave::dp::State;

using Masters = ExampleSlave;

TEST_F(Masters, C15_AForeignMasterMayReadAndChangesNothing)
{
    exchanges(kPrmSyncFreeze);
    master.data_exchange("A5 01");
    slave.set_ext_diag(octets("02 01"), true);

    EXPECT_EQ(foreign.slave_diag(), "DL 08 0C 00 02 47 11 02 01");
    EXPECT_EQ(foreign.get_cfg(), "DL 11 21");
    EXPECT_EQ(foreign.rd_inp(), "DL 12 34");
    EXPECT_EQ(foreign.rd_outp(), "DL A5 01");
    EXPECT_EQ(foreign.set_prm("40 00 00 64 47 11 00"), "SC");
    EXPECT_EQ(foreign.chk_cfg("FF"), "RS");
    EXPECT_EQ(foreign.data_exchange("00 00"), "RS");
    foreign.control("2A 00");

    EXPECT_EQ(state(), State::data_exch);
    EXPECT_EQ(slave.min_tsdr(), dpslave::Tbit{11});
    EXPECT_FALSE(seen().sync);
    EXPECT_FALSE(seen().freeze);
    EXPECT_TRUE(left().empty());
    EXPECT_EQ(master.data_exchange("A5 01"), "DH 12 34"); // the owner has not read the diagnosis yet
}

TEST_F(Masters, TheSnapshotShowsNoChkCfgOfAForeignMaster)
{
    exchanges();

    foreign.chk_cfg("FF");

    const auto snapshot = seen();
    EXPECT_EQ(show({snapshot.cfg.bytes().begin(), snapshot.cfg.bytes().end()}), "11 21");
}

TEST_F(Masters, C16_ASecondMasterTakesOverAfterUnlock)
{
    exchanges();
    EXPECT_EQ(foreign.set_prm(kPrm), "SC");
    EXPECT_EQ(diag_of(foreign), "00 0C 00 02"); // it sees whose the slave is
    master.set_prm("40 00 00 00 47 11 00");

    EXPECT_EQ(foreign.set_prm(kPrm), "SC");
    EXPECT_EQ(diag_of(foreign), "02 0C 00 09");
    EXPECT_EQ(foreign.chk_cfg(kCfg), "SC");

    EXPECT_EQ(foreign.data_exchange("00 01"), "DH 00 00");
    EXPECT_EQ(master.data_exchange("00 02"), "RS");
    EXPECT_EQ(seen().master, 9);
    EXPECT_EQ(foreign.rd_outp(), "DL 00 01");
}

TEST_F(Masters, C16_ASecondMasterTakesOverAfterTheWatchdog)
{
    exchanges();
    bus.advance(std::chrono::seconds{1});

    foreign.set_prm(kPrm);

    EXPECT_EQ(diag_of(foreign), "02 0C 00 09");
}

TEST_F(Masters, TheFirstOneWins)
{
    master.set_prm(kPrm);
    foreign.set_prm(kPrm);

    EXPECT_EQ(seen().master, 2);
}

TEST_F(Masters, MinTsdrWithoutLockIsTakenFromAnyMasterWhileTheSlaveHasNoOwner)
{
    foreign.set_prm("00 00 00 0F 00 00 00");

    EXPECT_EQ(slave.min_tsdr(), dpslave::Tbit{15});
}

} // namespace
} // namespace test
