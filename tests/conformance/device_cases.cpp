// SPDX-License-Identifier: Apache-2.0
// The GSD against the device: C-29. DP-V1: C-30.
#include "case.hpp"
#include "made_gsd.hpp"
#include "simulated_slave.hpp"

#include <array>

namespace conformance {
namespace {

using dpslave::Baud;

struct Rate {
    Baud baud;
    const char* name; ///< in the keywords of the GSD
};
constexpr std::array kRatesOfGsd{Rate{Baud::k9_6, "9.6"},     Rate{Baud::k19_2, "19.2"},
                                 Rate{Baud::k93_75, "93.75"}, Rate{Baud::k187_5, "187.5"},
                                 Rate{Baud::k500, "500"},     Rate{Baud::k1500, "1.5M"}};

/// A reply begins at MaxTsdr at the latest, however late the machine wakes up; else there is none.
void C29_MaxTsdr(Bench& b, SimulatedSlave& slave)
{
    const auto gsd = gsd_of(b.family);
    for (const auto& [rate, name] : kRatesOfGsd) {
        EXPECT_EQ(gsd.number(std::string{name} + "_supp"), 1) << name;
        const int promised = gsd.number(std::string{"MaxTsdr_"} + name);
        slave.restart_at(rate, false);
        ASSERT_TRUE(b.exchange(words({1, 2, 3, 4}))) << name;
        int answered = 0;
        auto longest = slave.bus().bits(0);
        for (std::uint32_t late = 0; late < 400; late += 7) {
            slave.bus().edge_is_late_by(slave.bus().bits(late));
            const std::string reply = b.owner.data_exchange(words({1, 2, 3, 4}));
            if (reply == "-") continue;
            EXPECT_EQ(reply, inputs_at_start()) << name;
            ++answered;
            longest = std::max(longest, slave.bus().turnaround());
        }
        EXPECT_GT(answered, 5) << name;
        EXPECT_LE(longest, slave.bus().bits(static_cast<std::uint32_t>(promised))) << name;
        slave.bus().edge_is_late_by({});
    }
}

void C29_IdentAndLengths(Bench& b, SimulatedSlave& /*clock*/)
{
    const auto gsd = gsd_of(b.family);
    EXPECT_EQ(gsd.number("Ident_Number"), b.family.ident);
    EXPECT_EQ(gsd.number("Max_Diag_Data_Len"), static_cast<int>(b.family.most_diag));
    const Octets user = gsd.octets("User_Prm_Data");
    EXPECT_EQ(gsd.number("User_Prm_Data_Len"), static_cast<int>(user.size()));
    // As a master's tool sends it: User_Prm_Data of the file, and its modules, or Demand Data alone.
    Octets modules = gsd.cfg();
    const bool modular = gsd.number("Modular_Station") == 1;
    if (modular) modules = {0x73};
    ASSERT_TRUE(b.start_up({}, user, modules));
    EXPECT_EQ(b.owner.get_cfg(), "DL " + test::show(modules));
    const Lengths lengths = lengths_of(modules);
    const std::string inputs = b.owner.data_exchange(Octets(lengths.outputs, 0));
    EXPECT_EQ(test::octets(inputs.substr(3)).size(), lengths.inputs) << inputs;
    if (modular) {
        const Lengths most = lengths_of(b.family.all_cfg);
        EXPECT_LE(most.inputs, static_cast<std::size_t>(gsd.number("Max_Input_Len")));
        EXPECT_LE(most.outputs, static_cast<std::size_t>(gsd.number("Max_Output_Len")));
        EXPECT_LE(most.inputs + most.outputs, static_cast<std::size_t>(gsd.number("Max_Data_Len")));
    }
}

/// The longest Data_Exchange that the device can have.
void C29_LongestTelegrams(Bench& b)
{
    ASSERT_TRUE(b.start_up({}, b.family.all_user_prm, b.family.all_cfg));
    const Lengths lengths = lengths_of(b.family.all_cfg);
    for (int cycles = 0; cycles < 5; ++cycles) {
        const std::string inputs = b.owner.data_exchange(Octets(lengths.outputs, 0));
        EXPECT_EQ(inputs.substr(0, 2), "DL");
        EXPECT_EQ(test::octets(inputs.substr(3)).size(), lengths.inputs);
    }
    EXPECT_EQ(b.owner.get_cfg(), "DL " + test::show(b.family.all_cfg));
}

void C29_Functions(Bench& b, SimulatedSlave& /*clock*/)
{
    const auto gsd = gsd_of(b.family);
    EXPECT_EQ(gsd.number("Sync_Mode_supp"), b.family.sync_and_freeze ? 1 : 0);
    EXPECT_EQ(gsd.number("Freeze_Mode_supp"), b.family.sync_and_freeze ? 1 : 0);
    EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0xB8})), "SC");
    EXPECT_EQ(b.diag(), b.family.sync_and_freeze ? kWaitCfg : "12 05 00 FF");
    EXPECT_EQ(b.owner.set_prm(b.prm({.status = 0x40})), "SC");
    EXPECT_EQ(gsd.number("Set_Slave_Add_supp"), 0);
    EXPECT_EQ(b.owner.asks(55, {7, 0, 0, 0}), "RS");
    EXPECT_EQ(gsd.number("Auto_Baud_supp"), 1) << "C24_EveryRate proves it";
    EXPECT_EQ(gsd.number("FMS_supp"), 0);
    EXPECT_EQ(gsd.number("Fail_Safe"), 0);
    ASSERT_TRUE(b.exchange(words({1, 2, 3, 4})));
    EXPECT_EQ(b.owner.data_exchange(Octets{}), "RS") << "so a Data_Exchange without data is a wrong length";
    EXPECT_EQ(gsd.keys.count("DPV1_Slave"), 0u);
    EXPECT_EQ(b.owner.asks(51, {0x5E, 1, 2, 10}, 51), "RS");
}

const char* no_dpv1(const Family& /*all*/)
{
    return "The devices are DP-V0. C06_UnknownSaps proves that SAPs 48 to 53 are answered with RS";
}

} // namespace

void add_device_cases(std::vector<Case>& all)
{
    constexpr const char* kOfTheGsd = "It compares the GSD with the device, and not with a port";
    all.push_back(
        {.name = "C29_IdentAndLengths",
         .asks = "Ident_Number, lengths of User_Prm_Data, configuration, data and diagnosis as in the GSD",
         .run_simulated = C29_IdentAndLengths,
         .why_simulated = kOfTheGsd});
    all.push_back({.name = "C29_Functions",
                   .asks = "Sync, Freeze, Set_Slave_Add, Fail_Safe, FMS and DP-V1 as in the GSD",
                   .run_simulated = C29_Functions,
                   .why_simulated = kOfTheGsd});
    all.push_back(
        {.name = "C29_MaxTsdr",
         .asks = "At each rate of the GSD no reply begins later than MaxTsdr, however late the machine is",
         .run_simulated = C29_MaxTsdr,
         .why_simulated = "A pty has no bit times"});
    all.push_back(
        {.name = "C29_LongestTelegrams",
         .asks = "The longest Data_Exchange that the device can have is answered with all its inputs",
         .run = C29_LongestTelegrams});
    all.push_back({.name = "C30_DpV1",
                   .asks = "MS1 and MS2: errors, alarms, Initiate, timeouts, abort",
                   .not_applicable = no_dpv1});
}

} // namespace conformance
