// SPDX-License-Identifier: Apache-2.0
/// The names and numbers of HA463561U002, "MMI Parameter Descriptions" (B-048, B-051).
#include "dpslave/base/option_state.hpp"

#include <gtest/gtest.h>

using namespace dpslave;

namespace {

TEST(OptionState, FaultsHaveTheNumbersAndNamesOfTheManual)
{
    const char* const printed[] = {"NONE", "PARAMETER", "TYPE MISMATCH", "SELF TEST", "HARDWARE", "MISSING"};

    for (std::uint8_t number = 0; number < 6; ++number)
        EXPECT_EQ(text(static_cast<OptionFault>(number)), printed[number]);
}

TEST(OptionState, NetworkStatesHaveTheNumbersAndNamesOfTheManual)
{
    const char* const printed[] = {"DATA EXCHANGE", "DATA EX ERROR", "WAIT CONFIG",
                                   "WAIT PARAM",    "BAUD SEARCH",   "DISABLED"};

    for (std::uint8_t number = 0; number < 6; ++number)
        EXPECT_EQ(text(static_cast<NetworkState>(number)), printed[number]);
}

} // namespace
