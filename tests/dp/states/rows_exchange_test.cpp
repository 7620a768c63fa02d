// SPDX-License-Identifier: Apache-2.0
/// The transition table of wire reference 6.4, row by row: Chk_Cfg, Data_Exchange, reading back,
/// Global_Control, watchdog, retries, and what the application brings.
#include "dp/states/rows.hpp"

namespace test {
namespace {

using dpslave::dp::LeaveReason;
using dpslave::dp::State;

TEST_F(Rows, C1_ChkCfgInWaitPrmIsNotActivated)
{
    EXPECT_EQ(master.chk_cfg(kCfg), "RS");
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
}

TEST_F(Rows, C2_AcceptedChkCfgBeginsTheExchange)
{
    waits_for_cfg();

    EXPECT_EQ(master.chk_cfg(kCfg), "SC");

    EXPECT_EQ(state(), State::data_exch);
    EXPECT_EQ(diag_of(master), "00 0E 00 02");
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
    EXPECT_EQ(generation(), 1u);
}

TEST_F(Rows, C2_ClearsTheCfgFaultOfBefore)
{
    waits_for_cfg();
    master.chk_cfg("FF");
    waits_for_cfg();
    EXPECT_EQ(diag_of(master), "06 0C 00 02");

    master.chk_cfg(kCfg);

    EXPECT_EQ(diag_of(master), "00 0E 00 02");
}

TEST_F(Rows, C3_WrongChkCfgIsCfgFaultAndReleasesTheSlave)
{
    waits_for_cfg();

    EXPECT_EQ(master.chk_cfg("FF"), "SC");

    EXPECT_EQ(diag_of(master), "06 05 00 FF");
    EXPECT_TRUE(left().empty());
}

TEST_F(Rows, C3_EmptyChkCfgCountsAsWrong)
{
    waits_for_cfg();

    EXPECT_EQ(master.chk_cfg(""), "SC");

    EXPECT_EQ(diag_of(master), "06 05 00 FF");
}

TEST_F(Rows, C4_TheAcceptedOctetsAgainChangeNothing)
{
    exchanges();
    master.data_exchange("A5 01");
    const auto before = generation();

    EXPECT_EQ(master.chk_cfg(kCfg), "SC");

    EXPECT_EQ(generation(), before);
    EXPECT_EQ(master.rd_outp(), "DL A5 01");
    EXPECT_EQ(master.data_exchange("A5 01"), "DL 12 34");
    EXPECT_TRUE(left().empty());
}

TEST_F(Rows, C5_OtherOctetsInDataExchAreCfgFaultEvenIfLegal)
{
    for (const std::string_view cfg : {"21 11", "FF", "11", "11 21 11", ""}) {
        bus.advance(std::chrono::milliseconds{1});
        exchanges();
        left();
        EXPECT_EQ(master.chk_cfg(cfg), "SC");
        EXPECT_EQ(diag_of(master), "06 05 00 FF") << cfg;
        EXPECT_EQ(left().size(), 1u);
    }
}

TEST_F(Rows, C6_ForeignChkCfgIsNotActivated)
{
    waits_for_cfg();
    EXPECT_EQ(foreign.chk_cfg("FF"), "RS");
    EXPECT_EQ(state(), State::wait_cfg);
    master.chk_cfg(kCfg);
    EXPECT_EQ(foreign.chk_cfg("FF"), "RS");
    EXPECT_EQ(state(), State::data_exch);
}

TEST_F(Rows, X1_DataExchangeBeforeTheStartUpIsNotActivated)
{
    EXPECT_EQ(master.data_exchange("00 00"), "RS");
    EXPECT_EQ(master.data_exchange(""), "RS");
    waits_for_cfg();
    EXPECT_EQ(master.data_exchange("00 00"), "RS");
    EXPECT_EQ(master.data_exchange(""), "RS");
    EXPECT_EQ(state(), State::wait_cfg);
}

TEST_F(Rows, X2_DataExchangeTakesOutputsAndReturnsInputs)
{
    exchanges();

    EXPECT_EQ(master.data_exchange("A5 01"), "DL 12 34");

    const auto outputs = slave.take_outputs();
    ASSERT_TRUE(outputs);
    EXPECT_TRUE(outputs->may_write);
    EXPECT_EQ(outputs->words[1], 0xA501);
}

class RowsFailSafe : public Rows {
protected:
    RowsFailSafe() : Rows(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = example_device();
        device.fail_safe = true;
        return device;
    }
};

TEST_F(RowsFailSafe, X3_EmptyDataExchangeClearsTheOutputs)
{
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(master.data_exchange(""), "DL 12 34");

    EXPECT_EQ(master.rd_outp(), "DL 00 00");
    EXPECT_EQ(state(), State::data_exch);
    EXPECT_TRUE(left().empty());
    EXPECT_EQ(master.data_exchange("A5 01"), "DL 12 34"); // both forms are legal
    EXPECT_EQ(master.rd_outp(), "DL A5 01");
    EXPECT_EQ(seen().counters.data_exchange, 3u);
}

TEST_F(Rows, X4_AnotherLengthLeavesWithoutTakingTheOutputs)
{
    exchanges();
    master.data_exchange("A5 01");
    slave.take_outputs();

    EXPECT_EQ(master.data_exchange("11 22 33"), "RS");

    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    EXPECT_EQ(seen().left_because, LeaveReason::output_length);
    expect_outputs_zeroed_once();
}

TEST_F(Rows, X4_EmptyDataExchangeIsAnotherLengthWithoutFailSafe)
{
    exchanges();

    EXPECT_EQ(master.data_exchange(""), "RS");

    EXPECT_EQ(state(), State::wait_prm);
}

TEST_F(Rows, X5_ForeignDataExchangeIsNotActivated)
{
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(foreign.data_exchange("00 00"), "RS");
    EXPECT_EQ(foreign.data_exchange("00 00 00"), "RS");

    EXPECT_EQ(state(), State::data_exch);
    EXPECT_EQ(master.rd_outp(), "DL A5 01");
}

TEST_F(Rows, R1_ReadingBackIsForEveryMasterInDataExch)
{
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(foreign.rd_inp(), "DL 12 34");
    EXPECT_EQ(foreign.rd_outp(), "DL A5 01");
}

TEST_F(Rows, R1_NothingToReadBackIsSc)
{
    start_up(kPrm, "21");
    EXPECT_EQ(master.rd_inp(), "SC");
    master.set_prm(kUnlock);
    start_up(kPrm, "11");
    EXPECT_EQ(master.rd_outp(), "SC");
}

TEST_F(Rows, R1_ReadingBackIsNeverHighPriority)
{
    exchanges();
    slave.set_ext_diag(octets("02 01"), true);

    EXPECT_EQ(master.rd_inp(), "DL 12 34");
    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
}

TEST_F(Rows, R2_ReadingBackWithDataIsNoResource)
{
    exchanges();

    EXPECT_EQ(master.rd_inp({0}), "RR");
    EXPECT_EQ(foreign.rd_outp({0}), "RR");
}

TEST_F(Rows, R3_ReadingBackBeforeTheExchangeIsNotActivated)
{
    EXPECT_EQ(master.rd_inp(), "RS");
    EXPECT_EQ(master.rd_outp({0}), "RS");
    waits_for_cfg();
    EXPECT_EQ(master.rd_inp({0}), "RS");
    EXPECT_EQ(master.rd_outp(), "RS");
}

TEST_F(Rows, G1_GlobalControlOfTheOwnerIsExecuted)
{
    exchanges();
    master.data_exchange("A5 01");

    master.control("02 00");

    EXPECT_EQ(master.rd_outp(), "DL 00 00");
    EXPECT_EQ(state(), State::data_exch);
}

TEST_F(Rows, G2_GlobalControlIsIgnoredElsewhere)
{
    master.control("02 00");
    EXPECT_EQ(state(), State::wait_prm);
    waits_for_cfg();
    master.control("2A 00");
    EXPECT_EQ(diag_of(master), "02 0C 00 02");
    master.chk_cfg(kCfg);
    master.data_exchange("A5 01");
    foreign.control("02 00");
    EXPECT_EQ(master.rd_outp(), "DL A5 01");
}

TEST_F(Rows, W1_WatchdogGuardsWaitCfg)
{
    waits_for_cfg();
    const auto expiry = bus.asked_at() + std::chrono::milliseconds{200};

    time_is(expiry - std::chrono::nanoseconds{1});
    EXPECT_EQ(state(), State::wait_cfg);
    time_is(expiry);
    EXPECT_EQ(state(), State::wait_prm);
}

TEST_F(Rows, W1_WatchdogInDataExchLeavesWithoutAFaultBit)
{
    exchanges();
    master.data_exchange("A5 01");

    bus.advance(std::chrono::milliseconds{201});

    expect_outputs_zeroed_once();
    EXPECT_EQ(seen().left_because, LeaveReason::watchdog);
    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    EXPECT_EQ(master.data_exchange("A5 01"), "RS");
}

TEST_F(Rows, W2_WithoutWatchdogASilentMasterChangesNothing)
{
    exchanges(kPrmNoWatchdog);
    master.data_exchange("A5 01");

    bus.advance(std::chrono::hours{100});

    EXPECT_EQ(foreign.rd_outp(), "DL A5 01");
    EXPECT_EQ(master.data_exchange("A5 02"), "DL 12 34"); // goes on without Set_Prm
    EXPECT_TRUE(left().empty());
}

TEST_F(Rows, F1_FdlStatusIsAnsweredInEveryState)
{
    EXPECT_EQ(master.fdl_status(), "OK");
    waits_for_cfg();
    EXPECT_EQ(master.fdl_status(), "OK");
    master.chk_cfg(kCfg);
    EXPECT_EQ(foreign.fdl_status(), "OK");
}

TEST_F(Rows, F2_ARetryIsAnsweredFromMemoryAndExecutesNothing)
{
    exchanges();
    master.data_exchange("A5 01");
    const auto before = seen().counters.data_exchange;
    inputs_are({0x5678});

    EXPECT_EQ(master.repeats(), "DL 12 34");

    EXPECT_EQ(seen().counters.data_exchange, before);
}

TEST_F(Rows, A1_NewDiagnosisMakesTheRepliesHighPriority)
{
    exchanges();

    slave.set_ext_diag(octets("02 01"), false);

    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
}

TEST_F(Rows, A2_InputsReadyEndsStatDiagAndIsReported)
{
    start_up(kPrm, kCfg);
    diagnosis_is_read();
    EXPECT_EQ(master.data_exchange("00 00"), "DH 00 00"); // Stat_Diag keeps the flag

    inputs_are({0x1234});

    EXPECT_EQ(master.data_exchange("00 00"), "DH 12 34");
    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Rows, A4_ADriveThatIsGoneAsksForDiagnosisUntilEveryInputIsReadAgain)
{
    exchanges();
    master.data_exchange("A5 01");
    dpslave::InputImage gone{.generation = generation(), .drive_gone = true};
    gone.words[0] = 0x1234;
    slave.set_inputs(gone);

    EXPECT_EQ(master.data_exchange("A5 01"), "DH 12 34");
    EXPECT_EQ(diag_of(master), "00 0E 00 02") << "Stat_Diag";
    EXPECT_EQ(master.data_exchange("A5 01"), "DH 12 34") << "Stat_Diag keeps the flag";
    EXPECT_EQ(state(), State::data_exch);

    slave.set_inputs({.generation = generation(), .drive_answers = true, .words = {0x5678}}); // not read yet
    EXPECT_EQ(diag_of(master), "00 0E 00 02");
    inputs_are({0x5678});
    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    EXPECT_EQ(master.data_exchange("A5 01"), "DL 56 78");
}

TEST_F(Rows, A4_ATagThatTheDriveDeniesWhenItIsBackDoesNotHoldTheExchangeThatHadBegun)
{
    exchanges();
    slave.set_inputs({.generation = generation(), .drive_gone = true});
    slave.set_inputs({.generation = generation(),
                      .every_input_tried = true,
                      .drive_answers = true,
                      .hold = dpslave::StartHold::denied});
    EXPECT_EQ(diag_of(master), "00 0C 00 02");
}

TEST_F(Rows, A4_AFrozenImageIsReleased)
{
    start_up("B8 14 01 0C 47 11 01", kCfg);
    inputs_are({0x1234});
    master.control("08 00");
    ASSERT_TRUE(slave.snapshot().freeze);
    slave.set_inputs({.generation = generation(), .drive_gone = true, .words = {0x1234}});
    EXPECT_FALSE(slave.snapshot().freeze);
}

TEST_F(Rows, A3_AnInputImageThatIsStaleChangesNeitherStateNorDiagnosis)
{
    exchanges();

    dpslave::InputImage stale{.generation = generation(), .every_input_tried = true};
    stale.words[0] = 0x1234;
    slave.set_inputs(stale);

    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
    EXPECT_EQ(diag_of(master), "00 0C 00 02");
}

TEST_F(Rows, M2_OtherServiceAccessPointsAreNotActivated)
{
    exchanges();
    for (const std::uint8_t sap : octets("00 30 31 32 33 34 35 36 3A 3F"))
        EXPECT_EQ(master.asks(sap), "RS") << +sap;
    EXPECT_EQ(state(), State::data_exch);
}

/// Layer 2 answers it alone, so the slave is asked directly.
TEST_F(Rows, M2_ADataExchangeWithASourceSapIsNotActivated)
{
    exchanges();
    master.data_exchange("A5 01");
    const Octets outputs = octets("00 02");
    dpslave::fdl::Indication request;
    request.sa = 2;
    request.ssap = std::uint8_t{62};
    request.data = outputs;
    request.at = bus.now();
    dpslave::fdl::ReplyData reply;

    EXPECT_EQ(slave.srd(request, reply), dpslave::fdl::Answer::not_activated);

    EXPECT_EQ(master.rd_outp(), "DL A5 01");
}

TEST_F(Rows, M2_ServicesAreForTheMastersSap62Only)
{
    EXPECT_EQ(master.asks(61, octets(kPrm), 61), "RS");
    EXPECT_EQ(master.asks(60, {}, 0), "RS");
    EXPECT_EQ(state(), State::wait_prm);
}

} // namespace
} // namespace test
