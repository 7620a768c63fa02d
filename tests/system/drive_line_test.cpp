// SPDX-License-Identifier: Apache-2.0
// Drive lines under stress: late answers, spoilt frames, noise, an echo, drives that are not there. Each tag
// holds a word of its own, so every word that the master sees shows its tag.
#include "gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>

namespace dpslave::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
Wiring four_registers(const std::string& line_keys = "")
{
    Wiring wiring;
    wiring.profile = "2408f";
    wiring.protocol = "modbus-rtu";
    wiring.units = {"1"};
    wiring.drive = {"--turnaround", "10ms"};
    wiring.line_keys = line_keys;
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

TEST_F(InstrumentLine, WithALateExceptionNeverShowsZeroForATagThatIsThere)
{
    begins(four_registers());
    gateway->drive().send_line("late 1300ms tag 1500");
    gateway->drive().send_line("late 1300ms 1/40 tag 1200");
    EXPECT_TRUE(master->does("wait 14s")); // what was denied is asked every 10 s
    shows_only_its_own_words();
}

TEST_F(InstrumentLine, WithoutFunction8SettlesLateAnswersAsWell)
{
    begins(four_registers("timeout_ms = 200\n"));
    gateway->drive().send_line("no-loopback");
    gateway->drive().send_line("late 500ms 1/15");
    EXPECT_TRUE(master->does(fmt::format("wait {}", kWatched)));
    shows_only_its_own_words();
}

TEST_F(InstrumentLine, WithASpoiltFrameBeforeAnAnswerDoesNotTakeThatAnswerForTheNext)
{
    begins(four_registers());
    gateway->drive().send_line("spoil 1/15");
    gateway->drive().send_line("late 40ms 1/15");
    EXPECT_TRUE(master->does("wait 5s"));
    shows_only_its_own_words();
    gateway->drive().send_line("ok");
    gateway->drive().send_line("set 1000 1112");
    EXPECT_TRUE(master->does("wait 60s for in 1 = 1112"));
}

TEST(DeadDrives, OnALineDelayAChangedOutputByTwoTimeOutsAtMost)
{
    Wiring wiring = four_registers();
    wiring.units = {"1", "2", "3", "4", "5", "6"};
    wiring.present = {"1"};
    Gateway gateway{wiring};
    Master master{gateway,
                  {"--family", "controller", "--ident", "0x0A0B", "--master", "36", "--tags", "1000,1400w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(gateway.daemon().says("stacker: the drive does not answer"));
    ASSERT_TRUE(master.does("out 1 = 1"));
    ASSERT_TRUE(gateway.drive().says("tag 1400 written 1"));

    constexpr std::chrono::milliseconds kTwoTimeOuts{1200}, kMachine{500};
    for (int value = 2; value < 12; ++value) {
        const auto changed = std::chrono::steady_clock::now();
        ASSERT_TRUE(master.does(fmt::format("out 1 = {}", value)));
        ASSERT_TRUE(gateway.drive().says(fmt::format("tag 1400 written {}", value)));
        EXPECT_LT(std::chrono::steady_clock::now() - changed, kTwoTimeOuts + kMachine)
            << "change to " << value;
        ASSERT_TRUE(master.does("wait 800ms"));
    }
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

TEST_F(TwoDrives, AreNeverTakenForEachOtherWhereOneIsLateNowAndThen)
{
    begins({.units = {"00", "01"}, .drive = {"--turnaround", "5ms"}});
    gateway->drive().send_line("unit 00");
    gateway->drive().send_line("late 900ms 1/20");
    for (int i = 1; i <= 8; ++i) {
        gateway->drive().send_line(fmt::format("set 55 {}", 10 + i)); // of the other one
        EXPECT_TRUE(master->does("wait 1s"));
    }
    EXPECT_THAT(seen(*master, 1), ElementsAre(2001));
    EXPECT_THAT(seen(*master, 2), ElementsAre(2002));
}

TEST_F(TwoDrives, DoNotTakeALateAcknowledgementOfOneForThatOfTheOther)
{
    begins({.units = {"00", "01"}, .output_refresh_s = "0.1"});
    Process& drive = gateway->drive();
    ASSERT_TRUE(master->does("out 1 = 700"));
    ASSERT_TRUE(drive.says("unit 01: tag 56 written 7.00"));
    drive.send_line("unit 00");
    drive.send_line("late 300ms tag 56");
    drive.send_line("unit 01");
    drive.send_line("silence");
    ASSERT_TRUE(master->does("unlock")); // the zero cannot reach it
    EXPECT_TRUE(gateway->daemon().says("rewinder: the drive does not answer"));
    drive.send_line("unit 00");
    drive.send_line("ok");
    drive.skip();
    drive.send_line("unit 01");
    drive.send_line("ok");
    EXPECT_TRUE(drive.says("unit 01: tag 56 written 0.00"));
}

TEST(EiAsciiLine, WithAStrayEotDoesNotDenyATag)
{
    Gateway gateway;
    gateway.drive().send_line("set 55 12.50");
    Master master{gateway, {"--tags", "55,57,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(master.does("wait 60s for in 1 = 1250"));
    ASSERT_TRUE(master.does("follow on"));
    for (int i = 0; i < 5; ++i) {
        gateway.drive().send_line("instead 04 once tag 55");
        EXPECT_TRUE(master.does("wait 500ms"));
    }
    EXPECT_THAT(seen(master, 1), ElementsAre(1250));
}

TEST(EiAsciiLine, WithMoreDecimalsThanTheTableSaysIsNotReadWithFewer)
{
    Gateway gateway;
    gateway.drive().send_line("text 61 12.34"); // the table says one decimal
    EXPECT_THAT(gateway.dpctl({"read", "61"}).out, Not(HasSubstr("12")));
    gateway.drive().send_line("text 61 12.5");
    const Outcome outcome = gateway.dpctl({"read", "61"});
    EXPECT_NE(outcome.status, 0) << outcome.out;
}

class Echo : public ::testing::TestWithParam<const char*> {};

TEST_P(Echo, OfALineWithoutDriveIsNoDrive)
{
    Wiring wiring;
    wiring.present = {"07"};
    wiring.drive_baud = 9600;
    wiring.drive = {"--fault", "echo on"};
    wiring.line_keys = GetParam();
    Gateway gateway{wiring};
    EXPECT_TRUE(gateway.daemon().says("unwinder: the drive does not answer"));
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 4s"));
    EXPECT_FALSE(gateway.daemon().ever_said("the drive answers"));
}

INSTANTIATE_TEST_SUITE_P(Configured, Echo, ::testing::Values("", "echo = \"on\"\n", "echo = \"auto\"\n"));

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
