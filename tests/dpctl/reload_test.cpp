// SPDX-License-Identifier: Apache-2.0
// Tests what dpctl reload prints.
#include "control/fixtures.hpp"
#include "dpctl/cli/render.hpp"

#include <gtest/gtest.h>

namespace dpslave::dpctl {
namespace {

using test::fixture;

TEST(DpctlReload, SaysWhatIsDifferentAndWhatWaits)
{
    EXPECT_EQ(render_reload(report::read<report::ReloadReply>(fixture("Reload")), false),
              "station rewinder removed\n"
              "pending: station unwinder: address 7 takes effect at the next start\n");
}

TEST(DpctlReload, SaysThatNothingHasChanged)
{
    const Json nothing = Json::parse(
        R"({"applied":true,"changes":[],"pending":[],"leaving":[],"warnings":["w"],"faults":[]})");
    EXPECT_EQ(render_reload(report::read<report::ReloadReply>(nothing), false),
              "warning: w\nNothing has changed.\n");
}

TEST(DpctlReload, OfADryRunNamesTheStationsThatWouldLeaveTheBusAndWhy)
{
    EXPECT_EQ(render_reload(report::read<report::ReloadReply>(fixture("Reload")), true),
              "station rewinder removed\n"
              "pending: station unwinder: address 7 takes effect at the next start\n"
              "leaves the bus: rewinder (removed)\n"
              "Nothing was changed: this is what a reload would do.\n");
}

TEST(DpctlReload, OfADryRunSaysThatNoStationWouldLeaveTheBus)
{
    const Json live = Json::parse(R"({"applied":false,"changes":["station unwinder: other lamps"],
        "leaving":[],"pending":[],"warnings":[],"faults":[]})");
    EXPECT_EQ(render_reload(report::read<report::ReloadReply>(live), true),
              "station unwinder: other lamps\n"
              "no station leaves the bus\n"
              "Nothing was changed: this is what a reload would do.\n");
}

TEST(DpctlReload, SaysAllFaultsAndThatTheOldConfigurationRunsOn)
{
    const Json refused = Json::parse(
        R"({"applied":false,"changes":[],"leaving":[],"pending":[],"warnings":[],"faults":["a: b","c: d"]})");
    EXPECT_EQ(render_reload(report::read<report::ReloadReply>(refused), false),
              "a: b\nc: d\nThe new configuration is refused; the old one stays in use.\n");
}

} // namespace
} // namespace dpslave::dpctl
