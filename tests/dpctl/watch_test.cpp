// SPDX-License-Identifier: Apache-2.0
#include "control/fixtures.hpp"
#include "control/varlink_reader.hpp"
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <memory>
#include <optional>
#include <sstream>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kChange = "unwinder: state Wait_Prm (was Data_Exch)\n";

TEST(DpctlWatch, PrintsALineForEachChangeIntoAPipeAndEndsFineOnCtrlC)
{
    const FixtureDaemon daemon;
    Dpctl watch{{"watch", "--socket", daemon.socket()}};

    EXPECT_TRUE(watch.prints(kChange));
    watch.signal(SIGINT);
    const Ran ran = watch.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(ran.out, std::string{"bus: rate 187.5 kbit/s, state DP_Control\n"
                                   "unwinder: state Data_Exch, master 2, drive answers\n"
                                   "rewinder: state Wait_Prm, master none, drive silent\n"
                                   "unwinder: in tag 7 SPEED FEEDBACK = 50.00 (good)\n"
                                   "unwinder: out tag 56 = -12.50 (read only)\n"} +
                           kChange);
}

TEST(DpctlWatch, PrintsOneJsonObjectALine)
{
    const FixtureDaemon daemon;
    Dpctl watch{{"watch", "--json", "--socket", daemon.socket()}};
    EXPECT_TRUE(
        watch.prints("\"state\":\"Wait_Prm\",\"sync\":false,\"watchdog_ms\":100")); // the second picture
    watch.signal(SIGTERM);
    const Ran ran = watch.wait();

    EXPECT_EQ(ran.exit, 0);
    std::istringstream lines(ran.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_EQ(schema_fault(control_varlink(), control_varlink().outputs.at("Watch"), Json::parse(line)),
                  "");
    EXPECT_EQ(count, 2);
}

TEST(DpctlWatch, RedrawsOnATerminalAndEndsFineOnCtrlC)
{
    const FixtureDaemon daemon;
    Dpctl watch{{"watch", "--socket", daemon.socket()}, Dpctl::As::this_user, true};
    EXPECT_TRUE(
        watch.prints("\033[31mWait_Prm\033[0m       2")); // the unwinder of the second picture, in colour

    watch.type("\x03");
    const Ran ran = watch.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, HasSubstr("\033[H"));
    EXPECT_THAT(ran.out, Not(HasSubstr("(was")));
}

TEST(DpctlWatch, EndsWith3WhenTheDaemonGoes)
{
    auto daemon = std::make_unique<FixtureDaemon>();
    Dpctl watch{{"watch", "--socket", daemon->socket()}};
    EXPECT_TRUE(watch.prints(kChange));

    daemon.reset();
    const Ran ran = watch.wait();

    EXPECT_EQ(ran.exit, 3);
    EXPECT_THAT(ran.err, HasSubstr("the daemon ended the connection"));
}

} // namespace
} // namespace dpslave::test
