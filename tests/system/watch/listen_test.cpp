// SPDX-License-Identifier: Apache-2.0
// listen = true: a daemon that only listens, on a segment with a master and the slave of another daemon.
// Only here: a port that is opened for reading only.
#include "gateway.hpp"
#include "io/pty.hpp"
#include "support/paths.hpp"

#include "dpslave/io/tty.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <grp.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <thread>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::uint32_t kBaud = 187'500;

Arguments line_command(const std::filesystem::path& a, const std::filesystem::path& b)
{
    return {
        program_path("dpsim"), "line", "--baud", std::to_string(kBaud), "--bits", "11", "--a", a, "--b", b};
}

/// The simulated lines of two members, opened at their near ends, and a pty: what one sends, the others hear.
class Joint {
public:
    Joint(const std::string& one, const std::string& other, io::Pty& third) : third_(third)
    {
        for (const std::string& path : {one, other}) {
            auto tty = io::Tty::open(path, {.baud = kBaud});
            if (!tty) throw std::runtime_error(tty.error());
            ends_.push_back(*std::move(tty));
        }
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }

private:
    void run(const std::stop_token& stop)
    {
        while (!stop.stop_requested()) {
            std::array<pollfd, 3> ready{
                {{ends_[0].fd(), POLLIN, 0}, {ends_[1].fd(), POLLIN, 0}, {third_.fd(), POLLIN, 0}}};
            constexpr int kLookForTheEnd_ms = 10;
            ::poll(ready.data(), ready.size(), kLookForTheEnd_ms);
            for (std::size_t from = 0; from < ready.size(); ++from) pass_on(from);
        }
    }
    void pass_on(std::size_t from)
    {
        const auto octets = from < ends_.size() ? read(ends_[from]) : third_.received();
        if (octets.empty()) return;
        for (std::size_t to = 0; to < ends_.size(); ++to)
            if (to != from) static_cast<void>(ends_[to].write(octets));
        if (from < ends_.size()) third_.send(octets);
    }
    static std::vector<std::uint8_t> read(io::Tty& tty)
    {
        std::array<std::uint8_t, 512> buffer{};
        const auto chunk = tty.read(buffer);
        if (!chunk) return {};
        return {chunk->octets.begin(), chunk->octets.end()};
    }

    io::Pty& third_;
    std::vector<io::Tty> ends_;
    std::jthread thread_;
};

/// A segment with a master (of the test), the station 5 of one daemon, and a daemon that listens.
class Listen : public ::testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_TRUE(plc_line.says("ready"));
        ASSERT_TRUE(tap.says("ready"));
        joint.emplace(folder / "plc", folder / "tap", slave_end);
        const group* const own = ::getgrgid(::getegid());
        write_file(config, fmt::format("[bus]\nport = \"{}\"\nbaud = \"auto\"\nlisten = true\n"
                                       "[control]\nsocket = \"{}\"\noperator_group = \"{}\"\n",
                                       (folder / "listener").string(), (folder / "listen.sock").string(),
                                       own != nullptr ? own->gr_name : "root"));
        listener.emplace(Arguments{program_path("dpslaved"), "--config", config, "--profiles",
                                   source_path("config/profiles")});
        ASSERT_TRUE(listener->says("only listens on " + (folder / "listener").string()));
    }
    void TearDown() override
    {
        if (listener) {
            EXPECT_EQ(listener->end(), 0);
        }
        joint.reset();
        EXPECT_EQ(tap.end(), 0);
        EXPECT_EQ(plc_line.end(), 0);
    }

    Outcome ask(Arguments arguments) const
    {
        Arguments command{"/usr/bin/env", "COLUMNS=1000", program_path("dpctl"), "--socket",
                          folder / "listen.sock"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return run(std::move(command));
    }
    /// "0 octets": what the listening daemon has put on the segment, as the simulated line counts it.
    std::string sent_by_the_listener()
    {
        const std::size_t before = tap.transcript().size();
        tap.send_line("stats");
        const auto found = tap.transcript().await("b to a: ", before, kLimit);
        if (!found) return "the line gives no answer";
        const std::string line = tap.transcript().lines(*found).front();
        return line.substr(0, line.find(" passed"));
    }

    Folder folder;
    io::Pty slave_end;
    Gateway gateway{{.bus_baud = kBaud, .bus_port = slave_end.path()}};
    Process plc_line{line_command(gateway.bus_end(), folder / "plc")};
    Process tap{line_command(folder / "tap", folder / "listener")};
    std::filesystem::path config = folder / "listen.toml";
    std::optional<Joint> joint;
    std::optional<Process> listener;
};

TEST_F(Listen, ShowsTheSegmentAtTheRateThatItFindsAndSendsNotOneOctet)
{
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 50s"));
    ASSERT_TRUE(eventually(
        [&] { return ask({"status"}).out.find("187.5 kbit/s (Baud_Control)") != std::string::npos; }));
    ASSERT_TRUE(master.does("unlock")); // parameterised again, and heard from the first telegram on

    EXPECT_TRUE(eventually([&] {
        return ask({"trace", "--service", "set_prm"}).out.find("  2 > 5   Set_Prm  [") != std::string::npos;
    }));
    EXPECT_TRUE(eventually(
        [&] { return ask({"trace"}).out.find("  5 > 2   Data_Exchange, reply  [") != std::string::npos; }));
    const char* const slave = "     5  slave   0533   Data_Exch   2";
    EXPECT_TRUE(eventually([&] { return ask({"bus"}).out.find(slave) != std::string::npos; }))
        << ask({"bus"}).out;
    EXPECT_THAT(ask({"bus"}).out, HasSubstr("     2  master "));
    const auto status = ask({"status"});
    EXPECT_EQ(status.status, 0);
    EXPECT_THAT(status.out, HasSubstr("; only listens\n"));
    EXPECT_THAT(ask({"top"}).out, HasSubstr("only listens"));
    EXPECT_THAT(ask({"metrics"}).out, HasSubstr("dpslaved_bus_stations{"));
    EXPECT_THAT(ask({"events"}).out, HasSubstr(" started: it only listens"));
    const auto doctor = ask({"doctor"});
    EXPECT_EQ(doctor.status, 0) << doctor.out;
    EXPECT_THAT(doctor.out, HasSubstr("all is well"));
    EXPECT_THAT(doctor.out, HasSubstr("The daemon only listens"));

    EXPECT_THAT(sent_by_the_listener(), StartsWith("b to a: 0 octets"));
    EXPECT_TRUE(master.leaves());
}

TEST_F(Listen, IsSilentOnABusWhereItsRateIsSearchedAndWithoutAMaster)
{
    EXPECT_TRUE(eventually([&] { return ask({"doctor"}).out.find("not one octet") != std::string::npos; }));

    EXPECT_EQ(listener->end(), 0);
    listener.reset();
    EXPECT_THAT(sent_by_the_listener(), StartsWith("b to a: 0 octets"));
}

TEST_F(Listen, AnswersCommandsThatNeedAStationWithASentence)
{
    for (const Arguments& command : {Arguments{"io"},
                                     {"diag"},
                                     {"show"},
                                     {"read", "55"},
                                     {"write", "55", "1"},
                                     {"status", "5"},
                                     {"status", "--wait", "1"},
                                     {"doctor", "unwinder"},
                                     {"top", "unwinder"},
                                     {"survey"}}) {
        const Outcome outcome = ask(command);
        EXPECT_EQ(outcome.status, 5) << command.front();
        EXPECT_THAT(outcome.err, HasSubstr("the daemon only listens, so it has no station"))
            << command.front();
    }
}

TEST_F(Listen, NeedsARestartToHaveStations)
{
    std::string text = content(config);
    text.replace(text.find("listen = true\n"), 14, "direction = \"none\"\n");
    const std::string stations = gateway.config_text();
    write_file(config, text + "\n" + stations.substr(stations.find("[[line]]")));

    const Outcome outcome = ask({"reload"});

    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.out + outcome.err, HasSubstr("[bus] listen cannot change while the bus is served"));
    EXPECT_THAT(outcome.out + outcome.err, HasSubstr("restart the service"));
}

} // namespace
} // namespace dpslave::test
