// SPDX-License-Identifier: Apache-2.0
// dpctl status --wait: the condition, and what is printed.
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

class DpctlWait : public testing::Test {
protected:
    Ran run(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), {"--socket", daemon.socket()});
        return dpctl(std::move(arguments));
    }
    FixtureDaemon daemon;
};

TEST_F(DpctlWait, AnswersWhetherStationsExchangeData)
{
    const auto asked = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"status", "--wait", "0", "--quiet"});
        return run(std::move(more));
    };
    const Ran all = asked({});
    EXPECT_EQ(all.exit, 1);
    EXPECT_EQ(all.out, "");
    EXPECT_EQ(all.err, "");
    EXPECT_EQ(asked({"unwinder", "--with-drive"}).exit, 0);
    EXPECT_EQ(asked({"unwinder"}).exit, 0);
    EXPECT_EQ(asked({"5"}).exit, 0);
    EXPECT_EQ(asked({"16"}).exit, 1);
    const Ran unknown = asked({"winder"});
    EXPECT_EQ(unknown.exit, 2);
    EXPECT_EQ(unknown.err, "dpctl: there is no station 'winder'; there are: unwinder, rewinder\n");
}

TEST_F(DpctlWait, PrintsTheStatusBehindTheWaitUnlessItIsQuiet)
{
    const Ran ran = run({"status", "unwinder", "--wait", "30"});

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.out, run({"status", "unwinder"}).out);
    EXPECT_EQ(run({"status", "16", "--wait", "0.1", "--json"}).exit, 1);
}

TEST_F(DpctlWait, WaitsUntilAStationIsInExchange)
{
    daemon.set_state("rewinder", "Wait_Prm");
    Dpctl waiting{{"status", "rewinder", "--wait", "60", "--quiet", "--socket", daemon.socket()}};
    EXPECT_TRUE(daemon.was_asked("GetStatus"));

    daemon.set_state("rewinder", "Data_Exch");

    EXPECT_EQ(waiting.wait().exit, 0);
}

TEST_F(DpctlWait, WaitsForADriveThatAnswersAndAMasterOutOfClearWhereThatIsAsked)
{
    daemon.set_state("rewinder", "Data_Exch"); // its drive is silent

    EXPECT_EQ(run({"status", "rewinder", "--wait", "0", "--quiet"}).exit, 0);
    EXPECT_EQ(run({"status", "rewinder", "--wait", "0", "--quiet", "--with-drive"}).exit, 1);
}

} // namespace
} // namespace dpslave::test
