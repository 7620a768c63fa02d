// SPDX-License-Identifier: Apache-2.0
/// Chk_Cfg, lengths, outputs and the layout generation (conformance tests C-10 to C-12 and C-14 of wire
/// reference 10).
#include "bench.hpp"

#include <functional>

namespace test {
namespace {

using dpslave::Generation;
using dpslave::dp::LeaveReason;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::State;

using Exchange = ExampleSlave;

TEST_F(Exchange, C10_WrongConfigurationsInWaitCfg)
{
    const std::vector<std::string> wrong{"10 21",
                                         "11 31",
                                         "91 21",
                                         "01 21",
                                         "11 21 11 21 11 21 11 21 11",
                                         show(Octets(244, 0x11)),
                                         show(Octets(244, 0xFF))};
    for (const std::string& cfg : wrong) {
        master.set_prm(kPrm);
        EXPECT_EQ(master.chk_cfg(cfg), "SC");
        EXPECT_EQ(diag_of(master), "06 05 00 FF") << cfg;
    }
    start_up(kPrm, kCfg);
}

TEST_F(Exchange, C10_WhatChangedInDataExchIsExplained)
{
    exchanges();
    master.chk_cfg("11 11");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_changed, 2, 0x21, 0x11}));
    exchanges();
    master.chk_cfg("11 21 11");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_changed, 3, 0, 0x11}));
    exchanges();
    master.chk_cfg("11");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_changed, 2, 0x21, 0}));
}

TEST_F(Exchange, C11_EveryOtherLengthLeaves)
{
    for (const std::size_t length : {0u, 1u, 3u, 243u, 244u}) {
        exchanges();
        EXPECT_EQ(master.data_exchange(Octets(length, 0x55)), "RS") << length;
        EXPECT_EQ(state(), State::wait_prm) << length;
        EXPECT_EQ(left().size(), 1u) << length;
    }
}

/// Every way out of Data_Exch.
class WaysOut : public ExampleSlave {
protected:
    struct Way {
        LeaveReason reason;
        std::function<void()> go;
    };
    std::vector<Way> ways()
    {
        return {
            {LeaveReason::prm_fault, [this] { master.set_prm("88 14 01 0B 00 00 01"); }},
            {LeaveReason::cfg_fault, [this] { master.chk_cfg("FF"); }},
            {LeaveReason::watchdog, [this] { bus.advance(std::chrono::seconds{1}); }},
            {LeaveReason::unlock, [this] { master.set_prm("40 00 00 00 47 11 00"); }},
            {LeaveReason::output_length, [this] { master.data_exchange("00"); }},
            {LeaveReason::new_parameters, [this] { master.set_prm("88 14 01 0B 47 11 01 77"); }},
            {LeaveReason::stop, [this] { slave.stop(bus.now()); }},
        };
    }
};

TEST_F(WaysOut, C12_OutputsAreZeroAndTheEndIsReportedExactlyOnce)
{
    for (const Way& way : ways()) {
        SCOPED_TRACE(text(way.reason));
        slave.start(bus.now()); // matters only after `stop`
        if (state() == State::wait_cfg) master.set_prm("40 00 00 00 47 11 00");
        exchanges();
        master.data_exchange("A5 01");
        const Generation before = generation();
        slave.take_outputs();
        ASSERT_TRUE(left().empty());

        way.go();

        EXPECT_EQ(seen().left_because, way.reason);
        EXPECT_EQ(left(), std::vector{before});
        const auto outputs = slave.take_outputs();
        ASSERT_TRUE(outputs);
        EXPECT_FALSE(outputs->may_write);
        EXPECT_EQ(outputs->layout.generation, 0u);
        EXPECT_EQ(outputs->words[1], 0);
        EXPECT_FALSE(slave.take_outputs());
        EXPECT_EQ(master.data_exchange("A5 01"), "RS");
        EXPECT_TRUE(left().empty());
    }
}

TEST_F(WaysOut, C12_AFastStartUpLosesNoLeaving)
{
    for (int i = 0; i < 5; ++i) {
        exchanges();
        master.set_prm("40 00 00 00 47 11 00");
    }
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(left(), (std::vector<Generation>{1, 2, 3, 4, 5}));
    EXPECT_EQ(slave.take_outputs()->layout.generation, 6u);
    EXPECT_EQ(seen().counters.left_data_exchange, 5u);
    EXPECT_EQ(seen().counters.orders_lost, 0u);
}

TEST_F(WaysOut, C12_LeavingsBeyondEightThatWereNotFetchedAreCounted)
{
    for (int i = 0; i < 10; ++i) {
        exchanges();
        master.set_prm("40 00 00 00 47 11 00");
    }

    EXPECT_EQ(left(), (std::vector<Generation>{3, 4, 5, 6, 7, 8, 9, 10}));
    EXPECT_EQ(seen().counters.orders_lost, 2u);
}

TEST_F(Exchange, C14_AMasterThatComesBackWithoutSetPrmGoesOn)
{
    exchanges(kPrmNoWatchdog);
    master.data_exchange("A5 01");
    slave.take_outputs();

    bus.advance(std::chrono::hours{1});

    EXPECT_FALSE(slave.take_outputs());
    EXPECT_EQ(master.data_exchange("A5 01"), "DL 12 34");
    EXPECT_FALSE(slave.take_outputs()); // nothing changed
}

TEST_F(Exchange, NothingMayBeWrittenBeforeTheFirstDataExchange)
{
    exchanges();

    const auto outputs = slave.take_outputs();
    ASSERT_TRUE(outputs);
    EXPECT_FALSE(outputs->may_write);
    EXPECT_EQ(outputs->layout.generation, generation());
    master.data_exchange("00 00"); // zeros, but the master's
    const auto allowed = slave.take_outputs();
    ASSERT_TRUE(allowed);
    EXPECT_TRUE(allowed->may_write);
}

TEST_F(Exchange, OutputsAreGivenOnlyWhenTheyChanged)
{
    exchanges();
    master.data_exchange("00 01");
    EXPECT_TRUE(slave.take_outputs());
    master.data_exchange("00 01");
    EXPECT_FALSE(slave.take_outputs());
    master.data_exchange("00 02");
    EXPECT_EQ(slave.take_outputs()->words[1], 2);
}

TEST_F(Exchange, InputsOfAnotherGenerationAreNotTakenIntoReplies)
{
    exchanges();
    const Generation old = generation();
    master.set_prm("40 00 00 00 47 11 00");
    start_up(kPrm, kCfg);
    EXPECT_EQ(generation(), old + 1);

    dpslave::InputImage late{.generation = old, .every_input_tried = true};
    late.words[0] = 0x9999;
    slave.set_inputs(late);

    EXPECT_EQ(master.data_exchange("00 00"), "DH 00 00");
    inputs_are({0x4321});
    EXPECT_EQ(master.data_exchange("00 00"), "DH 43 21");
}

TEST_F(Exchange, ALateImageDoesNotDriveOutTheCurrentOne)
{
    exchanges();
    slave.set_inputs({.generation = generation() + 1, .every_input_tried = true, .words = {}});

    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

TEST_F(Exchange, EachNewLayoutCountsUpEvenIfItIsTheSame)
{
    exchanges();
    EXPECT_EQ(generation(), 1u);
    master.set_prm("40 00 00 00 47 11 00");
    EXPECT_EQ(generation(), 0u); // there is none
    exchanges();
    EXPECT_EQ(generation(), 2u);
}

TEST_F(Exchange, RefusedConfigurationsDoNotCount)
{
    master.set_prm(kPrm);
    master.chk_cfg("FF");
    exchanges();

    EXPECT_EQ(generation(), 1u);
}

TEST_F(Exchange, ARestartOfTheSlaveDoesNotReuseAGeneration)
{
    exchanges();
    slave.stop(bus.now());
    slave.start(bus.now());
    exchanges();

    EXPECT_EQ(generation(), 2u);
}

TEST_F(Exchange, Sd3CarriesEightOctetsOfOutputsAndSixIdentifiers)
{
    const auto answer = [this](const Octets& telegram) {
        bus.master_sends(telegram);
        return show(bus.reply().value_or(Octets{}));
    };
    EXPECT_EQ(master.set_prm(kPrm), "SC");
    EXPECT_EQ(answer(sd3(kUs, 2, 0x5D, Saps{62, 62}, octets("21 11 21 21 11 21"))), "E5");
    ASSERT_EQ(state(), State::data_exch);
    inputs_are({0, 0x1122, 0, 0, 0x3344});
    diagnosis_is_read();

    EXPECT_EQ(answer(sd3(kUs, 2, 0x7D, octets("A0 A1 B0 B1 C0 C1 D0 D1"))),
              show(sd2(2, kUs, 0x08, octets("11 22 33 44"))));

    EXPECT_EQ(master.rd_outp(), "DL A0 A1 B0 B1 C0 C1 D0 D1");
}

} // namespace
} // namespace test
