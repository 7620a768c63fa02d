// SPDX-License-Identifier: Apache-2.0
// dpctl read: by name, several tags, again and again.
#include "control/fixtures.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/live/tag_names.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <sstream>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

/// The daemon of fixtures has the tags 7 SPEED FEEDBACK, 8 SPEED DEMAND and 9 TORQUE.
class DpctlRead : public testing::Test {
protected:
    Ran run(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "read");
        arguments.insert(arguments.end(), {"--station", "unwinder", "--socket", daemon.socket()});
        return dpctl(std::move(arguments));
    }
    FixtureDaemon daemon;
};

TEST_F(DpctlRead, TakesANameOrThePartOfOneThatFitsNoOtherTag)
{
    const std::string value = "unwinder: tag 7 SPEED FEEDBACK is 50.00, raw 5000 (0x1388)\n";

    for (const char* name : {"SPEED FEEDBACK", "speed feedback", "feedback", "7"}) {
        const Ran ran = run({name});
        EXPECT_EQ(ran.exit, 0) << name << ran.err;
        EXPECT_EQ(ran.out, value) << name;
    }
    EXPECT_EQ(daemon.read(), (std::vector<int>{7, 7, 7, 7}));
}

TEST_F(DpctlRead, RefusesANameThatFitsSeveralTagsAndNamesThem)
{
    const Ran ran = run({"speed"});

    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "dpctl: 'speed' fits 2 tags of unwinder:\n"
                       "  TAG  NAME\n"
                       "    7  SPEED FEEDBACK\n"
                       "    8  SPEED DEMAND\n"
                       "Write the number, or more of the name.\n");
    EXPECT_TRUE(daemon.read().empty()) << "nothing was read";
}

TEST_F(DpctlRead, SaysWhenNoTagHasTheName)
{
    const Ran ran = run({"7", "colour"});

    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.err,
              "dpctl: no tag of unwinder has 'colour' in its name; dpctl read --names prints the names\n");
    EXPECT_TRUE(daemon.read().empty()) << "also none before it";
}

TEST_F(DpctlRead, ListsTheTagsWithTheirNames)
{
    EXPECT_EQ(run({"--names", "speed"}).out, "  TAG  NAME\n    7  SPEED FEEDBACK\n    8  SPEED DEMAND\n");
    EXPECT_EQ(Json::parse(run({"--names", "--json"}).out).at("tags").size(), 3u);
    EXPECT_EQ(run({"--names", "colour"}).out, "no tag of unwinder has such a name\n");
}

TEST_F(DpctlRead, ReadsSeveralTagsInTheirOrderAsOneJsonObjectALine)
{
    const Ran ran = run({"9", "feedback", "--json"});

    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(daemon.read(), (std::vector<int>{9, 7}));
    std::istringstream lines(ran.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_EQ(Json::parse(line), fixture("ReadTag"));
    EXPECT_EQ(count, 2);
}

TEST_F(DpctlRead, TakesNumbersInEachFormRangesAndNames)
{
    EXPECT_EQ(run({"007", "0x7", "7-8,9", "speed demand"}).exit, 0);
    EXPECT_EQ(daemon.read(), (std::vector<int>{7, 7, 7, 8, 9, 8}));
    EXPECT_EQ(run({"torq"}).exit, 0) << "no other tag begins so";
    EXPECT_EQ(run({"57-55"}).exit, 2);
    EXPECT_EQ(run({"7,"}).exit, 2);
}

TEST_F(DpctlRead, OfATagThatIsRefusedReadsTheOthersAndEndsWith5)
{
    const Ran ran = run({"1", "7"});

    EXPECT_EQ(ran.exit, 5);
    EXPECT_THAT(ran.out, HasSubstr("tag 7 SPEED FEEDBACK is 50.00"));
    EXPECT_EQ(ran.err, "dpctl: tag 1: read only (Demand Data: error code 1)\n");
}

TEST_F(DpctlRead, AgainAndAgainPrintsTheTimeAndEndsFineOnCtrlC)
{
    Dpctl reading{{"read", "--every", "100ms", "7", "--station", "5", "--socket", daemon.socket()}};

    EXPECT_TRUE(reading.prints("5000 (0x1388)\n"));
    EXPECT_TRUE(daemon.was_read(3)) << "into a pipe too, each at once";
    reading.signal(SIGINT);
    const Ran ran = reading.wait();

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_THAT(ran.out.substr(0, ran.out.find('\n')),
                MatchesRegex("[0-9:]{8}\\.[0-9]{3} unwinder: tag 7 SPEED FEEDBACK is 50.00, raw 5000 .*"));
}

TEST_F(DpctlRead, AgainAndAgainPrintsOneJsonObjectALine)
{
    Dpctl reading{
        {"read", "--every", "100ms", "7", "1", "--json", "--station", "5", "--socket", daemon.socket()}};

    EXPECT_TRUE(daemon.was_read(4));
    reading.signal(SIGTERM);
    const Ran ran = reading.wait();

    EXPECT_EQ(ran.exit, 0);
    std::istringstream lines(ran.out);
    std::vector<Json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(Json::parse(line));
    ASSERT_GE(all.size(), 2u);
    EXPECT_EQ(all[0], fixture("ReadTag"));
    EXPECT_EQ(all[1].at("error"), "org.dpslaved.Control.DriveRefused") << "a drive may answer next time";
}

/// Tag 2 never gets an answer.
TEST_F(DpctlRead, AgainAndAgainHasOneReadInTheDaemonAtMost)
{
    Dpctl reading{{"read", "--every", "100ms", "2", "7", "--timeout", "3", "--station", "5", "--socket",
                   daemon.socket()}};

    EXPECT_TRUE(daemon.was_read(1));
    const Ran ran = reading.wait();

    EXPECT_EQ(ran.exit, 4);
    EXPECT_THAT(ran.err, HasSubstr("no answer within 3000 ms"));
    EXPECT_EQ(daemon.read(), std::vector<int>{2}) << "30 intervals long";
}

TEST_F(DpctlRead, AgainAndAgainEndsOnCtrlCAlsoWhileADriveIsSilent)
{
    Dpctl reading{
        {"read", "--every", "1s", "2", "--timeout", "3600", "--station", "5", "--socket", daemon.socket()}};

    EXPECT_TRUE(daemon.was_read(1));
    reading.signal(SIGINT);

    EXPECT_EQ(reading.wait().exit, 0);
}

} // namespace
} // namespace dpslave::test
