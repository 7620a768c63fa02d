// SPDX-License-Identifier: Apache-2.0
// The bus as a whole: rates, interruptions, endurance, cycle time and addresses: C-24 to C-28.
#include "case.hpp"
#include "gsd/reader.hpp"
#include "made_gsd.hpp"
#include "simulated_slave.hpp"
#include "support/count_of.hpp"

#include <random>

namespace conformance {
namespace {

using namespace std::chrono_literals;
using dpslave::Baud;
using std::chrono::nanoseconds;

/// The rates of the GSD files: all but 45.45 kbit/s.
constexpr std::array kRates{Baud::k9_6, Baud::k19_2, Baud::k93_75, Baud::k187_5, Baud::k500, Baud::k1500};

/// A lone master polls in the GAP until the slave answers.
testing::AssertionResult is_found(Bench& b, SimulatedSlave& slave, nanoseconds within)
{
    const auto end = slave.bus().now() + within;
    while (slave.bus().now() < end) {
        if (b.owner.fdl_status() == "OK") return testing::AssertionSuccess();
        slave.pass_exactly(50ms);
    }
    return testing::AssertionFailure() << "the rate was not found in " << within.count() << " ns";
}

/// The dwell times of all rates, twice: section 7.2.
constexpr auto kSearch = 2 * (4 * 2s + 2 * 4s);

void C24_EveryRate(Bench& b, SimulatedSlave& slave)
{
    for (const Baud rate : kRates) {
        slave.restart_at(rate, true);
        ASSERT_TRUE(is_found(b, slave, kSearch)) << text(rate);
        ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}))) << text(rate);
        EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4})) << text(rate);
    }
}

void C24_ChangeOfTheRate(Bench& b, SimulatedSlave& slave)
{
    for (const auto& [from, to] : {std::pair{Baud::k1500, Baud::k93_75}, std::pair{Baud::k19_2, Baud::k500},
                                   std::pair{Baud::k187_5, Baud::k9_6}}) {
        slave.restart_at(from, true);
        ASSERT_TRUE(is_found(b, slave, kSearch));
        ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), {.factor_1 = 10, .factor_2 = 1}));
        slave.bus().set_baud(to);
        slave.bus().set_max_tsdr(slave.personality().max_tsdr[index_of(to)]);
        ASSERT_TRUE(is_found(b, slave, kSearch)) << text(from) << " to " << text(to);
        EXPECT_EQ(b.diag(), kWaitPrm) << "the watchdog has expired";
        ASSERT_TRUE(b.exchange(words({5, 6, 7, 8})));
    }
}

void C24_Noise(Bench& b, SimulatedSlave& slave)
{
    slave.restart_at(Baud::k187_5, true);
    std::minstd_rand chance{1};
    for (int burst = 0; burst < 200; ++burst) {
        Octets noise(1 + chance() % 30);
        for (std::uint8_t& octet : noise) octet = static_cast<std::uint8_t>(chance());
        slave.bus().breaks_in_after(slave.bus().bits(33 + static_cast<std::uint32_t>(chance() % 500)), noise);
        EXPECT_FALSE(slave.bus().reply()) << "a station that searches is silent";
    }
    ASSERT_TRUE(is_found(b, slave, kSearch));
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
}

void C24_TrafficOfOthersOnly(Bench& b, SimulatedSlave& slave)
{
    slave.restart_at(Baud::k500, true);
    const auto end = slave.bus().now() + kSearch;
    while (slave.bus().now() < end && slave.layer2().baud_state() == dpslave::fdl::BaudState::baud_search) {
        slave.send(test::sd2(30, 2, 0x7D, words({1, 2})));
        slave.bus().breaks_in_after(slave.bus().bits(15), test::sd2(2, 30, 0x08, words({3, 4})));
        slave.send(test::sd2(31, 2, 0x5D, words({1, 2})));
        slave.bus().breaks_in_after(slave.bus().bits(15), test::sc());
        slave.pass_exactly(2ms);
    }
    EXPECT_EQ(b.owner.fdl_status(), "OK") << "its first request is answered: the rate is known";
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
}

void C25_ShortInterruption(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), {.factor_1 = 200, .factor_2 = 1})); // 2 s
    Octets cut = test::sd2(test::kUs, 2, 0x6D, words({9, 9, 9, 9}));
    cut.resize(cut.size() / 2);
    EXPECT_TRUE(b.slave.is_silent_to(cut)) << "the cable parts in a telegram";
    b.slave.pass(300ms);
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
    EXPECT_EQ(b.diag(), kExchanging) << "the exchange goes on";
    EXPECT_EQ(b.foreign.rd_outp(), dl({5, 6, 7, 8}));
}

void C25_LongInterruption(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({0x1111, 2, 3, 4})));
    EXPECT_TRUE(b.slave.drive_gets(0x1111));
    b.shorten_the_watchdog();
    Octets cut = test::sd2(test::kUs, 2, 0x6D, words({9, 9, 9, 9}));
    cut.resize(cut.size() / 2);
    EXPECT_TRUE(b.slave.is_silent_to(cut));
    b.slave.pass(500ms);
    EXPECT_TRUE(b.slave.drive_gets(0)) << "the watchdog has expired";
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), "RS") << "so the master starts it up";
    ASSERT_TRUE(b.exchange(words({0x5555, 6, 7, 8})));
    EXPECT_TRUE(b.slave.drive_gets(0x5555));
}

void C25_SupplyOffAndOn(Bench& b)
{
    for (const std::uint8_t status : Octets{0x88, 0x80}) {
        ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), {.status = status}));
        b.slave.restart(test::kUs);
        EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS");
        EXPECT_EQ(b.diag(), kWaitPrm) << "as new";
        EXPECT_EQ(b.owner.get_cfg(), "SC") << "no configuration is kept";
        ASSERT_TRUE(b.exchange(words({5, 6, 7, 8}), {.status = status}));
    }
}

void C25_MasterOffAndOn(Bench& b)
{
    for (int round = 0; round < 3; ++round) {
        ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
        b.let_the_watchdog_expire();
        Master again{b.slave, 2}; // it knows nothing of its frame count bit
        EXPECT_EQ(again.slave_diag().substr(0, 14), "DL 02 05 00 FF") << round;
    }
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    Master again{b.slave, 2};
    EXPECT_EQ(again.set_prm(b.prm()), "SC") << "before the watchdog: the same master starts up again";
    EXPECT_EQ(again.chk_cfg(cfg()), "SC");
    EXPECT_EQ(again.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
}

void C25_NoiseBurst(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    std::minstd_rand chance{7};
    for (std::uint16_t burst = 1; burst <= 40; ++burst) {
        Octets noise(1 + chance() % 60);
        for (std::uint8_t& octet : noise) octet = static_cast<std::uint8_t>(chance());
        EXPECT_TRUE(b.slave.is_silent_to(noise));
        EXPECT_EQ(b.owner.data_exchange(words({burst, 2, 3, 4})), inputs_at_start());
        EXPECT_EQ(b.foreign.rd_outp(), dl({burst, 2, 3, 4})) << "after " << test::show(noise);
    }
    EXPECT_EQ(b.diag(), kExchanging);
}

/// 24 hours in cycles of 86.4 ms: 10^6 of them.
void C26_TwentyFourHours(Bench& b, SimulatedSlave& slave)
{
    constexpr auto kCycle = 86'400us;
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), {.factor_1 = 20, .factor_2 = 1})); // 200 ms
    Octets requests[]{test::sd2(test::kUs, 2, 0x5D, words({1, 2, 3, 4})),
                      test::sd2(test::kUs, 2, 0x7D, words({5, 6, 7, 8}))};
    const Octets reply = test::sd2(2, test::kUs, 0x08, words({kInputsAtStart.begin(), kInputsAtStart.end()}));
    b.owner.sends(test::sd2(test::kUs, 2, 0x6D, words({5, 6, 7, 8})));
    const auto begin = slave.bus().now();
    const std::size_t cycles =
        dpslave::test::count_of("CONFORMANCE_CYCLES", 20'000); // tools/run conformance: all
    std::size_t lost = 0;
    for (std::size_t cycle = 0; cycle < cycles; ++cycle) {
        slave.bus().advance(begin + cycle * kCycle - slave.bus().now());
        const auto got = slave.bus().ask(requests[cycle % 2]);
        if (got != reply) ++lost;
    }
    EXPECT_EQ(lost, 0u);
    const auto& counters = slave.layer2().counters();
    EXPECT_EQ(counters.late, 0u);
    EXPECT_EQ(counters.overtaken, 0u);
    for (const std::uint64_t flaws : counters.flaws) EXPECT_EQ(flaws, 0u);
    EXPECT_EQ(slave.slave().snapshot().counters.left_data_exchange, 0u);
    EXPECT_EQ(b.diag(), kExchanging);
}

void C27_MinSlaveInterval(Bench& b, SimulatedSlave& slave)
{
    const nanoseconds interval = 100us * gsd_of(b.family).number("Min_Slave_Intervall");
    // At a rate at which the telegrams are shorter than the interval.
    slave.restart_at(Baud::k187_5, false);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    const auto begin = slave.bus().now();
    for (std::uint16_t cycle = 1; cycle <= 5000; ++cycle) {
        slave.bus().advance(begin + cycle * interval - slave.bus().now());
        ASSERT_EQ(b.owner.data_exchange(words({cycle, 2, 3, 4})), inputs_at_start()) << cycle;
        ASSERT_LT(slave.bus().now(), begin + (cycle + 1) * interval) << "the telegrams fit into the interval";
    }
    EXPECT_EQ(b.foreign.rd_outp(), dl({5000, 2, 3, 4}));
    EXPECT_EQ(slave.layer2().counters().late, 0u);
}

void C28_EveryAddress(Bench& b)
{
    for (std::uint8_t address = 0; address <= 125; ++address) {
        b.slave.restart(address);
        Master master{b.slave, static_cast<std::uint8_t>(address == 2 ? 3 : 2), address};
        EXPECT_EQ(master.fdl_status(), "OK") << int{address};
        EXPECT_EQ(master.set_prm(b.prm()), "SC") << int{address};
        EXPECT_EQ(master.chk_cfg(cfg()), "SC") << int{address};
        const std::string inputs = master.data_exchange(words({1, 2, 3, 4}));
        EXPECT_TRUE(inputs.starts_with("DH ") && inputs.size() == 14) << int{address} << ": " << inputs;
    }
}

} // namespace

void add_bus_cases(std::vector<Case>& all)
{
    constexpr const char* kNoRates = "A pty has no bit times, and no octet of another rate";
    all.push_back({.name = "C24_EveryRate",
                   .asks = "Each rate of the GSD is found, and data are exchanged at it",
                   .run_simulated = C24_EveryRate,
                   .why_simulated = kNoRates});
    all.push_back({.name = "C24_ChangeOfTheRate",
                   .asks = "The masters change the rate while data are exchanged: the slave follows",
                   .run_simulated = C24_ChangeOfTheRate,
                   .why_simulated = kNoRates});
    all.push_back({.name = "C24_Noise",
                   .asks = "Noise is no rate: silence, and then the right rate is found",
                   .run_simulated = C24_Noise,
                   .why_simulated = kNoRates});
    all.push_back({.name = "C24_TrafficOfOthersOnly",
                   .asks = "The rate is found from the traffic of two other slaves",
                   .run_simulated = C24_TrafficOfOthersOnly,
                   .why_simulated = kNoRates});
    all.push_back(
        {.name = "C25_ShortInterruption",
         .asks = "The bus is interrupted for less than T_WD, within a telegram: the exchange goes on",
         .run = C25_ShortInterruption});
    all.push_back({.name = "C25_LongInterruption",
                   .asks = "For longer than T_WD: outputs 0, then a start-up without manual help",
                   .run = C25_LongInterruption});
    all.push_back({.name = "C25_SupplyOffAndOn",
                   .asks = "The supply of the device goes off and on, watchdog on or off: it is as new",
                   .run = C25_SupplyOffAndOn});
    all.push_back({.name = "C25_MasterOffAndOn",
                   .asks = "The master goes off and on, for long or short: it starts the slave up again",
                   .run = C25_MasterOffAndOn});
    all.push_back({.name = "C25_NoiseBurst",
                   .asks = "Noise on the line: silence, no change, the next request is answered",
                   .run = C25_NoiseBurst});
    all.push_back({.name = "C26_TwentyFourHours",
                   .asks = "24 hours, 10^6 cycles: no cycle is lost, no error counted",
                   .run_simulated = C26_TwentyFourHours,
                   .why_simulated = "24 hours pass on the simulated clock only"});
    all.push_back({.name = "C27_MinSlaveInterval",
                   .asks = "Polled at exactly Min_Slave_Intervall: every request is answered",
                   .run_simulated = C27_MinSlaveInterval,
                   .why_simulated = "Other programs of the machine disturb an exact interval"});
    all.push_back(
        {.name = "C28_EveryAddress", .asks = "Each address from 0 to 125", .run = C28_EveryAddress});
}

} // namespace conformance
