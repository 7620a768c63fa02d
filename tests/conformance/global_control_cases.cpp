// SPDX-License-Identifier: Apache-2.0
// Global_Control: C-17 and C-18.
#include "case.hpp"

namespace conformance {
namespace {

constexpr std::uint8_t kGroups = 0x05; // groups 1 and 3
constexpr std::uint16_t kActive = 0x1122, kReceived = 0xA501;

/// Sync and Freeze as the owner asks for them in Set_Prm, where the device has them.
PrmHeader with_groups(const Bench& b)
{
    return {.status = static_cast<std::uint8_t>(b.family.sync_and_freeze ? 0xB8 : 0x88), .group = kGroups};
}

/// What a slave does with a command, read out of section 4.10 a second time.
struct Held {
    bool sync = false;
    bool freeze = false;
    std::uint16_t active = kActive; ///< output 1

    void take(unsigned command, bool has_sync_and_freeze)
    {
        const bool clear = command & 0x02, unfreeze = command & 0x04, freezes = command & 0x08,
                   unsync = command & 0x10, syncs = command & 0x20;
        if (has_sync_and_freeze) {
            if (sync && (unsync || syncs)) active = kReceived;
            sync = !unsync && (syncs || sync);
            freeze = !unfreeze && (freezes || freeze);
        }
        if (clear) active = 0;
    }
    std::string diag() const
    {
        return test::show(
            {0x00, static_cast<std::uint8_t>(0x0C | (freeze ? 0x10 : 0) | (sync ? 0x20 : 0)), 0x00, 0x02});
    }
};

/// A slave in Data_Exch; `held`: in Sync with other outputs received, and in Freeze.
testing::AssertionResult is_prepared(Bench& b, Held& expected, bool held)
{
    if (auto wrong = b.exchange(words({kActive, 2, 3, 4}), with_groups(b)); !wrong) return wrong;
    expected = {};
    if (held && b.family.sync_and_freeze) {
        b.owner.control(Octets{0x28, 0x00});
        b.owner.data_exchange(words({kReceived, 2, 3, 4}));
        expected.sync = expected.freeze = true;
    }
    return testing::AssertionSuccess();
}

void expect_state(Bench& b, const Held& expected, const std::string& after)
{
    EXPECT_EQ(b.diag(), expected.diag()) << after;
    const std::string outputs = b.foreign.rd_outp();
    const std::uint16_t rest = expected.active == 0 ? 0 : 1;
    EXPECT_EQ(outputs, dl({expected.active, static_cast<std::uint16_t>(2 * rest),
                           static_cast<std::uint16_t>(3 * rest), static_cast<std::uint16_t>(4 * rest)}))
        << after;
}

/// The 32 commands of bits 1 to 5, from a slave that holds and from one that does not.
void C17_EveryCommand(Bench& b)
{
    for (const bool held : {false, true})
        for (const std::uint8_t group : Octets{0x00, 0x04})
            for (unsigned command = 0; command < 0x40; command += 2) {
                Held expected;
                ASSERT_TRUE(is_prepared(b, expected, held));
                b.owner.control(Octets{static_cast<std::uint8_t>(command), group});
                expected.take(command, b.family.sync_and_freeze);
                expect_state(b, expected, "command " + std::to_string(command));
                EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
            }
}

/// All that must have no effect: another group, another length, another master, in Data_Exch and in Wait_Cfg.
void C17_WhatIsNotForTheSlave(Bench& b)
{
    const auto without_effect = [&](unsigned command) {
        const auto octet = static_cast<std::uint8_t>(command);
        b.owner.control(Octets{octet, 0x0A}); // groups 2 and 4
        for (const std::uint8_t group : Octets{0x00, 0x04, 0x0A}) {
            b.foreign.control(Octets{octet, group});
            for (Master* const master : {&b.owner, &b.foreign}) {
                const auto sends = [&](const Octets& data) { master->control(data); };
                if (group == 0) sends({octet});
                sends({octet, group, 0x00});
            }
        }
    };
    for (const bool held : {false, true}) {
        Held expected;
        ASSERT_TRUE(is_prepared(b, expected, held));
        for (unsigned command = 0; command < 0x40; command += 2) {
            without_effect(command);
            expect_state(b, expected, "command " + std::to_string(command));
        }
        EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
    }
    ASSERT_TRUE(b.parameterise(with_groups(b)));
    for (unsigned command = 0; command < 0x40; command += 2) {
        without_effect(command);
        b.owner.control(Octets{static_cast<std::uint8_t>(command), 0x00});
        b.owner.control(Octets{static_cast<std::uint8_t>(command), 0x04});
        EXPECT_EQ(b.diag(), kWaitCfg) << command;
    }
}

void C17_ToOneStation(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({kActive, 2, 3, 4}), with_groups(b)));
    for (const std::uint8_t fc : Octets{0x46, 0x44}) { // SDN high, and low as some masters send it
        EXPECT_TRUE(b.slave.is_silent_to(test::sd2(test::kUs, 2, fc, Saps{58, 62}, {0x02, 0x00})));
        EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0})) << int{fc};
        EXPECT_EQ(b.owner.data_exchange(words({kActive, 2, 3, 4})), inputs_at_start());
        b.slave.send(test::sd2(127, 2, fc, Saps{58, 62}, {0x02, 0x00}));
        EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0})) << int{fc} << ", to all";
        EXPECT_EQ(b.owner.data_exchange(words({kActive, 2, 3, 4})), inputs_at_start());
    }
    for (const Saps saps : {Saps{57, 62}, Saps{58, 61}, Saps{62, 58}})
        b.slave.send(test::sd2(127, 2, 0x46, saps, {0x02, 0x00}));
    EXPECT_EQ(b.foreign.rd_outp(), dl({kActive, 2, 3, 4})) << "no SAP of Global_Control";
    b.owner.control(Octets{0xC1, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({kActive, 2, 3, 4})) << "reserved bits are ignored";
    EXPECT_EQ(b.diag(), kExchanging);
}

void C18_Sync(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), with_groups(b)));
    const auto exchange = [&](std::uint16_t first) {
        EXPECT_EQ(b.owner.data_exchange(words({first, 2, 3, 4})), inputs_at_start());
    };
    b.owner.control(Octets{0x20, 0x00});
    exchange(5);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4})) << "held";
    EXPECT_EQ(b.diag(), "00 2C 00 02");
    exchange(6);
    b.owner.control(Octets{0x20, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({6, 2, 3, 4})) << "those received last";
    exchange(7);
    EXPECT_EQ(b.foreign.rd_outp(), dl({6, 2, 3, 4})) << "held again";
    b.owner.control(Octets{0x30, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({7, 2, 3, 4})) << "Unsync has priority over Sync";
    exchange(8);
    EXPECT_EQ(b.foreign.rd_outp(), dl({8, 2, 3, 4}));
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_TRUE(b.slave.drive_gets(8));
    const auto got = b.slave.written();
    EXPECT_EQ(std::count(got.begin(), got.end(), 5), 0) << "what was only stored never went to the drive";
}

void C18_Freeze(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), with_groups(b)));
    const auto inputs = [&] { return b.owner.data_exchange(words({1, 2, 3, 4})); };
    const auto with_first = [](std::uint16_t word) { return dl({word, kInputsAtStart[1]}); };
    b.owner.control(Octets{0x08, 0x00});
    b.slave.set_input(0, 0x1111);
    EXPECT_EQ(inputs(), inputs_at_start()) << "held";
    EXPECT_EQ(b.foreign.rd_inp(), inputs_at_start());
    EXPECT_EQ(b.diag(), "00 1C 00 02");
    b.owner.control(Octets{0x08, 0x00});
    EXPECT_EQ(inputs(), with_first(0x1111)) << "a new copy";
    b.slave.set_input(0, 0x2222);
    EXPECT_EQ(inputs(), with_first(0x1111));
    b.owner.control(Octets{0x0C, 0x00});
    EXPECT_EQ(inputs(), with_first(0x2222)) << "Unfreeze has priority over Freeze";
    b.slave.set_input(0, 0x3333);
    EXPECT_EQ(inputs(), with_first(0x3333));
    EXPECT_EQ(b.diag(), kExchanging);
}

void C18_ClearInSync(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), with_groups(b)));
    b.owner.control(Octets{0x20, 0x00});
    EXPECT_EQ(b.owner.data_exchange(words({5, 6, 7, 8})), inputs_at_start());
    b.owner.control(Octets{0x02, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0})) << "at once, also in Sync";
    b.owner.control(Octets{0x20, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0})) << "what was received is cleared too";
    EXPECT_EQ(b.owner.data_exchange(words({9, 6, 7, 8})), inputs_at_start());
    EXPECT_EQ(b.foreign.rd_outp(), dl({0, 0, 0, 0}));
    b.owner.control(Octets{0x20, 0x00});
    EXPECT_EQ(b.foreign.rd_outp(), dl({9, 6, 7, 8}));
}

/// Sync and Freeze end with the exchange.
void C18_TheEndOfSyncAndFreeze(Bench& b)
{
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}), with_groups(b)));
    b.owner.control(Octets{0x28, 0x00});
    EXPECT_EQ(b.diag(), "00 3C 00 02");
    EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm);
    ASSERT_TRUE(b.exchange(words({5, 6, 7, 8}), with_groups(b)));
    EXPECT_EQ(b.diag(), kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({5, 6, 7, 8}));
}

const char* neither_sync_nor_freeze(const Family& family)
{
    return family.sync_and_freeze ? nullptr : "The device has neither Sync nor Freeze";
}

} // namespace

void add_global_control_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C17_EveryCommand",
                   .asks =
                       "The 32 commands, for all and for its group: Clear, Sync, Unsync, Freeze, Unfreeze "
                       "as the device has them",
                   .run = C17_EveryCommand});
    all.push_back({.name = "C17_WhatIsNotForTheSlave",
                   .asks = "The 32 commands for another group, of 1 or 3 octets, of another master, and in "
                           "Wait_Cfg: no effect",
                   .run = C17_WhatIsNotForTheSlave});
    all.push_back(
        {.name = "C17_ToOneStation",
         .asks = "Sent to its address or to all, SDN high or low: it takes effect, and is never answered",
         .run = C17_ToOneStation});
    all.push_back({.name = "C18_Sync",
                   .asks = "Outputs received in Sync wait for the next Sync or Unsync",
                   .run = C18_Sync,
                   .not_applicable = neither_sync_nor_freeze});
    all.push_back({.name = "C18_Freeze",
                   .asks = "Inputs stay as they were at the last Freeze until Unfreeze",
                   .run = C18_Freeze,
                   .not_applicable = neither_sync_nor_freeze});
    all.push_back({.name = "C18_ClearInSync",
                   .asks = "Clear_Data clears at once in Sync too, and what was received with it",
                   .run = C18_ClearInSync,
                   .not_applicable = neither_sync_nor_freeze});
    all.push_back({.name = "C18_TheEndOfSyncAndFreeze",
                   .asks = "Sync and Freeze end with the exchange",
                   .run = C18_TheEndOfSyncAndFreeze,
                   .not_applicable = neither_sync_nor_freeze});
}

} // namespace conformance
