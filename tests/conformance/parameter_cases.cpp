// SPDX-License-Identifier: Apache-2.0
// Set_Prm while data are exchanged, min T_SDR, and the address: C-21 to C-23.
#include "case.hpp"
#include "simulated_slave.hpp"

namespace conformance {
namespace {

void C21_TheSameParameters(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4})) << "the outputs stay";
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start()) << "without Chk_Cfg";
}

void C21_AnotherWatchdog(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x80})), "SC");
    EXPECT_EQ(b.diag(), kExchangingUnguarded) << "off";
    EXPECT_EQ(b.owner.set_prm(b.prm({.factor_1 = 50, .factor_2 = 1})), "SC");
    EXPECT_EQ(b.diag(), kExchanging) << "on, with 500 ms";
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
    b.slave.pass(std::chrono::milliseconds{700});
    EXPECT_EQ(b.diag(), kWaitPrm);
}

void C21_OtherTags(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    Octets user = b.family.user_prm;
    const std::size_t first = b.family.dpv1_status ? 3 : 0;
    std::swap(user[first + 1], user[first + 3]); // the inputs change places
    EXPECT_EQ(b.owner.set_prm(b.prm({}, user)), "SC");
    EXPECT_EQ(b.diag(), kWaitCfg) << "values of the old tags must not pass for the new ones";
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS");
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "SC");
    ASSERT_TRUE(b.becomes_ready());
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), dl({kInputsAtStart[1], kInputsAtStart[0]}));
}

void C21_WrongParameters(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    Octets prm = b.prm();
    prm[4] ^= 0x80;
    EXPECT_EQ(b.owner.set_prm(prm), "SC");
    EXPECT_EQ(b.diag(), "42 05 00 FF");
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS");
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
}

void C21_MinTsdrAlone(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    Octets prm = b.prm({.status = 0x00, .min_tsdr = 60});
    prm[4] ^= 0x80;
    EXPECT_EQ(b.owner.set_prm(prm), "SC") << "neither lock nor unlock: the ident is not looked at";
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
}

/// min T_SDR as the master wants it, measured at the replies behind the SC.
void C22_MinTsdr(Bench& b, SimulatedSlave& slave)
{
    const auto is_answered_after = [&](std::uint32_t bits, const std::string& when) {
        b.owner.fdl_status();
        EXPECT_EQ(slave.bus().turnaround(), slave.bus().bits(bits)) << when << ", FDL status";
        b.owner.data_exchange(words({1, 2, 3, 4}));
        EXPECT_EQ(slave.bus().turnaround(), slave.bus().bits(bits)) << when << ", Data_Exchange";
        b.foreign.slave_diag();
        EXPECT_EQ(slave.bus().turnaround(), slave.bus().bits(bits)) << when << ", another master";
    };
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    is_answered_after(11, "from power-on");
    std::uint32_t before = 11;
    for (const std::uint8_t wanted : Octets{0, 5, 10, 11, 12, 100, 254, 255, 0, 1}) {
        const std::uint32_t taken = wanted == 0 ? before : std::max<std::uint32_t>(wanted, 11);
        ASSERT_EQ(b.owner.set_prm(b.prm({.min_tsdr = wanted})), "SC"); // answered with the old one
        slave.bus().set_min_tsdr(dpslave::Tbit{taken});
        is_answered_after(taken, "Set_Prm with " + std::to_string(int{wanted}));
        before = taken;
    }
    EXPECT_EQ(b.foreign.set_prm(b.prm({.status = 0x00, .min_tsdr = 99})), "SC");
    is_answered_after(before, "after another master wanted 99");
}

void C23_IsRefused(Bench& b)
{
    const Octets ident{static_cast<std::uint8_t>(b.family.ident / 256),
                       static_cast<std::uint8_t>(b.family.ident % 256)};
    const auto is_refused = [&](const char* state) {
        for (const std::uint8_t no_further : Octets{0x00, 0xFF})
            EXPECT_EQ(b.owner.asks(55, {7, ident[0], ident[1], no_further}), "RS") << state;
        EXPECT_EQ(b.owner.asks(55, {}), "RS") << state << ", without data";
        EXPECT_EQ(b.owner.fdl_status(), "OK") << state << ": the address is the same";
    };
    is_refused("Wait_Prm");
    ASSERT_TRUE(b.parameterise());
    is_refused("Wait_Cfg");
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    is_refused("Data_Exch");
    EXPECT_EQ(b.diag(), kExchanging);
}

const char* no_set_slave_add(const Family& /*all*/)
{
    return "The device has no Set_Slave_Add: the address is set at the device (Set_Slave_Add_supp = 0)";
}

} // namespace

void add_parameter_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C21_TheSameParameters",
                   .asks = "A valid Set_Prm of the owner in Data_Exch: the exchange goes on, outputs stay",
                   .run = C21_TheSameParameters});
    all.push_back({.name = "C21_AnotherWatchdog",
                   .asks = "A changed watchdog in Data_Exch is taken at once",
                   .run = C21_AnotherWatchdog});
    all.push_back({.name = "C21_OtherTags",
                   .asks = "Other User_Prm_Data in Data_Exch: Wait_Cfg, a new Chk_Cfg is needed",
                   .run = C21_OtherTags});
    all.push_back({.name = "C21_WrongParameters",
                   .asks = "A wrong Set_Prm of the owner in Data_Exch: Prm_Fault, Wait_Prm",
                   .run = C21_WrongParameters});
    all.push_back({.name = "C21_MinTsdrAlone",
                   .asks = "Lock and unlock both 0 in Data_Exch: min T_SDR alone, with any ident",
                   .run = C21_MinTsdrAlone});
    all.push_back({.name = "C22_MinTsdr",
                   .asks = "Replies begin min T_SDR after the request: 0 keeps it, 1 to 10 are 11, 11 to 255",
                   .run_simulated = C22_MinTsdr,
                   .why_simulated = "A pty has no bit times"});
    all.push_back({.name = "C23_IsRefused",
                   .asks = "Set_Slave_Add to a slave without it: RS in every state",
                   .run = C23_IsRefused});
    all.push_back({.name = "C23_ConditionsAndPersistence",
                   .asks = "Set_Slave_Add: state, ident, range, No_Add_Chg; the address outlives power-off",
                   .not_applicable = no_set_slave_add});
}

} // namespace conformance
