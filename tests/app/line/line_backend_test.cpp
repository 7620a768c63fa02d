// SPDX-License-Identifier: Apache-2.0
/// The port of a two-wire line at the end of the program: RTS of a UART that stands in for one.
#include "app/bus_bench.hpp"
#include "app/line/line_backend.hpp"

#include <thread>

namespace dpslave::test {
namespace {

TEST(LineBackendAtTheEnd, ReleasesTheDriverEnableOfAThreadThatHangsWhileItSends)
{
    uart::reset();
    io::Pty pty;
    config::LineConfig line;
    line.port = pty.path();
    line.baud = 300; // the guard time is 17 s
    line.driver_enable.direction = io::Direction::rts;
    app::LineLink link;
    auto opened = app::LineBackend::open(line, app::listeners_of(link));
    ASSERT_TRUE(opened);
    uart::shift_register(uart::Shift::busy);
    std::atomic<bool> is_sent{false};
    std::jthread thread{[&] {
        static_cast<void>((*opened)->backend().probe({}));
        is_sent = true;
    }};
    ASSERT_TRUE(eventually([] { return uart::is_active(); }));

    link.ends_by.store(io::monotonic_now());

    EXPECT_TRUE(eventually([] { return !uart::is_active(); }));
    EXPECT_FALSE(is_sent) << "the guard has released it, not the thread";
    uart::shift_register(uart::Shift::empty);
}

} // namespace
} // namespace dpslave::test
