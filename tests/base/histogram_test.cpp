// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/histogram.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace dpslave;

namespace {

/// The class that one value falls into; more than one, or none, is a failure.
std::size_t class_of(std::uint32_t value)
{
    Histogram one;
    one.add(value);
    std::size_t found = Histogram::kClasses;
    std::uint64_t sum = 0;
    for (std::size_t n = 0; n < Histogram::kClasses; ++n) {
        sum += one.in_class(n);
        if (one.in_class(n) != 0) found = n;
    }
    EXPECT_EQ(sum, 1u);
    return found;
}

TEST(Histogram, HasNoFigureBeforeTheFirstValue)
{
    const Histogram none;

    EXPECT_EQ(none.count(), 0u);
    EXPECT_EQ(none.highest(), 0u);
    EXPECT_EQ(none.quantile(0.5), 0u);
}

TEST(Histogram, HasTheSumOfAllValuesAlsoOfThoseBeyondTheLastClass)
{
    Histogram counted;
    for (const std::uint32_t value : {3u, 66u, 4'000'000'000u, 4'000'000'000u}) counted.add(value);

    EXPECT_EQ(counted.sum(), 8'000'000'069u);
}

TEST(Histogram, HasLowerEndsThatGrowByAQuarterAtMost)
{
    EXPECT_EQ(Histogram::lower_end(0), 0u);
    for (std::size_t n = 1; n < Histogram::kClasses; ++n) {
        const std::uint32_t lower = Histogram::lower_end(n - 1), upper = Histogram::lower_end(n);
        ASSERT_GT(upper, lower) << n;
        EXPECT_LE(upper - lower, lower < 16 ? 1u : lower / (lower < 64 ? 8 : 4)) << n;
    }
    EXPECT_EQ(Histogram::lower_end(Histogram::kClasses - 1), 14'336u);
}

TEST(Histogram, PutsEveryValueBetweenTheEndsOfItsClass)
{
    for (std::uint32_t value = 0; value < 20'000; ++value) {
        const std::size_t n = class_of(value);
        ASSERT_LT(n, Histogram::kClasses) << value;
        ASSERT_GE(value, Histogram::lower_end(n)) << value;
        ASSERT_TRUE(n + 1 == Histogram::kClasses || value < Histogram::lower_end(n + 1)) << value;
    }
}

TEST(Histogram, CountsWhatIsBeyondTheLastClassAsTheLastClass)
{
    constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();

    EXPECT_EQ(class_of(kMost), Histogram::kClasses - 1);
    Histogram one;
    one.add(kMost);
    EXPECT_EQ(one.highest(), kMost);
    EXPECT_EQ(one.quantile(1.0), kMost);
}

TEST(Histogram, GivesSmallValuesExactly)
{
    Histogram many; // 0, 0, 1, 1 ... 9, 9
    for (std::uint32_t value = 0; value < 10; ++value) {
        many.add(value);
        many.add(value);
    }

    EXPECT_EQ(many.count(), 20u);
    EXPECT_EQ(many.quantile(0.0), 0u);  // the first value
    EXPECT_EQ(many.quantile(0.1), 0u);  // the second
    EXPECT_EQ(many.quantile(0.11), 1u); // the third
    EXPECT_EQ(many.quantile(0.5), 4u);
    EXPECT_EQ(many.quantile(0.95), 9u);
    EXPECT_EQ(many.quantile(1.0), 9u);
}

TEST(Histogram, FindsTheOneInAThousand)
{
    Histogram many;
    for (int i = 0; i < 999; ++i) many.add(10);
    many.add(5000);

    EXPECT_EQ(many.quantile(0.99), 10u);
    EXPECT_EQ(many.quantile(0.999), 10u);
    EXPECT_EQ(many.quantile(0.9995), 5000u);
}

TEST(Histogram, IsNeverMoreThanAQuarterTooHighAndNeverTooLow)
{
    for (std::uint32_t value = 1; value < Histogram::kLastLowerEnd; value = value * 17 / 16 + 1) {
        Histogram many;
        many.add(value);
        many.add(20'000); // so that the highest does not cap the figure
        const std::uint32_t figure = many.quantile(0.5);
        EXPECT_GE(figure, value);
        EXPECT_LE(figure, value + value / 4) << value;
    }
}

TEST(Histogram, TakesAShareOutsideOneForTheNearestEnd)
{
    Histogram many;
    many.add(3);
    many.add(7);

    EXPECT_EQ(many.quantile(-1.0), 3u);
    EXPECT_EQ(many.quantile(2.0), 7u);
}

} // namespace
