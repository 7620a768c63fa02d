// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/repeated_lines.hpp"

#include <gtest/gtest.h>

namespace dpslave {
namespace {

using namespace std::chrono_literals;

class RepeatedLinesTest : public testing::Test {
protected:
    /// All that is said of one line and of what is due before it.
    void line(std::string_view key, const std::string& text, Instant at)
    {
        time(at);
        if (const auto one = lines.on_line(key, {.level = 3, .text = text}, at)) said.push_back(one->text);
    }
    void time(Instant at)
    {
        for (const auto& one : lines.on_time(at)) said.push_back(one.text);
    }

    const Instant start = Instant{1h};
    RepeatedLines lines;
    std::vector<std::string> said;
    using Said = std::vector<std::string>;
};

TEST_F(RepeatedLinesTest, TheFirstIsSaidAtOnceAndItsLikeAreOneLineWithACount)
{
    for (int i = 0; i < 1380; ++i) line("5/tag 24/range", "tag 24: " + std::to_string(i), start + i * 7ms);
    time(start + 10s);

    EXPECT_EQ(said, (Said{"tag 24: 0", "tag 24: 1379 (1379 more times in 10 s)"}));
}

TEST_F(RepeatedLinesTest, EndlessOnesAreOneLineInTenSeconds)
{
    for (int i = 0; i < 100'000; ++i) line("one", "no answer", start + i * 1ms);

    EXPECT_EQ(said.size(), 10u);
    EXPECT_EQ(said[1], "no answer (9999 more times in 10 s)");
    EXPECT_EQ(said[9], "no answer (10000 more times in 10 s)");
}

TEST_F(RepeatedLinesTest, UnlikeOnesDoNotHoldEachOtherBack)
{
    line("5/1", "tag 1", start);
    line("5/2", "tag 2", start);
    line("6/1", "tag 1", start);

    EXPECT_EQ(said, (Said{"tag 1", "tag 2", "tag 1"}));
}

TEST_F(RepeatedLinesTest, AfterAQuietTimeALineIsSaidAtOnceAgain)
{
    line("one", "gone", start);
    line("one", "gone", start + 10s);

    EXPECT_EQ(said, (Said{"gone", "gone"}));
}

TEST_F(RepeatedLinesTest, WhatWasHeldBackIsSaidAlsoWhenNothingFollows)
{
    line("one", "gone", start);
    line("one", "gone", start + 1s);
    time(start + 9'999ms);
    EXPECT_EQ(said.size(), 1u);

    time(start + 10s);
    time(start + 30s);

    EXPECT_EQ(said, (Said{"gone", "gone (1 more time in 10 s)"}));
}

TEST_F(RepeatedLinesTest, OfAFlappingStateTheLatestIsSaidLast)
{
    for (int i = 0; i < 5; ++i) {
        line("answers", "it answers", start + i * 2s);
        if (i < 4) line("silent", "it is silent", start + i * 2s + 1s);
    }
    time(start + 20s);

    EXPECT_EQ(said, (Said{"it answers", "it is silent", "it is silent (3 more times in 10 s)",
                          "it answers (4 more times in 10 s)"}));
}

TEST_F(RepeatedLinesTest, EndlesslyDifferentOnesAreBoundedToo)
{
    for (int i = 0; i < 60'000; ++i) line(std::to_string(i), "tag " + std::to_string(i), start + i * 100us);
    time(start + 11s);

    EXPECT_EQ(said.size(), RepeatedLines::kMostKeys + 2);
    EXPECT_EQ(said.back(), "tag 59999 (the newest of 58975 different messages in 10 s)");
}

TEST_F(RepeatedLinesTest, TheLevelGoesWithTheLine)
{
    EXPECT_EQ(lines.on_line("one", {.level = 4, .text = "a"}, start)->level, 4);
    lines.on_line("one", {.level = 3, .text = "b"}, start);
    EXPECT_EQ(lines.on_time(start + 10s).at(0).level, 3);
}

} // namespace
} // namespace dpslave
