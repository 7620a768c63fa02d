// SPDX-License-Identifier: Apache-2.0
// dpctl events and dpctl log-level.
#include "control/fixtures.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/dpctl_bench.hpp"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <sstream>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

report::GetEventsReply events()
{
    return report::read<report::GetEventsReply>(fixture("GetEvents"));
}

/// The zone of the process is another one for as long as this lives.
class Zone {
public:
    explicit Zone(const char* name)
    {
        ::setenv("TZ", name, 1);
        ::tzset();
    }
    Zone(const Zone&) = delete;
    Zone& operator=(const Zone&) = delete;
    ~Zone()
    {
        ::unsetenv("TZ");
        ::tzset();
    }
};

TEST(Events, AreLinesWithLocalTimeTheNewestLast)
{
    const Zone zone{"XXX-2"};
    constexpr double kNow = 1'700'000'000; // 2023-11-14 22:13:20 UTC

    EXPECT_EQ(dpctl::render_events(events(), kNow),
              "2023-11-15 00:13:11.000 dpslaved 9.8.7 started\n"
              "2023-11-15 00:13:15.000 unwinder: Data_Exch with master 2\n"
              "2023-11-15 00:13:18.500 rewinder: Chk_Cfg of master 2 was refused (40 times)\n");
}

TEST(Events, SayHowManyBeforeThemAreGone)
{
    report::GetEventsReply reply;
    reply.lost = 1;
    EXPECT_EQ(dpctl::render_events(reply, 0), "1 event before these is not kept any more\n");
    reply.lost = 12;
    EXPECT_EQ(dpctl::render_events(reply, 0), "12 events before these are not kept any more\n");
}

TEST(DpctlEvents, FollowPrintsEachReplyAndEndsFineOnCtrlC)
{
    FixtureDaemon daemon;
    Dpctl following{{"events", "--follow", "--socket", daemon.socket()}};
    EXPECT_TRUE(following.prints("rewinder: Chk_Cfg of master 2 was refused (40 times)\n"));

    daemon.something_happens();

    EXPECT_TRUE(following.prints("unwinder: the drive does not answer\n"));
    following.signal(SIGINT);
    const Ran ran = following.wait();
    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.err, "");
}

TEST(DpctlEvents, FollowWithJsonPrintsOneReplyALine)
{
    FixtureDaemon daemon;
    Dpctl following{{"events", "--follow", "--json", "--socket", daemon.socket()}};
    EXPECT_TRUE(following.prints("}\n"));

    daemon.something_happens();

    EXPECT_TRUE(following.prints("the drive does not answer"));
    following.signal(SIGINT);
    std::istringstream lines(following.wait().out);
    std::vector<Json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(Json::parse(line));
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0], fixture("GetEvents"));
}

TEST(DpctlLogLevel, SaysWhichOneItIsOrSetsIt)
{
    const FixtureDaemon daemon;
    const auto run = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"log-level", "--socket", daemon.socket()});
        return dpctl(std::move(arguments));
    };

    EXPECT_EQ(run({}).out, "level of the log: info\n");
    EXPECT_EQ(run({"debug", "10m"}).out, "level of the log: debug, for 10 min more\n");
    EXPECT_EQ(daemon.written(), Json::object({{"level", "debug"}, {"seconds", 600}}));
    EXPECT_EQ(run({"debug"}).exit, 0);
    EXPECT_EQ(daemon.written(), Json::object({{"level", "debug"}})) << "the daemon knows how long";
    EXPECT_EQ(Json::parse(run({"info", "--json"}).out), fixture("SetLogLevel"));
    EXPECT_EQ(Json::parse(run({"--json"}).out), Json::object({{"log", fixture("GetStatus").at("log")}}));
    for (const auto& wrong : std::vector<std::vector<std::string>>{
             {"warning"}, {"debug", "soon"}, {"debug", "0"}, {"debug", "10m", "x"}, {"10m"}})
        EXPECT_EQ(run(wrong).exit, 2) << wrong.back();
}

TEST(DpctlLogLevel, OfDebugIsShownByStatus)
{
    Json status = fixture("GetStatus");
    EXPECT_THAT(dpctl::render_status(status, false), testing::Not(HasSubstr("debug")));

    status["log"] = Json::object({{"level", "debug"}, {"ends_in_ms", 125'000.0}});
    EXPECT_THAT(dpctl::render_status(status, false), HasSubstr("log       debug, for 2 min more\n"));
}

} // namespace
} // namespace dpslave::test
