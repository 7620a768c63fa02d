// SPDX-License-Identifier: Apache-2.0
// What surrounds an incident is on the disk, and nothing suffers when it cannot be.
// Only here: files that are written beside a running bus, on a disk that is full or slow.
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

/// A gateway as a service: with a folder for what outlives it.
class Incidents : public testing::Test {
protected:
    std::filesystem::path state() const { return folder_ / "state"; }
    std::filesystem::path incidents() const { return state() / "incidents"; }
    Wiring wiring() const
    {
        Wiring wiring;
        wiring.environment = {{"STATE_DIRECTORY", state().string()}};
        wiring.line_keys = "timeout_ms = 5000\n"; // a busy machine is no incident
        return wiring;
    }
    static Json list(const Gateway& gateway) { return gateway.json({"trace", "--incidents"}); }
    static testing::AssertionResult lists(const Gateway& gateway, std::size_t count)
    {
        return eventually([&] { return list(gateway).at("incidents").size() == count; });
    }
    /// The lines of --incident, as soon as there is a file. What followed is in it two seconds later.
    static std::vector<Json> lines_of(const Gateway& gateway, const std::string& number)
    {
        Outcome outcome;
        EXPECT_TRUE(eventually([&] {
            outcome = gateway.dpctl({"trace", "--json", "--incident", number});
            return outcome.status == 0;
        })) << outcome.err;
        std::istringstream lines{outcome.out};
        std::vector<Json> all;
        for (std::string line; std::getline(lines, line);) all.push_back(Json::parse(line));
        return all;
    }
    /// Longer than the time before an incident that is kept: the start-up is not in it.
    static constexpr const char* kLongExchange = "wait 3500ms";
    /// A station that was in exchange and that its master has released.
    static void release(Gateway& gateway, const char* after = "wait 1s")
    {
        Master master{gateway, {"--tags", "55,56w"}};
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(master.does(after));
        ASSERT_TRUE(master.does("unlock"));
        ASSERT_TRUE(lists(gateway, 1));
    }
    static testing::AssertionResult appears(const std::filesystem::path& path)
    {
        return eventually([&] { return std::filesystem::exists(path); });
    }

    Folder folder_;
};

TEST_F(Incidents, OfAStationThatLeftHaveItsParametersAndTheTelegramsAroundIt)
{
    Gateway gateway{wiring()};
    release(gateway, kLongExchange);

    const Json one = list(gateway).at("incidents").at(0);
    EXPECT_EQ(one.at("number"), 1);
    EXPECT_EQ(one.at("kind"), "left");
    EXPECT_EQ(one.at("station"), "unwinder");
    EXPECT_EQ(one.at("reason"), "unlock");
    EXPECT_EQ(one.at("count"), 1);

    std::vector<Json> lines;
    const auto heard = [&](const char* service) {
        return std::count_if(lines.begin() + 5, lines.end(),
                             [&](const Json& entry) { return entry.at("service") == service; });
    };
    EXPECT_TRUE(eventually([&] {
        lines = lines_of(gateway, "1");
        return lines.size() > 5 && heard("Set_Prm") > 0;
    })) << "the one that released it";
    ASSERT_GT(lines.size(), 5U);
    EXPECT_GT(heard("Data_Exchange"), 0);
    EXPECT_EQ(lines[0].at("what"), "incident");
    const Json& station = lines[0].at("incident").at("stations").at(0);
    EXPECT_EQ(station.at("state"), "Data_Exch");
    EXPECT_EQ(station.at("master"), 2);
    EXPECT_EQ(lines[1].at("service"), "Set_Prm");
    EXPECT_TRUE(lines[1].contains("note"));
    EXPECT_THAT(lines[1].at("octets").get<std::string>(),
                HasSubstr(station.at("set_prm").get<std::string>()));
}

TEST_F(Incidents, ListTheirCauseAmongWhatIsBad)
{
    Gateway gateway{wiring()};
    release(gateway);

    EXPECT_TRUE(eventually([&] {
        const std::string said = gateway.dpctl({"trace", "--incident", "1", "--bad"}).out;
        const std::size_t cause = said.find("(the cause of the incident)");
        return cause != std::string::npos && said.rfind("Set_Prm", cause) != std::string::npos &&
               said.find("Data_Exchange") == std::string::npos;
    })) << "the Set_Prm that released it";
}

TEST_F(Incidents, OfAShortExchangeNeverHaveTheParametersThatEndedIt)
{
    Gateway gateway{wiring()};
    release(gateway, "wait 1ms");

    const Json station = lines_of(gateway, "1").at(0).at("incident").at("stations").at(0);
    const auto set_prm = station.at("set_prm").get<std::string>();
    EXPECT_TRUE(set_prm.empty() || set_prm.starts_with("B8")) << set_prm;
}

TEST_F(Incidents, AreDecodedWithTheLayoutOfTheirHead)
{
    Gateway gateway{wiring()};
    release(gateway);
    Master other{gateway, {"--tags", "62w"}}; // the layout that is in force when the incident is read
    ASSERT_TRUE(other.does("start 60s"));
    ASSERT_GT(lines_of(gateway, "1").size(), 5U);

    const std::string profiles = source_path("config/profiles");
    const std::string said =
        gateway.dpctl({"trace", "--incident", "1", "--decode", "--profiles", profiles}).out;
    EXPECT_EQ(said.find("incident 1,"), said.rfind("incident 1,")) << "its head, once: " << said;
    EXPECT_THAT(said, HasSubstr("55 Example: speed feedback"));
    EXPECT_THAT(said, testing::Not(HasSubstr("62 Example")));
}

TEST_F(Incidents, OutliveKillMinus9WithTheirNumbers)
{
    Gateway gateway{wiring()};
    release(gateway);
    ASSERT_TRUE(appears(incidents() / "1.incident"));
    gateway.daemon().end(SIGKILL);
    gateway.start_daemon();

    ASSERT_TRUE(lists(gateway, 1));
    EXPECT_GT(lines_of(gateway, "1").size(), 5U);

    Master master{gateway, {"--tags", "55,56w", "--ident", "0x1234"}};
    master.send_line("start 1s");
    ASSERT_TRUE(lists(gateway, 2));
    const Json second = list(gateway).at("incidents").at(1);
    EXPECT_EQ(second.at("number"), 2);
    EXPECT_EQ(second.at("kind"), "refused");
    EXPECT_EQ(second.at("reason"), "prm_ident");
}

TEST_F(Incidents, BecomeACaptureThatBeginsWithTheStartUp)
{
    Gateway gateway{wiring()};
    release(gateway, kLongExchange);
    const std::string path = gateway.folder("incident.pcapng").string();

    EXPECT_EQ(gateway.dpctl({"trace", "--incident", "1", "--output", path}).status, 0);

    std::ifstream file{path, std::ios::binary};
    const std::vector<std::uint8_t> octets{std::istreambuf_iterator<char>{file}, {}};
    const auto capture = pcapng::read(octets);
    ASSERT_TRUE(capture) << capture.error();
    ASSERT_GT(capture->packets.size(), 4U);
    EXPECT_THAT(capture->packets[0].comments.at(0), HasSubstr("from the head"));
    EXPECT_EQ(capture->packets[0].octets.at(7), 61) << "Set_Prm";
    EXPECT_EQ(capture->packets[2].octets.at(7), 62) << "Chk_Cfg";
}

TEST_F(Incidents, HaveTheFramesOfTheDriveLines)
{
    Gateway gateway{wiring()};
    release(gateway);
    ASSERT_GT(lines_of(gateway, "1").size(), 5U);

    const Outcome frames = gateway.dpctl({"trace", "--incident", "1", "--line", "p3"});
    EXPECT_EQ(frames.status, 0) << frames.err;
    EXPECT_THAT(frames.out, HasSubstr("BCC right: taken"));
    EXPECT_THAT(frames.out, testing::Not(HasSubstr("Data_Exchange"))) << "in place of the telegrams";
    EXPECT_THAT(gateway.dpctl({"trace", "--incident", "1"}).out, testing::Not(HasSubstr("taken")));
    const Outcome unknown = gateway.dpctl({"trace", "--incident", "1", "--line", "p4"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("incident 1 has no drive line 'p4'; it has: p3"));
}

TEST_F(Incidents, AreReplayedToAnotherDaemonWithoutADifference)
{
    Wiring slow = wiring();
    slow.bus_baud = 19'200; // a busy machine tears few telegrams into pieces
    const Folder captures;
    // False: the machine was too busy, a request of the master was not answered.
    const auto record = [&](const char* exchange, const std::string& path) {
        std::filesystem::remove_all(incidents());
        Gateway gateway{slow};
        release(gateway, exchange);
        const auto lines = lines_of(gateway, "1");
        EXPECT_GT(lines.size(), 5U);
        EXPECT_EQ(gateway.dpctl({"trace", "--incident", "1", "--output", path}).status, 0);
        return std::none_of(lines.begin(), lines.end(), [](const Json& line) {
            return line.at("what") == "unanswered" || line.at("what") == "piece";
        });
    };
    for (const char* exchange : {kLongExchange, "wait 100ms"}) { // without the start-up in it, and with it
        const std::string path = (captures / exchange).string();
        ASSERT_TRUE(record(exchange, path) || record(exchange, path) || record(exchange, path));

        const Gateway other{{.bus_baud = slow.bus_baud}};
        const Outcome outcome =
            run({program_path("dpsim"), "replay", path, "--port", other.bus_end().string(), "--baud",
                 std::to_string(other.bus_baud()), "--slot", "200ms"});
        EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr(": no difference"));
    }
}

TEST_F(Incidents, ThatCannotBeWrittenAreSaidOnceAndHinderNothing)
{
    Gateway gateway{wiring()};
    ASSERT_TRUE(lists(gateway, 0));
    std::filesystem::remove_all(incidents());
    write_file(incidents(), "in the way");

    Master master{gateway, {"--tags", "55,56w"}};
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(master.does("unlock"));
        ASSERT_TRUE(eventually([&] { return list(gateway).at("failures") >= i + 1; }));
    }
    EXPECT_TRUE(gateway.daemon().says("incidents are not kept until the folder can be written again"));
    EXPECT_EQ(gateway.daemon().how_often("incidents are not kept"), 0U) << "said once";
    EXPECT_TRUE(list(gateway).at("incidents").empty());

    std::filesystem::remove(incidents());
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(master.does("unlock"));
    EXPECT_TRUE(lists(gateway, 1));
    EXPECT_TRUE(gateway.daemon().says("incidents are kept again"));
}

TEST_F(Incidents, AreSkippedWhereAFileIsForeignOrCutOff)
{
    write_file(incidents() / "7.incident", "dpslaved incident 1\n{");
    write_file(incidents() / "letter.txt", "hello");
    Gateway gateway{wiring()};

    release(gateway);

    EXPECT_TRUE(gateway.daemon().ever_said("7.incident is skipped"));
    EXPECT_TRUE(gateway.daemon().ever_said("letter.txt is skipped"));
    EXPECT_EQ(list(gateway).at("incidents").at(0).at("number"), 8);
    EXPECT_EQ(gateway.dpctl({"trace", "--incident", "7"}).status, 2);
}

TEST_F(Incidents, AreOffWithoutAFolderAndTheReasonIsGiven)
{
    Gateway gateway;

    const Outcome outcome = gateway.dpctl({"trace", "--incidents"});

    EXPECT_EQ(outcome.status, 5);
    EXPECT_THAT(outcome.err, HasSubstr("STATE_DIRECTORY"));
}

} // namespace
} // namespace dpslave::test
