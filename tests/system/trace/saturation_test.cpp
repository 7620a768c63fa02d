// SPDX-License-Identifier: Apache-2.0
// A trace of a bus without a pause at 1.5 Mbit/s has what the simulated line counted, octet for octet. In
// ctest the traffic of 20 seconds; DPSLAVE_TRACE_SECONDS=600 makes it ten minutes (docs/internals/trace.md).
// Only here: a ring that a reader follows as fast as a tty can bring octets.
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include "dpslave/pcapng/pcapng.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;
using Octets = std::vector<std::uint8_t>;
using pcapng::Direction;

constexpr unsigned kBaud = 1'500'000;
constexpr std::uint64_t kOctetsInASecond = kBaud / 11;
constexpr const char* kTshark = "/usr/bin/tshark";

std::uint64_t seconds_of_traffic()
{
    const char* const text =
        std::getenv("DPSLAVE_TRACE_SECONDS"); // NOLINT(concurrency-mt-unsafe): nobody sets it
    return text != nullptr ? std::strtoull(text, nullptr, 10) : 20;
}

Octets octets_in(const std::filesystem::path& path)
{
    std::ifstream file{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{file}, {}};
}

/// The packets of the bus in a capture, which may still grow.
std::vector<pcapng::Packet> packets_in(const std::filesystem::path& path)
{
    bool is_cut = false;
    auto capture = pcapng::read(octets_in(path), &is_cut);
    if (!capture) return {};
    std::vector<pcapng::Packet> packets;
    std::copy_if(capture->packets.begin(), capture->packets.end(), std::back_inserter(packets),
                 [](const pcapng::Packet& one) { return one.interface == 0; });
    return packets;
}

/// All of one direction, one behind the other.
Octets octets_of(const std::vector<pcapng::Packet>& packets, Direction direction)
{
    Octets all;
    for (const pcapng::Packet& one : packets)
        if (one.direction == direction) all.insert(all.end(), one.octets.begin(), one.octets.end());
    return all;
}

/// Says where they differ, for they have millions.
::testing::AssertionResult are_equal(const Octets& captured, const Octets& counted)
{
    const auto [one, other] = std::mismatch(captured.begin(), captured.end(), counted.begin(), counted.end());
    if (one == captured.end() && other == counted.end()) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure()
           << captured.size() << " octets captured, " << counted.size()
           << " counted; the first other one is number " << one - captured.begin();
}

std::uint64_t dropped_in(const std::filesystem::path& capture)
{
    const auto whole = pcapng::read(octets_in(capture));
    return whole ? whole->statistics.at(0).dropped : 0;
}

/// That the follower has written so much. Nothing tells when it has.
::testing::AssertionResult has_all_of(const std::filesystem::path& capture, const Octets& heard,
                                      const Octets& spoken)
{
    return eventually(
        [&] {
            const auto packets = packets_in(capture);
            return octets_of(packets, Direction::inbound).size() >= heard.size() &&
                   octets_of(packets, Direction::outbound).size() >= spoken.size();
        },
        kLimit + std::chrono::seconds{seconds_of_traffic()});
}

/// That it has written what was said last. Each exchange of the others has another number.
::testing::AssertionResult has_end_of(const std::filesystem::path& capture, const Octets& heard)
{
    constexpr std::ptrdiff_t kEnd = 1000;
    return eventually([&] {
        const Octets written = octets_of(packets_in(capture), Direction::inbound);
        return written.size() >= kEnd && std::equal(written.end() - kEnd, written.end(), heard.end() - kEnd);
    });
}

/// The number that a line of the simulated line's counters begins with: "a to b: 123 octets passed, ...".
std::uint64_t passed(const std::string& line)
{
    std::uint64_t count = 0;
    const std::size_t at = line.find(": ") + 2;
    std::from_chars(line.data() + at, line.data() + line.size(), count);
    return count;
}

/// Gateway and master at 1.5 Mbit/s. The master sends what other stations say before each request of its own,
/// and goes on at once. The line logs what arrives at both ends.
class TraceAtSaturation : public testing::Test {
protected:
    Folder folder;
    Gateway gateway{{.bus_baud = kBaud,
                     .bus = {"--log-a", folder / "spoken", "--log-b", folder / "heard"},
                     .started = false}};

    /// The rings have this size.
    void start_daemon(unsigned kib)
    {
        write_file(gateway.config(),
                   gateway.config_text() + "\n[trace]\nbus_kib = " + std::to_string(kib) + "\n");
        gateway.start_daemon();
    }
    std::unique_ptr<Master> start_master() const
    {
        return std::make_unique<Master>(
            gateway, Arguments{"--tags", "55,56w", "--cycle", "0", "--others", "32", "--slot", "200ms"});
    }
    std::uint64_t heard() { return passed(gateway.passed_on_the_bus("a to b")); }
    ::testing::AssertionResult traffic_goes_on(Master& master, std::uint64_t octets)
    {
        for (const std::uint64_t end = heard() + octets; heard() < end;)
            if (const auto done = master.does("wait 500ms"); !done) return done;
        return ::testing::AssertionSuccess();
    }
    /// The bus is silent from then on: the answer comes behind all that was said before.
    static ::testing::AssertionResult leaves(Master& master)
    {
        for (const char* const command : {"stop", "get-cfg"})
            if (const auto done = master.does(command); !done) return done;
        return master.leaves();
    }
    /// A follower that the daemon knows: what is said from now on is in its capture.
    ::testing::AssertionResult follows(const std::filesystem::path& capture) const
    {
        return eventually([&] {
            const auto begin = pcapng::read(octets_in(capture));
            return begin && !begin->interfaces.empty();
        });
    }
    /// What arrived at the ends of the line, as it logged it. Precondition: the bus is silent.
    Octets log_of_heard() { return log("a to b", "heard"); }
    Octets log_of_spoken() { return log("b to a", "spoken"); }

private:
    Octets log(const std::string& direction, const std::string& name)
    {
        const std::string line = gateway.passed_on_the_bus(direction);
        EXPECT_THAT(line,
                    HasSubstr(" 0 spoilt, 0 lost while cut, 0 lost because they were not read, 0 sent"));
        Octets octets = octets_in(folder / name);
        EXPECT_EQ(octets.size(), passed(line));
        return octets;
    }
};

/// No packet that a dissector cannot read.
void expect_nothing_malformed(const Gateway& gateway, const std::filesystem::path& capture)
{
    if (!std::filesystem::exists(kTshark)) return; // the tests of the captures say that it is missing
    const std::filesystem::path shown = gateway.folder("malformed");
    const std::string scripts = "lua_script:" + source_path("config/wireshark/");
    Process tshark{
        {"/bin/sh", "-c", R"(exec "$@" >"$0")", shown, kTshark, "-r", capture, "-X",
         scripts + "dpslaved_profibus.lua", "-X", scripts + "dpslaved_drive.lua", "-Y",
         "_ws.malformed || _ws.lua.error"},
        {{"HOME", gateway.folder("home").string()}, {"XDG_CONFIG_HOME", gateway.folder("home").string()}}};
    EXPECT_EQ(tshark.wait(kLimit + 3 * std::chrono::seconds{seconds_of_traffic()}), 0);
    EXPECT_EQ(content(shown), "");
}

/// How full the line was and what came of it, for the page that names it.
void print_figures(const Octets& heard, const Octets& spoken, const std::vector<pcapng::Packet>& packets,
                   std::chrono::nanoseconds took)
{
    const auto torn =
        std::count_if(packets.begin(), packets.end(), [](const auto& one) { return one.checksum_error; });
    const double wanted = static_cast<double>(heard.size() + spoken.size()) / kOctetsInASecond;
    std::printf("%zu octets heard and %zu spoken in %zu packets, %td of them pieces: %.0f %% of %.0f s\n",
                heard.size(), spoken.size(), packets.size(), torn,
                100 * wanted / std::chrono::duration<double>(took).count(),
                std::chrono::duration<double>(took).count());
}

TEST_F(TraceAtSaturation, HasEachOctetThatTheLineCountedAndNoMore)
{
    start_daemon(4096);
    const std::filesystem::path path = folder / "bus.pcapng";
    Process follower{gateway.dpctl_command({"trace", "--follow", "--output", path})};
    ASSERT_TRUE(follows(path));

    const auto began = std::chrono::steady_clock::now();
    const auto master = start_master();
    ASSERT_TRUE(master->does("start 60s"));
    ASSERT_TRUE(traffic_goes_on(*master, seconds_of_traffic() * kOctetsInASecond));
    ASSERT_TRUE(leaves(*master));
    const auto took = std::chrono::steady_clock::now() - began;

    const Octets heard = log_of_heard(), spoken = log_of_spoken();
    EXPECT_TRUE(has_all_of(path, heard, spoken));
    follower.send(SIGINT);
    EXPECT_EQ(follower.wait(), 0);
    const auto packets = packets_in(path);
    EXPECT_TRUE(are_equal(octets_of(packets, Direction::inbound), heard));
    EXPECT_TRUE(are_equal(octets_of(packets, Direction::outbound), spoken));
    EXPECT_EQ(dropped_in(path), 0U);
    const auto telegrams = std::count_if(packets.begin(), packets.end(), [](const pcapng::Packet& one) {
        return one.direction == Direction::inbound && !one.checksum_error && !one.octets.empty();
    });
    EXPECT_EQ(static_cast<std::uint64_t>(telegrams), gateway.counter("bus", "telegrams"))
        << "a telegram is what layer 2 took for one";
    expect_nothing_malformed(gateway, path);
    print_figures(heard, spoken, packets, took);
}

/// Followers that stand still, with a ring that holds a second.
class StalledReader : public TraceAtSaturation {
protected:
    static constexpr std::uint64_t kTraffic = 2 * kOctetsInASecond;
    /// More than ring, socket and what the daemon keeps for a caller hold together.
    static constexpr std::uint64_t kMuch = 8 * kOctetsInASecond;

    void SetUp() override { start_daemon(256); }

    /// Traffic, a stop of the followers in the midst of it, and traffic again. `follow`: true as soon as all
    /// of them are known to the daemon.
    template <class Follow>
    void stall(const std::vector<Process*>& followers, Follow follow)
    {
        const auto master = start_master();
        ASSERT_TRUE(master->does("start 60s"));
        ASSERT_TRUE(eventually([&] { return master->does("get-cfg") && follow(); }));
        ASSERT_TRUE(traffic_goes_on(*master, kTraffic));
        for (Process* const one : followers) one->send(SIGSTOP);
        ASSERT_TRUE(traffic_goes_on(*master, kMuch));
        for (Process* const one : followers) one->send(SIGCONT);
        ASSERT_TRUE(traffic_goes_on(*master, kTraffic));
        ASSERT_TRUE(leaves(*master));
    }
};

TEST_F(StalledReader, HasItsLossAsANumberInACaptureThatIsWholeBeforeAndBehindIt)
{
    const std::filesystem::path path = folder / "bus.pcapng";
    Process follower{gateway.dpctl_command({"trace", "--follow", "--output", path})};
    ASSERT_TRUE(follows(path));
    stall({&follower}, [] { return true; });
    const Octets heard = log_of_heard();
    EXPECT_TRUE(has_end_of(path, heard));
    follower.send(SIGINT);
    EXPECT_EQ(follower.wait(), 0);

    const auto packets = packets_in(path);
    const auto has_loss = [](const pcapng::Packet& one) { return one.dropped.value_or(0) != 0; };
    const auto first = std::find_if(packets.begin(), packets.end(), has_loss);
    ASSERT_NE(first, packets.end());
    const auto last = std::prev(std::find_if(packets.rbegin(), packets.rend(), has_loss).base());
    const Octets before = octets_of({packets.begin(), first}, Direction::inbound);
    const Octets behind = octets_of({last, packets.end()}, Direction::inbound);
    EXPECT_GT(before.size(), 0U);
    EXPECT_LT(before.size() + behind.size(), heard.size());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), heard.begin()));
    EXPECT_TRUE(std::equal(behind.rbegin(), behind.rend(), heard.rbegin()));
    std::uint64_t dropped = 0;
    for (const pcapng::Packet& one : packets) dropped += one.dropped.value_or(0);
    EXPECT_EQ(dropped, dropped_in(path));
    expect_nothing_malformed(gateway, path);
}

TEST_F(StalledReader, SaysInTextAndJsonHowManyRecordsWereLost)
{
    Process text{gateway.dpctl_command({"trace", "--follow", "--service", "get_cfg"})};
    Process json{gateway.dpctl_command({"--json", "trace", "--follow", "--service", "get_cfg"})};
    stall({&text, &json}, [&] { return text.ever_said("Get_Cfg") && json.ever_said("Get_Cfg"); });

    EXPECT_TRUE(text.says(" records were lost here"));
    EXPECT_FALSE(text.ever_said(" 0 records were lost here"));
    EXPECT_TRUE(json.says("\"what\":\"lost\""));
    for (const std::string& line : json.transcript().lines()) {
        const Json entry = Json::parse(line);
        EXPECT_TRUE(entry.at("what") != "lost" || entry.at("lost") > 0) << line;
    }
}

} // namespace
} // namespace dpslave::test
