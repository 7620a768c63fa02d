// SPDX-License-Identifier: Apache-2.0
// Tests what the commands that watch say of a real daemon: events, one screen, reads by name, the level of
// the log.
// Only here: calls that stay open while the daemon works.
#include "gateway.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(DpctlEvents, HaveMasterDriveAndWritesInTheirOrder)
{
    Gateway gateway;
    Process follow{gateway.dpctl_command({"events", "--follow"})};
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(follow.says("Data_Exch"));
    EXPECT_EQ(gateway.dpctl({"write", "62", "95.5"}).status, 0);
    EXPECT_TRUE(follow.says("set to 95.5 by uid " + std::to_string(::geteuid())));
    gateway.drive().send_line("silence");
    EXPECT_TRUE(follow.says("the drive does not answer"));
    gateway.drive().send_line("ok");
    EXPECT_TRUE(follow.says("the drive answers"));

    const Json all = gateway.json({"events"});
    EXPECT_EQ(all.at("lost"), 0);
    std::vector<std::string> kinds;
    std::int64_t number = 0;
    for (const Json& one : all.at("events")) {
        EXPECT_EQ(one.at("number"), ++number);
        kinds.push_back(one.at("kind").get<std::string>());
    }
    EXPECT_EQ(kinds.front(), "daemon");
    EXPECT_THAT(kinds, testing::IsSupersetOf({"state", "write", "drive"}));
    EXPECT_THAT(gateway.dpctl({"events", "other"}).err, HasSubstr("there is no station 'other'"));
}

TEST(DpctlEvents, HaveAReloadThatWasRefused)
{
    Gateway gateway;
    write_file(gateway.config(), "[bus]\nport = 5\n");
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 1);

    EXPECT_THAT(gateway.dpctl({"events"}).out, HasSubstr("reload refused: "));
}

TEST(DpctlLogLevel, IsDebugForAWhileAndFallsBackByItself)
{
    Gateway gateway;
    EXPECT_EQ(gateway.dpctl({"log-level"}).out, "level of the log: info\n");

    EXPECT_EQ(gateway.dpctl({"log-level", "debug", "1h"}).status, 0);
    EXPECT_TRUE(gateway.daemon().says("level of the log set to debug for 3600 s by uid"));
    EXPECT_THAT(gateway.dpctl({"status"}).out, HasSubstr("debug, for 59 min more"));
    EXPECT_TRUE(gateway.daemon().says("control socket: GetStatus of uid"));
    EXPECT_EQ(gateway.dpctl({"read", "62"}).status, 0);
    EXPECT_TRUE(gateway.daemon().says("read tag 62 "));

    EXPECT_EQ(gateway.dpctl({"log-level", "debug", "1s"}).status, 0) << "asked twice: the second one counts";
    EXPECT_TRUE(gateway.daemon().says("level of the log: info again"));
    EXPECT_EQ(gateway.dpctl({"log-level"}).out, "level of the log: info\n");
    EXPECT_THAT(gateway.dpctl({"status"}).out, Not(HasSubstr("debug")));
}

TEST(DpctlTop, HasTheRatesAndTheValuesOfARunningBus)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    ASSERT_TRUE(master.does("wait 10s for in 1 = 1250"));

    Process top{gateway.dpctl_command({"top", "--every", "100ms"})};

    EXPECT_TRUE(top.says("unwinder: data_exchange ")) << "a counter that does not grow is left out";
    EXPECT_TRUE(top.says("  12.50  good"));
    EXPECT_TRUE(top.says("turnaround ["));
    EXPECT_TRUE(top.says("unwinder: Data_Exch, master 2")) << "an event";
    EXPECT_EQ(top.end(SIGINT), 0);
}

TEST(DpctlRead, FindsTagsOfTheTableByTheirNames)
{
    Gateway gateway;
    const std::string by_number = gateway.dpctl({"read", "55"}).out;

    EXPECT_EQ(gateway.dpctl({"read", "example: speed feedback"}).out, by_number);
    EXPECT_EQ(gateway.dpctl({"read", "speed_feedback"}).out, by_number);
    const Outcome several = gateway.dpctl({"read", "speed"});
    EXPECT_EQ(several.status, 2);
    EXPECT_THAT(several.err, HasSubstr("Example: speed setpoint"));
}

TEST(DpctlRead, AgainAndAgainDoesNotDisturbTheExchange)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    Process reading{gateway.dpctl_command({"read", "--every", "100ms", "62", "55"})};
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(reading.says("tag 62"));

    EXPECT_TRUE(master.does("expect state data-exchange"));
    EXPECT_EQ(gateway.dpctl({"read", "61"}).status, 0) << "there is a place for others";
}

} // namespace
} // namespace dpslave::test
