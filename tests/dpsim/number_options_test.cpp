// SPDX-License-Identifier: Apache-2.0
#include "dpsim/common/command_line.hpp"
#include "support/leading_zeros.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::sim {
namespace {

TEST(DpsimOptions, TakeEachNumberBehindZerosAsTheSameNumber)
{
    CommandLine said;
    CLI::App app;
    add_commands(app, said);
    unsigned numbers = 0;

    EXPECT_THAT(test::options_that_mind_zeros(app, "dpsim", numbers), testing::IsEmpty());
    EXPECT_GE(numbers, 15u) << "the walk has to find the options that take a number";
}

TEST(DpsimOptions, AreDecimalUnless0xStandsBefore)
{
    CommandLine said;
    CLI::App app;
    add_commands(app, said);
    app.parse("master --port p --baud 0187500 --slave 010 --watchdog 0100ms --min-tsdr 011");

    EXPECT_EQ(said.texts.baud, 187'500u);
    EXPECT_EQ(said.texts.slave, 10u);
    EXPECT_EQ(said.texts.watchdog, std::chrono::milliseconds{100});
    EXPECT_EQ(said.texts.min_tsdr, 11u);
}

TEST(DpsimOptions, NameTheLimitsOfANumber)
{
    CommandLine said;
    CLI::App app;
    add_commands(app, said);
    try {
        app.parse("master --port p --baud 187500 --slave 0127");
        FAIL() << "was taken";
    } catch (const CLI::ParseError& error) {
        EXPECT_STREQ(error.what(), "--slave: \"0127\": write a number from 0 to 126");
    }
}

} // namespace
} // namespace dpslave::sim
