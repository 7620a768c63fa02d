// SPDX-License-Identifier: Apache-2.0
/// Tests what an operator reads of states, refusals and reasons.
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/state.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace {

using namespace dpslave;

constexpr std::array kRefusedPrm{dp::Refusal::prm_ident,         dp::Refusal::prm_watchdog,
                                 dp::Refusal::prm_not_supported, dp::Refusal::prm_length,
                                 dp::Refusal::prm_dpv1,          dp::Refusal::prm_tag_too_large,
                                 dp::Refusal::prm_zero_tag};
constexpr std::array kRefusedCfg{dp::Refusal::cfg_empty,      dp::Refusal::cfg_too_long,
                                 dp::Refusal::cfg_identifier, dp::Refusal::cfg_too_few,
                                 dp::Refusal::cfg_too_many,   dp::Refusal::cfg_changed};
constexpr std::array kLeaveReasons{dp::LeaveReason::prm_fault,      dp::LeaveReason::not_supported,
                                   dp::LeaveReason::cfg_fault,      dp::LeaveReason::watchdog,
                                   dp::LeaveReason::unlock,         dp::LeaveReason::output_length,
                                   dp::LeaveReason::new_parameters, dp::LeaveReason::stop};

TEST(Text, NamesTheStatesAsTheStandardDoes)
{
    EXPECT_EQ(dp::text(dp::State::power_on), "Power_On");
    EXPECT_EQ(dp::text(dp::State::wait_prm), "Wait_Prm");
    EXPECT_EQ(dp::text(dp::State::wait_cfg), "Wait_Cfg");
    EXPECT_EQ(dp::text(dp::State::data_exch), "Data_Exch");
}

TEST(Text, SaysOfEachRefusalWhatNoOtherSays)
{
    std::set<std::string_view> said{"", "?"};
    for (const dp::Refusal why : kRefusedPrm) EXPECT_TRUE(said.insert(dp::text(why)).second) << dp::text(why);
    for (const dp::Refusal why : kRefusedCfg) EXPECT_TRUE(said.insert(dp::text(why)).second) << dp::text(why);
    EXPECT_EQ(dp::text(dp::Refusal::none), "");
}

TEST(Text, SaysOfEachEndOfDataExchangeWhatNoOtherSays)
{
    std::set<std::string_view> said{"", "?"};
    for (const dp::LeaveReason why : kLeaveReasons)
        EXPECT_TRUE(said.insert(dp::text(why)).second) << dp::text(why);
    EXPECT_EQ(dp::text(dp::LeaveReason::none), "");
}

TEST(Text, PutsEachRefusalToTheTelegramThatWasRefused)
{
    for (const dp::Refusal why : kRefusedPrm)
        EXPECT_EQ(dp::service_of(why), dp::Service::set_prm) << dp::text(why);
    for (const dp::Refusal why : kRefusedCfg)
        EXPECT_EQ(dp::service_of(why), dp::Service::chk_cfg) << dp::text(why);
    EXPECT_EQ(dp::service_of(dp::Refusal::none), dp::Service::none);
}

} // namespace
