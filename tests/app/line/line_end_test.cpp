// SPDX-License-Identifier: Apache-2.0
/// A drive line that ends: its thread is real, and so is its port.
#include "app/bus_bench.hpp"
#include "app/reload/plant.hpp"

#include "dpslave/io/tty.hpp"

#include <gmock/gmock.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using test::eventually;
using test::kGood;

class LineThatEnds : public test::ConfigFile {};

TEST_F(LineThatEnds, HasClosedItsPortItselfSoThatTheMainThreadDoesNotWaitForThat)
{
    io::Pty pty;
    std::string text = kGood;
    text.replace(text.find("/dev/null-p3"), 12, pty.path());
    const config::Config config = good(text);
    BusLink bus;
    Plant plant{bus, true};
    plant.open(config);
    plant.start();
    ASSERT_TRUE(eventually([&] { return !pty.received().empty(); })) << "it asks its drive";
    EXPECT_FALSE(io::Tty::open(pty.path(), {.baud = 9600})) << "the line has it";

    const Instant now = io::monotonic_now();
    plant.request_end(now + 1s);
    EXPECT_THAT(plant.end(now + 1min), testing::IsEmpty());

    EXPECT_TRUE(io::Tty::open(pty.path(), {.baud = 9600})) << "although the line is still there";
}

} // namespace
} // namespace dpslave::app
