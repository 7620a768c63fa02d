// SPDX-License-Identifier: Apache-2.0
/// No service of the whole stack, layer 2 and DP, takes memory from the heap.
#include "bench.hpp"
#include "support/allocations.hpp"

#include <optional>
#include <utility>

namespace test {
namespace {

using dpslave::test::allocations;
using Counting = std::optional<dpslave::test::CountAllocations>;

class NoAllocation : public testing::Test {
protected:
    /// What the edge does with one telegram, while allocations are counted. The reply's first octet, 0 =
    /// silence.
    std::uint8_t passes(const Octets& telegram)
    {
        const dpslave::Bytes octets{telegram};
        Counting counting{std::in_place};
        now += std::chrono::milliseconds{1};
        station.on_bytes(octets, now);
        station.on_time(now);
        now += dpslave::duration_of(slave.min_tsdr(), station.baud()); // the window opens
        station.on_time(now);
        const auto reply = station.take_transmit();
        const std::uint8_t first = reply ? (*reply)[0] : std::uint8_t{0};
        (void)slave.take_outputs();
        (void)slave.take_demand_order();
        (void)slave.take_left();
        (void)slave.take_event();
        (void)slave.snapshot();
        counting.reset();
        EXPECT_EQ(allocations(), 0u) << show(telegram);
        return first;
    }
    Octets request(std::uint8_t sap, std::string_view data = "")
    {
        fc = fc == 0x5D ? 0x7D : 0x5D;
        return sd2(kUs, 2, fc, Saps{sap, 62}, octets(data));
    }
    Octets exchange(std::string_view data)
    {
        fc = fc == 0x5D ? 0x7D : 0x5D;
        return sd2(kUs, 2, fc, octets(data));
    }

    std::uint8_t fc = 0;
    dpslave::Instant now{std::chrono::seconds{1000}};
    dpslave::dp::Personality personality = option_board();
    dpslave::fdl::Layer2 station{{.baud = dpslave::Baud::k187_5, .search = {}, .start_up_latency = {}}};
    dpslave::dp::Slave slave{personality, kUs};
};

TEST_F(NoAllocation, TheCounterCounts)
{
    Counting counting{std::in_place};
    const auto* one = new volatile int{1};
    counting.reset();
    delete one;

    EXPECT_GT(allocations(), 0u);
}

TEST_F(NoAllocation, InAnyService)
{
    slave.start(now);
    station.attach(kUs, slave, personality.max_tsdr);
    constexpr std::uint8_t kSc = 0xE5, kSd1 = 0x10, kSd2 = 0x68;

    EXPECT_EQ(passes(sd1(kUs, 2, 0x49)), kSd1);
    EXPECT_EQ(passes(request(60)), kSd2);
    EXPECT_EQ(passes(request(59)), kSc);
    EXPECT_EQ(passes(request(61, "88 14 01 0B 05 34 01")), kSc); // refused
    EXPECT_EQ(passes(request(61, board_prm({55, 56}, "B8 14 01 0B 05 33 01"))), kSc);
    EXPECT_EQ(passes(request(62, "51")), kSc); // refused
    EXPECT_EQ(passes(request(61, board_prm({55, 56}, "B8 14 01 0B 05 33 01"))), kSc);
    EXPECT_EQ(passes(request(62, "73 50 60")), kSc);
    ASSERT_EQ(slave.state(), dpslave::dp::State::data_exch);
    EXPECT_EQ(passes(exchange("10 37 00 00 00 00 00 00 00 01")), kSd2);
    EXPECT_EQ(passes(exchange("20 37 00 00 00 00 00 05 00 02")), kSd2);
    EXPECT_EQ(passes(exchange("30 37 00 00 00 00 00 05 00 02")), kSd2);
    EXPECT_EQ(passes(request(56)), kSd2);
    EXPECT_EQ(passes(request(57)), kSd2);
    EXPECT_EQ(passes(request(59)), kSd2);
    EXPECT_EQ(passes(request(55)), kSd1);
    EXPECT_EQ(passes(sd2(127, 2, 0x46, Saps{58, 62}, octets("2A 00"))), 0);

    Counting counting{std::in_place};
    dpslave::InputImage inputs{.generation = slave.snapshot().layout.generation, .every_input_tried = true};
    slave.set_inputs(inputs);
    slave.set_demand_answer({.number = 2});
    counting.reset();
    EXPECT_EQ(allocations(), 0u);

    const Octets block = octets("02 01");
    counting.emplace();
    slave.set_ext_diag(block, true);
    counting.reset();
    EXPECT_EQ(allocations(), 0u);

    EXPECT_EQ(passes(exchange("00 00 00 00 00 00 00 00 00 02")), kSd2);
    EXPECT_EQ(passes(exchange("00")), kSd1); // leaves
    EXPECT_EQ(slave.state(), dpslave::dp::State::wait_prm);

    EXPECT_EQ(passes(request(61, board_prm({55}))), kSc);
    counting.emplace();
    now += std::chrono::seconds{1};
    station.on_time(now); // the watchdog
    counting.reset();
    EXPECT_EQ(allocations(), 0u);
    EXPECT_EQ(slave.state(), dpslave::dp::State::wait_prm);
}

} // namespace
} // namespace test
