// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/typed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(TypedDuration, IsSecondsWithoutAUnit)
{
    EXPECT_EQ(read_duration("10"), 10s);
    EXPECT_EQ(read_duration("010"), 10s);
    EXPECT_EQ(read_duration("0.3"), 300ms);
    EXPECT_EQ(read_duration("0"), 0s);
}

TEST(TypedDuration, HasUnitsFromMicrosecondsToDays)
{
    EXPECT_EQ(read_duration("100us"), 100us);
    EXPECT_EQ(read_duration("500ms"), 500ms);
    EXPECT_EQ(read_duration("0.5ms"), 500us);
    EXPECT_EQ(read_duration("10s"), 10s);
    EXPECT_EQ(read_duration("1.5s"), 1500ms);
    EXPECT_EQ(read_duration("5m"), 5min);
    EXPECT_EQ(read_duration("1h"), 1h);
    EXPECT_EQ(read_duration("1.5h"), 90min);
    EXPECT_EQ(read_duration("3d"), 72h);
}

TEST(TypedDuration, IsNothingWhereItIsNoTime)
{
    for (const char* const text :
         {"", "s", "ms", "-5m", "5 m", "1.", ".5", "1.5.2", "1e3", "soon", "5S", "10min", "0x10", "366d",
          "9999999999h", "99999999999999999999", "0.00000000001"})
        EXPECT_EQ(read_duration(text), std::nullopt) << text;
}

TEST(TypedDuration, IsNothingBeyondItsLimits)
{
    EXPECT_EQ(read_duration("100ms", 100ms, 1h), 100ms);
    EXPECT_EQ(read_duration("99ms", 100ms, 1h), std::nullopt);
    EXPECT_EQ(read_duration("61m", 100ms, 1h), std::nullopt);
}

TEST(TypedDuration, IsPrintedInItsLargestUnit)
{
    for (const char* const text : {"0s", "100us", "20ms", "1500ms", "90s", "10m", "2h", "3d"})
        EXPECT_EQ(duration_text(read_duration(text).value_or(-1s)), text);
    EXPECT_EQ(duration_text(5s), "5s");
    EXPECT_EQ(duration_text(3ns), "3ns");
}

TEST(TypedRate, MayEndWithKOrM)
{
    EXPECT_EQ(read_rate("9600"), 9'600u);
    EXPECT_EQ(read_rate("0187500"), 187'500u);
    EXPECT_EQ(read_rate("187.5k"), 187'500u);
    EXPECT_EQ(read_rate("45.45k"), 45'450u);
    EXPECT_EQ(read_rate("1.5M"), 1'500'000u);
    EXPECT_EQ(read_rate("12M"), 12'000'000u);
    for (const char* const text :
         {"", "k", "-1k", "0", "9.6", "1.5m", "1.5 M", "fast", "1.2345k", "5000M", "0x10"})
        EXPECT_EQ(read_rate(text), std::nullopt) << text;
}

TEST(TypedTags, AreNumbersRangesAndNames)
{
    EXPECT_THAT(*read_tags("055"), ElementsAre(TypedTag{{55, 55}, ""}));
    EXPECT_THAT(*read_tags("0x37"), ElementsAre(TypedTag{{55, 55}, ""}));
    EXPECT_THAT(*read_tags("55-57,60"), ElementsAre(TypedTag{{55, 57}, ""}, TypedTag{{60, 60}, ""}));
    EXPECT_THAT(*read_tags("60 0x10-0x11"), ElementsAre(TypedTag{{60, 60}, ""}, TypedTag{{16, 17}, ""}));
    EXPECT_THAT(*read_tags("speed feedback"), ElementsAre(TypedTag{{}, "speed feedback"}));
    EXPECT_THAT(*read_tags("7, ramp 2"), ElementsAre(TypedTag{{7, 7}, ""}, TypedTag{{}, "ramp 2"}));
    EXPECT_THAT(*read_tags("2nd-gain"), ElementsAre(TypedTag{{}, "2nd-gain"}));
}

TEST(TypedTags, AreRefusedWhereTheyAreNeither)
{
    for (const char* const text :
         {"", " ", "-1", "65536", "0x10000", "1,", ",1", "1,,2", "99999999999999999999"})
        EXPECT_THAT(read_tags(text).error(), HasSubstr("write a tag from 0 to 65535, or a name")) << text;
    EXPECT_EQ(read_tags("7,57-55").error(), "\"57-55\": the first tag is above the last one: swap them");
}

TEST(TypedTagSpans, AreSortedAndJoined)
{
    EXPECT_THAT(*read_tag_spans("01000-1127,1-600,0x7,601,65535"),
                ElementsAre(TagSpan{1, 601}, TagSpan{1000, 1127}, TagSpan{65535, 65535}));
    EXPECT_THAT(*read_tag_spans("1-3 7, 9"), ElementsAre(TagSpan{1, 3}, TagSpan{7, 7}, TagSpan{9, 9}));
}

TEST(TypedTagSpans, AreRefusedWhereTheyAreNoNumbers)
{
    for (const char* const text : {"", "1,", ",1", "1-", "-5", "5-1", "65536", "37h", "1 - 5", "1;5", "1--5"})
        EXPECT_FALSE(read_tag_spans(text)) << text;
    EXPECT_THAT(read_tag_spans("5-1").error(), HasSubstr("swap them"));
    EXPECT_THAT(read_tag_spans("5,").error(), HasSubstr("\"5,\": write tags")) << "5 alone is right";
}

} // namespace
} // namespace dpslave
