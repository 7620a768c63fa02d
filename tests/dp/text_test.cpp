// SPDX-License-Identifier: Apache-2.0
/// What an operator reads of states, refusals and reasons.
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/state.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace {

using namespace dpslave::dp;

constexpr std::array kRefusedPrm{Refusal::prm_ident,   Refusal::prm_watchdog, Refusal::prm_not_supported,
                                 Refusal::prm_length,  Refusal::prm_dpv1,     Refusal::prm_tag_too_large,
                                 Refusal::prm_zero_tag};
constexpr std::array kRefusedCfg{Refusal::cfg_empty,   Refusal::cfg_too_long, Refusal::cfg_identifier,
                                 Refusal::cfg_too_few, Refusal::cfg_too_many, Refusal::cfg_changed};
constexpr std::array kLeft{
    LeaveReason::prm_fault, LeaveReason::not_supported, LeaveReason::cfg_fault,      LeaveReason::watchdog,
    LeaveReason::unlock,    LeaveReason::output_length, LeaveReason::new_parameters, LeaveReason::stop};

TEST(Text, NamesTheStatesAsTheStandardDoes)
{
    EXPECT_EQ(text(State::power_on), "Power_On");
    EXPECT_EQ(text(State::wait_prm), "Wait_Prm");
    EXPECT_EQ(text(State::wait_cfg), "Wait_Cfg");
    EXPECT_EQ(text(State::data_exch), "Data_Exch");
}

TEST(Text, SaysOfEachRefusalWhatNoOtherSays)
{
    std::set<std::string_view> said{"", "?"};
    for (const Refusal why : kRefusedPrm) EXPECT_TRUE(said.insert(text(why)).second) << text(why);
    for (const Refusal why : kRefusedCfg) EXPECT_TRUE(said.insert(text(why)).second) << text(why);
    EXPECT_EQ(text(Refusal::none), "");
}

TEST(Text, SaysOfEachEndOfDataExchangeWhatNoOtherSays)
{
    std::set<std::string_view> said{"", "?"};
    for (const LeaveReason why : kLeft) EXPECT_TRUE(said.insert(text(why)).second) << text(why);
    EXPECT_EQ(text(LeaveReason::none), "");
}

TEST(Text, PutsEachRefusalToTheTelegramThatWasRefused)
{
    for (const Refusal why : kRefusedPrm) EXPECT_EQ(service_of(why), Service::set_prm) << text(why);
    for (const Refusal why : kRefusedCfg) EXPECT_EQ(service_of(why), Service::chk_cfg) << text(why);
    EXPECT_EQ(service_of(Refusal::none), Service::none);
}

} // namespace
