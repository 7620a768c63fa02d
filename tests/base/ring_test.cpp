// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/ring.hpp"

#include <gtest/gtest.h>

#include <thread>

using namespace dpslave;

namespace {

TEST(Ring, IsEmptyAtFirst)
{
    Ring<int, 4> ring;

    EXPECT_EQ(ring.pop(), std::nullopt);
    EXPECT_EQ(ring.refused(), 0u);
}

TEST(Ring, CarriesEachOnceAndInOrder)
{
    Ring<int, 4> ring;
    EXPECT_TRUE(ring.push(1));
    EXPECT_TRUE(ring.push(2));

    EXPECT_EQ(ring.pop(), 1);
    EXPECT_EQ(ring.pop(), 2);
    EXPECT_EQ(ring.pop(), std::nullopt);
}

TEST(Ring, RefusesWhenFullAndCountsTheRefusals)
{
    Ring<int, 4> ring;
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.push(i));
    EXPECT_FALSE(ring.push(4));
    EXPECT_FALSE(ring.push(5));

    EXPECT_EQ(ring.refused(), 2u);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(ring.pop(), i); // what it had taken is untouched
    EXPECT_TRUE(ring.push(6));
    EXPECT_EQ(ring.pop(), 6);
}

TEST(Ring, KeepsTheOrderThroughManyRounds)
{
    Ring<int, 8> ring;
    int next = 0;
    for (int i = 0; i < 10'000; ++i) {
        ASSERT_TRUE(ring.push(i));
        if (i % 3 == 0) continue; // let it fill up a little
        while (const auto value = ring.pop()) ASSERT_EQ(*value, next++);
    }
    while (const auto value = ring.pop()) ASSERT_EQ(*value, next++);

    EXPECT_EQ(next, 10'000);
    EXPECT_EQ(ring.refused(), 0u);
}

TEST(Ring, LosesAndDoublesNothingBetweenTwoThreads)
{
    constexpr std::uint64_t kCount = 200'000;
    struct Order {
        std::uint64_t number = 0;
        std::uint64_t copy = 0;
    };
    Ring<Order, 64> ring;
    std::thread writer{[&] {
        for (std::uint64_t i = 1; i <= kCount;) {
            if (ring.push({i, i}))
                ++i;
            else
                std::this_thread::yield();
        }
    }};
    std::uint64_t wrong = 0;
    for (std::uint64_t next = 1; next <= kCount;) {
        const auto order = ring.pop();
        if (!order) {
            std::this_thread::yield();
            continue;
        }
        wrong += order->number != next || order->copy != next ? 1u : 0u;
        ++next;
    }
    writer.join();

    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(ring.pop(), std::nullopt);
}

} // namespace
