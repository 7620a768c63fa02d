// SPDX-License-Identifier: Apache-2.0
/// Slave_Diag (wire reference 5; conformance tests C-19 and C-20 of section 10).
#include "bench.hpp"

namespace test {
namespace {

using namespace std::chrono_literals;

using Diagnosis = ExampleSlave;

constexpr std::string_view kUnlock = "40 00 00 00 47 11 00";

/// The table of canonical values, from top to bottom.
class CanonicalValues : public ExampleSlave {};

TEST_F(CanonicalValues, AfterPowerOn)
{
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
}

TEST_F(CanonicalValues, AfterLeaving)
{
    exchanges();
    master.set_prm(kUnlock);
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
}

TEST_F(CanonicalValues, AfterAWrongIdent)
{
    master.set_prm("88 14 01 0B 00 00 01");
    EXPECT_EQ(diag_of(master), "42 05 00 FF");
}

TEST_F(CanonicalValues, InWaitCfgWithAndWithoutWatchdog)
{
    master.set_prm(kPrm);
    EXPECT_EQ(diag_of(master), "02 0C 00 02");
    master.set_prm(kPrmNoWatchdog);
    EXPECT_EQ(diag_of(master), "02 04 00 02");
}

TEST_F(CanonicalValues, AfterAWrongChkCfg)
{
    master.set_prm(kPrm);
    master.chk_cfg("12");
    EXPECT_EQ(diag_of(master), "06 05 00 FF");
}

TEST_F(CanonicalValues, InDataExchWhileTheApplicationIsNotReady)
{
    start_up(kPrm, kCfg);
    EXPECT_EQ(diag_of(master), "00 0E 00 02");
}

TEST_F(CanonicalValues, InDataExchWithAndWithoutWatchdog)
{
    exchanges();
    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    master.set_prm(kPrmNoWatchdog);
    EXPECT_EQ(diag_of(master), "00 04 00 02");
}

TEST_F(CanonicalValues, InSyncAndFreeze)
{
    exchanges(kPrmSyncFreeze);
    master.control("28 00");
    EXPECT_EQ(diag_of(master), "00 3C 00 02");
}

TEST_F(CanonicalValues, WithAFaultBlock)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);
    EXPECT_EQ(diag_of(master), "08 0C 00 02");
}

TEST_F(CanonicalValues, AfterTheWatchdogExpired)
{
    exchanges();
    bus.advance(1s);
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
}

TEST_F(CanonicalValues, ReadByAnotherMaster)
{
    exchanges();
    EXPECT_EQ(diag_of(foreign), "00 0C 00 02");
}

TEST_F(Diagnosis, C19_ADiagnosisThatAppearsIsPendingUntilTheOwnerHasReadIt)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);

    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
    foreign.slave_diag();
    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
    EXPECT_EQ(master.slave_diag(), "DL 08 0C 00 02 47 11 02 01");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
    EXPECT_EQ(master.slave_diag(), "DL 08 0C 00 02 47 11 02 01"); // reading clears nothing that is true
}

TEST_F(Diagnosis, C19_ADiagnosisThatDisappearsIsReportedToo)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);
    diagnosis_is_read();
    slave.set_ext_diag({}, false);

    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
    EXPECT_EQ(master.slave_diag(), "DL 00 0C 00 02 47 11");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Diagnosis, C19_AChangeWhileUnreadIsReadOnce)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);
    slave.set_ext_diag(octets("02 03"), true);

    EXPECT_EQ(master.slave_diag(), "DL 08 0C 00 02 47 11 02 03");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Diagnosis, C19_TheSameContentIsNoNews)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);
    diagnosis_is_read();
    slave.set_ext_diag(octets("02 01"), true);

    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Diagnosis, C19_OnlyTheFaultBitChanging)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);
    diagnosis_is_read();
    slave.set_ext_diag(octets("02 01"), false);

    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
    EXPECT_EQ(master.slave_diag(), "DL 00 0C 00 02 47 11 02 01"); // a status message
}

TEST_F(Diagnosis, C19_SyncAndFreezeAloneAreNoNews)
{
    exchanges(kPrmSyncFreeze);
    master.control("28 00");

    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Diagnosis, C19_WhatAppearsInWaitCfgIsPendingToo)
{
    master.set_prm(kPrm);
    slave.set_ext_diag(octets("02 01"), true);
    master.chk_cfg("21");

    EXPECT_EQ(master.data_exchange("00 00"), "DH");
}

TEST_F(Diagnosis, C20_StatDiagKeepsTheDiagnosisPendingHoweverOftenItIsRead)
{
    start_up(kPrm, kCfg);
    EXPECT_EQ(diag_of(master), "00 0E 00 02");
    EXPECT_EQ(diag_of(master), "00 0E 00 02");
    EXPECT_EQ(master.data_exchange("00 00"), "DH 00 00");
}

TEST_F(Diagnosis, C20_StatDiagEndsOneSecondAfterChkCfgEvenWithoutInputs)
{
    start_up(kPrmNoWatchdog, kCfg);
    const auto checked = bus.asked_at();

    time_is(checked + 1s - 1ns);
    EXPECT_TRUE(seen().stat_diag);
    time_is(checked + 1s);
    EXPECT_FALSE(seen().stat_diag);
    EXPECT_EQ(master.data_exchange("00 00"), "DH 00 00");
    EXPECT_EQ(diag_of(master), "00 04 00 02");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 00 00");
}

TEST_F(Diagnosis, C20_StatDiagEndsOnlyWithTheInputsOfThisLayout)
{
    start_up(kPrm, kCfg);
    slave.set_inputs({.generation = generation() - 1, .every_input_tried = true, .words = {}});
    EXPECT_TRUE(seen().stat_diag);
    slave.set_inputs({.generation = generation(), .every_input_tried = false, .words = {}});
    EXPECT_TRUE(seen().stat_diag);
    slave.set_inputs({.generation = generation(), .every_input_tried = true, .words = {}});
    EXPECT_FALSE(seen().stat_diag); // tried, with whatever result
}

TEST_F(Diagnosis, C20_WithoutInputsTheSlaveIsReadyAtOnce)
{
    start_up(kPrm, "21");

    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    EXPECT_EQ(master.data_exchange("00 00"), "SC");
}

TEST_F(Diagnosis, C20_BlocksThatDoNotFitAreCutOffAtABlockBoundary)
{
    exchanges();                                          // 32 octets: 26 beside the standard part
    Octets blocks = octets("04 E1 00 80 45 01 10 04 00"); // 9
    Octets big(17, 0x00);
    big[0] = 17;
    blocks.insert(blocks.end(), big.begin(), big.end()); // 26: fits
    EXPECT_TRUE(slave.set_ext_diag(blocks, true));
    EXPECT_EQ(master.slave_diag(), "DL 08 0C 00 02 47 11 " + show(blocks));

    Octets more = blocks;
    more.push_back(0xC1); // a revision number, one octet too many
    EXPECT_TRUE(slave.set_ext_diag(more, true));
    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34"); // the overflow is news
    EXPECT_EQ(master.slave_diag(), "DL 08 0C 80 02 47 11 " + show(blocks));

    slave.set_ext_diag(blocks, true);
    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34"); // and so is its end
}

TEST_F(Diagnosis, C20_ABlockThatDoesNotFitIsNotSplit)
{
    exchanges();
    Octets blocks(27, 0x00);
    blocks[0] = 27;
    slave.set_ext_diag(blocks, true);

    EXPECT_EQ(master.slave_diag(), "DL 00 0C 80 02 47 11");
}

struct Malformed {
    const char* name;
    const char* blocks;
    const char* kept;
};

class MalformedBlocks : public ExampleSlave, public testing::WithParamInterface<Malformed> {};

TEST_P(MalformedBlocks, AreNotSent)
{
    exchanges();

    EXPECT_FALSE(slave.set_ext_diag(octets(GetParam().blocks), false));

    EXPECT_EQ(master.slave_diag(), std::string{"DL 00 0C 00 02 47 11"} + GetParam().kept);
}

INSTANTIATE_TEST_SUITE_P(Diagnosis, MalformedBlocks,
                         testing::Values(Malformed{"LengthZero", "00", ""}, Malformed{"LengthOne", "01", ""},
                                         Malformed{"HeaderPromisesMore", "04 01 02", ""},
                                         Malformed{"ChannelCutShort", "02 AA 80 01", " 02 AA"},
                                         Malformed{"IdentifierCutShort", "43 01", ""}),
                         [](const auto& one) { return std::string{one.param.name}; });

TEST_F(Diagnosis, NoBlocksAtAllAreWellFormed)
{
    exchanges();

    EXPECT_TRUE(slave.set_ext_diag({}, true));
}

TEST_F(Diagnosis, ARevisionNumberIsABlockOfOneOctet)
{
    exchanges();
    EXPECT_TRUE(slave.set_ext_diag(octets("C5 02 01 C6"), false));

    EXPECT_EQ(master.slave_diag(), "DL 00 0C 00 02 47 11 C5 02 01 C6");
}

TEST_F(Diagnosis, TheSnapshotShowsWhatWouldBeAnswered)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);
    const auto snapshot = seen();

    EXPECT_TRUE(snapshot.diag_pending);
    EXPECT_EQ("DL " + dpslave::hex(snapshot.diagnosis), foreign.slave_diag());
}

} // namespace
} // namespace test
