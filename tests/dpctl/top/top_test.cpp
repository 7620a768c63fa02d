// SPDX-License-Identifier: Apache-2.0
// The program dpctl top: on a terminal (a pty), in a pipe, and every way out.
#include "control/fixtures.hpp"
#include "control/varlink_reader.hpp"
#include "dpctl/dpctl_bench.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <sstream>

namespace dpslave::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kEnters = "\033[?1049h\033[?25l\033[?7l\033[2J";
constexpr const char* kLeaves = "\033[?7h\033[?25h\033[?1049l";
constexpr const char* kFooter = "q quit   up/down station 1/2";

std::size_t occurrences(const std::string& text, std::string_view part)
{
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
    return count;
}

/// It has given the terminal back as it was.
void expect_left(const Ran& ran, int exit)
{
    EXPECT_EQ(ran.exit, exit) << ran.err;
    EXPECT_THAT(ran.out, StartsWith(kEnters));
    EXPECT_THAT(ran.out, EndsWith(kLeaves));
    EXPECT_TRUE(ran.echoes);
}

/// dpctl top on a terminal of 80 x 24.
class DpctlTopOnATerminal : public testing::Test {
protected:
    /// It has drawn its first screen, and takes keys one by one.
    void start()
    {
        ASSERT_TRUE(top.prints(kFooter));
        ASSERT_FALSE(top.echoes());
    }
    std::unique_ptr<FixtureDaemon> daemon = std::make_unique<FixtureDaemon>();
    Dpctl top{{"top", "--every", "100ms", "--socket", daemon->socket()}, Dpctl::As::this_user, true};
};

TEST_F(DpctlTopOnATerminal, EndsWithQAndTheTerminalIsWhatItWas)
{
    start();
    top.type("q");
    expect_left(top.wait(), 0);
}

TEST_F(DpctlTopOnATerminal, EndsWithCtrlC)
{
    start();
    top.type("\x03");
    expect_left(top.wait(), 0);
}

TEST_F(DpctlTopOnATerminal, EndsWithTheSignalsOfAnEnd)
{
    start();
    top.signal(SIGTERM);
    expect_left(top.wait(), 0);
}

TEST_F(DpctlTopOnATerminal, EndsWhenTheConnectionOfTheTerminalIsLost)
{
    start();
    top.signal(SIGHUP);
    expect_left(top.wait(), 0);
}

TEST_F(DpctlTopOnATerminal, EndsWith3AndTheReasonWhenTheDaemonGoes)
{
    start();
    daemon.reset();

    const Ran ran = top.wait();

    expect_left(ran, 3);
    EXPECT_THAT(ran.err, HasSubstr("control.sock"));
}

TEST_F(DpctlTopOnATerminal, DrawsAgainForEachKey)
{
    start();
    top.type("\x1B[B");
    EXPECT_TRUE(top.prints("up/down station 2/2"));
    top.type("/feedback");
    EXPECT_TRUE(top.prints("filter: feedback_"));
    top.type("\r");
    EXPECT_TRUE(top.prints("/ filter (feedback)"));
    top.type("q");
    expect_left(top.wait(), 0);
}

TEST_F(DpctlTopOnATerminal, DrawsAgainAndAgainByItself)
{
    start();
    EXPECT_TRUE(top.prints("telegrams 0.0/s")) << "the second look";
    daemon->set_state("rewinder", "Wait_Cfg");
    EXPECT_TRUE(top.prints("Wait_Cfg"));
    top.type("q");
    const Ran ran = top.wait();
    EXPECT_EQ(occurrences(ran.out, kEnters), 1u);
    EXPECT_EQ(occurrences(ran.out, kLeaves), 1u);
}

TEST_F(DpctlTopOnATerminal, FollowsTheSizeOfTheTerminal)
{
    start();
    top.resize(20, 10);
    EXPECT_TRUE(top.prints("Data_~"));
    top.type("q");
    expect_left(top.wait(), 0);
}

TEST(DpctlTop, GivesTheTerminalBackWhileItStandsStill)
{
    const FixtureDaemon daemon;
    Dpctl top{{"top", "--every", "1h", "--socket", daemon.socket()}, Dpctl::As::this_user, true};
    ASSERT_TRUE(top.prints(kFooter));
    top.type("\x1A"); // Ctrl-Z
    ASSERT_TRUE(top.stands_still());
    EXPECT_TRUE(top.prints(kLeaves));
    EXPECT_TRUE(top.echoes());
    top.signal(SIGCONT);
    EXPECT_TRUE(top.prints(std::string{kLeaves} + kEnters));
    top.type("q");
    expect_left(top.wait(), 0);
}

TEST(DpctlTop, ShowsTextOfTheDaemonAsCodes)
{
    const FixtureDaemon daemon{"\x1B[2J\u009B31m\u202E\r\n"};
    Dpctl top{{"top", "--every", "100ms", "--socket", daemon.socket()}, Dpctl::As::this_user, true};
    EXPECT_TRUE(top.prints("station 1/2"));
    EXPECT_TRUE(top.prints("no counter of the bus grows")) << "the second look";
    top.type("q");

    const Ran ran = top.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(occurrences(ran.out, "\x1B[2J"), 1u) << "its own, at the start";
    EXPECT_THAT(ran.out, Not(HasSubstr("\u009B")));
    EXPECT_THAT(ran.out, Not(HasSubstr("\u202E")));
    EXPECT_THAT(ran.out, HasSubstr("\\x1B[2J"));
}

/// A socket at which nothing answers.
class SilentDaemon {
public:
    SilentDaemon()
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        socket().copy(address.sun_path, sizeof address.sun_path - 1);
        if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
            ::listen(fd_, 4) != 0)
            throw std::runtime_error("listen");
    }
    SilentDaemon(const SilentDaemon&) = delete;
    SilentDaemon& operator=(const SilentDaemon&) = delete;
    ~SilentDaemon() { ::close(fd_); }
    std::string socket() const { return (folder_.path() / "control.sock").string(); }

private:
    TempFolder folder_;
    int fd_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
};

TEST(DpctlTop, EndsWithQWhileTheDaemonDoesNotAnswer)
{
    const SilentDaemon daemon;
    Dpctl top{{"top", "--timeout", "3600", "--socket", daemon.socket()}, Dpctl::As::this_user, true};
    EXPECT_TRUE(top.prints(kEnters));

    top.type("q");

    const Ran ran = top.wait();
    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, EndsWith(kLeaves));
}

TEST(DpctlTop, PrintsOneScreenIntoAPipeAndEnds)
{
    const FixtureDaemon daemon;
    const Ran ran = dpctl({"top", "--socket", daemon.socket()});

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_THAT(ran.out, Not(HasSubstr("\033")));
    EXPECT_EQ(occurrences(ran.out, "telegrams 0.0/s, octets 0.0/s\n"), 1u);
    EXPECT_EQ(occurrences(ran.out, "rewinder: Chk_Cfg of master 2 was refused (40 times)\n"), 1u);
}

TEST(DpctlTop, PrintsAgainAndAgainIntoAPipeWithEvery)
{
    const FixtureDaemon daemon;
    Dpctl top{{"top", "unwinder", "--every", "100ms", "--socket", daemon.socket()}};
    const std::string line = "STATION ";
    EXPECT_TRUE(top.prints(line));
    while (occurrences(top.printed(), line) < 3 && top.prints_more()) {
    }
    top.signal(SIGINT);

    const Ran ran = top.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_GE(occurrences(ran.out, line), 3u);
}

TEST(DpctlTop, PrintsTheRepliesAsJson)
{
    const FixtureDaemon daemon;
    const Json all = Json::parse(dpctl({"top", "--json", "--socket", daemon.socket()}).out);

    ASSERT_EQ(all.size(), 4u);
    for (const auto& [key, method] : {std::pair{"status", "GetStatus"},
                                      {"counters", "GetCounters"},
                                      {"io", "GetIo"},
                                      {"events", "GetEvents"}})
        EXPECT_EQ(all.at(key), fixture(method));
}

TEST(DpctlTop, PrintsOneJsonObjectALineWithEvery)
{
    const FixtureDaemon daemon;
    Dpctl top{{"top", "--json", "--every", "100ms", "--socket", daemon.socket()}};
    EXPECT_TRUE(top.prints("}\n{"));
    top.signal(SIGTERM);
    std::istringstream lines(top.wait().out);
    for (std::string line; std::getline(lines, line) && !lines.eof();)
        EXPECT_EQ(Json::parse(line).at("io"), fixture("GetIo"));
}

TEST(DpctlTop, EndsWith2WhenThereIsNoSuchStation)
{
    const FixtureDaemon daemon;
    for (const bool terminal : {false, true}) {
        Dpctl top{{"top", "nowhere", "--socket", daemon.socket()}, Dpctl::As::this_user, terminal};
        const Ran ran = top.wait();
        EXPECT_EQ(ran.exit, 2);
        EXPECT_THAT(ran.err, HasSubstr("nowhere"));
    }
}

TEST(DpctlTop, EndsWith3WithoutADaemonAndLeavesTheTerminalAlone)
{
    Dpctl top{{"top", "--socket", "/nonexistent/control.sock"}, Dpctl::As::this_user, true};
    const Ran ran = top.wait();
    EXPECT_EQ(ran.exit, 3);
    EXPECT_EQ(ran.out, "");
}

} // namespace
} // namespace dpslave::test
