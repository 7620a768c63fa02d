// SPDX-License-Identifier: Apache-2.0
/// The driver enable around each reply (rows ): RTS of a UART that stands in for one.
#include "app/bus/driver_guard.hpp"
#include "app/bus_bench.hpp"

#include "dpslave/fdl/transmission.hpp"

#include <algorithm>

namespace dpslave::test {
namespace {

using app::PortEvent;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr Tbit kStatusReply{6 * 11}; ///< SD1 has six octets

class DriverEnableOfTheBus : public OnABus {
protected:
    void ask_status() { ASSERT_EQ(master.ask(fdl_status(kStation)), kStatus); }
    static void expect_pulses(const std::vector<uart::Edge>& edges)
    {
        for (std::size_t i = 0; i < edges.size(); ++i) EXPECT_EQ(edges[i].active, i % 2 == 0) << i;
        EXPECT_EQ(edges.size() % 2, 0u);
    }

    const Octets kStatus = ::test::octets("10 02 05 00 07 16");
};

TEST_F(DriverEnableOfTheBus, IsActiveFromBeforeTheFirstBitUntilTheLastStopBit)
{
    start({.baud = Baud::k19_2}, {station(kStation)});
    constexpr int kReplies = 60;
    for (int i = 0; i < kReplies; ++i) {
        ASSERT_FALSE(uart::is_active());
        ask_status();
        EXPECT_GE(uart::edges().size(), 2u * static_cast<unsigned>(i) + 1); // up before the first octet came
        ASSERT_TRUE(eventually([] { return !uart::is_active(); }));
    }
    const auto edges = uart::edges();
    expect_pulses(edges);
    ASSERT_GE(edges.size(), 2u * kReplies);

    for (std::size_t i = 0; i < edges.size(); i += 2)
        EXPECT_GE(edges[i + 1].at - edges[i].at, duration_of(kStatusReply, Baud::k19_2));
}

TEST_F(DriverEnableOfTheBus, HasAPulseForEachReplyAlsoWhereTheNextRequestComesEarly)
{
    start({.baud = Baud::k9_6}, {station(kStation)}); // 6.9 ms on the line that a pty does not take
    for (int i = 0; i < 30; ++i) ask_status();
    const std::size_t replies = 30;
    ASSERT_TRUE(eventually([] { return !uart::is_active(); }));

    expect_pulses(uart::edges());
    EXPECT_GE(uart::edges().size(), 2 * replies); // more where the master had to ask again
}

TEST_F(DriverEnableOfTheBus, IsHeldUntilTheUartSaysThatItsShiftRegisterIsEmpty)
{
    uart::shift_register(uart::Shift::busy);
    start({.baud = Baud::k9_6}, {station(kStation)});
    ask_status();
    ASSERT_EQ(uart::edges().size(), 1u);
    const Instant rose = uart::edges().front().at;
    ASSERT_TRUE(eventually([&] { return io::monotonic_now() > rose + milliseconds{30}; }));

    uart::shift_register(uart::Shift::empty);
    EXPECT_TRUE(eventually([] { return !uart::is_active(); }));
    EXPECT_GE(uart::edges()[1].at - rose,
              milliseconds{30}); // 6.9 ms by arithmetic, and not one bit of that is believed
}

TEST_F(DriverEnableOfTheBus, IsLetGoByTheGuardAfterTwiceTheLongestTelegram)
{
    uart::shift_register(uart::Shift::busy);
    start({.baud = Baud::k500}, {station(kStation)});
    ask_status();
    ASSERT_TRUE(eventually([] { return !uart::is_active(); }));

    const auto edges = uart::edges();
    ASSERT_GE(edges.size(), 2u);
    EXPECT_GE(edges[1].at - edges[0].at, microseconds{11220}); // 2 * 255 * 22 us
    EXPECT_TRUE(eventually([this] { return snapshot().driver_guarded >= 1; }));
    EXPECT_TRUE(reports(PortEvent::driver_guarded));
}

TEST_F(DriverEnableOfTheBus, StaysActiveForAReplyBehindOneThatHasNotGoneOut)
{
    uart::shift_register(uart::Shift::busy);
    start({.baud = Baud::k9_6}, {station(kStation)});
    ask_status();
    ask_status(); // a line with two pairs: the request comes while we send
    const auto edges = uart::edges();
    if (io::monotonic_now() > edges[0].at + milliseconds{500}) GTEST_SKIP() << "so late the guard lets go";
    EXPECT_EQ(edges.size(), 1u);

    uart::shift_register(uart::Shift::empty);
    EXPECT_TRUE(eventually([] { return !uart::is_active(); }));
}

TEST_F(DriverEnableOfTheBus, ThatDoesNotWorkKeepsTheReplyBackUntilItWorksAgain)
{
    start({}, {station(kStation)});
    ask_status();
    uart::refuse_edges(true);
    EXPECT_EQ(master.ask(fdl_status(kStation), 2), std::nullopt); // nothing without driver enable
    ASSERT_TRUE(asked_until(fdl_status(kStation),
                            [this] { return snapshot().unsent >= 2; })); // that one, and all after it
    ASSERT_TRUE(reports(PortEvent::driver_lost));
    EXPECT_GE(snapshot().driver_errors, 1U);

    uart::refuse_edges(false);
    ASSERT_TRUE(reports(PortEvent::driver_back));
    ask_status();
}

TEST_F(DriverEnableOfTheBus, IsNeverActiveAndNothingIsWrittenByABusThatOnlyListens)
{
    start({.listen = true}, {station(kStation)}); // a station that no configuration would allow
    EXPECT_EQ(master.ask(fdl_status(kStation), 3), std::nullopt);
    EXPECT_EQ(master.ask(set_prm(kStation, 0x6D), 3), std::nullopt);
    ASSERT_TRUE(eventually([this] { return snapshot().counters.telegrams >= 6; })) << "it hears";
    stop();

    EXPECT_TRUE(uart::edges().empty());
    EXPECT_FALSE(uart::is_active());
    EXPECT_EQ(snapshot().write_errors, 0U);
    const auto all = records();
    EXPECT_TRUE(std::none_of(all.begin(), all.end(),
                             [](const trace::Record& one) { return one.head.kind == trace::Kind::sent; }));
    EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                            [](const trace::Record& one) { return one.head.kind == trace::Kind::heard; }));
}

TEST(BusSender, DistinguishesAPortThatHasGoneFromOneThatIsFull)
{
    io::Pty pty;
    auto port = io::Tty::open(pty.path(), {.baud = 1'500'000});
    ASSERT_TRUE(port) << port.error();
    auto driver = io::DriverEnable::open({.direction = io::Direction::none});
    ASSERT_TRUE(driver) << driver.error();
    app::BusSender sender{*driver};
    const Octets telegram(255, 0x00);

    auto sent = sender.send(telegram, *port, Baud::k1500, kNever);
    EXPECT_TRUE(sent);
    for (int i = 0; i < 1000 && sent; ++i)
        sent = sender.send(telegram, *port, Baud::k1500, kNever); // not read
    ASSERT_FALSE(sent);
    EXPECT_EQ(sent.error(), app::BusSender::Unsent::not_taken);

    pty.hang_up();
    sent = sender.send(telegram, *port, Baud::k1500, kNever);
    ASSERT_FALSE(sent);
    EXPECT_EQ(sent.error(), app::BusSender::Unsent::port_gone);
    EXPECT_EQ(sender.write_errors(), 2u);
}

TEST_F(DriverEnableOfTheBus, IsMadeActiveAgainForAReplyBehindTheGuardThatHasLetItGo)
{
    auto port = io::Tty::open(pty.path(), {.baud = 500'000});
    ASSERT_TRUE(port) << port.error();
    auto driver = io::DriverEnable::open({.direction = io::Direction::rts});
    ASSERT_TRUE(driver) << driver.error();
    ASSERT_EQ(driver->attach(*port), std::nullopt);
    uart::shift_register(uart::Shift::busy); // and it never says anything else
    app::BusSender sender{*driver};
    ASSERT_TRUE(sender.send(kStatus, *port, Baud::k500, kNever));
    ASSERT_TRUE(driver->drop_if_stuck(io::monotonic_now() + milliseconds{20}, milliseconds{10}));
    ASSERT_FALSE(uart::is_active());

    ASSERT_TRUE(sender.send(kStatus, *port, Baud::k500, kNever));

    EXPECT_TRUE(uart::is_active());
    driver->detach();
}

TEST_F(DriverEnableOfTheBus, F19_OfAStuckTransmitterIsDroppedWithTheReplyThatDidNotLeave)
{
    start({.baud = Baud::k500, .direction = io::Direction::none}, {station(kStation)});
    uart::hold_back(6);
    EXPECT_TRUE(asked_until(fdl_status(kStation), [] { return uart::flushes() == 1; }));
    EXPECT_TRUE(eventually([this] { return snapshot().unsent == 1; }));
    EXPECT_EQ(snapshot().write_errors, 1u);

    ask_status();
    EXPECT_EQ(uart::flushes(), 1u) << "what leaves is left alone";
}

/// A long reply is in the kernel's buffer while the first octets of it are heard.
TEST_F(DriverEnableOfTheBus, LeavesAReplyAloneWhoseEchoIsHeardBeforeItsRestHasLeft)
{
    start({.baud = Baud::k9_6, .direction = io::Direction::none, .echo = EchoMode::on}, {station(kStation)});
    master.echoes = true;
    const Instant gone = io::monotonic_now() + milliseconds{15}; // well before it counts as stuck
    uart::hold_back(6, gone);

    ask_status();

    ASSERT_TRUE(eventually([gone] { return io::monotonic_now() >= gone; }));
    ask_status();
    EXPECT_EQ(uart::flushes(), 0u);
    EXPECT_EQ(snapshot().write_errors, 0u);
}

/// The bus thread does not release it: it hangs, or the program is at its end.
TEST_F(DriverEnableOfTheBus, IsLetGoByAThreadOfItsOwnAfterTwiceTheLongestTelegramAtTheRateOfTheBus)
{
    const auto port = io::Tty::open(pty.path(), {.baud = 1'500'000});
    ASSERT_TRUE(port) << port.error();
    auto driver = io::DriverEnable::open({.direction = io::Direction::rts});
    ASSERT_TRUE(driver) << driver.error();
    ASSERT_EQ(driver->attach(*port), std::nullopt);
    app::DriverGuard guard{*driver, [] { return fdl::transmission_guard(Baud::k1500); }};
    guard.start(0);
    ASSERT_FALSE(driver->set(true, io::monotonic_now()));

    ASSERT_TRUE(eventually([&] { return guard.dropped() == 1; }));
    EXPECT_FALSE(uart::is_active());
    const auto edges = uart::edges();
    ASSERT_EQ(edges.size(), 2u);
    EXPECT_GE(edges[1].at - edges[0].at, microseconds{3740}); // 2 * 255 * 7.33 us
    driver->detach();
}

TEST_F(DriverEnableOfTheBus, IsInactiveAtTheEndAndTheLastReplyIsWhole)
{
    start({.baud = Baud::k9_6}, {station(kStation)});
    ask_status();
    stop();

    const auto edges = uart::edges();
    expect_pulses(edges);
    ASSERT_GE(edges.size(), 2u);
    EXPECT_GE(edges.back().at - edges[edges.size() - 2].at, duration_of(kStatusReply, Baud::k9_6));
}

TEST_F(DriverEnableOfTheBus, IsLeftAloneWhereTheTransceiverSwitchesByItself)
{
    start({.direction = io::Direction::none}, {station(kStation)});
    for (int i = 0; i < 10; ++i) ask_status();

    EXPECT_TRUE(uart::edges().empty());
}

} // namespace
} // namespace dpslave::test
