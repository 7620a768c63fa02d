// SPDX-License-Identifier: Apache-2.0
// Tables of which each row is one line, and how wide text is on a terminal.
#include "dpctl/cli/columns.hpp"
#include "dpctl/top/grid.hpp"

#include <gtest/gtest.h>

namespace dpslave::dpctl {
namespace {

using Strings = std::vector<std::string>;

TEST(Columns, AreTwoForALetterOfEastAsiaAndNoneForAnAccent)
{
    EXPECT_EQ(columns_of("abc"), 3u);
    EXPECT_EQ(columns_of("Z\u00FCrich"), 6u);
    EXPECT_EQ(columns_of("\u4E2D\u6587"), 4u); // two ideographs
    EXPECT_EQ(columns_of("\uFF21"), 2u);       // fullwidth A
    EXPECT_EQ(columns_of("\uD55C"), 2u);       // a syllable of Hangul
    EXPECT_EQ(columns_of("\U0001F600"), 2u);   // a face
    EXPECT_EQ(columns_of("u\u0308"), 1u);      // u, and the two dots on it
    EXPECT_EQ(columns_of("\u2588"), 1u);       // a full block
    EXPECT_EQ(columns_of("a\xFF"
                         "b"),
              3u); // an octet that is no UTF-8
    EXPECT_EQ(columns_of(""), 0u);
}

TEST(Columns, CutNoCharacterInTwo)
{
    EXPECT_EQ(octets_within("\u4E2D\u6587", 3), 3u) << "the second one would need a fourth column";
    EXPECT_EQ(octets_within("u\u0308x", 1), 3u) << "the accent stays with its letter";
    EXPECT_EQ(octets_within("abc", 0), 0u);
    EXPECT_EQ(octets_within("abc", 9), 3u);
}

TEST(Columns, AreFilledOrCutToExactlySoMany)
{
    EXPECT_EQ(fitted("ab", 4), "ab  ");
    EXPECT_EQ(fitted("ab", 4, true), "  ab");
    EXPECT_EQ(fitted("abcde", 4), "abc~");
    EXPECT_EQ(fitted("\u4E2D\u6587x", 4), "\u4E2D~~") << "half of an ideograph does not fit";
    EXPECT_EQ(cut("abcde", 5), "abcde");
    EXPECT_EQ(cut("abcde", 4), "abc~");
    EXPECT_EQ(fitted("abc", 1), "~");
    EXPECT_EQ(fitted("abc", 0), "");
}

Grid grid_of_two()
{
    Grid grid({"NAME", ">VALUE", "WORDS"});
    grid.add({"speed", "12.5", "all is as it should be"});
    grid.add({"a long name", "-7", "no"});
    return grid;
}

TEST(Grid, IsOneLineForEachRow)
{
    EXPECT_EQ(grid_of_two().lines({}, 80, 0, 9), (Strings{"NAME         VALUE  WORDS",                  //
                                                          "speed         12.5  all is as it should be", //
                                                          "a long name     -7  no"}));
}

TEST(Grid, CutsTheWidestColumnOfWordsFirst)
{
    EXPECT_EQ(grid_of_two().lines({}, 30, 0, 9), (Strings{"NAME         VALUE  WORDS",      //
                                                          "speed         12.5  all is as~", //
                                                          "a long name     -7  no"}));
}

TEST(Grid, LeavesColumnsOutFromTheEndWhenNoneCanBeCutFurther)
{
    EXPECT_EQ(grid_of_two().lines({}, 16, 0, 9), (Strings{"NAME       VALUE", //
                                                          "speed       12.5", //
                                                          "a long n~     -7"}));
    EXPECT_EQ(grid_of_two().lines({}, 5, 0, 9), (Strings{"NAME", "speed", "a lo~"}));
    EXPECT_EQ(grid_of_two().lines({}, 0, 0, 9), (Strings{"", "", ""}));
}

TEST(Grid, ShowsAPartOfItsRows)
{
    EXPECT_EQ(grid_of_two().lines({}, 5, 1, 1), (Strings{"NAME", "a lo~"}));
    EXPECT_EQ(grid_of_two().lines({}, 5, 2, 1), (Strings{"NAME"}));
}

TEST(Grid, NeverIsWiderThanItMayBe)
{
    Grid grid({"NAME", ">N", "WORDS"});
    grid.add({"\u4E2D\u6587\u4E2D\u6587\u4E2D\u6587", "123456789", "\u4E2D\u6587\u4E2D\u6587"});
    for (std::size_t columns = 0; columns < 40; ++columns)
        for (const std::string& line : grid.lines({}, columns, 0, 9))
            EXPECT_LE(columns_of(line), columns) << line;
}

TEST(Grid, HasItsColoursAroundTheWordsOnly)
{
    Grid grid({"A", "B"});
    grid.add({Cell{"x", Tone::bad}, "y"});
    EXPECT_EQ(grid.lines({true}, 80, 0, 9),
              (Strings{"\033[1mA\033[0m  \033[1mB\033[0m", "\033[31mx\033[0m  y"}));
}

} // namespace
} // namespace dpslave::dpctl
