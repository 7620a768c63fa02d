// SPDX-License-Identifier: Apache-2.0
// Tests what a drive line tells the main thread.
#include "app/links/line_happenings.hpp"

#include <gmock/gmock.h>

#include <string>

namespace dpslave::app {
namespace {

using Kind = LineHappenings::Kind;

std::string text_of(const std::optional<LineHappening>& happening)
{
    return happening ? happening->text.data() : "none";
}

TEST(LineHappenings, ComeOnceAndInTheirOrder)
{
    LineHappenings line;
    line.tell(Severity::info, 3, "unwinder: the drive answers", Kind::answers);
    line.tell(Severity::error, 0, "/dev/ttyS2 is missing", Kind::port_missing, "port");

    const auto first = line.take(), second = line.take();
    ASSERT_TRUE(first && second);
    EXPECT_EQ(text_of(first), "unwinder: the drive answers");
    EXPECT_EQ(first->station, 3u);
    EXPECT_EQ(first->kind, Kind::answers);
    EXPECT_EQ(second->severity, Severity::error);
    EXPECT_EQ(std::string{second->key.data()}, "port");
    EXPECT_EQ(text_of(line.take()), "none");
}

TEST(LineHappenings, AreCutWhereTheirTextIsTooLong)
{
    LineHappenings line;
    line.tell(Severity::info, 1, std::string(1000, 'x'));

    EXPECT_EQ(text_of(line.take()), std::string(383, 'x'));
    line.tell(Severity::info, 1, std::string(382, 'x') + "\u00FC");
    EXPECT_EQ(text_of(line.take()), std::string(382, 'x')) << "in whole characters";
}

TEST(LineHappenings, ThatFoundNoRoomAreCountedInTheNextOneThatDoes)
{
    LineHappenings line;
    for (int i = 0; i < 131; ++i) line.tell(Severity::info, 1, std::to_string(i));
    for (int i = 0; i < 128; ++i) EXPECT_EQ(text_of(line.take()), std::to_string(i));
    EXPECT_EQ(text_of(line.take()), "none");

    line.tell(Severity::info, 1, "next");

    EXPECT_EQ(text_of(line.take()), "3 things that happened at a drive line were not told");
    EXPECT_EQ(text_of(line.take()), "next");
    line.tell(Severity::info, 1, "another");
    EXPECT_EQ(text_of(line.take()), "another") << "what is lost is told once";
}

} // namespace
} // namespace dpslave::app
