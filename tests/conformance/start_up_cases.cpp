// SPDX-License-Identifier: Apache-2.0
// From power-on to Data_Exch: C-08 to C-10.
#include "case.hpp"

#include <random>

namespace conformance {
namespace {

using test::kUs;
using test::sd2;
using test::show;

/// Slave_Diag as the master at 2 gets it: octets 1 to 4, ident and the extended diagnosis.
std::string diag_reply(const Bench& b, const char* standard)
{
    Octets data = test::octets(standard);
    data.push_back(static_cast<std::uint8_t>(b.family.ident / 256));
    data.push_back(static_cast<std::uint8_t>(b.family.ident % 256));
    data.insert(data.end(), b.family.healthy.begin(), b.family.healthy.end());
    return show(sd2(2, kUs, 0x08, Saps{62, 60}, data));
}

/// Section 4.2, telegram by telegram, with pauses as a slow or a hasty master makes them.
void starts_up(Bench& b, std::minstd_rand& chance)
{
    const auto pause = [&] { b.slave.pass(std::chrono::milliseconds{chance() % 40}); };
    const auto says = [&](const Octets& request) {
        pause();
        return b.owner.says(show(request));
    };
    const auto diag = [&](std::uint8_t fc) { return says(sd2(kUs, 2, fc, Saps{60, 62})); };

    EXPECT_EQ(says(test::sd1(kUs, 2, 0x49)), "10 02 05 00 07 16");
    EXPECT_EQ(diag(0x6D), diag_reply(b, kWaitPrm));
    EXPECT_EQ(says(sd2(kUs, 2, 0x5D, Saps{61, 62}, b.prm({.group = 1}))), "E5");
    EXPECT_EQ(says(sd2(kUs, 2, 0x7D, Saps{62, 62}, cfg())), "E5");
    std::uint8_t fc = 0x5D;
    const auto toggle = [&] { return std::exchange(fc, fc == 0x5D ? 0x7D : 0x5D); };
    const std::string starting = diag_reply(b, "00 0E 00 02"), ready = diag_reply(b, kExchanging);
    std::string seen = diag(toggle());
    for (int polls = 0; seen == starting && polls < 300; ++polls) seen = diag(toggle());
    EXPECT_EQ(seen, ready);
    EXPECT_EQ(diag(toggle()), ready);

    const auto exchange = [&](const Octets& outputs) { return says(sd2(kUs, 2, toggle(), outputs)); };
    const std::string inputs = show(sd2(2, kUs, 0x08, words({kInputsAtStart.begin(), kInputsAtStart.end()})));
    EXPECT_EQ(exchange(words({0, 0, 0, 0})), inputs);
    b.slave.send(sd2(127, 2, 0x46, Saps{58, 62}, {0x00, 0x00})); // Operate
    EXPECT_EQ(exchange(words({0xA501, 2, 3, 4})), inputs);
    EXPECT_TRUE(b.slave.drive_gets(0xA501));
    EXPECT_EQ(says(sd2(kUs, 2, toggle(), Saps{57, 62})),
              show(sd2(2, kUs, 0x08, Saps{62, 57}, words({0xA501, 2, 3, 4}))));
    EXPECT_EQ(says(sd2(kUs, 2, toggle(), Saps{56, 62})),
              show(sd2(2, kUs, 0x08, Saps{62, 56}, words({kInputsAtStart.begin(), kInputsAtStart.end()}))));
    EXPECT_EQ(says(sd2(kUs, 2, toggle(), Saps{59, 62})), show(sd2(2, kUs, 0x08, Saps{62, 59}, cfg())));
}

void C08_StartUpWithRandomPauses(Bench& b)
{
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        std::minstd_rand chance{seed};
        starts_up(b, chance);
        const Octets unlock = sd2(kUs, 2, 0x6D, Saps{61, 62}, b.prm({.status = 0x40}));
        EXPECT_EQ(b.owner.sends(unlock), "SC"); // from the beginning
        ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
    }
}

void C09_WrongIdent(Bench& b)
{
    for (const std::size_t octet : {std::size_t{4}, std::size_t{5}})
        for (unsigned bit = 0; bit < 8; ++bit) {
            Octets prm = b.prm();
            prm[octet] = static_cast<std::uint8_t>(prm[octet] ^ (1u << bit));
            EXPECT_EQ(b.owner.set_prm(prm), "SC");
            EXPECT_EQ(b.diag(), "42 05 00 FF");
            EXPECT_EQ(b.diag(), "42 05 00 FF") << "reading does not clear it";
        }
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "RS");
    ASSERT_TRUE(b.parameterise()) << "an accepted one does";
}

void C09_TooShort(Bench& b)
{
    const auto are_discarded = [&](const std::string& state) {
        for (std::size_t length = 0; length < 7; ++length) {
            Octets prm = b.prm();
            prm.resize(length);
            EXPECT_EQ(b.owner.set_prm(prm), "SC") << length;
            EXPECT_EQ(b.diag(), state) << length;
        }
    };
    are_discarded(kWaitPrm);
    ASSERT_TRUE(b.parameterise());
    are_discarded(kWaitCfg);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    are_discarded(kExchanging);
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4}));
}

/// As long as a telegram can be: none of the devices has so much User_Prm_Data.
void C09_With244Octets(Bench& b)
{
    Octets prm = b.prm();
    prm.resize(244, 1);
    EXPECT_EQ(b.owner.set_prm(prm), "SC");
    EXPECT_EQ(b.diag(), "42 05 00 FF");
    ASSERT_TRUE(b.parameterise());
}

void C09_LockBits(Bench& b)
{
    const auto set_prm = [&](std::uint8_t status) { return b.owner.set_prm(b.prm({.status = status})); };
    EXPECT_EQ(set_prm(0x00), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm) << "neither: min T_SDR alone";
    EXPECT_EQ(set_prm(0x40), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm) << "unlock";
    EXPECT_EQ(set_prm(0xC0), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm) << "both: unlock has priority";
    EXPECT_EQ(set_prm(0x88), "SC");
    EXPECT_EQ(b.diag(), kWaitCfg) << "lock";
    EXPECT_EQ(set_prm(0x00), "SC");
    EXPECT_EQ(b.diag(), kWaitCfg) << "neither: the owner stays";
    EXPECT_EQ(set_prm(0x40), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm) << "unlock by the owner";
    EXPECT_EQ(set_prm(0x88), "SC");
    EXPECT_EQ(set_prm(0xC0), "SC");
    EXPECT_EQ(b.diag(), kWaitPrm) << "both";
}

void C09_UnsupportedSyncAndFreeze(Bench& b)
{
    for (const std::uint8_t request : Octets{0x20, 0x10, 0x30}) {
        const auto status = static_cast<std::uint8_t>(0x88 | request);
        EXPECT_EQ(b.owner.set_prm(b.prm({.status = status})), "SC");
        EXPECT_EQ(b.diag(), "12 05 00 FF") << "Not_Supported, without Prm_Fault";
    }
    ASSERT_TRUE(b.parameterise());
}

void C09_SyncAndFreeze(Bench& b)
{
    for (const std::uint8_t request : Octets{0x20, 0x10, 0x30}) {
        const auto status = static_cast<std::uint8_t>(0x88 | request);
        ASSERT_TRUE(b.parameterise({.status = status}));
    }
}

void C09_BadUserPrmData(Bench& b)
{
    EXPECT_EQ(b.owner.set_prm(b.prm({}, b.family.bad_user_prm)), "SC");
    EXPECT_EQ(b.diag(), "42 05 00 FF");
    Octets longer = b.family.user_prm;
    longer.push_back(0x01);
    EXPECT_EQ(b.owner.set_prm(b.prm({}, longer)), "SC");
    EXPECT_EQ(b.diag(), "42 05 00 FF") << "an octet more";
    longer.resize(b.family.user_prm.size() - 1);
    EXPECT_EQ(b.owner.set_prm(b.prm({}, longer)), "SC");
    EXPECT_EQ(b.diag(), "42 05 00 FF") << "an octet less";
    ASSERT_TRUE(b.parameterise());
}

void C09_WatchdogFactors(Bench& b)
{
    for (const auto& [one, other] : {std::pair{0, 1}, std::pair{1, 0}, std::pair{0, 0}}) {
        const auto factor = [](int number) { return static_cast<std::uint8_t>(number); };
        EXPECT_EQ(b.owner.set_prm(b.prm({.factor_1 = factor(one), .factor_2 = factor(other)})), "SC");
        EXPECT_EQ(b.diag(), "42 05 00 FF") << one << " and " << other;
    }
    ASSERT_TRUE(b.parameterise({.status = 0x80, .factor_1 = 0, .factor_2 = 0})) << "without watchdog";
}

void C10_ConfigurationsThatAreRefused(Bench& b)
{
    std::vector<Octets> wrong{Octets{}, Octets{0x50}, Octets(244, 0x50), Octets(244, 0x00)};
    wrong.push_back(cfg());
    wrong.back().pop_back();
    wrong.push_back(cfg());
    wrong.back().push_back(0x60);
    for (std::size_t i = 0; i < cfg().size(); ++i)
        for (unsigned bit = 0; bit < 8; ++bit) {
            Octets one = cfg();
            one[i] = static_cast<std::uint8_t>(one[i] ^ (1u << bit));
            if (one[i] != 0x70 || !b.family.both_ways) wrong.push_back(one); // else it is another right one
        }
    for (const Octets& one : wrong) {
        EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
        EXPECT_EQ(b.owner.chk_cfg(one), "SC") << show(one);
        EXPECT_EQ(b.diag(), "06 05 00 FF") << "Cfg_Fault, and no owner: " << show(one);
        EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), "RS") << show(one);
    }
    EXPECT_EQ(b.owner.set_prm(b.prm()), "SC");
    EXPECT_EQ(b.diag(), "06 0C 00 02") << "Set_Prm does not clear it";
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}))) << "the right one does";
}

void C10_InEachState(Bench& b)
{
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "RS") << "Wait_Prm";
    EXPECT_EQ(b.diag(), kWaitPrm);
    ASSERT_TRUE(b.parameterise());
    EXPECT_EQ(b.foreign.chk_cfg(cfg()), "RS") << "Wait_Cfg, not the owner";
    EXPECT_EQ(b.diag(), kWaitCfg);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.owner.chk_cfg(cfg()), "SC") << "Data_Exch, the same octets";
    EXPECT_EQ(b.foreign.rd_outp(), dl({1, 2, 3, 4})) << "the exchange goes on";
    EXPECT_EQ(b.owner.data_exchange(words({1, 2, 3, 4})), inputs_at_start());
    EXPECT_EQ(b.owner.chk_cfg({0x50}), "SC") << "Data_Exch, others";
    EXPECT_EQ(b.diag(), "06 05 00 FF");
}

const char* no_sync_and_freeze(const Family& family)
{
    return family.sync_and_freeze ? nullptr : "The device has neither Sync nor Freeze";
}

const char* has_sync_and_freeze(const Family& family)
{
    return family.sync_and_freeze ? "The device has Sync and Freeze" : nullptr;
}

} // namespace

void add_start_up_cases(std::vector<Case>& all)
{
    all.push_back({.name = "C08_StartUpWithRandomPauses",
                   .asks = "The start-up of section 4.2, octet for octet, with pauses of any length",
                   .run = C08_StartUpWithRandomPauses});
    all.push_back({.name = "C09_WrongIdent",
                   .asks = "Set_Prm with another ident: SC, Prm_Fault, no owner; reading does not clear it",
                   .run = C09_WrongIdent});
    all.push_back({.name = "C09_TooShort",
                   .asks = "Set_Prm of fewer than seven octets: SC, discarded in every state",
                   .run = C09_TooShort});
    all.push_back({.name = "C09_With244Octets",
                   .asks = "Set_Prm of 244 octets: SC, judged as a whole",
                   .run = C09_With244Octets});
    all.push_back({.name = "C09_LockBits",
                   .asks = "Lock and unlock, all four, with and without an owner",
                   .run = C09_LockBits});
    all.push_back({.name = "C09_SyncAndFreeze",
                   .asks = "Sync and Freeze are taken by a slave that has them",
                   .run = C09_SyncAndFreeze,
                   .not_applicable = no_sync_and_freeze});
    all.push_back({.name = "C09_UnsupportedSyncAndFreeze",
                   .asks = "Sync and Freeze are refused with Not_Supported by a slave that has neither",
                   .run = C09_UnsupportedSyncAndFreeze,
                   .not_applicable = has_sync_and_freeze});
    all.push_back({.name = "C09_BadUserPrmData",
                   .asks = "User_Prm_Data that the device cannot have: SC, Prm_Fault",
                   .run = C09_BadUserPrmData});
    all.push_back({.name = "C09_WatchdogFactors",
                   .asks = "A watchdog factor of 0 is a Prm_Fault, but not with the watchdog off",
                   .run = C09_WatchdogFactors});
    all.push_back({.name = "C10_ConfigurationsThatAreRefused",
                   .asks =
                       "Chk_Cfg empty, shorter, longer, with one wrong bit, of 244 octets: SC, Cfg_Fault, "
                       "no owner",
                   .run = C10_ConfigurationsThatAreRefused});
    all.push_back(
        {.name = "C10_InEachState",
         .asks = "Chk_Cfg in Wait_Prm or from another master: RS; in Data_Exch the same octets go on",
         .run = C10_InEachState});
}

} // namespace conformance
