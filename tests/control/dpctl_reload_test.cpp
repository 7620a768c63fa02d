// SPDX-License-Identifier: Apache-2.0
// What dpctl reload prints.
#include "fixtures.hpp"
#include "render.hpp"

#include <gtest/gtest.h>

namespace dpslave::dpctl {
namespace {

using test::fixture;

TEST(DpctlReload, SaysWhatIsDifferentAndWhatWaits)
{
    EXPECT_EQ(render_reload(fixture("Reload")),
              "station rewinder removed\n"
              "pending: station unwinder: address 7 counts from the next start on\n");
}

TEST(DpctlReload, SaysThatNothingHasChanged)
{
    const Json nothing =
        Json::parse(R"({"applied":true,"changes":[],"pending":[],"warnings":["w"],"faults":[]})");
    EXPECT_EQ(render_reload(nothing), "warning: w\nNothing has changed.\n");
}

TEST(DpctlReload, SaysAllFaultsAndThatTheOldConfigurationRunsOn)
{
    const Json refused =
        Json::parse(R"({"applied":false,"changes":[],"pending":[],"warnings":[],"faults":["a: b","c: d"]})");
    EXPECT_EQ(render_reload(refused),
              "a: b\nc: d\nThe new configuration is refused; the one until now runs on.\n");
}

} // namespace
} // namespace dpslave::dpctl
