// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/cli.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "support/leading_zeros.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::dpctl {
namespace {

using testing::HasSubstr;

/// The number that the command line takes for this option of a command.
double said(const std::string& line, const std::string& option)
{
    CLI::App app;
    Chosen chosen;
    add_command_line(app, chosen);
    app.parse(line);
    return app.get_subcommands().front()->get_option(option)->as<double>();
}

TEST(DpctlOptions, TakeEachNumberBehindZerosAsTheSameNumber)
{
    CLI::App app;
    Chosen chosen;
    add_command_line(app, chosen);
    unsigned numbers = 0;

    EXPECT_THAT(test::options_that_mind_zeros(app, "dpctl", numbers), testing::IsEmpty());
    EXPECT_GE(numbers, 10u) << "the walk has to find the options that take a number";
}

TEST(DpctlOptions, AreDecimalUnless0xStandsBefore)
{
    EXPECT_EQ(said("write 070 1", "TAG"), 70);
    EXPECT_EQ(said("write 0x46 1", "TAG"), 70);
    EXPECT_EQ(said("trace --incident 010", "--incident"), 10);
    EXPECT_EQ(said("survey --passes 010", "--passes"), 10);
    EXPECT_EQ(said("status --wait 010", "--wait"), 10);
    EXPECT_EQ(said("status --timeout 010", "--timeout"), 10);
}

TEST(DpctlOptions, NameTheLimitsOfATag)
{
    const test::Ran ran = test::dpctl({"write", "0065536", "1"});

    EXPECT_EQ(ran.exit, 2);
    EXPECT_THAT(ran.err, HasSubstr("\"0065536\": write a tag from 0 to 65535, or a name"));
}

TEST(DpctlGsdMake, RefusesAnIdentOfFourDigitsWithout0xWithBothReadings)
{
    const test::Ran ran = test::dpctl({"gsd", "make", "--profile", "605", "--ident", "1649"});

    EXPECT_EQ(ran.exit, 2);
    EXPECT_THAT(ran.err,
                HasSubstr("--ident: 1649 could mean 0x1649 or 1649 = 0x0671: write 0x1649 or 0x0671."));
}

} // namespace
} // namespace dpslave::dpctl
