// SPDX-License-Identifier: Apache-2.0
#include "control/fixtures.hpp"
#include "control/varlink_reader.hpp"
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <optional>
#include <sstream>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kChange = "unwinder: state Wait_Prm (was Data_Exch)\n";

TEST(DpctlFollow, PrintsALineForEachChangeIntoAPipeAndEndsFineOnCtrlC)
{
    const FixtureDaemon daemon;
    Dpctl following{{"status", "--follow", "--socket", daemon.socket()}};

    EXPECT_TRUE(following.prints(kChange));
    following.signal(SIGINT);
    const Ran ran = following.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(ran.out, std::string{"bus: rate 187.5 kbit/s, state DP_Control\n"
                                   "unwinder: state Data_Exch, master 2, drive answers\n"
                                   "rewinder: state Wait_Prm, master none, drive silent\n"} +
                           kChange);
}

TEST(DpctlFollow, PrintsOneJsonObjectALine)
{
    const FixtureDaemon daemon;
    Dpctl following{{"status", "--follow", "--json", "--socket", daemon.socket()}};
    EXPECT_TRUE(
        following.prints("\"state\":\"Wait_Prm\",\"sync\":false,\"watchdog_ms\":100")); // the second picture
    following.signal(SIGTERM);
    const Ran ran = following.wait();

    EXPECT_EQ(ran.exit, 0);
    std::istringstream lines(ran.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_EQ(schema_fault(control_varlink(), control_varlink().outputs.at("Watch"), Json::parse(line)),
                  "");
    EXPECT_EQ(count, 2);
}

TEST(DpctlFollow, PrintsOfIoOnlyTheValues)
{
    FixtureDaemon daemon;
    Dpctl words{{"io", "--follow", "--socket", daemon.socket()}};
    Dpctl json{{"io", "--follow", "--json", "--socket", daemon.socket()}};
    EXPECT_TRUE(words.prints("unwinder: out tag 56 = -12.50 (read only)\n"));
    EXPECT_TRUE(json.prints("}\n"));

    daemon.change_value();

    EXPECT_TRUE(words.prints("unwinder: in tag 7 SPEED FEEDBACK = 51.00 (good)\n"));
    EXPECT_TRUE(json.prints("\"value\":\"51.00\""));
    words.signal(SIGINT);
    json.signal(SIGINT);
    EXPECT_EQ(words.wait().out, "unwinder: in tag 7 SPEED FEEDBACK = 50.00 (good)\n"
                                "unwinder: out tag 56 = -12.50 (read only)\n"
                                "unwinder: in tag 7 SPEED FEEDBACK = 51.00 (good)\n");
    const Ran ran = json.wait();
    EXPECT_EQ(std::count(ran.out.begin(), ran.out.end(), '\n'), 2) << "a state that changes is no value";
}

TEST(DpctlFollow, RedrawsOnATerminalAndEndsFineOnCtrlC)
{
    const FixtureDaemon daemon;
    Dpctl following{{"status", "--follow", "--socket", daemon.socket()}, Dpctl::As::this_user, true};
    EXPECT_TRUE(
        following.prints("\033[31mWait_Prm\033[0m       2")); // the unwinder of the second picture, in colour

    following.type("\x03");
    const Ran ran = following.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, HasSubstr("\033[H"));
    EXPECT_THAT(ran.out, Not(HasSubstr("(was")));
}

TEST(DpctlFollow, EndsWith3WhenTheDaemonGoes)
{
    auto daemon = std::make_unique<FixtureDaemon>();
    Dpctl following{{"status", "--follow", "--socket", daemon->socket()}};
    EXPECT_TRUE(following.prints(kChange));

    daemon.reset();
    const Ran ran = following.wait();

    EXPECT_EQ(ran.exit, 3);
    EXPECT_THAT(ran.err, HasSubstr("the daemon ended the connection"));
}

} // namespace
} // namespace dpslave::test
