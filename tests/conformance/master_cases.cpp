// SPDX-License-Identifier: Apache-2.0
// Two masters: C-15 and C-16.
#include "case.hpp"

namespace conformance {
namespace {

void C15_ASecondMasterReads(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.diag(b.foreign), kExchanging);
    EXPECT_EQ(b.foreign.get_cfg(), "DL " + test::show(cfg()));
    EXPECT_EQ(b.foreign.rd_inp(), inputs_at_start());
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4}));
    EXPECT_EQ(b.foreign.fdl_status(), "OK");
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
    EXPECT_EQ(b.foreign.rd_inp({0x00}), "RR") << "with data";
    EXPECT_EQ(b.foreign.rd_outp({0x00}), "RR");
    EXPECT_EQ(b.foreign.get_cfg({0x00}), "RR");
    EXPECT_EQ(b.foreign.slave_diag({0x00}), "RR");
}

void C15_ASecondMasterChangesNothing(Bench& b)
{
    const auto has_no_effect = [&](const char* state) {
        for (const std::uint8_t status : Octets{0x88, 0x80, 0x40, 0xC0, 0x00})
            EXPECT_EQ(b.foreign.set_prm(b.prm({.status = status, .min_tsdr = 200})), "SC") << int{status};
        EXPECT_EQ(b.foreign.chk_cfg(cfg()), "RS");
        EXPECT_EQ(b.foreign.chk_cfg({0x50}), "RS");
        EXPECT_EQ(b.foreign.data_exchange(words({9, 9, 9, 9})), "RS");
        for (const std::uint8_t command : Octets{0x02, 0x08, 0x20, 0x2A}) b.foreign.control({command, 0x00});
        EXPECT_EQ(b.diag(), state);
    };
    ASSERT_TRUE(b.parameterise());
    has_no_effect(kWaitCfg);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    has_no_effect(kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4}));
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
}

/// Master 9 has the slave.
testing::AssertionResult is_taken(Bench& b)
{
    if (b.foreign.set_prm(b.prm()) != "SC") return testing::AssertionFailure() << "Set_Prm";
    if (b.foreign.chk_cfg(cfg()) != "SC") return testing::AssertionFailure() << "Chk_Cfg";
    for (int polls = 0; b.diag(b.foreign) == "00 0E 00 09" && polls < 300; ++polls)
        b.slave.pass(std::chrono::milliseconds{5});
    if (const std::string now = b.diag(b.foreign); now != "00 0C 00 09")
        return testing::AssertionFailure() << now;
    b.foreign.slave_diag();
    return testing::AssertionSuccess();
}

void C16_TakeoverAfterUnlock(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.foreign.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.diag(), kExchanging) << "it is locked";
    EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm);
    ASSERT_TRUE(is_taken(b));
    EXPECT_EQ(b.foreign.data_exchange(words({9, 9, 9, 9})), inputs_at_start());
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS") << "now the first one is the foreign one";
    EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
    EXPECT_EQ(b.diag(), "00 0C 00 09");
    EXPECT_EQ(b.owner.rd_outp(), dl({9, 9, 9, 9}));
}

void C16_TakeoverAfterTheWatchdog(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.foreign.set_prm(b.prm()), "SC");
    b.let_the_watchdog_expire();
    EXPECT_EQ(b.diag(), kWaitPrm) << "the Set_Prm in between was not kept";
    ASSERT_TRUE(is_taken(b));
    EXPECT_EQ(b.foreign.data_exchange(words({9, 9, 9, 9})), inputs_at_start());
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "RS");
}

/// VPC3+, "TC08 NMAS1" and "TC09 NMAS2": two Set_Prm behind each other.
void C16_TwoSetPrmBehindEachOther(Bench& b)
{
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.diag(), kWaitCfg) << "of one master";
    EXPECT_EQ(b.foreign.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.diag(), kWaitCfg) << "of two: the first one has it";
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "SC");
    ASSERT_TRUE(b.becomes_ready());
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), inputs_at_start());
}

} // namespace

void add_master_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C15_ASecondMasterReads",
                   .asks = "Slave_Diag, Get_Cfg, RD_Inp, RD_Outp and FDL status are answered to every master",
                   .run = C15_ASecondMasterReads});
    all.push_back(
        {.name = "C15_ASecondMasterChangesNothing",
         .asks = "Set_Prm, Chk_Cfg, Data_Exchange and Global_Control of another master have no effect",
         .run = C15_ASecondMasterChangesNothing});
    all.push_back({.name = "C16_TakeoverAfterUnlock",
                   .asks = "After unlock another master, of class 1 or 2, takes the slave",
                   .run = C16_TakeoverAfterUnlock});
    all.push_back({.name = "C16_TakeoverAfterTheWatchdog",
                   .asks = "After the watchdog another master takes the slave",
                   .run = C16_TakeoverAfterTheWatchdog});
    all.push_back({.name = "C16_TwoSetPrmBehindEachOther",
                   .asks = "Two Set_Prm behind each other, of one master and of two: the first one has it",
                   .run = C16_TwoSetPrmBehindEachOther});
}

} // namespace conformance
