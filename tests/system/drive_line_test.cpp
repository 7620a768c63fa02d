// SPDX-License-Identifier: Apache-2.0
// Late answers and an echo on the lines of the real daemon, one line of each kind: the rules themselves are
// judged on the simulated clock (tests/drive_line). Each tag holds a word of its own, so every word that the
// master sees shows its tag.
// Only here: the clients on a tty, with the daemon's threads around them.
#include "gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

namespace dpslave::test {
namespace {

using ::testing::ElementsAre;

constexpr const char* kWatched = "10s"; ///< long enough for several wrong images of a program that guesses

/// What the master saw in input `n` while it followed them.
std::set<int> seen(const Master& master, int n)
{
    std::set<int> words;
    const std::string begin = fmt::format("in {} is ", n);
    for (const std::string& line : master.transcript().lines())
        if (line.starts_with(begin)) words.insert(std::stoi(line.substr(begin.size())));
    return words;
}

// ---- Modbus

/// Four registers too far apart for one block, each with its own word, and one that is not there.
Wiring four_registers()
{
    Wiring wiring;
    wiring.profile = "2408f";
    wiring.protocol = "modbus-rtu";
    wiring.units = {"1"};
    wiring.drive = {"--turnaround", "10ms"};
    wiring.keys = "ident = 0x0A0B\n";
    wiring.table = "tag,name,type,decimals,min,max,access,start\n"
                   "1000,A,INT,0,,,ro,1111\n"
                   "1100,B,INT,0,,,ro,2222\n"
                   "1200,C,INT,0,,,ro,3333\n"
                   "1300,D,INT,0,,,ro,4444\n"
                   "1400,E,INT,0,,,rw,0\n";
    return wiring;
}

class InstrumentLine : public ::testing::Test {
protected:
    void begins(const Wiring& wiring)
    {
        gateway.emplace(wiring);
        master.emplace(*gateway, Arguments{"--family", "controller", "--ident", "0x0A0B", "--master", "36",
                                           "--tags", "1000,1100,1200,1300,1500,1400w"});
        ASSERT_TRUE(master->does("start 60s"));
        ASSERT_TRUE(master->does("wait 60s for in 4 = 4444"));
        ASSERT_TRUE(master->does("wait 60s for in 1 = 1111"));
        ASSERT_TRUE(master->does("follow on"));
    }
    void shows_only_its_own_words()
    {
        EXPECT_THAT(seen(*master, 1), ElementsAre(1111));
        EXPECT_THAT(seen(*master, 2), ElementsAre(2222));
        EXPECT_THAT(seen(*master, 3), ElementsAre(3333));
        EXPECT_THAT(seen(*master, 4), ElementsAre(4444));
        EXPECT_THAT(seen(*master, 5), ElementsAre(0)) << "the drive denies it";
    }
    std::optional<Gateway> gateway;
    std::optional<Master> master;
};

TEST_F(InstrumentLine, WithAnAnswerThatIsLateNowAndThenNeverShowsTheWordOfAnotherTag)
{
    begins(four_registers());
    gateway->drive().send_line("late 1300ms every 3s");
    EXPECT_TRUE(master->does(fmt::format("wait {}", kWatched)));
    shows_only_its_own_words();
}

// ---- EI-ASCII

/// Two drives with the same parameters; tags 55 and 57 of the first hold 10.01 and 10.02, of the second 20.01
/// and 20.02.
class TwoDrives : public ::testing::Test {
protected:
    void begins(const Wiring& wiring)
    {
        gateway.emplace(wiring);
        Process& drive = gateway->drive();
        for (const char* const command :
             {"unit 00", "set 55 10.01", "set 57 10.02", "unit 01", "set 55 20.01", "set 57 20.02"})
            drive.send_line(command);
        {
            Master first{*gateway, {"--tags", "55,57,56w", "--no-watchdog"}, 5}; // the slave goes on alone
            ASSERT_TRUE(first.does("start 60s"));
            ASSERT_TRUE(first.does("out 1 = 500"));
            ASSERT_TRUE(drive.says("unit 00: tag 56 written 5.00"));
            ASSERT_TRUE(first.does("stop"));
            ASSERT_TRUE(first.leaves());
        }
        master.emplace(*gateway, Arguments{"--tags", "55,57,56w"}, 6);
        ASSERT_TRUE(master->does("start 60s"));
        ASSERT_TRUE(master->does("wait 60s for in 1 = 2001"));
        ASSERT_TRUE(master->does("wait 60s for in 2 = 2002"));
        ASSERT_TRUE(master->does("follow on"));
    }
    std::optional<Gateway> gateway;
    std::optional<Master> master;
};

TEST_F(TwoDrives, WithTheSameMnemonicsAreNeverTakenForEachOtherWhereOneIsALittleTooLate)
{
    begins({.units = {"00", "01"}, .drive = {"--turnaround", "5ms"}});
    gateway->drive().send_line("unit 00");
    gateway->drive().send_line("late 210ms-230ms 1/2");
    EXPECT_TRUE(master->does(fmt::format("wait {}", kWatched)));
    EXPECT_THAT(seen(*master, 1), ElementsAre(2001));
    EXPECT_THAT(seen(*master, 2), ElementsAre(2002));
}

TEST(EchoOfALine, IsNotTakenForAnAnswerOfTheDriveThatIsThere)
{
    Gateway gateway{{.drive = {"--fault", "echo on"}, .line_keys = "echo = \"on\"\n"}};
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
}

} // namespace
} // namespace dpslave::test
