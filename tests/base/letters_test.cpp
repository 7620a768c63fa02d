// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/letters.hpp"

#include <gtest/gtest.h>

using namespace dpslave;

namespace {

TEST(Letters, AreThoseOfAsciiOnly)
{
    EXPECT_EQ(to_lower("Set_Prm AZaz09@[`{"), "set_prm azaz09@[`{");
    EXPECT_EQ(to_lower("\u00C4"), "\u00C4") << "other characters stay as they are";
}

TEST(Letters, AreComparedInAnyCaseAndInTheirWholeLength)
{
    EXPECT_TRUE(same_any_case("Slave_Diag", "sLAVE_dIAG"));
    EXPECT_FALSE(same_any_case("Slave_Diag", "Slave_Dia"));
    EXPECT_FALSE(same_any_case("", "a"));
    EXPECT_TRUE(same_any_case("", ""));
}

TEST(Letters, AreFoundAnywhereInAnyCase)
{
    EXPECT_TRUE(contains_any_case("Slave_Diag, reply", "DIAG"));
    EXPECT_TRUE(contains_any_case("Slave_Diag", ""));
    EXPECT_FALSE(contains_any_case("Slave_Diag", "Diag "));
}

} // namespace
