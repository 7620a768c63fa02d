// SPDX-License-Identifier: Apache-2.0
/// NETWORK STATE follows the bus, the drive and FAULT (B-043, B-051, B-052, B-055).
#include "tec_bench.hpp"

namespace test {
namespace {

using dpslave::NetworkState;
using dpslave::OptionFault;
using dpslave::WordState;
using dpslave::tec::Hardware;

class TecNetworkState : public TecBench {
protected:
    NetworkState network(OptionFault fault = OptionFault::none, const Hardware& hardware = {}) const
    {
        return dpslave::tec::network_state(fault, hardware, seen(), drive);
    }
};

TEST_F(TecNetworkState, FollowsTheStartUp)
{
    EXPECT_EQ(network(OptionFault::none, {.baud_search = true}), NetworkState::baud_search);
    EXPECT_EQ(network(), NetworkState::wait_param);
    master.set_prm(prm("00 00 00"));
    EXPECT_EQ(network(), NetworkState::wait_config);
    master.chk_cfg("73");
    EXPECT_EQ(network(), NetworkState::data_exchange);
    master_lets_go();
    EXPECT_EQ(network(), NetworkState::wait_param);
}

TEST_F(TecNetworkState, BeforeTheStationIsStartedIsBaudSearch)
{
    slave.stop(bus.now());

    EXPECT_EQ(network(), NetworkState::baud_search);
}

TEST_F(TecNetworkState, IsDisabledWithAnyFaultWhateverTheBusDoes)
{
    for (std::uint8_t number = 1; number <= 5; ++number) {
        EXPECT_EQ(network(static_cast<OptionFault>(number)), NetworkState::disabled);
        EXPECT_EQ(network(static_cast<OptionFault>(number), {.baud_search = true}), NetworkState::disabled);
    }
    exchanges();
    EXPECT_EQ(network(OptionFault::type_mismatch), NetworkState::disabled);
}

TEST_F(TecNetworkState, IsDataExchangeWhileEveryParameterWorks)
{
    exchanges();
    EXPECT_EQ(network(), NetworkState::data_exchange);
    drive.states[0] = WordState::untried; // nothing was written yet
    EXPECT_EQ(network(), NetworkState::data_exchange);
}

struct Failure {
    const char* name;
    WordState state;
};

class TecDataExError : public TecNetworkState, public testing::WithParamInterface<Failure> {};

TEST_P(TecDataExError, WhenOneParameterFailsAndUntilItWorksAgain)
{
    exchanges();
    for (std::size_t parameter = 0; parameter < 4; ++parameter) {
        drive.states[parameter] = GetParam().state;
        EXPECT_EQ(network(), NetworkState::data_ex_error) << parameter;
        drive.states[parameter] = WordState::good;
        EXPECT_EQ(network(), NetworkState::data_exchange) << parameter;
    }
}

INSTANTIATE_TEST_SUITE_P(B052, TecDataExError,
                         testing::Values(Failure{"Stale", WordState::stale},
                                         Failure{"InvalidTag", WordState::invalid_tag},
                                         Failure{"ReadOnly", WordState::read_only},
                                         Failure{"OutOfRange", WordState::out_of_range},
                                         Failure{"Refused", WordState::refused}),
                         [](const auto& one) { return std::string{one.param.name}; });

TEST_F(TecNetworkState, StaysWhileALostAnswerIsOnlyRepeated)
{
    exchanges();
    drive.states[1] = WordState::stale;
    drive.repeated[1] = true;
    EXPECT_EQ(network(), NetworkState::data_exchange);
    drive.repeated[1] = false;
    EXPECT_EQ(network(), NetworkState::data_ex_error);
}

TEST_F(TecNetworkState, IsDataExErrorWhileTheDriveIsLostAlsoWithDemandDataAlone)
{
    start_up(prm("00 00 00"), "73");
    drive.known = true;
    drive.answers = false;
    EXPECT_EQ(network(), NetworkState::data_ex_error);
    drive.answers = true;
    EXPECT_EQ(network(), NetworkState::data_exchange);
}

TEST_F(TecNetworkState, ADriveThatWasNotAskedYetIsNotLost)
{
    exchanges();
    drive.known = drive.answers = false;

    EXPECT_EQ(network(), NetworkState::data_exchange);
}

TEST_F(TecNetworkState, WhatFailedInAnotherLayoutOrBehindTheLastParameterDoesNotCount)
{
    exchanges();
    drive.states[4] = WordState::refused; // there are four
    EXPECT_EQ(network(), NetworkState::data_exchange);
    drive.states[1] = WordState::invalid_tag;
    drive.generation = generation() - 1;
    EXPECT_EQ(network(), NetworkState::data_exchange);
}

TEST_F(TecNetworkState, ALostDriveIsNoErrorOfABusThatDoesNotExchange)
{
    drive.known = true;
    drive.answers = false;

    EXPECT_EQ(network(), NetworkState::wait_param);
}

} // namespace
} // namespace test
