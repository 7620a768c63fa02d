// SPDX-License-Identifier: Apache-2.0
// The watchdog (control interval monitoring): C-13. Its times are judged on the simulated clock.
#include "case.hpp"
#include "simulated_slave.hpp"

namespace conformance {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr const char* kWhySimulated = "Times are judged on a clock that runs as the case says";

/// Keeps the exchange until just before the watchdog `period` after the last request, and looks on both sides
/// of the tolerance of 10 ms.
void expires_after(Bench& b, SimulatedSlave& slave, nanoseconds period)
{
    ASSERT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), inputs_at_start());
    const auto asked = slave.bus().asked_at();
    const auto until = [&](nanoseconds after) { slave.bus().advance(asked + after - slave.bus().now()); };
    until(period - 1ns);
    EXPECT_EQ(slave.slave().state(), dpslave::dp::State::data_exch)
        << "not before " << period.count() << " ns";
    until(period + 10ms);
    EXPECT_EQ(slave.slave().state(), dpslave::dp::State::wait_prm) << "within 10 ms after it";
    EXPECT_EQ(b.diag(), kWaitPrm);
    EXPECT_TRUE(slave.drive_gets(0));
}

void C13_Times(Bench& b, SimulatedSlave& slave)
{
    for (const int one : {1, 2, 10, 100, 254, 255})
        for (const int other : {1, 3, 50, 255}) {
            const PrmHeader header{.factor_1 = static_cast<std::uint8_t>(one),
                                   .factor_2 = static_cast<std::uint8_t>(other)};
            // A start-up takes longer than the shortest times: they are set in Data_Exch.
            ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
            ASSERT_EQ(b.owner.set_prm(b.prm(header)), "SC");
            expires_after(b, slave, 10ms * one * other);
        }
}

void C13_TimesOfOneMillisecond(Bench& b, SimulatedSlave& slave)
{
    Octets user = b.family.user_prm;
    user[0] = 0x04; // WD_Base
    for (const auto& [one, other] :
         {std::pair{20, 1}, std::pair{1, 25}, std::pair{7, 11}, std::pair{255, 255}}) {
        const PrmHeader header{.factor_1 = static_cast<std::uint8_t>(one),
                               .factor_2 = static_cast<std::uint8_t>(other)};
        ASSERT_EQ(b.owner.set_prm(b.prm(header, user)), "SC");
        ASSERT_EQ(b.owner.chk_cfg(cfg()), "SC");
        b.owner.slave_diag();
        b.owner.slave_diag();
        expires_after(b, slave, 1ms * one * other);
    }
}

void C13_EveryRequestOfTheOwnerRetriggers(Bench& b, SimulatedSlave& slave)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), {.factor_1 = 10, .factor_2 = 1})); // 100 ms
    const auto after_90_ms = [&](const std::string& reply, const std::string& wanted, const char* what) {
        EXPECT_EQ(reply, wanted) << what;
        slave.pass_exactly(90ms);
        EXPECT_EQ(slave.slave().state(), dpslave::dp::State::data_exch) << what;
    };
    slave.pass_exactly(90ms);
    after_90_ms(b.owner.data_exchange(words({1, 2, 3, 4})), inputs_at_start(), "Data_Exchange");
    after_90_ms(b.owner.repeats(), inputs_at_start(), "a repetition");
    after_90_ms(b.owner.fdl_status(), "OK", "FDL status");
    after_90_ms(b.owner.rd_inp(), inputs_at_start(), "RD_Inp");
    after_90_ms(b.owner.rd_outp(), dl({1, 2, 3, 4}), "RD_Outp");
    after_90_ms(b.owner.get_cfg(), "DL " + test::show(cfg()), "Get_Cfg");
    after_90_ms(b.owner.chk_cfg(cfg()), "SC", "Chk_Cfg");
    after_90_ms(b.owner.asks(20), "RS", "what is refused");
    after_90_ms(b.diag(b.owner), kExchanging, "Slave_Diag");
    slave.pass_exactly(21ms);
    EXPECT_EQ(slave.slave().state(), dpslave::dp::State::wait_prm);
}

void C13_OthersDoNotRetrigger(Bench& b, SimulatedSlave& slave)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), {.factor_1 = 10, .factor_2 = 1}));
    const auto expiry = slave.bus().asked_at() + 100ms;
    while (slave.bus().now() < expiry - 25ms) {
        b.foreign.slave_diag();
        b.foreign.rd_inp();
        b.foreign.fdl_status();
        b.foreign.set_prm(b.prm());
        b.owner.control(Octets{0x00, 0x00}); // Global_Control of the owner, wire reference 7.1
        slave.send(test::sd2(30, 2, 0x5D, words({1, 2})));
        EXPECT_EQ(slave.slave().state(), dpslave::dp::State::data_exch);
    }
    slave.bus().advance(expiry + 10ms - slave.bus().now());
    EXPECT_EQ(b.diag(), kWaitPrm);
}

const char* no_dpv1_status(const Family& family)
{
    return family.dpv1_status ? nullptr : "User_Prm_Data has no DPV1_Status, so there is no base of 1 ms";
}

} // namespace

void add_watchdog_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C13_Times",
                   .asks = "The watchdog expires between T_WD and T_WD + 10 ms, for factors from 1 to 255",
                   .run_simulated = C13_Times,
                   .why_simulated = kWhySimulated});
    all.push_back({.name = "C13_TimesOfOneMillisecond",
                   .asks = "The same with the base of 1 ms (WD_Base)",
                   .run_simulated = C13_TimesOfOneMillisecond,
                   .why_simulated = kWhySimulated,
                   .not_applicable = no_dpv1_status});
    all.push_back({.name = "C13_EveryRequestOfTheOwnerRetriggers",
                   .asks = "Every request of the owner retriggers it, repetitions and refused ones too",
                   .run_simulated = C13_EveryRequestOfTheOwnerRetriggers,
                   .why_simulated = kWhySimulated});
    all.push_back({.name = "C13_OthersDoNotRetrigger",
                   .asks = "Other masters, Global_Control and requests to other slaves do not",
                   .run_simulated = C13_OthersDoNotRetrigger,
                   .why_simulated = kWhySimulated});
}

} // namespace conformance
