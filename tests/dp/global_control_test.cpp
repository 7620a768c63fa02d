// SPDX-License-Identifier: Apache-2.0
/// Global_Control (conformance tests C-17 and C-18 of wire reference 10; section 4.10).
#include "bench.hpp"

namespace test {
namespace {

using dpslave::dp::State;

using GlobalControl = ExampleSlave;

/// The 32 commands of bits 5..1 against a second reading of section 4.10, from a slave in Sync and Freeze and
/// from one in neither; D = A5 01 received, N = 11 22 in force.
class Matrix : public ExampleSlave {
protected:
    void prepare(bool held)
    {
        exchanges("B0 00 00 0B 47 11 05"); // groups 1 and 3, no watchdog
        master.data_exchange("11 22");
        if (held) {
            master.control("28 00");
            master.data_exchange("A5 01");
        }
    }
};

struct Expected {
    bool sync;
    bool freeze;
    std::string active;
};

Expected expected(unsigned bits, bool held)
{
    const bool clear = bits & 0x02, unfreeze = bits & 0x04, freeze = bits & 0x08, unsync = bits & 0x10,
               sync = bits & 0x20;
    Expected e{held, held, "DL 11 22"};
    if (unsync)
        e.sync = false;
    else if (sync)
        e.sync = true;
    if (unfreeze)
        e.freeze = false;
    else if (freeze)
        e.freeze = true;
    if (held && (sync || unsync)) e.active = "DL A5 01";
    if (clear) e.active = "DL 00 00";
    return e;
}

TEST_F(Matrix, C17_EveryCommandForOurGroupAndForAll)
{
    for (const bool held : {false, true})
        for (const std::string_view group : {"00", "01", "04", "05", "FF"})
            for (unsigned bits = 0; bits < 0x40; bits += 2) {
                prepare(held);
                master.control(show({static_cast<std::uint8_t>(bits)}) + " " + std::string{group});
                const Expected e = expected(bits, held);
                EXPECT_EQ(seen().sync, e.sync) << bits;
                EXPECT_EQ(seen().freeze, e.freeze) << bits;
                EXPECT_EQ(master.rd_outp(), e.active) << bits;
                EXPECT_EQ(state(), State::data_exch);
                master.set_prm("40 00 00 00 47 11 00");
            }
}

TEST_F(Matrix, C17_OtherGroupsLengthsAndMastersHaveNoEffect)
{
    prepare(true);
    for (unsigned bits = 0; bits < 0x40; bits += 2) {
        const std::string command = show({static_cast<std::uint8_t>(bits)});
        master.control(command + " 02"); // group 2
        master.control(command + " FA");
        master.control(command);
        master.control(command + " 00 00");
        foreign.control(command + " 00");
        foreign.control(command + " 05");
        ASSERT_TRUE(seen().sync && seen().freeze) << bits;
        ASSERT_EQ(master.rd_outp(), "DL 11 22") << bits;
    }
}

TEST_F(Matrix, C17_InWaitCfgNothingHappens)
{
    master.set_prm("B0 00 00 0B 47 11 05");
    for (unsigned bits = 0; bits < 0x40; bits += 2)
        master.control(show({static_cast<std::uint8_t>(bits)}) + " 00");

    EXPECT_EQ(diag_of(master), "02 04 00 02");
}

TEST_F(GlobalControl, C17_AnSdnToAnotherSapOrFromAnotherIsNone)
{
    exchanges();
    master.data_exchange("A5 01");
    const Octets clear = octets("02 00");
    for (const Saps saps : {Saps{57, 62}, Saps{59, 62}, Saps{58, 61}, Saps{58, 58}, Saps{62, 58}})
        bus.master_sends(sd2(127, 2, 0x46, saps, clear));
    bus.master_sends(sd2(127, 2, 0x46, clear)); // without SAPs
    EXPECT_EQ(seen().counters.global_control, 0u);
    EXPECT_EQ(master.rd_outp(), "DL A5 01");

    bus.master_sends(sd2(127, 2, 0x46, Saps{58, 62}, clear));
    EXPECT_EQ(seen().counters.global_control, 1u);
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
}

TEST_F(GlobalControl, C17_ASlaveWithoutAGroupHeedsOnlyCommandsForAll)
{
    exchanges("B0 00 00 0B 47 11 00");
    master.data_exchange("11 22");

    master.control("02 FF");
    EXPECT_EQ(master.rd_outp(), "DL 11 22");
    master.control("02 00");
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
}

TEST_F(GlobalControl, TheReservedBitsAreIgnored)
{
    exchanges(kPrmSyncFreeze);
    master.data_exchange("11 22");

    master.control("C1 00");

    EXPECT_EQ(master.rd_outp(), "DL 11 22");
    EXPECT_EQ(diag_of(master), "00 0C 00 02");
}

TEST_F(GlobalControl, C18_SyncHoldsTheOutputsAndLetsThemThroughAtTheNextOne)
{
    exchanges(kPrmSyncFreeze);
    master.data_exchange("00 01");
    master.control("20 00");
    master.data_exchange("00 02");
    EXPECT_EQ(master.rd_outp(), "DL 00 01");
    EXPECT_EQ(diag_of(master), "00 2C 00 02");

    master.control("20 00");
    EXPECT_EQ(master.rd_outp(), "DL 00 02");
    master.data_exchange("00 03");
    EXPECT_EQ(master.rd_outp(), "DL 00 02");

    master.control("10 00");
    EXPECT_EQ(master.rd_outp(), "DL 00 03");
    master.data_exchange("00 04");
    EXPECT_EQ(master.rd_outp(), "DL 00 04");
}

TEST_F(GlobalControl, C18_FreezeHoldsTheInputs)
{
    exchanges(kPrmSyncFreeze);
    master.control("08 00");
    inputs_are({0x2222});
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
    EXPECT_EQ(master.rd_inp(), "DL 12 34");
    EXPECT_EQ(seen().inputs[0], 0x1234);
    EXPECT_EQ(diag_of(master), "00 1C 00 02");

    master.control("08 00");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 22 22");
    inputs_are({0x3333});
    EXPECT_EQ(master.data_exchange("00 00"), "DL 22 22");

    master.control("04 00");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 33 33");
}

TEST_F(GlobalControl, C18_ClearInSyncClearsWhatWasReceivedToo)
{
    exchanges(kPrmSyncFreeze);
    master.data_exchange("00 01");
    master.control("20 00");
    master.data_exchange("00 02");

    master.control("02 00");
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
    EXPECT_TRUE(seen().sync);
    master.control("10 00");
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
}

TEST_F(GlobalControl, ClearIsAnEventNotALock)
{
    exchanges();
    master.control("02 00");
    master.data_exchange("00 01");

    EXPECT_EQ(master.rd_outp(), "DL 00 01");
}

TEST_F(GlobalControl, SyncAndFreezeThatSetPrmDidNotAskForAreIgnoredButClearIsExecuted)
{
    exchanges(kPrm);
    master.data_exchange("00 01");

    master.control("2A 00");

    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
    master.data_exchange("00 02");
    EXPECT_EQ(master.rd_outp(), "DL 00 02");
}

TEST_F(GlobalControl, SyncAloneCanBeAskedFor)
{
    exchanges("A8 14 01 0B 47 11 01");

    master.control("28 00");

    EXPECT_EQ(diag_of(master), "00 2C 00 02");
}

TEST_F(GlobalControl, SyncAndFreezeEndWithTheExchange)
{
    exchanges(kPrmSyncFreeze);
    master.control("28 00");
    master.set_prm("40 00 00 00 47 11 00");
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    start_up(kPrmSyncFreeze, kCfg);
    inputs_are({0x5678});
    diagnosis_is_read();

    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    EXPECT_EQ(master.data_exchange("00 09"), "DL 56 78");
    EXPECT_EQ(master.rd_outp(), "DL 00 09");
}

TEST_F(GlobalControl, TheSnapshotShowsWhetherTheLastOneWasClearData)
{
    exchanges();

    master.control("02 00");
    EXPECT_TRUE(seen().clear);
    master.control("00 00");
    EXPECT_FALSE(seen().clear);
}

TEST_F(GlobalControl, ClearDataAloneAllowsWriting)
{
    exchanges();
    slave.take_outputs();

    master.control("02 00");

    const auto outputs = slave.take_outputs();
    ASSERT_TRUE(outputs);
    EXPECT_TRUE(outputs->may_write);
    EXPECT_EQ(outputs->words[1], 0);
}

} // namespace
} // namespace test
