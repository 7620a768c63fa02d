// SPDX-License-Identifier: Apache-2.0
// A paced line: a character takes 11 bit times, 10 with seven data bits.
#include "dpsim/line/pacer.hpp"
#include "octets.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;

const Octets kThree{1, 2, 3};

TEST(Pacer, DeliversEachOctetOneCharacterAfterTheOther)
{
    Pacer line{11'000, 11, 1}; // a character takes 1 ms
    const Instant t{1s};
    line.take(kThree, t);
    EXPECT_EQ(line.next_due(), t + 1ms);
    EXPECT_TRUE(line.due_by(t + 999us).empty());
    EXPECT_EQ(line.due_by(t + 1ms), Octets{1});
    EXPECT_EQ(line.next_due(), t + 2ms);
}

TEST(Pacer, CatchesUpWithAllThatIsDue)
{
    Pacer line{11'000, 11, 1};
    const Instant t{1s};
    line.take(kThree, t);
    EXPECT_EQ(line.due_by(t + 2500us), (Octets{1, 2}));
    EXPECT_EQ(line.next_due(), t + 3ms);
}

TEST(Pacer, QueuesBehindABusyLine)
{
    Pacer line{11'000, 11, 1};
    const Instant t{1s};
    line.take(kThree, t);
    line.take(Octets{4}, t + 500us);
    line.due_by(t + 3ms);
    EXPECT_EQ(line.next_due(), t + 4ms);
}

TEST(Pacer, StartsAnewAfterAnIdleLine)
{
    Pacer line{11'000, 11, 1};
    const Instant t{1s};
    line.take(kThree, t);
    line.due_by(t + 3ms);
    line.take(Octets{4}, t + 10ms);
    EXPECT_EQ(line.next_due(), t + 11ms);
}

TEST(Pacer, KeepsTheAverageRateExactOverManyCharacters)
{
    Pacer line{187'500, 11, 1};
    const Instant t{1s};
    for (int i = 0; i < 187'500; ++i) line.take(Octets{0x55}, t);
    Instant last{};
    while (!line.empty()) {
        last = line.next_due();
        line.due_by(last);
    }
    EXPECT_EQ(last, t + 11s); // 187500 characters of 11 bit at 187500 bit/s
}

TEST(Pacer, HasTheCharacterTimesOfTheReference)
{
    const Instant t{1s};
    const auto first = [&](std::uint32_t baud, unsigned bits) {
        Pacer line{baud, bits, 1};
        line.take(Octets{0}, t);
        return line.next_due() - t;
    };
    EXPECT_EQ(first(9'600, 11), 1'145'834ns);
    EXPECT_EQ(first(187'500, 11), 58'667ns);
    EXPECT_EQ(first(9'600, 10), 1'041'667ns);
}

TEST(Pacer, AddsTheDelayWithoutSlowingTheLine)
{
    Pacer line{11'000, 11, 1};
    line.set_delay(5ms);
    const Instant t{1s};
    line.take(kThree, t);
    EXPECT_EQ(line.next_due(), t + 6ms);
    line.due_by(t + 6ms);
    EXPECT_EQ(line.next_due(), t + 7ms);
}

TEST(Pacer, DoesNotLetAShorterDelayOvertake)
{
    Pacer line{11'000, 11, 1};
    const Instant t{1s};
    line.set_delay(50ms);
    line.take(Octets{1}, t);
    line.set_delay(0ms);
    line.take(Octets{2}, t + 10ms);
    EXPECT_EQ(line.due_by(t + 51ms), (Octets{1, 2}));
}

TEST(Pacer, HasAnotherRateFromTheNextOctetOn)
{
    Pacer line{11'000, 11, 1};
    const Instant t{1s};
    line.take(kThree, t);
    line.set_baud(1'100); // a character takes 10 ms
    line.take(Octets{4}, t + 1ms);
    EXPECT_EQ(line.due_by(t + 3ms), kThree);
    EXPECT_EQ(line.next_due(), t + 13ms);
}

TEST(Pacer, LosesEverythingWhileItIsCut)
{
    Pacer line{11'000, 11, 1};
    const Instant t{1s};
    line.take(kThree, t);
    line.set_cut(true);
    line.take(kThree, t + 1ms);
    EXPECT_TRUE(line.due_by(t + 1s).empty());
    EXPECT_EQ(line.lost(), 6U);
    line.set_cut(false);
    line.take(Octets{7}, t + 2s);
    EXPECT_EQ(line.due_by(t + 3s), Octets{7});
}

TEST(Pacer, InvertsAboutAsManyBitsAsAskedFor)
{
    Pacer line{11'000, 11, 42};
    line.set_errors(0.001);
    const Instant t{1s};
    const Octets zeros(10'000, 0);
    line.take(zeros, t);
    const Octets came = line.due_by(t + 100s);
    EXPECT_NEAR(static_cast<double>(line.spoilt()), 110.0, 40.0); // 10000 characters of 11 bits
    EXPECT_LT(came.size(), zeros.size()) << "hit start and stop bits lose their character";
}

TEST(Pacer, TurnsACharacterOfWrongParityIntoNulAndLetsAnEvenNumberOfHitsPass)
{
    Pacer line{11'000, 11, 3};
    line.set_errors(0.05);
    line.take(Octets(2'000, 0xA5), Instant{1s});
    std::size_t nuls = 0, others = 0;
    for (const std::uint8_t octet : line.due_by(Instant{10s})) {
        nuls += octet == 0 ? 1U : 0U;
        others += octet != 0 && octet != 0xA5 ? 1U : 0U;
    }
    EXPECT_NEAR(static_cast<double>(nuls), 553.0, 90.0);   // 2000 x 0.95^2 x P(an odd number of 9 bits)
    EXPECT_NEAR(static_cast<double>(others), 115.0, 50.0); // 2000 x 0.95^2 x P(2, 4, 6 or 8 of 9 bits)
}

TEST(Pacer, HasNoParityWhereAnOctetNeedsAllTenBits)
{
    Pacer line{11'000, 10, 3};
    line.set_errors(0.05);
    line.take(Octets(2'000, 0xFF), Instant{1s});
    for (const std::uint8_t octet : line.due_by(Instant{10s})) EXPECT_NE(octet, 0);
}

TEST(Pacer, SpoilsTheSameBitsWithTheSameSeed)
{
    Pacer one{11'000, 11, 7}, other{11'000, 11, 7};
    for (Pacer* const line : {&one, &other}) {
        line->set_errors(0.01);
        line->take(Octets(500, 0xA5), Instant{1s});
    }
    EXPECT_EQ(one.due_by(Instant{10s}), other.due_by(Instant{10s}));
}

} // namespace
} // namespace dpslave::sim
