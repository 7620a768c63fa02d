// SPDX-License-Identifier: Apache-2.0
/// Tests when a request on a two-wire drive line may count as gone, at any rate: arithmetic, the UART's word
/// and the guard. The replies of the bus are judged in tests/fdl/transmission_test.cpp.
#include "dpslave/base/transmission.hpp"

#include <gtest/gtest.h>

using namespace dpslave;
using namespace std::chrono_literals;

namespace {

constexpr Instant kWritten{7s};
/// 7E1 at 300 bit/s.
constexpr Transmission::Times kSlow{.character = 33'333'333ns, .guard = 17s};

TEST(RequestOnALine, AtThreeHundredBitsIsOverWhenItsCharactersHaveGone)
{
    Transmission request;
    request.begin(9 * kSlow.character, kWritten, kSlow);

    EXPECT_FALSE(request.is_over(kWritten + 9 * kSlow.character - 1ns, true));
    EXPECT_TRUE(request.is_over(kWritten + 9 * kSlow.character, std::nullopt));
    EXPECT_EQ(request.busy_until(), kWritten + 9 * kSlow.character);
}

TEST(RequestOnALine, WasOnItsWayForAsLongAsTheUartSaysSo)
{
    Transmission request;
    request.begin(kSlow.character, kWritten, kSlow);
    const Instant asked = request.ends_at() + 2ms;

    EXPECT_FALSE(request.is_over(asked, false));

    EXPECT_EQ(request.busy_until(), asked);
    EXPECT_TRUE(request.is_over(request.ends_at(), true));
    EXPECT_EQ(request.busy_until(), asked) << "also when it is over";
}

TEST(RequestOnALine, IsEndedByTheGuardOfItsLine)
{
    Transmission request;
    request.begin(kSlow.character, kWritten, kSlow);

    EXPECT_TRUE(request.is_over(kWritten + 17s, false));
    EXPECT_EQ(request.guarded(), 1U);
}

} // namespace
