// SPDX-License-Identifier: Apache-2.0
// Data_Exchange, its lengths, and its end: C-11, C-12 and C-14; the order of octets, and consistency.
#include "case.hpp"

namespace conformance {
namespace {

using std::chrono::milliseconds;

void C11_BeforeTheConfiguration(Bench& b)
{
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS") << "Wait_Prm";
    EXPECT_EQ(b.owner.data_exchange(Octets{}), "RS") << "Wait_Prm, without data";
    EXPECT_EQ(b.diag(), kWaitPrm);
    ASSERT_TRUE(b.parameterise());
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS") << "Wait_Cfg";
    EXPECT_EQ(b.diag(), kWaitCfg);
}

void C11_OtherLengths(Bench& b)
{
    for (const std::size_t length : {7u, 9u, 0u, 1u, 244u}) {
        ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
        EXPECT_TRUE(b.slave.drive_gets(1)) << length;
        EXPECT_EQ(b.owner.data_exchange(Octets(length, 0x55)), "RS") << length;
        EXPECT_EQ(b.diag(), kWaitPrm) << length;
        EXPECT_TRUE(b.slave.drive_gets(0)) << length;
    }
}

void C11_AnotherMaster(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.foreign.data_exchange(words({9, 9, 9, 9})), "RS");
    EXPECT_EQ(b.foreign.data_exchange(Octets(3, 0x55)), "RS") << "nor does a wrong length end anything";
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4}));
}

/// A way out of Data_Exch, and octets 1 to 4 of the diagnosis behind it.
struct WayOut {
    const char* name;
    void (*take)(Bench&);
    const char* diag;
};

const std::vector<WayOut>& ways_out()
{
    static const std::vector<WayOut> all{
        {"unlock", [](Bench& b) { EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC"); }, kWaitPrm},
        {"another ident",
         [](Bench& b) {
             Octets prm = b.prm();
             prm[5] ^= 0x01;
             EXPECT_EQ(b.owner.set_prm(prm), "SC");
         },
         "42 05 00 FF"},
        {"bad User_Prm_Data",
         [](Bench& b) { EXPECT_EQ(b.owner.set_prm(b.prm({}, b.family.bad_user_prm)), "SC"); }, "42 05 00 FF"},
        {"another configuration", [](Bench& b) { EXPECT_EQ(b.owner.chk_cfg({0x50}), "SC"); }, "06 05 00 FF"},
        {"another length", [](Bench& b) { EXPECT_EQ(b.owner.data_exchange({0x55}), "RS"); }, kWaitPrm},
        {"watchdog", [](Bench& b) { b.let_the_watchdog_expire(); }, kWaitPrm},
    };
    return all;
}

void C12_OutputsAfterEachWayOut(Bench& b)
{
    for (const WayOut& way : ways_out()) {
        ASSERT_TRUE(b.exchange(words({0x1111, 0x2222, 0x3333, 0x4444})));
        EXPECT_TRUE(b.slave.drive_gets(0x1111)) << way.name;
        way.take(b);
        EXPECT_EQ(b.diag(), way.diag) << way.name;
        EXPECT_EQ(b.foreign.rd_outp(), "RS") << way.name;
        EXPECT_TRUE(b.slave.drive_gets(0)) << way.name;
        ASSERT_TRUE(b.start_up()) << way.name;
        EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0})) << way.name;
        EXPECT_EQ(b.owner.data_exchange(words({0x5555, 2, 3, 4})), inputs_at_start()) << way.name;
        EXPECT_TRUE(b.slave.drive_gets(0x5555)) << way.name;
        EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
        EXPECT_TRUE(b.slave.drive_gets(0)) << way.name;
        EXPECT_EQ(b.slave.written(), (std::vector<std::uint16_t>{0x1111, 0, 0x5555, 0}))
            << way.name << ": each end is told exactly once";
    }
}

/// The devices have no Fail_Safe: a master in Clear sends zeros, and Global_Control with Clear_Data.
void C12_Clear(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({0x1111, 2, 3, 4})));
    EXPECT_TRUE(b.slave.drive_gets(0x1111));
    b.owner.control(Octets{0x02, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0}));
    EXPECT_TRUE(b.slave.drive_gets(0));
    EXPECT_EQ(b.diag(), kExchanging) << "it stays in the exchange";
    EXPECT_EQ(b.owner.data_exchange(words({0, 0, 0, 0})), inputs_at_start());
    b.owner.control(Octets{0x00, 0x00});
    EXPECT_EQ(b.owner.data_exchange(words({0x2222, 2, 3, 4})), inputs_at_start());
    EXPECT_TRUE(b.slave.drive_gets(0x2222));
}

void C14_WithoutWatchdogTheOutputsHold(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({0x1111, 2, 3, 4}), {.status = 0x80, .factor_1 = 1, .factor_2 = 1}));
    EXPECT_TRUE(b.slave.drive_gets(0x1111));
    b.slave.pass(milliseconds{2500}); // longer than Baud_Control and a dwell of the search
    EXPECT_EQ(b.foreign.rd_outp(), dl({0x1111, 2, 3, 4}));
    EXPECT_EQ(b.diag(), kExchangingUnguarded);
    EXPECT_EQ(b.owner.data_exchange(words({0x2222, 2, 3, 4})), inputs_at_start()) << "without Set_Prm";
    EXPECT_TRUE(b.slave.drive_gets(0x2222));
    EXPECT_EQ(b.slave.written(), (std::vector<std::uint16_t>{0x1111, 0x2222}));
}

void B2_DataFormat(Bench& b)
{
    ASSERT_TRUE(b.start_up());
    b.slave.set_input(0, 0x00FF);
    EXPECT_EQ(b.owner.data_exchange(test::octets("01 02 03 04 05 06 07 08")), "DL 00 FF 56 78")
        << "the high octet of a word first, words in the order of the identifiers";
    EXPECT_TRUE(b.slave.drive_gets(0x0102));
    b.slave.set_input(1, 0x8000);
    EXPECT_EQ(b.owner.data_exchange(test::octets("FE 00 00 00 00 00 00 00")), "DL 00 FF 80 00");
    EXPECT_TRUE(b.slave.drive_gets(0xFE00));
}

/// A word is consistent (identifiers 50 and 60): its two octets are of one moment, in both directions.
void B2_Consistency(Bench& b)
{
    ASSERT_TRUE(b.start_up());
    std::vector<std::uint16_t> given;
    for (std::uint16_t round = 1; round <= 10; ++round) {
        const auto word = static_cast<std::uint16_t>(round * 0x0101); // both octets are equal
        b.slave.set_input(0, word);
        given.push_back(word);
        for (int cycles = 0; cycles < 3; ++cycles)
            EXPECT_EQ(b.owner.data_exchange(words({word, 2, 3, 4})), dl({word, kInputsAtStart[1]}));
        EXPECT_TRUE(b.slave.drive_gets(word));
    }
    EXPECT_EQ(b.slave.written(), given) << "whole words, each once, in order";
}

} // namespace

void add_exchange_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C11_BeforeTheConfiguration",
                   .asks = "Data_Exchange in Wait_Prm and Wait_Cfg: RS",
                   .run = C11_BeforeTheConfiguration});
    all.push_back({.name = "C11_OtherLengths",
                   .asks = "Data_Exchange of another length (one less, one more, 0, 1, 244): RS, Wait_Prm",
                   .run = C11_OtherLengths});
    all.push_back({.name = "C11_AnotherMaster",
                   .asks = "Data_Exchange of another master: RS, and no change",
                   .run = C11_AnotherMaster});
    all.push_back(
        {.name = "C12_OutputsAfterEachWayOut",
         .asks = "On each way out of Data_Exch the outputs are 0, and the drive is told exactly once",
         .run = C12_OutputsAfterEachWayOut});
    all.push_back({.name = "C12_Clear",
                   .asks = "Clear_Data sets the outputs to 0 at once; the exchange goes on",
                   .run = C12_Clear});
    add_watchdog_cases(all);
    all.push_back(
        {.name = "C14_WithoutWatchdogTheOutputsHold",
         .asks = "With the watchdog off a master may vanish: outputs hold, and it goes on without Set_Prm",
         .run = C14_WithoutWatchdogTheOutputsHold});
}

void add_data_cases(std::vector<Case>& all)
{
    all.push_back({.name = "B2_DataFormat",
                   .asks = "The high octet of a word comes first; words are in the order of the identifiers",
                   .run = B2_DataFormat});
    all.push_back({.name = "B2_Consistency",
                   .asks = "The two octets of a word are of one moment, in both directions",
                   .run = B2_Consistency});
}

} // namespace conformance
