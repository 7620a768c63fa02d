// SPDX-License-Identifier: Apache-2.0
/// The view of the whole bus is the same, whether telegrams are counted at once or behind the replies.
#include "app/bus/bus_monitor.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;

constexpr std::uint8_t kRequest = 0x6D, kData = 0x08;

/// Master 2 asks slave 7 for its diagnosis.
constexpr fdl::Telegram kAsks{
    .delimiter = fdl::kSD2, .da = 7, .sa = 2, .fc = kRequest, .dsap = 60, .ssap = 62, .data = {}};

fdl::Telegram diagnosis(const std::vector<std::uint8_t>& octets)
{
    return {.delimiter = fdl::kSD2, .da = 2, .sa = 7, .fc = kData, .dsap = 62, .ssap = 60, .data = octets};
}

TEST(BusMonitor, CountsBehindTheReplyWhatItHeard)
{
    BusMonitor monitor;
    monitor.on_telegram(kAsks, Instant{1s});
    std::vector<std::uint8_t> octets{0, 4, 0, 2, 0x80, 0x21};
    monitor.on_telegram(diagnosis(octets), Instant{2s});
    octets.assign(6, 0xFF); // the buffer of the port is used again
    EXPECT_FALSE(monitor.members().table()[7].was_seen());

    monitor.catch_up();
    const dp::Member& slave = monitor.members().table()[7];
    EXPECT_EQ(slave.ident, 0x8021);
    EXPECT_EQ(slave.answers, 1U);
    EXPECT_EQ(slave.last_heard, Instant{2s});
    EXPECT_TRUE(monitor.members().table()[2].is_master);

    monitor.catch_up();
    EXPECT_EQ(monitor.members().table()[7].answers, 1U) << "each once";
}

TEST(BusMonitor, LosesNothingOfALongRead)
{
    BusMonitor monitor;
    dp::BusMembers at_once;
    for (std::size_t i = 0; i < 3 * BusMonitor::kMost + 1; ++i) {
        const Instant at{std::chrono::milliseconds{i}};
        monitor.on_telegram(kAsks, at);
        at_once.on_telegram(kAsks, at);
    }
    monitor.catch_up();
    EXPECT_EQ(monitor.members().table()[7].asked, at_once.table()[7].asked);
    EXPECT_EQ(monitor.members().table()[7].unanswered, at_once.table()[7].unanswered);
    EXPECT_EQ(monitor.members().table()[7].last_asked, at_once.table()[7].last_asked);
}

} // namespace
} // namespace dpslave::app
