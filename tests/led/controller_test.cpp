// SPDX-License-Identifier: Apache-2.0
/// The REM beacon of a 2408f/2404f (C-009).
#include "watch.hpp"

#include <gtest/gtest.h>

namespace dpslave::led {
namespace {

using namespace std::chrono_literals;

Seen rem(const Condition& condition)
{
    const std::vector<Lamp> shown = lamps(Language::controller, condition);
    EXPECT_EQ(shown.size(), 1u);
    EXPECT_EQ(shown.at(0).name, "rem");
    return watch(shown.at(0).pattern, 12'345ms);
}

TEST(RemBeacon, FlashesWhileDataExchangeRuns)
{
    const Condition condition{.running = true, .data_exchange = true};

    EXPECT_EQ(rem(condition), k1Hz);
    EXPECT_TRUE(says(Language::controller, condition, "run"));
    EXPECT_TRUE(says(Language::controller, condition, "data exchange with the master"));
}

TEST(RemBeacon, IsDarkWhileTheMasterDoesNotExchange)
{
    const Condition condition{.running = true, .data_exchange = false};

    EXPECT_EQ(rem(condition), kDark);
    EXPECT_TRUE(says(Language::controller, condition, "rdY"));
}

TEST(RemBeacon, FlashesOnWhenTheControllerIsSilentAndTheWordsSaySo)
{
    const Condition condition{.running = true, .data_exchange = true, .drive_answers = false};

    EXPECT_EQ(rem(condition), k1Hz);
    EXPECT_TRUE(says(Language::controller, condition, "does not answer"));
}

TEST(RemBeacon, IsDarkWhenNotServedWhateverElse)
{
    const Condition condition{.running = false, .data_exchange = true};

    EXPECT_EQ(rem(condition), kDark);
    EXPECT_TRUE(says(Language::controller, condition, "not served"));
}

} // namespace
} // namespace dpslave::led
