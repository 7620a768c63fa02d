// SPDX-License-Identifier: Apache-2.0
/// Tests what the program tests of itself at the start (B-006).
#include "app/main/self_test.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace dpslave::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Instant kEarlier{std::chrono::seconds{5}};
constexpr Instant kLater{kEarlier + std::chrono::nanoseconds{1}};

TEST(SelfTest, PassesWhereTelegramsAndClockAreSound)
{
    EXPECT_THAT(self_test(kKnownTelegram, kEarlier, kLater), IsEmpty());
}

TEST(SelfTest, RecognisesASlaveDiagRequestOfMaster2ToStation5)
{
    EXPECT_THAT(kKnownTelegram,
                ElementsAre(0x68, 0x05, 0x05, 0x68, 0x85, 0x82, 0x6D, 0x3C, 0x3E, 0xEE, 0x16));
}

TEST(SelfTest, FailsWhereTheTelegramThatIsKnownIsNotUnderstoodAsItIs)
{
    for (std::size_t i = 0; i < kKnownTelegram.size(); ++i) {
        auto other = kKnownTelegram;
        other[i] ^= 0x01;
        EXPECT_THAT(self_test(other, kEarlier, kLater), ElementsAre(HasSubstr("known telegram"))) << i;
    }
    const std::vector<std::uint8_t> to_station_6{0x68, 0x05, 0x05, 0x68, 0x86, 0x82,
                                                 0x6D, 0x3C, 0x3E, 0xEF, 0x16};
    EXPECT_THAT(self_test(to_station_6, kEarlier, kLater), ElementsAre(HasSubstr("known telegram")))
        << "a good one, but another";
    EXPECT_THAT(self_test({}, kEarlier, kLater), ElementsAre(HasSubstr("known telegram")));
}

TEST(SelfTest, FailsWhereTheClockStandsStillOrRunsBack)
{
    EXPECT_THAT(self_test(kKnownTelegram, kEarlier, kEarlier), ElementsAre(HasSubstr("clock")));
    EXPECT_THAT(self_test(kKnownTelegram, kLater, kEarlier), ElementsAre(HasSubstr("clock")));
}

} // namespace
} // namespace dpslave::app
