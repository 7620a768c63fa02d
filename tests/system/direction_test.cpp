// SPDX-License-Identifier: Apache-2.0
// The line that switches the RS-485 driver: the real daemon over a stand-in of libgpiod whose chip is a file,
// and keeps the level of a line whose owner has died, as many chips do.
// Only here: a process that is killed while its line is high.
#include "gateway.hpp"
#include "support/gpio_stand_in/chip.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <random>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr unsigned kLine = 5;
constexpr unsigned kBaud = 9'600; // a reply takes long: much of the time the line is active

/// A gateway whose transceiver hangs on a line of `chip`. The daemon is not started yet.
class Switched {
public:
    explicit Switched(bool active_low = false)
        : gateway({.bus_baud = kBaud, .environment = environment, .started = false})
    {
        use(chip.path(), kLine, active_low);
        chip.watch(kLine, gateway.folder("bus-gateway"), kBaud);
        chip.leave(kLine, !active_low); // as a program that died would have left it
    }
    void use(const std::string& path, unsigned line, bool active_low = false)
    {
        std::string text = gateway.config_text();
        const std::string none = "direction = \"none\"\n";
        text.replace(text.find(none), none.size(),
                     "direction = \"gpio\"\ngpio_chip = \"" + path +
                         "\"\ngpio_line = " + std::to_string(line) +
                         "\ngpio_active_low = " + (active_low ? "true" : "false") + "\n");
        write_file(gateway.config(), text);
    }
    Outcome run_daemon(Arguments more = {}) const
    {
        return run(gateway.daemon_command(std::move(more)), environment);
    }
    /// The driver has been on and off for so many more replies.
    ::testing::AssertionResult answers(unsigned replies)
    {
        const unsigned before = chip.watched().releases;
        return eventually([&] { return chip.watched().releases - before >= replies; });
    }

    Folder folder;
    /// As the service manager starts it.
    const Environment environment{{"LD_LIBRARY_PATH", built_path("tests/gpio_stand_in")},
                                  {"RUNTIME_DIRECTORY", (folder / "").string()}};
    stand_in::ChipFile chip{folder / "gpiochip0", "pl061"};
    Gateway gateway;
};

TEST(DriverEnable, IsHighWhileTheDaemonSendsAndLowWithinACharacterAfterEachReply)
{
    Switched at;
    at.gateway.start_daemon();
    EXPECT_FALSE(at.chip.high(kLine)) << "at start, whatever it was before";
    EXPECT_TRUE(at.gateway.daemon().ever_said("line 5 of GPIO chip " + at.chip.path().string()));
    Master master{at.gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(at.answers(40));

    EXPECT_EQ(at.gateway.daemon().end(), 0);

    const stand_in::Watch& seen = at.chip.watched();
    EXPECT_FALSE(at.chip.high(kLine)) << "at the end";
    EXPECT_FALSE(at.chip.is_taken(kLine));
    EXPECT_EQ(seen.writes_while_inactive, 0U);
    EXPECT_EQ(at.chip.rises(kLine), seen.writes) << "once for each reply";
    EXPECT_EQ(at.chip.falls(kLine), seen.writes + 1) << "and once at start";
    // Not of every single one: where the machine lets the master wait for too long it repeats itself in the
    // middle of a reply.
    EXPECT_LT(seen.releases_early * 10, seen.releases) << "of " << seen.releases;
    EXPECT_GT(seen.releases_in_time, seen.releases * 3 / 4) << "of " << seen.releases;
    EXPECT_EQ(at.chip.requests(kLine), 1U);
    at.gateway.start_daemon();
}

TEST(DriverEnable, ThatIsActiveLowIsLowWhileTheDaemonSends)
{
    Switched at{true};
    at.gateway.start_daemon();
    EXPECT_TRUE(at.chip.high(kLine));
    Master master{at.gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(at.answers(5));

    EXPECT_EQ(at.gateway.daemon().end(), 0);

    EXPECT_TRUE(at.chip.high(kLine));
    EXPECT_EQ(at.chip.watched().writes_while_inactive, 0U);
    EXPECT_EQ(at.chip.falls(kLine), at.chip.watched().writes);
    at.gateway.start_daemon();
}

TEST(DriverEnable, IsInactiveAfterThePortHasGoneInTheMiddleOfAReply)
{
    Switched at;
    at.gateway.start_daemon();
    {
        Master master{at.gateway, {"--tags", "55"}};
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(at.answers(5));
        ASSERT_TRUE(eventually([&] { return at.chip.high(kLine); }));
        at.gateway.unplug_bus();
    }
    EXPECT_TRUE(at.gateway.daemon().says("is missing"));
    EXPECT_TRUE(eventually([&] { return !at.chip.high(kLine); }));
    EXPECT_TRUE(at.chip.is_taken(kLine)) << "it is never given back in service";

    at.gateway.plug_bus();
    EXPECT_TRUE(at.gateway.daemon().says("is back"));
    at.chip.watch(kLine, at.gateway.folder("bus-gateway"), kBaud);
    Master again{at.gateway, {"--tags", "55"}};
    EXPECT_TRUE(again.does("start 60s"));
}

TEST(DriverEnable, ThatCannotBeHadKeepsTheBusSilentAndIsNamed)
{
    struct Case {
        const char* chip;
        unsigned line;
        const char* sentence;
    };
    Switched at;
    at.chip.occupy(2, "gpio-leds");
    const std::string chip = at.chip.path();
    for (const auto& [path, line, sentence] :
         {Case{chip.c_str(), 2, "in use by \"gpio-leds\""}, Case{chip.c_str(), 8, "8 lines, from 0 to 7"},
          Case{"/dev/not-there", kLine, "/dev/not-there is not there"},
          Case{"no-such-label", kLine, "no chip has this name or label"}}) {
        SCOPED_TRACE(sentence);
        at.use(path, line);
        at.gateway.start_daemon();
        EXPECT_TRUE(at.gateway.daemon().says(sentence));
        for (const char* const part : {"driver enable: ", "`gpio", "it is tried again"})
            EXPECT_TRUE(at.gateway.daemon().ever_said(part)) << part;
        EXPECT_EQ(at.gateway.daemon().end(SIGTERM), 0);
    }
    EXPECT_EQ(at.gateway.spoken_on_the_bus(), "b to a: 0 octets");
}

TEST(DriverEnable, OfAChipThatIsMissingAtTheStartIsTakenWhenItHasCome)
{
    Switched at;
    at.chip.remove();
    at.gateway.start_daemon();
    EXPECT_TRUE(at.gateway.daemon().says("driver enable: "));
    EXPECT_FALSE(at.gateway.json({"status"}).at("bus").at("port_open"));
    at.chip.come_back();
    at.chip.watch(kLine, at.gateway.folder("bus-gateway"), kBaud);
    Master master{at.gateway, {"--tags", "55"}};
    EXPECT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(at.answers(5));
}

TEST(DriverEnable, WhoseChipIsPulledSilencesTheDaemonUntilItIsBack)
{
    Switched at;
    at.gateway.start_daemon();
    Master master{at.gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(at.answers(5));

    at.chip.remove();
    EXPECT_TRUE(at.gateway.daemon().says("the driver enable of"));
    const unsigned sent = at.chip.watched().writes;
    EXPECT_TRUE(master.does("wait 60s for state not data-exchange"));
    EXPECT_EQ(at.chip.watched().writes, sent) << "a reply without driver enable is no reply";
    EXPECT_TRUE(eventually([&] { return at.gateway.counter("bus", "driver_errors") > 0; }));

    at.chip.come_back();
    EXPECT_TRUE(at.gateway.daemon().says("works again"));
    EXPECT_TRUE(master.does("wait 60s for state data-exchange"));
    EXPECT_EQ(at.chip.watched().writes_while_inactive, 0U);
    EXPECT_EQ(at.gateway.daemon().end(), 0);
    EXPECT_FALSE(at.chip.high(kLine));
    at.gateway.start_daemon();
}

TEST(DriverEnable, OfAKilledDaemonIsReleasedWhateverHasBecomeOfTheConfiguration)
{
    Switched at;
    const std::string good = content(at.gateway.config()) + "\n";
    std::string other = good;
    other.replace(other.find("gpio_line = 5"), 13, "gpio_line = 4");
    for (const std::string& edited : {other, "bus = [\n" + good}) {
        SCOPED_TRACE(edited);
        at.gateway.start_daemon();
        EXPECT_EQ(at.gateway.daemon().end(SIGKILL), 128 + SIGKILL);
        at.chip.leave(kLine, true); // as if that had come in the middle of a reply
        write_file(at.gateway.config(), edited);

        const Outcome released = at.run_daemon({"--release"});

        EXPECT_EQ(released.status, 0);
        EXPECT_EQ(released.err, "");
        EXPECT_FALSE(at.chip.high(kLine));
        write_file(at.gateway.config(), good);
    }
    at.gateway.start_daemon();
}

/// A gateway whose transceiver of the drive line hangs on a line of `chip`.
class SwitchedLine {
public:
    explicit SwitchedLine(const std::string& protocol)
        : gateway({.drive_baud = kBaud,
                   .profile = protocol == "ei-ascii" ? "590" : "2408f",
                   .units = {protocol == "ei-ascii" ? "00" : "1"},
                   .protocol = protocol,
                   .line_keys = "direction = \"gpio\"\ngpio_chip = \"" + chip.path().string() +
                                "\"\ngpio_line = " + std::to_string(kLine) + "\n",
                   .keys = protocol == "ei-ascii" ? "" : "ident = 0x0A0B\n",
                   .environment = environment,
                   .started = false})
    {
        // The chip counts characters of eleven bits; 7E1 and 8N1 have ten.
        chip.watch(kLine, gateway.folder("drive-gateway"), kBaud * 11 / 10);
        chip.leave(kLine, true);
    }
    ::testing::AssertionResult asks(unsigned requests)
    {
        const unsigned before = chip.watched().releases;
        return eventually([&] { return chip.watched().releases - before >= requests; });
    }

    Folder folder;
    const Environment environment{{"LD_LIBRARY_PATH", built_path("tests/gpio_stand_in")},
                                  {"RUNTIME_DIRECTORY", (folder / "").string()}};
    stand_in::ChipFile chip{folder / "gpiochip0", "pl061"};
    Gateway gateway;
};

TEST(TwoWireLine, IsHighWhileARequestLeavesInBothProtocols)
{
    for (const std::string protocol : {"ei-ascii", "modbus-rtu"}) {
        SCOPED_TRACE(protocol);
        SwitchedLine at{protocol};
        at.gateway.start_daemon();
        EXPECT_TRUE(at.gateway.daemon().says("line p3: " + at.gateway.folder("drive-gateway").string() +
                                             ": driver enable: line 5 of GPIO chip"));
        Master master{at.gateway, protocol == "ei-ascii"
                                      ? Arguments{"--tags", "55,56w"}
                                      : Arguments{"--family", "controller", "--ident", "0x0A0B", "--master",
                                                  "36", "--tags", "1,5,24w"}};
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(at.asks(20));
        EXPECT_TRUE(eventually([&] { return at.gateway.station()["drive"]["ever_answered"] == true; }));

        EXPECT_EQ(at.gateway.daemon().end(), 0);

        const stand_in::Watch& seen = at.chip.watched();
        EXPECT_FALSE(at.chip.high(kLine)) << "at the end";
        EXPECT_FALSE(at.chip.is_taken(kLine));
        EXPECT_EQ(seen.writes_while_inactive, 0U);
        EXPECT_EQ(at.chip.rises(kLine), seen.writes) << "once for each request";
        EXPECT_EQ(seen.releases_early, 0U);
        EXPECT_EQ(at.chip.requests(kLine), 1U);
        at.gateway.start_daemon();
    }
}

TEST(TwoWireLine, OfAKilledDaemonIsReleasedWhateverHasBecomeOfTheConfiguration)
{
    SwitchedLine at{"ei-ascii"};
    const std::string good = content(at.gateway.config()) + "\n";
    at.gateway.start_daemon();
    ASSERT_TRUE(at.asks(1));
    EXPECT_EQ(at.gateway.daemon().end(SIGKILL), 128 + SIGKILL);
    at.chip.leave(kLine, true); // as if that had come in the middle of a request
    write_file(at.gateway.config(), "bus = [\n" + good);

    const Outcome released = run(at.gateway.daemon_command({"--release"}), at.environment);

    EXPECT_EQ(released.status, 0);
    EXPECT_EQ(released.err, "");
    EXPECT_FALSE(at.chip.high(kLine));
    write_file(at.gateway.config(), good);
    at.gateway.start_daemon();
}

TEST(TwoWireLine, MovesToAnotherGpioLineByAReload)
{
    SwitchedLine at{"ei-ascii"};
    at.gateway.start_daemon();
    ASSERT_TRUE(at.asks(1));
    std::string text = content(at.gateway.config()) + "\n";
    text.replace(text.find("gpio_line = 5"), 13, "gpio_line = 4");
    write_file(at.gateway.config(), text);

    EXPECT_EQ(at.gateway.dpctl({"reload"}).status, 0);

    EXPECT_TRUE(eventually([&] { return at.chip.rises(4) > 0; }));
    EXPECT_FALSE(at.chip.is_taken(kLine));
    EXPECT_FALSE(at.chip.high(kLine));
    EXPECT_EQ(at.gateway.daemon().end(SIGKILL), 128 + SIGKILL);
    at.chip.leave(4, true);
    EXPECT_EQ(run(at.gateway.daemon_command({"--release"}), at.environment).status, 0);
    EXPECT_FALSE(at.chip.high(4)) << "what was in use last";
    at.gateway.start_daemon();
}

/// DPSLAVE_KILLS says how often; a thousand for the whole proof, which takes a quarter of an hour.
unsigned kills()
{
    const char* const wanted = std::getenv("DPSLAVE_KILLS");
    return wanted != nullptr ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : 25;
}

TEST(DriverEnable, IsNeverLeftActiveByADaemonThatIsKilledAtARandomMoment)
{
    Switched at;
    Master master{at.gateway, {"--tags", "55,56w,57,61,62,70,71,80,81,84,90,91"}};
    std::mt19937 random{std::random_device{}()};
    std::uniform_int_distribution<int> moment{0, 100'000};
    unsigned met_active = 0;
    at.gateway.start_daemon();
    ASSERT_TRUE(master.does("start 60s")); // from now on it comes back by itself
    at.gateway.daemon().end(SIGKILL);
    for (unsigned kill = 0; kill < kills(); ++kill) {
        at.gateway.start_daemon();
        ASSERT_TRUE(at.gateway.daemon().says("Data_Exch, master 2", 4 * kLimit)) << "before kill " << kill;
        std::this_thread::sleep_for(std::chrono::microseconds{moment(random)});

        EXPECT_EQ(at.gateway.daemon().end(SIGKILL), 128 + SIGKILL);
        if (at.chip.high(kLine)) ++met_active;
        const Outcome released = at.run_daemon({"--release"}); // what the service manager does

        EXPECT_EQ(released.status, 0) << released.err;
        ASSERT_FALSE(at.chip.high(kLine)) << "after kill " << kill;
        EXPECT_FALSE(at.chip.is_taken(kLine));
    }
    EXPECT_GT(met_active, 0U) << "or nothing was proven";
    std::printf("%u of %u kills met an active line; none of them left it active\n", met_active, kills());
    at.gateway.start_daemon();
}

} // namespace
} // namespace dpslave::test
