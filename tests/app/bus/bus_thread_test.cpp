// SPDX-License-Identifier: Apache-2.0
/// Tests what the bus thread costs, counts and survives.
#include "app/bus_bench.hpp"

#include <gmock/gmock.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace dpslave::test {
namespace {

using app::PortEvent;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;
using testing::StartsWith;

constexpr std::size_t kTelegrams = 1500;

class BusThread : public OnABus {
protected:
    /// Telegrams with a new value of the drive now and then; each value arrives.
    void exchange_many(std::size_t count)
    {
        std::uint16_t value = 1;
        for (std::size_t i = 0; i < count; ++i) {
            if (i % 7 == 0) drive_reads(kStation, ++value);
            const auto read = exchange(kStation);
            ASSERT_TRUE(read) << "telegram " << i;
            ASSERT_EQ(*read, value) << "telegram " << i;
        }
    }
    /// Minor and major page faults of the bus thread, by the kernel's own book (proc(5)).
    std::uint64_t page_faults() const
    {
        std::ifstream file{"/proc/self/task/" + std::to_string(tid) + "/stat"};
        std::string line;
        std::getline(file, line);
        std::istringstream fields{line.substr(line.rfind(')') + 2)}; // the name may hold anything
        std::string skipped;
        for (int field = 3; field < 10; ++field) fields >> skipped;
        std::uint64_t minor = 0, of_children = 0, major = 0;
        fields >> minor >> of_children >> major;
        EXPECT_TRUE(fields) << line;
        return minor + major;
    }
};

TEST_F(BusThread, AllocatesNothingWhileItServes)
{
    start({}, {station(kStation), station(6)});
    start_up(kStation);
    exchange_many(kTelegrams);
    EXPECT_TRUE(eventually([this] { // it did hand on what it knows,
        return links[kStation]->bus_snapshot.latest().counters.data_exchange >= kTelegrams;
    }));
    stop(); // and nothing at its end

    EXPECT_EQ(allocations(), 0u);
    EXPECT_THAT(uart::edges().size(), Ge(2 * kTelegrams)); // switch the driver,
    EXPECT_THAT(records().size(), Ge(2 * kTelegrams));     // and record requests and replies
}

TEST_F(BusThread, MeetsNoPageFaultWhileItServesWithLockedMemory)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizer's own memory is met page by page";
#endif
    io::keep_memory();
    if (const auto refused = io::lock_memory(); !refused.empty()) GTEST_SKIP() << refused.front();
    start({}, {station(kStation)});
    start_up(kStation);
    exchange_many(50);
    const std::uint64_t before = page_faults();
    exchange_many(kTelegrams);
    const std::uint64_t after = page_faults();
    const std::uint64_t published = snapshot().page_faults;
    stop();
    ::munlockall();

    EXPECT_EQ(after - before, 0u);
    EXPECT_EQ(published, 0u);
}

TEST_F(BusThread, CountsTheTurnaroundOfEachReply)
{
    start({.baud = Baud::k19_2}, {station(kStation)});
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(master.ask(fdl_status(kStation)));
    ASSERT_TRUE(eventually([this] { return snapshot().counters.replies >= 40; }));
    const app::BusSnapshot seen = snapshot();

    EXPECT_EQ(seen.turnaround_us.count(), seen.counters.replies);
    EXPECT_EQ(seen.turnaround_tbit.count(), seen.counters.replies);
    EXPECT_GE(seen.turnaround_tbit.quantile(0), 11u); // min T_SDR is waited for
    EXPECT_GE(seen.turnaround_us.quantile(0), 573u);  // 11 bits at 19.2 kbit/s
    EXPECT_LE(seen.turnaround_tbit.quantile(0.5), 1023u);
    EXPECT_EQ(seen.write_errors + seen.driver_errors + seen.driver_guarded, 0u);
}

TEST_F(BusThread, ShowsNothingWhileAReplyWaits)
{
    start({.baud = Baud::k9_6}, {station(kStation)});
    ASSERT_EQ(
        master.ask(::test::sd2(kStation, 2, master.next_fc(), ::test::Saps{61, 62},
                               {0, 0, 0, 255, 0x05, 0x33, 0})), // min T_SDR: 27 ms, for longest a reply waits
        Octets{0xE5});
    std::uint64_t seen = 0;
    for (std::uint64_t i = 0; i < 40; ++i) {
        pty.send(fdl_status(kStation));
        std::uint64_t dropped = snapshot().counters.late;
        ASSERT_TRUE(eventually([&] { // each that was shown was shown between two telegrams
            const fdl::Counters& shown = snapshot().counters;
            EXPECT_EQ(shown.requests, shown.replies + shown.late + shown.overtaken);
            seen = std::max(seen, shown.requests);
            if (std::exchange(dropped, shown.late) != shown.late)
                pty.send(fdl_status(kStation)); // it stood still
            return !pty.received().empty() || ::testing::Test::HasFailure();
        }));
    }
    EXPECT_GT(seen, 1u);
}

/// The bus thread stands still in a signal handler, as a debugger, a hypervisor or a busy machine makes it.
class StoodStill : public BusThread {
protected:
    StoodStill()
    {
        struct sigaction action {};
        action.sa_handler = [](int) {
            is_still = true;
            while (is_still) ::usleep(1000);
        };
        ::sigaction(SIGUSR1, &action, nullptr);
    }
    ~StoodStill() override
    {
        is_still = false;
        stop();
        ::signal(SIGUSR1, SIG_DFL);
    }
    void stand_still()
    {
        ASSERT_EQ(::tgkill(::getpid(), tid, SIGUSR1), 0);
        ASSERT_TRUE(eventually([] { return is_still.load(); }));
    }
    static void go_on() { is_still = false; }

    static inline std::atomic<bool> is_still{false};
};

TEST_F(StoodStill, DoesNotAnswerWhatMayHaveLainUnreadForLongerThanItsWindow)
{
    start({}, {station(kStation)});
    ASSERT_TRUE(master.ask(fdl_status(kStation)));
    const std::uint64_t late = snapshot().counters.late;
    stand_still();
    pty.send(fdl_status(kStation));
    const Instant over = io::monotonic_now() + std::chrono::milliseconds{200}; // its window is 2 ms
    ASSERT_TRUE(eventually([over] { return io::monotonic_now() > over; }));
    go_on();

    EXPECT_TRUE(eventually([&] { return snapshot().counters.late > late; }));
    EXPECT_EQ(pty.received(), Octets{});
    EXPECT_TRUE(master.ask(fdl_status(kStation)));
}

/// What comes between the opening of the port and the bus thread takes its time: a slow line of a GPIO chip.
class SlowStart : public BusThread {
protected:
    void when_opened() override
    {
        pty.send(fdl_status(kStation));
        const Instant over = io::monotonic_now() + std::chrono::milliseconds{100}; // its window is 2 ms
        ASSERT_TRUE(eventually([over] { return io::monotonic_now() > over; }));
    }
};

TEST_F(SlowStart, DoesNotAnswerWhatCameLongBeforeTheBusThreadBegan)
{
    start({}, {station(kStation)});

    EXPECT_TRUE(eventually([this] { return snapshot().counters.late >= 1; }));
    EXPECT_EQ(pty.received(), Octets{});
    EXPECT_TRUE(master.ask(fdl_status(kStation)));
}

TEST_F(BusThread, SaysWhatItCountsOfItsPageFaults)
{
    start({}, {station(kStation)});
    const std::uint64_t before = page_faults();
    const std::uint64_t reported = snapshot().page_faults;
    ASSERT_TRUE(master.ask(fdl_status(kStation)));

    EXPECT_LE(reported, before); // since it serves, not since it began
}

class ReopenedPort : public BusThread {
protected:
    ReopenedPort() { plug(); }
    std::string port_path() override { return link_.string(); }
    /// First the name: the number of a pty that has gone is given to the next one that is opened.
    void pull()
    {
        std::filesystem::remove(link_);
        pty.hang_up();
    }
    void plug()
    {
        unplug();
        std::filesystem::create_symlink(pty.path(), link_);
    }
    void unplug() { std::filesystem::remove(link_); }

private:
    const std::filesystem::path link_ = folder_.path() / "bus";
};

TEST_F(ReopenedPort, GoesOnWithItsStationsWhereItWas)
{
    start({}, {station(kStation)});
    start_up(kStation);
    drive_reads(kStation, 7);
    ASSERT_EQ(exchange(kStation), 7);
    pull();
    ASSERT_TRUE(reports(PortEvent::lost));
    ASSERT_TRUE(eventually([this] { return !snapshot().port_open; }));
    EXPECT_FALSE(uart::is_active());

    pty = io::Pty{};
    plug();
    ASSERT_TRUE(reports(PortEvent::back));
    EXPECT_EQ(exchange(kStation), 7); // still in Data_Exch
    ASSERT_TRUE(eventually([this] { return snapshot().port_open; }));
    EXPECT_EQ(links[kStation]->bus_snapshot.latest().counters.left_data_exchange, 0u);
}

TEST_F(ReopenedPort, ThatIsMissingAtTheStartIsServedWhenItHasCome)
{
    unplug();
    start({}, {station(kStation)});
    EXPECT_FALSE(snapshot().port_open);
    EXPECT_THAT(hears_trouble(), HasSubstr("is not there: check `port` in the configuration"));
    plug();

    ASSERT_TRUE(reports(PortEvent::back));
    ASSERT_TRUE(eventually([this] { return snapshot().port_open; }));
    start_up(kStation);
    drive_reads(kStation, 7);
    EXPECT_EQ(exchange(kStation), 7);
    EXPECT_TRUE(uart::edges().size() >= 2) << "with its driver enable";
}

TEST_F(ReopenedPort, LetsTheDriverGoWithThePort)
{
    start({.baud = Baud::k9_6}, {station(kStation)});
    ASSERT_TRUE(master.ask(fdl_status(kStation))); // takes 6.9 ms on the line
    pull();
    ASSERT_TRUE(reports(PortEvent::lost));

    EXPECT_FALSE(uart::is_active());
}

TEST_F(ReopenedPort, IsClosedAgainWhereItsDriverEnableDoesNotWork)
{
    start({}, {station(kStation)});
    pull();
    ASSERT_TRUE(reports(PortEvent::lost));
    uart::refuse_edges(true);
    pty = io::Pty{};
    plug();
    std::string trouble = hears_trouble();
    while (trouble.starts_with(port_path() + " is not there"))
        trouble = hears_trouble(); // it tried before the port was back
    EXPECT_THAT(trouble, StartsWith(port_path() + ": driver enable: "));
    EXPECT_TRUE(eventually([this] { return !snapshot().port_open; }));

    uart::refuse_edges(false);
    ASSERT_TRUE(reports(PortEvent::back));
    EXPECT_TRUE(master.ask(fdl_status(kStation)));
}

TEST_F(ReopenedPort, SaysWhyItCannotBeOpened)
{
    start({}, {station(kStation)});
    pull();
    ASSERT_TRUE(reports(PortEvent::lost));

    EXPECT_THAT(hears_trouble(), StartsWith(port_path() + " is not there"));
}

TEST_F(BusThread, SearchesTheRateFromTheHighestDown)
{
    start({.baud = std::nullopt}, {station(kStation)});
    ASSERT_TRUE(eventually([this] { return pty.rate() == 1'500'000 && snapshot().baud == Baud::k1500; }));
    EXPECT_EQ(snapshot().baud_state, fdl::BaudState::baud_search);
}

TEST_F(BusThread, StaysAtTheRateAtWhichItHearsARequest)
{
    start({.baud = std::nullopt}, {station(kStation)});
    ASSERT_TRUE(master.ask(fdl_status(kStation))); // the first one ends the search, the next is answered
    ASSERT_TRUE(eventually([this] { return snapshot().baud_state == fdl::BaudState::baud_control; }));
    EXPECT_EQ(static_cast<std::uint32_t>(snapshot().baud), pty.rate());
}

TEST_F(BusThread, SwitchesTheLineToTheNextRateAfterTheDwell)
{
    start({.baud = std::nullopt}, {station(kStation)});

    ASSERT_TRUE(eventually([this] { return pty.rate() == 500'000; })); // two seconds
    ASSERT_TRUE(eventually([this] { return snapshot().baud == Baud::k500; }));
    EXPECT_EQ(snapshot().baud_state, fdl::BaudState::baud_search);
}

class EchoOnTheLine : public BusThread, public testing::WithParamInterface<EchoMode> {};

TEST_P(EchoOnTheLine, IsTakenAwayBeforeLayerTwoSeesIt)
{
    start({.echo = GetParam()}, {station(kStation)});
    master.echoes = true;
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(master.ask(fdl_status(kStation))) << i;
    ASSERT_TRUE(eventually([this] { return snapshot().counters.replies >= 20; }));

    // Each of them but those that the master of this test, on a busy machine, sends back too late.
    EXPECT_LE(snapshot().counters.own_address, snapshot().echo_missing);
    EXPECT_EQ(snapshot().echo_broken, 0u);
}

INSTANTIATE_TEST_SUITE_P(Modes, EchoOnTheLine, testing::Values(EchoMode::on, EchoMode::automatic),
                         [](const auto& mode) { return mode.param == EchoMode::on ? "On" : "Auto"; });

TEST_F(BusThread, TakesAnEchoThatIsNotRemovedForAnAddressConflict)
{
    start({.echo = EchoMode::off}, {station(kStation)});
    master.echoes = true;
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(master.ask(fdl_status(kStation)));

    EXPECT_TRUE(eventually([this] { return snapshot().counters.own_address >= 4; }));
}

TEST_F(BusThread, LosesNothingWithAutomaticEchoWhereThereIsNone)
{
    start({.echo = EchoMode::automatic}, {station(kStation)});
    start_up(kStation);
    exchange_many(50);

    EXPECT_EQ(snapshot().echo_broken + snapshot().echo_missing, 0u);
}

} // namespace
} // namespace dpslave::test
