// SPDX-License-Identifier: Apache-2.0
/// The driver enable around each request of a two-wire drive line: RTS of a UART that stands in for one.
#include "app/bus_bench.hpp"

#include "dpslave/io/switched_port.hpp"

#include <gmock/gmock.h>
#include <sched.h>

#include <string>
#include <thread>

namespace dpslave::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using testing::HasSubstr;

class TwoWirePort : public testing::Test {
protected:
    TwoWirePort() { uart::reset(); }

    io::SwitchedPort opened(std::uint32_t baud, int priority = 0,
                            io::Direction direction = io::Direction::rts)
    {
        auto port = io::SwitchedPort::open(
            pty.path(), {.baud = baud, .data_bits = 7, .parity = 'E', .stop_bits = 1},
            {.driver = {.direction = direction}, .priority = priority, .counts = &counts});
        if (!port) throw std::runtime_error{port.error()};
        return *std::move(port);
    }
    static nanoseconds on_line(std::size_t octets, std::uint32_t baud)
    {
        return nanoseconds{static_cast<std::int64_t>(octets) * 10 * std::nano::den / baud};
    }

    io::Pty pty;
    io::TransceiverCounts counts;
    const Octets request = ::test::octets("04 30 30 30 30 49 49 05");
};

TEST_F(TwoWirePort, IsActiveUntilTheLastStopBitAtEachRate)
{
    std::uint64_t longer_than_guard = 0; // the thread stood still
    for (const std::uint32_t baud : {300U, 1'200U, 9'600U, 19'200U, 115'200U}) {
        SCOPED_TRACE(baud);
        uart::reset();
        io::SwitchedPort port = opened(baud);
        ASSERT_FALSE(uart::is_active());

        EXPECT_EQ(port.write(request), std::error_code{});

        EXPECT_FALSE(uart::is_active()) << "when it returns the drive may answer";
        const auto edges = uart::edges();
        ASSERT_EQ(edges.size(), 2U);
        EXPECT_TRUE(edges[0].active);
        EXPECT_GE(edges[1].at - edges[0].at, on_line(request.size(), baud));
        EXPECT_EQ(port.guard(), 510 * on_line(1, baud));
        if (edges[1].at - edges[0].at >= port.guard()) ++longer_than_guard;
    }
    EXPECT_EQ(counts.requests, 5U);
    EXPECT_LE(counts.guarded, longer_than_guard);
}

TEST_F(TwoWirePort, IsHeldUntilTheUartSaysThatItsShiftRegisterIsEmpty)
{
    io::SwitchedPort port = opened(9'600);
    const Instant busy_until = io::monotonic_now() + 30ms; // 8.3 ms by arithmetic
    uart::shift_register(uart::Shift::busy, busy_until);

    EXPECT_EQ(port.write(request), std::error_code{});

    const auto edges = uart::edges();
    ASSERT_EQ(edges.size(), 2U);
    EXPECT_GE(edges[1].at, busy_until);
}

TEST_F(TwoWirePort, IsReleasedAfterTwiceTheLongestRequestWhateverTheUartSays)
{
    uart::shift_register(uart::Shift::busy);
    io::SwitchedPort port = opened(115'200);

    EXPECT_EQ(port.write(request), std::error_code{});

    EXPECT_FALSE(uart::is_active());
    EXPECT_EQ(counts.guarded, 1U);
    const auto edges = uart::edges();
    ASSERT_EQ(edges.size(), 2U);
    EXPECT_GE(edges[1].at - edges[0].at, 44ms); // 2 * 255 * 10 bits at 115200 bit/s
}

TEST_F(TwoWirePort, IsClosedByADriverEnableThatFailsUntilItWorksAgain)
{
    io::SwitchedPort port = opened(115'200);
    uart::refuse_edges(true);

    EXPECT_TRUE(port.write(request));

    EXPECT_FALSE(port.is_open()) << "nothing is sent without it";
    EXPECT_EQ(counts.errors, 1U);
    const auto trouble = port.take_trouble();
    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, HasSubstr("the driver enable cannot be switched"));

    uart::refuse_edges(false);
    EXPECT_TRUE(port.ready(io::monotonic_now() + 10s));
    EXPECT_EQ(port.write(request), std::error_code{});
    EXPECT_FALSE(uart::is_active());
}

TEST_F(TwoWirePort, IsLeftAloneWhereTheTransceiverSwitchesByItself)
{
    io::SwitchedPort port = opened(300, 0, io::Direction::none);

    EXPECT_EQ(port.write(request), std::error_code{});

    EXPECT_TRUE(uart::edges().empty());
    EXPECT_EQ(counts.requests, 0U);
}

TEST_F(TwoWirePort, RunsItsThreadInRealTimeWhileItSendsAndOrdinaryOtherwise)
{
    ASSERT_THAT(io::enter_realtime(0, -1), testing::IsEmpty());
    std::atomic<int> tid{0};
    std::atomic<bool> go{false}, look{false}, refused{false};
    std::jthread thread{[&] {
        {
            const io::RaisedPriority trial{1};
            refused = ::sched_getscheduler(0) != SCHED_FIFO;
        }
        io::SwitchedPort port = opened(300, 5);
        tid = ::gettid();
        go.wait(false);
        static_cast<void>(port.write(request));
        look.wait(false);
    }};
    ASSERT_TRUE(eventually([&] { return tid != 0; }));
    EXPECT_EQ(::sched_getscheduler(tid), SCHED_OTHER) << "before";
    uart::shift_register(uart::Shift::busy); // it sends until it was seen, at most 17 s
    go = true;
    go.notify_all();
    const bool raised = eventually([&] { return ::sched_getscheduler(tid) == SCHED_FIFO; },
                                   refused ? nanoseconds{300ms} : nanoseconds{1min});
    EXPECT_NE(raised, refused);
    uart::shift_register(uart::Shift::empty);
    if (raised) {
        sched_param param{};
        ::sched_getparam(tid, &param);
        EXPECT_EQ(param.sched_priority, 5);
        EXPECT_TRUE(eventually([&] { return ::sched_getscheduler(tid) == SCHED_OTHER; })) << "behind it";
        EXPECT_FALSE(uart::is_active());
    }
    look = true;
    look.notify_all();
    if (refused) GTEST_SKIP() << "this machine allows no real time";
}

} // namespace
} // namespace dpslave::test
