// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

using namespace dpslave;

namespace {

enum class Why { too_short, too_long };

Result<std::string, Why> named(std::size_t length)
{
    if (length < 2) return Failure{Why::too_short};
    if (length > 4) return Failure{Why::too_long};
    return std::string(length, 'x');
}

TEST(Result, HoldsAValue)
{
    const auto result = named(3);

    ASSERT_TRUE(result);
    EXPECT_EQ(*result, "xxx");
    EXPECT_EQ(result->size(), 3u);
}

TEST(Result, OrTheNamedReasonWhyThereIsNone)
{
    EXPECT_FALSE(named(1));
    EXPECT_EQ(named(1).error(), Why::too_short);
    EXPECT_EQ(named(5).error(), Why::too_long);
}

TEST(Result, GivesItsValueAway)
{
    Result<std::unique_ptr<int>, Why> result{std::make_unique<int>(7)};

    const std::unique_ptr<int> taken = *std::move(result);

    EXPECT_EQ(*taken, 7);
}

TEST(Result, MayBeChangedInPlace)
{
    auto result = named(2);
    *result += "y";
    result->push_back('z');

    EXPECT_EQ(*result, "xxyz");
}

} // namespace
