// SPDX-License-Identifier: Apache-2.0
/// The table of HA389815 ch. 9 row by row, and the time line of the lamps.
#include "support/long_times.hpp"
#include "watch.hpp"

#include <gtest/gtest.h>

namespace dpslave::led {
namespace {

using namespace std::chrono_literals;

struct Row {
    const char* name;
    Language language;
    Condition condition;
    Seen red;
    Seen green;
    const char* says;
};

class OptionBoardLeds : public testing::TestWithParam<Row> {};

TEST_P(OptionBoardLeds, ShowTheRowOfTheManual)
{
    const Row& row = GetParam();

    const std::vector<Lamp> shown = lamps(row.language, row.condition);

    ASSERT_EQ(shown.size(), 2u);
    EXPECT_EQ(shown[0].name, "red"); // red is left, green is right
    EXPECT_EQ(shown[1].name, "green");
    EXPECT_EQ(watch(shown[0].pattern, 12'345ms), row.red);
    EXPECT_EQ(watch(shown[1].pattern, 12'345ms), row.green);
    EXPECT_NE(meaning(row.language, row.condition).find(row.says), std::string_view::npos)
        << meaning(row.language, row.condition);
}

constexpr Condition kNormal{.running = true, .data_exchange = true, .drive_answers = true};
constexpr Condition kNoMaster{.running = true, .data_exchange = false, .drive_answers = true};
constexpr Condition kNoDrive{.running = true, .data_exchange = true, .drive_answers = false};
constexpr Condition kNoMasterNoDrive{.running = true, .data_exchange = false, .drive_answers = false};
constexpr Condition kNotServed{.running = false, .data_exchange = false, .drive_answers = true};
constexpr Condition kStopped{.running = false, .data_exchange = true, .drive_answers = false};

INSTANTIATE_TEST_SUITE_P(
    HA389815Chapter9, OptionBoardLeds,
    testing::Values(
        Row{"DataExchange", Language::option_board, kNormal, kDark, k2Hz, "normal operation"},
        Row{"ExternalOrConfigurationFault", Language::option_board, kNoMaster, kSteady, k1Hz,
            "external communications fault"},
        Row{"InternalFault", Language::option_board, kNoDrive, kSteady, k2Hz,
            "internal communications fault"},
        Row{"InternalFaultGoesFirst", Language::option_board, kNoMasterNoDrive, kSteady, k2Hz,
            "internal communications fault"},
        Row{"NoPowerOrMajorFault", Language::option_board, kNotServed, kDark, kDark,
            "no power or major fault"},
        Row{"NotRunningIsDarkWhateverElse", Language::option_board, kStopped, kDark, kDark,
            "no power or major fault"},
        Row{"DataExchangeOf620", Language::option_board_620, kNormal, kDark, k2Hz, "normal operation"},
        Row{"ExternalOrConfigurationFaultOf620", Language::option_board_620, kNoMaster, kSteady, k1Hz,
            "configuration fault"},
        Row{"InternalFaultOf620", Language::option_board_620, kNoDrive, k2Hz, k2Hz,
            "internal communications fault"},
        Row{"NoPowerOf620", Language::option_board_620, kNotServed, kDark, kDark, "no power or major fault"}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(LedTimeLine, EqualPatternsFlashTogether)
{
    const auto one = lamps(Language::option_board_620, kNoDrive);
    const auto other = lamps(Language::option_board, kNormal);

    for (auto time = 0ns; time < 1s; time += 7ms)
        ASSERT_EQ(lit(one[0].pattern, at(time)), lit(other[1].pattern, at(time))) << time.count();
}

TEST(LedTimeLine, ALampGoesOnAtTheStartOfItsPeriodAndOffInTheMiddle)
{
    const Pattern two_hz{500ms, 250ms};

    EXPECT_TRUE(lit(two_hz, at(1500ms)));
    EXPECT_TRUE(lit(two_hz, at(1750ms - 1ns)));
    EXPECT_FALSE(lit(two_hz, at(1750ms)));
    EXPECT_FALSE(lit(two_hz, at(2000ms - 1ns)));
    EXPECT_TRUE(lit(two_hz, at(2000ms)));
}

TEST(LedTimeLine, TheNextChangeIsTheFirstMomentAtWhichTheLampLooksDifferent)
{
    const Pattern patterns[] = {{500ms, 250ms}, {1000ms, 500ms}, {300ms, 100ms}};
    const std::chrono::nanoseconds moments[] = {0ns,   1ns,         99ms,  100ms,        249'999'999ns,
                                                250ms, 250ms + 1ns, 777ms, 86'400s + 3ms};

    for (const Pattern& pattern : patterns)
        for (const auto moment : moments) {
            const Instant change = next_change(pattern, at(moment));
            ASSERT_GT(change, at(moment));
            ASSERT_NE(lit(pattern, change), lit(pattern, at(moment)));
            ASSERT_EQ(lit(pattern, change - 1ns), lit(pattern, at(moment)));
            ASSERT_LE(change - at(moment), pattern.period);
        }
}

TEST(LedTimeLine, FromChangeToChangeTheLampMissesNothing)
{
    const Pattern one_hz{1000ms, 500ms};

    Instant now = at(3'250ms);
    std::vector<std::chrono::nanoseconds> steps;
    for (int i = 0; i < 4; ++i) {
        const Instant next = next_change(one_hz, now);
        steps.push_back(next - now);
        now = next;
    }

    EXPECT_EQ(steps, (std::vector<std::chrono::nanoseconds>{250ms, 500ms, 500ms, 500ms}));
}

TEST(LedTimeLine, ASteadyLampNeverChanges)
{
    EXPECT_EQ(next_change({0ms, 0ms}, at(5s)), kNever);
    EXPECT_EQ(next_change({0ms, 1ms}, at(5s)), kNever);
    EXPECT_EQ(next_change({500ms, 0ms}, at(5s)), kNever);
    EXPECT_EQ(next_change({500ms, 500ms}, at(5s)), kNever);
    EXPECT_TRUE(lit({500ms, 500ms}, at(4'999ms)));
    EXPECT_FALSE(lit({500ms, 0ms}, at(5s)));
}

TEST(LedTimeLine, HoldsBeforeItsZeroAndAtItsEnd)
{
    EXPECT_EQ(watch({500ms, 250ms}, -10s), k2Hz);
    EXPECT_EQ(next_change({500ms, 250ms}, at(-100ms)), at(0ms));
    EXPECT_EQ(next_change({500ms, 250ms}, kNever), kNever);
}

TEST(Words, OfOptionBoardsAndControllersHaveTheFrequency)
{
    const Pattern half_a_second{500ms, 250ms}, second{1s, 500ms}, odd{300ms, 150ms};

    for (const Language language :
         {Language::option_board, Language::option_board_620, Language::controller}) {
        EXPECT_EQ(words(language, half_a_second), "flashing 2 Hz");
        EXPECT_EQ(words(language, second), "flashing 1 Hz");
        EXPECT_EQ(words(language, odd), "flashing every 300 ms");
        EXPECT_EQ(words(language, Pattern{0ms, 1ms}), "on");
        EXPECT_EQ(words(language, Pattern{}), "off");
        EXPECT_EQ(words(language, Pattern{1s, 1s}), "on") << "lit all the time";
    }
}

TEST(Lamps, FlashAtTheirRateWhenTheClockHasRunForWeeks)
{
    const std::vector<Lamp> lamps = led::lamps(Language::option_board, kNoMaster);
    for (const test::LongTime& time : test::kLongTimes)
        for (const Lamp& lamp : lamps)
            EXPECT_EQ(watch(lamp.pattern, time.since_start - 1s), watch(lamp.pattern, 12'345ms)) << time;
}

} // namespace
} // namespace dpslave::led
