// SPDX-License-Identifier: Apache-2.0
/// When the drive of a station counts as gone because its line stalls: each combination of what
/// the bus sees, and random histories against a model that remembers everything.
#include "app/bus/stalled_line.hpp"

#include <gtest/gtest.h>

#include <random>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;

constexpr Instant kBegin{1h};

/// Looks every 10 ms, as the bus thread does.
class Looks {
public:
    explicit Looks(std::chrono::nanoseconds after) : line(after) {}
    void until(Instant end, std::uint32_t noted = 0)
    {
        for (; now < end; now += 10ms) line.look(sign, noted, now);
    }
    Instant now = kBegin;
    Instant sign = kBegin;
    StalledLine line;
};

TEST(StalledLine, DoesNotStallWhileSignsComeInTime)
{
    Looks looks{500ms};
    for (int i = 0; i < 100; ++i) {
        looks.until(looks.now + 490ms);
        EXPECT_FALSE(looks.line.is_stalled());
        looks.sign = looks.now;
    }
    EXPECT_EQ(looks.line.stalls(), 0U);
}

TEST(StalledLine, StallsWhenNoSignHasComeForSoLong)
{
    Looks looks{2s};
    looks.until(kBegin + 1990ms);
    EXPECT_FALSE(looks.line.is_stalled());
    looks.until(kBegin + 2020ms);
    EXPECT_TRUE(looks.line.is_stalled());
    EXPECT_EQ(looks.line.stalls(), 1U);
}

TEST(StalledLine, StaysStalledUntilTheLineGoesRoundAndHasTakenNote)
{
    Looks looks{2s};
    looks.until(kBegin + 3s);
    looks.sign = looks.now; // it goes round, and does not know of it yet
    looks.until(looks.now + 1s);
    EXPECT_TRUE(looks.line.is_stalled());
    looks.sign = looks.now;
    looks.until(looks.now + 20ms, 1);
    EXPECT_FALSE(looks.line.is_stalled());
}

TEST(StalledLine, StaysStalledWhereTheLineTookNoteAndStalledAgain)
{
    Looks looks{2s};
    looks.until(kBegin + 3s);
    looks.until(kBegin + 6s, 1); // no sign with it
    EXPECT_TRUE(looks.line.is_stalled());
}

TEST(StalledLine, TakesALongerTimeFromNowOn)
{
    Looks looks{2s};
    looks.until(kBegin + 1s);
    looks.line.set_after(10s);
    looks.until(kBegin + 9s);
    EXPECT_FALSE(looks.line.is_stalled());
    looks.until(kBegin + 11s);
    EXPECT_TRUE(looks.line.is_stalled());
}

/// A line and a bus that stall at random, for 1 ms to 60 s. The model adds up the time in which the bus
/// ran since the newest sign.
TEST(StalledLine, IsThatOfAModelInRandomHistories)
{
    std::mt19937 random{58};
    const auto in = [&](int least, int most) {
        return std::chrono::milliseconds{std::uniform_int_distribution<int>{least, most}(random)};
    };
    for (int history = 0; history < 2000; ++history) {
        const std::chrono::nanoseconds after = in(500, 5000);
        StalledLine line{after};
        Instant now = kBegin, sign = kBegin, line_until = kBegin;
        std::chrono::nanoseconds ran{};
        std::uint32_t noted = 0;
        bool first = true;
        for (int step = 0; step < 500; ++step) {
            const auto bus = random() % 100 == 0 ? in(1, 60'000) : in(1, 10);
            now += bus;
            bool is_new = false;
            if (now >= line_until) { // the line goes round, and may stall behind it
                const bool knows = random() % 4 != 0;
                if (knows) noted = line.stalls();
                sign = now;
                is_new = true;
                line_until = now + (random() % 20 == 0 ? in(1, 60'000) : in(1, 100));
            }
            ran = is_new || first ? 0ns : ran + std::min<std::chrono::nanoseconds>(bus, 100ms);
            first = false;
            const bool stood = line.is_stalled();
            line.look(sign, noted, now);
            if (ran >= after)
                EXPECT_TRUE(line.is_stalled()) << "history " << history << ", step " << step;
            else if (!stood)
                EXPECT_FALSE(line.is_stalled()) << "history " << history << ", step " << step;
            else
                EXPECT_EQ(line.is_stalled(), noted != line.stalls());
            if (HasFailure()) return;
        }
    }
}

} // namespace
} // namespace dpslave::app
