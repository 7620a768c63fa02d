// SPDX-License-Identifier: Apache-2.0
/// The transition table of wire reference 6.4, row by row: the test's name begins with the row's.
/// Here: start and stop, addresses, diagnosis, Set_Prm.
#include "dp/state_table.hpp"
#include "dp/states/rows.hpp"

#include <set>

namespace test {
namespace {

using dpslave::dp::LeaveReason;
using dpslave::dp::State;

TEST(StateTable, HasEveryRowOfTheReferenceThatIsForThisRoom)
{
    const std::set<std::string_view> expected{"B1", "B2", "S3", "D1", "D2", "D3",  "P1",  "P2",  "P3", "P4",
                                              "P5", "P6", "P7", "P8", "P9", "P10", "P11", "P12", "C1", "C2",
                                              "C3", "C4", "C5", "C6", "X1", "X2",  "X3",  "X4",  "X5", "R1",
                                              "R2", "R3", "G1", "G2", "W1", "A1",  "A2",  "A4",  "M2"};

    std::set<std::string_view> rows;
    for (const auto& row : dpslave::dp::kTable)
        if (row.id != "-") rows.insert(row.id);

    EXPECT_EQ(rows, expected);
}

TEST_F(Rows, B1_StartLeadsToWaitPrm)
{
    EXPECT_EQ(state(), State::wait_prm);
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
}

TEST_F(Rows, B2_StopFromDataExchLeavesAndEndsInPowerOn)
{
    exchanges();
    master.data_exchange("A5 01");

    slave.stop(bus.now());

    EXPECT_EQ(state(), State::power_on);
    EXPECT_EQ(seen().left_because, LeaveReason::stop);
    expect_outputs_zeroed_once();
    EXPECT_EQ(slave.supervision(), dpslave::fdl::Supervision::unowned);
}

TEST_F(Rows, B2_StopInWaitPrmReportsNoOutputs)
{
    slave.stop(bus.now());

    EXPECT_EQ(state(), State::power_on);
    EXPECT_TRUE(left().empty());
}

TEST_F(Rows, PowerOn_NothingIsServed)
{
    slave.stop(bus.now());

    EXPECT_EQ(master.set_prm(kPrm), "RS");
    EXPECT_EQ(state(), State::power_on);
}

TEST_F(Rows, B1_AfterStopEverythingBeginsAnew)
{
    exchanges();
    master.set_prm("00 00 00 64 00 00 00"); // min T_SDR 100
    slave.stop(bus.now());
    slave.start(bus.now());

    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    EXPECT_EQ(master.get_cfg(), "SC");
    EXPECT_EQ(slave.min_tsdr(), dpslave::Tbit{11});
}

TEST_F(Rows, B1_StartIsLoggedAsNoLeaving)
{
    slave.stop(bus.now());
    events();

    slave.start(bus.now());

    EXPECT_EQ(events(), (std::vector{dpslave::dp::Event{.state = State::wait_prm}}));
}

TEST_F(RowsWithoutSync, B1_AfterStopNoFaultOfBeforeIsLeft)
{
    const auto restarted = [this] {
        slave.stop(bus.now());
        slave.start(bus.now());
        return diag_of(master);
    };
    master.set_prm("88 14 01 0B 12 34 01"); // another ident
    ASSERT_EQ(diag_of(master), "42 05 00 FF");
    EXPECT_EQ(restarted(), "02 05 00 FF");
    master.set_prm("A8 14 01 0B 47 11 01"); // Sync, which it does not have
    ASSERT_EQ(diag_of(master), "12 05 00 FF");
    EXPECT_EQ(restarted(), "02 05 00 FF");
    master.set_prm(kPrm);
    master.chk_cfg("FF");
    ASSERT_EQ(diag_of(master), "06 05 00 FF");
    EXPECT_EQ(restarted(), "02 05 00 FF");
    EXPECT_EQ(seen().refusal, dpslave::dp::RefusalDetail{});
}

TEST_F(Rows, S3_SetSlaveAddIsNotActivatedInAnyState)
{
    const Octets change = octets("07 47 11 00");
    EXPECT_EQ(master.asks(55, change), "RS");
    waits_for_cfg();
    EXPECT_EQ(master.asks(55, change), "RS");
    master.chk_cfg(kCfg);
    EXPECT_EQ(master.asks(55, change), "RS");
    EXPECT_EQ(state(), State::data_exch);
}

TEST_F(Rows, D1_SlaveDiagIsAnsweredInEveryStateToEveryMaster)
{
    EXPECT_EQ(diag_of(foreign), "02 05 00 FF");
    waits_for_cfg();
    EXPECT_EQ(diag_of(foreign), "02 0C 00 02");
    master.chk_cfg(kCfg);
    EXPECT_EQ(diag_of(foreign), "00 0E 00 02");
    EXPECT_EQ(state(), State::data_exch);
}

TEST_F(Rows, D1_SlaveDiagWithDataIsNoResource)
{
    EXPECT_EQ(master.slave_diag({0x00}), "RR");
}

TEST_F(Rows, D2_GetCfgIsScUntilAConfigurationWasAccepted)
{
    EXPECT_EQ(master.get_cfg(), "SC");
    waits_for_cfg();
    EXPECT_EQ(master.get_cfg(), "SC");
    master.chk_cfg("FF");
    EXPECT_EQ(master.get_cfg(), "SC");
    waits_for_cfg();
    master.chk_cfg(kCfg);
    EXPECT_EQ(foreign.get_cfg(), "DL 11 21");
}

TEST_F(Rows, D2_GetCfgKeepsTheOctetsAcceptedLast)
{
    exchanges();
    master.set_prm(kUnlock);

    EXPECT_EQ(master.get_cfg(), "DL 11 21");
}

TEST_F(Rows, D3_GetCfgWithDataIsNoResource)
{
    EXPECT_EQ(master.get_cfg({0x00}), "RR");
    exchanges();
    EXPECT_EQ(master.get_cfg({0x00}), "RR");
}

TEST_F(Rows, P1_SetPrmShorterThanSevenOctetsIsDiscarded)
{
    EXPECT_EQ(master.set_prm("88 14 01 0B 47 11"), "SC");
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    exchanges();
    EXPECT_EQ(master.set_prm("40"), "SC");
    EXPECT_EQ(master.set_prm(""), "SC");
    EXPECT_EQ(state(), State::data_exch);
}

TEST_F(Rows, P2_WithoutLockAndUnlockOnlyMinTsdrIsTaken)
{
    EXPECT_EQ(master.set_prm("38 14 01 64 00 00 FF"), "SC"); // another ident even
    EXPECT_EQ(slave.min_tsdr(), dpslave::Tbit{100});
    bus.set_min_tsdr({100});
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    EXPECT_EQ(seen().groups, 0);
}

TEST_F(Rows, P2_InDataExchTheExchangeGoesOn)
{
    exchanges();
    EXPECT_EQ(master.set_prm("00 00 00 0C 00 00 00"), "SC");
    bus.set_min_tsdr({12});

    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
    EXPECT_EQ(seen().groups, 0x01);
    EXPECT_TRUE(seen().watchdog_on);
}

TEST_F(Rows, P3_AcceptedSetPrmLocksTheSlave)
{
    EXPECT_EQ(master.set_prm(kPrm), "SC");

    EXPECT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(diag_of(master), "02 0C 00 02");
    EXPECT_EQ(slave.supervision(), dpslave::fdl::Supervision::supervised);
}

TEST_F(Rows, P3_WithoutWatchdog)
{
    EXPECT_EQ(master.set_prm(kPrmNoWatchdog), "SC");

    EXPECT_EQ(diag_of(master), "02 04 00 02");
    EXPECT_EQ(slave.supervision(), dpslave::fdl::Supervision::owned);
}

TEST_F(Rows, P4_WrongIdentIsPrmFault)
{
    EXPECT_EQ(master.set_prm(kWrongIdent), "SC");

    EXPECT_EQ(state(), State::wait_prm);
    EXPECT_EQ(diag_of(master), "42 05 00 FF");
}

TEST_F(Rows, P4_PrmFaultStaysUntilSetPrmIsAcceptedNotUntilItIsRead)
{
    master.set_prm(kWrongIdent);
    diag_of(master);
    EXPECT_EQ(diag_of(master), "42 05 00 FF");
    master.set_prm(kPrm);
    EXPECT_EQ(diag_of(master), "02 0C 00 02");
}

TEST_F(RowsWithTags, P4_WrongUserPrmDataIsPrmFault)
{
    EXPECT_EQ(master.set_prm("88 14 01 0B 05 33 01 00"), "SC");

    EXPECT_EQ(master.slave_diag(), "DL 42 05 00 FF 05 33");
}

TEST_F(RowsWithoutSync, P5_SyncOrFreezeThatIsNotSupported)
{
    for (const std::string_view status : {"A8", "98", "B8"}) {
        EXPECT_EQ(master.set_prm(std::string{status} + " 14 01 0B 47 11 01"), "SC");
        EXPECT_EQ(diag_of(master), "12 05 00 FF");
    }
    master.set_prm(kPrm);
    EXPECT_EQ(diag_of(master), "02 0C 00 02");
}

TEST_F(Rows, P6_UnlockInWaitPrmChangesNothing)
{
    master.set_prm(kWrongIdent);

    EXPECT_EQ(master.set_prm(kUnlock), "SC");

    EXPECT_EQ(diag_of(master), "42 05 00 FF");
}

TEST_F(Rows, P7_SetPrmInWaitCfgIsTakenAgain)
{
    waits_for_cfg();

    EXPECT_EQ(master.set_prm("80 00 00 0B 47 11 04"), "SC");

    EXPECT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(seen().groups, 0x04);
    EXPECT_EQ(diag_of(master), "02 04 00 02");
}

TEST_F(Rows, P8_WrongSetPrmOfTheOwnerInWaitCfg)
{
    waits_for_cfg();

    EXPECT_EQ(master.set_prm(kWrongIdent), "SC");

    EXPECT_EQ(diag_of(master), "42 05 00 FF");
    EXPECT_TRUE(left().empty()); // no data was exchanged
}

TEST_F(Rows, P8_WrongSetPrmOfTheOwnerInDataExch)
{
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(master.set_prm(kWrongIdent), "SC");

    EXPECT_EQ(diag_of(master), "42 05 00 FF");
    EXPECT_EQ(seen().left_because, LeaveReason::prm_fault);
    expect_outputs_zeroed_once();
}

TEST_F(RowsWithoutSync, P8_UnsupportedSetPrmOfTheOwnerInDataExch)
{
    exchanges();

    EXPECT_EQ(master.set_prm("A8 14 01 0B 47 11 01"), "SC");

    EXPECT_EQ(diag_of(master), "12 05 00 FF");
    EXPECT_EQ(seen().left_because, LeaveReason::not_supported);
}

TEST_F(Rows, P9_ForeignSetPrmOfAnyKindIsAcknowledgedAndDiscarded)
{
    exchanges();
    for (const std::string_view prm : {kPrm, kWrongIdent, kUnlock, std::string_view{"C0 00 00 00 47 11 00"},
                                       std::string_view{"00 00 00 64 47 11 00"}}) {
        EXPECT_EQ(foreign.set_prm(prm), "SC");
        EXPECT_EQ(diag_of(foreign), "00 0C 00 02");
        EXPECT_EQ(slave.min_tsdr(), dpslave::Tbit{11});
    }
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Rows, P9_ForeignSetPrmInWaitCfg)
{
    waits_for_cfg();

    EXPECT_EQ(foreign.set_prm(kUnlock), "SC");

    EXPECT_EQ(diag_of(master), "02 0C 00 02");
}

TEST_F(Rows, P10_UnlockOfTheOwnerReleasesTheSlave)
{
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(master.set_prm(kUnlock), "SC");

    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    EXPECT_EQ(seen().left_because, LeaveReason::unlock);
    expect_outputs_zeroed_once();
}

TEST_F(Rows, P10_LockAndUnlockTogetherIsUnlock)
{
    waits_for_cfg();

    EXPECT_EQ(master.set_prm("C8 14 01 0B 47 11 01"), "SC");

    EXPECT_EQ(diag_of(master), "02 05 00 FF");
}

TEST_F(Rows, P11_SameUserPrmDataKeepsTheExchange)
{
    exchanges();
    master.data_exchange("A5 01");
    const auto before = generation();

    EXPECT_EQ(master.set_prm("88 28 01 0C 47 11 02"), "SC");
    bus.set_min_tsdr({12});

    EXPECT_EQ(state(), State::data_exch);
    EXPECT_EQ(seen().watchdog, std::chrono::milliseconds{400});
    EXPECT_EQ(seen().groups, 0x02);
    EXPECT_EQ(generation(), before);
    EXPECT_EQ(master.rd_outp(), "DL A5 01");
    EXPECT_TRUE(left().empty());
}

TEST_F(RowsWithTags, P12_OtherTagsNeedTheirOwnChkCfg)
{
    start_up(board_prm({55, 56}), "50 60");
    inputs_are({0x1111});
    master.data_exchange("00 07");
    slave.take_outputs();
    const auto before = generation();

    EXPECT_EQ(master.set_prm(board_prm({57, 56})), "SC");

    EXPECT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(seen().master, 2);
    EXPECT_EQ(seen().left_because, LeaveReason::new_parameters);
    EXPECT_EQ(left(), std::vector{before});
    EXPECT_FALSE(slave.take_outputs()->may_write);
    EXPECT_EQ(master.data_exchange("00 07"), "RS");
    EXPECT_EQ(master.chk_cfg("50 60"), "SC");
    EXPECT_EQ(generation(), before + 1);
    EXPECT_EQ(master.data_exchange("00 07"), "DH 00 00"); // the value of tag 55 does not pass for that of 57
}

} // namespace
} // namespace test
