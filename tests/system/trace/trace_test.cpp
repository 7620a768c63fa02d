// SPDX-License-Identifier: Apache-2.0
// What dpctl trace shows is what was on the wire.
// Only here: the ring of one process in the terminal of another one.
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include "dpslave/pcapng/pcapng.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

std::vector<Json> entries_of(const Gateway& gateway, Arguments more = {})
{
    Arguments arguments{"--json", "trace"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::istringstream lines{gateway.dpctl(arguments).out};
    std::vector<Json> entries;
    for (std::string line; std::getline(lines, line);) entries.push_back(Json::parse(line));
    return entries;
}

std::size_t count(const std::vector<Json>& entries, const char* key, const Json& value)
{
    return static_cast<std::size_t>(
        std::count_if(entries.begin(), entries.end(), [&](const Json& one) { return one.at(key) == value; }));
}

TEST(Trace, ShowsTheStartUpOfAStationWithItsReplies)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));

    const std::vector<Json> entries = entries_of(gateway);

    // The last one: on a busy machine one before may have come in pieces or too late, and was repeated.
    const auto set_prm = std::find_if(entries.rbegin(), entries.rend(),
                                      [](const Json& one) { return one.at("service") == "Set_Prm"; });
    ASSERT_NE(set_prm, entries.rend());
    EXPECT_EQ(set_prm->at("from"), 2);
    EXPECT_EQ(set_prm->at("to"), 5);
    EXPECT_EQ(set_prm->at("what"), "telegram");
    ASSERT_NE(set_prm, entries.rbegin());
    const Json& reply = *std::prev(set_prm);
    EXPECT_EQ(reply.at("what"), "reply");
    EXPECT_EQ(reply.at("octets"), "E5");
    EXPECT_LE(set_prm->at("last_ns"), reply.at("first_ns"));
    EXPECT_GT(count(entries, "service", "Data_Exchange"), 0U);
    EXPECT_EQ(count(entries, "what", "lost"), 0U);
}

TEST(Trace, CountsTheRepliesThatTheDaemonCounts)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(master.leaves());

    EXPECT_TRUE(eventually([&] { // what is counted may be a moment old
        const std::uint64_t replies = count(entries_of(gateway), "what", "reply");
        return replies != 0 && replies == gateway.counter("bus", "replies");
    }));
}

TEST(Trace, NamesWhatIsNoTelegramAndFiltersByAddressAndService)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    master.send_line("send 10 05 02 49 51 16");

    EXPECT_TRUE(eventually([&] {
        const auto bad = entries_of(gateway, {"--bad"});
        return std::any_of(bad.begin(), bad.end(), [](const Json& one) {
            return one.at("flaw") == "checksum" && one.at("octets") == "10 05 02 49 51 16";
        });
    }));

    for (const Json& one : entries_of(gateway, {"--service", "chk_cfg"}))
        EXPECT_EQ(one.at("service"), "Chk_Cfg");
    EXPECT_TRUE(entries_of(gateway, {"--station", "99"}).empty());
    EXPECT_FALSE(entries_of(gateway, {"--station", "unwinder"}).empty());
    EXPECT_EQ(gateway.dpctl({"trace", "--station", "nothing"}).status, 2);
}

TEST(Trace, FollowsFromNowOnUntilCtrlC)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));

    Process follower{gateway.dpctl_command({"trace", "--follow"})};
    EXPECT_TRUE(follower.says("  2 > 5   Data_Exchange  ["));
    EXPECT_FALSE(follower.ever_said("Set_Prm")) << "that was before";
    ASSERT_TRUE(master.does("unlock"));
    EXPECT_TRUE(follower.says("  2 > 5   Set_Prm  ["));

    follower.send(SIGINT);
    EXPECT_EQ(follower.wait(), 0);
}

TEST(Trace, WritesACaptureWithTheDirectionOfEachTelegram)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(master.leaves());
    const std::string path = gateway.folder("bus.pcapng").string();

    const Outcome outcome = gateway.dpctl({"trace", "--output", path});

    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, HasSubstr(" packets in " + path));
    std::ifstream file{path, std::ios::binary};
    const std::vector<std::uint8_t> octets{std::istreambuf_iterator<char>{file}, {}};
    const auto capture = pcapng::read(octets);
    ASSERT_TRUE(capture) << capture.error();
    EXPECT_EQ(capture->interfaces.at(0).link_type, 257);
    const auto sent = std::count_if(capture->packets.begin(), capture->packets.end(), [](const auto& one) {
        return one.interface == 0 && one.direction == pcapng::Direction::outbound;
    });
    EXPECT_EQ(static_cast<std::size_t>(sent), count(entries_of(gateway), "what", "reply"));
    const auto of_the_bus = std::count_if(capture->packets.begin(), capture->packets.end(),
                                          [](const auto& one) { return one.interface == 0; });
    EXPECT_EQ(capture->statistics.at(0).received, static_cast<std::uint64_t>(of_the_bus));
    EXPECT_EQ(capture->statistics.at(0).dropped, 0U);
}

TEST(Trace, ThatStopsOnATelegramEndsItsCaptureWithIt)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    const std::string path = gateway.folder("stopped.pcapng").string();

    const Outcome outcome = gateway.dpctl({"trace", "--output", path, "--stop-on", "service=set_prm,to=5"});

    EXPECT_EQ(outcome.status, 0) << outcome.err;
    std::ifstream file{path, std::ios::binary};
    const std::vector<std::uint8_t> octets{std::istreambuf_iterator<char>{file}, {}};
    const auto capture = pcapng::read(octets);
    ASSERT_TRUE(capture) << capture.error();
    ASSERT_GT(capture->packets.size(), 1U);
    EXPECT_EQ(capture->packets.back().octets.at(7), 61) << "DSAP of Set_Prm";
    EXPECT_EQ(capture->statistics.at(0).received, capture->packets.size());
}

TEST(Trace, DecodesTheDataOfOurStationByTheLayoutThatTheMasterHasChosen)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    ASSERT_TRUE(master.does("wait 10s for in 1 = 1250"));
    const Arguments decode{"trace", "--decode", "--profiles", source_path("config/profiles")};

    const Outcome whole = gateway.dpctl(decode);
    EXPECT_EQ(whole.status, 0) << whole.err;
    EXPECT_THAT(whole.out, HasSubstr("low octet: 55 Example: speed feedback"));
    EXPECT_THAT(whole.out, HasSubstr("    55 Example: speed feedback  12.50\n"));

    Arguments follow = decode; // the Set_Prm is not in it: the daemon says the layout
    follow.insert(follow.end(), {"--follow", "--stop-on", "from=5"});
    EXPECT_THAT(gateway.dpctl(follow).out, HasSubstr("    55 Example: speed feedback  12.50\n"));
}

TEST(Trace, OfADriveLineShowsQuestionsAnswersAndWaitsWithTheirJudgement)
{
    Gateway gateway{{.units = {"00", "01"}, .present = {"00"}}};
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));

    EXPECT_TRUE(eventually([&] {
        const auto entries = entries_of(gateway, {"--line", "p3"});
        return count(entries, "judgement", "taken") > 0 && count(entries, "what", "silence") > 0;
    }));
    const auto entries = entries_of(gateway, {"--line", "p3"});
    EXPECT_GT(count(entries, "what", "question"), 0U);
    for (const Json& one : entries) {
        EXPECT_EQ(one.at("line"), "p3");
        EXPECT_EQ(one.at("protocol"), "ei-ascii");
        EXPECT_TRUE(one.at("what") != "silence" || one.at("drive") == "01") << "00 is there: " << one;
    }
    for (const Json& one : entries_of(gateway, {"--line", "p3", "--bad"}))
        EXPECT_NE(one.at("judgement"), "taken");
    const Outcome unknown = gateway.dpctl({"trace", "--line", "p4"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("there is no drive line 'p4'; there are: p3"));
}

TEST(Trace, OfADriveLineFollowsUntilCtrlC)
{
    Gateway gateway{
        {.profile = "2408f", .units = {"1"}, .protocol = "modbus-rtu", .keys = "ident = 0x0A0B\n"}};
    Master master{gateway, {"--family", "controller", "--ident", "0x0A0B", "--tags", "1"}};
    ASSERT_TRUE(master.does("start 60s"));

    Process follower{gateway.dpctl_command({"trace", "--line", "p3", "--follow"})};
    EXPECT_TRUE(follower.says("> 1   read register"));
    EXPECT_TRUE(follower.says("CRC right: taken"));

    follower.send(SIGINT);
    EXPECT_EQ(follower.wait(), 0);
}

TEST(Trace, WritesTheBusAndTheDriveLinesIntoOneCaptureByTheirTimes)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    const std::string path = gateway.folder("all.pcapng").string();

    ASSERT_EQ(gateway.dpctl({"trace", "--output", path}).status, 0);

    std::ifstream file{path, std::ios::binary};
    const std::vector<std::uint8_t> octets{std::istreambuf_iterator<char>{file}, {}};
    const auto capture = pcapng::read(octets);
    ASSERT_TRUE(capture) << capture.error();
    ASSERT_EQ(capture->interfaces.size(), 2U);
    EXPECT_EQ(capture->interfaces.at(1).name, "drive p3");
    EXPECT_EQ(capture->interfaces.at(1).link_type, 148);
    EXPECT_TRUE(std::is_sorted(capture->packets.begin(), capture->packets.end(),
                               [](const auto& a, const auto& b) { return a.unix_ns < b.unix_ns; }));
    const auto is_taken = [](const pcapng::Packet& one) {
        return one.interface == 1 && one.direction == pcapng::Direction::inbound &&
               one.comments == std::vector<std::string>{"taken"};
    };
    EXPECT_GT(std::count_if(capture->packets.begin(), capture->packets.end(), is_taken), 0);
}

TEST(Trace, OfARecorderThatIsOffSaysHowToSwitchItOn)
{
    Gateway gateway{{.started = false}};
    write_file(gateway.config(), gateway.config_text() + "\n[trace]\nbus_kib = 0\n");
    gateway.start_daemon();

    const Outcome outcome = gateway.dpctl({"trace"});

    EXPECT_EQ(outcome.status, 5);
    EXPECT_THAT(outcome.err, HasSubstr("bus_kib"));
    EXPECT_EQ(gateway.dpctl({"trace", "--line", "p3"}).status, 0) << "that one is on";
}

} // namespace
} // namespace dpslave::test
