// SPDX-License-Identifier: Apache-2.0
// Tag tables as CSV.
#include "dpsim/common/tag_file.hpp"
#include "dpsim/drive/ei_ascii.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

#include <set>

namespace dpslave::sim {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string fault_of(const std::string& rows)
{
    return parse_tags("tag,name,type,decimals,min,max,access,values\n" + rows, "t.csv").error();
}

TEST(TagFile, LoadsTheShippedExample)
{
    const auto tags = load_tags(test::source_path("config/tags/example.csv"));
    ASSERT_TRUE(tags) << tags.error();
    std::set<TagKind> kinds;
    std::set<unsigned> decimals;
    std::set<TagAccess> accesses;
    std::set<std::string> mnemonics;
    for (const SimTag& tag : *tags) {
        EXPECT_THAT(tag.name, StartsWith("Example: "));
        kinds.insert(tag.type);
        accesses.insert(tag.access);
        if (tag.type == TagKind::number) decimals.insert(tag.decimals);
        EXPECT_TRUE(
            mnemonics.insert(tag.mnemonic.empty() ? mnemonic_of(Rule::dc_590plus, tag.number) : tag.mnemonic)
                .second)
            << tag.number;
    }
    EXPECT_EQ(kinds.size(), 5U) << "every type is there";
    EXPECT_EQ(accesses.size(), 3U);
    EXPECT_EQ(decimals, (std::set<unsigned>{0, 1, 2, 3, 4}));
    for (const int wanted : {55, 56, 288})
        EXPECT_TRUE(std::any_of(tags->begin(), tags->end(), [&](const SimTag& t) {
            return t.number == wanted;
        })) << wanted;
}

TEST(TagFile, FindsColumnsByNameInAnyOrderAndLeavesOthersAlone)
{
    const auto tags = parse_tags(
        "colour,max,name,tag,decimals,type\r\nred,\"9.5\",\"a \"\"b\"\", c\",7,1,INT\r\n", "t.csv");
    ASSERT_TRUE(tags) << tags.error();
    EXPECT_EQ((*tags)[0].number, 7);
    EXPECT_EQ((*tags)[0].name, "a \"b\", c");
    EXPECT_EQ((*tags)[0].max, 95);
}

TEST(TagFile, ReadsWordLimitsAsHexadecimal)
{
    const auto tags = parse_tags("tag,type,min,max\n1,WORD,0010,0x03FF\n", "t.csv");
    ASSERT_TRUE(tags) << tags.error();
    EXPECT_EQ((*tags)[0].min, 0x10);
    EXPECT_EQ((*tags)[0].max, 0x3FF);
}

TEST(TagFile, LetsDecimalsFollowTheDisplay)
{
    const auto tags =
        parse_tags("tag,type,decimals,max,start\n1,INT,display,9999,18.3\n2,WORD,display,,\n", "t.csv");
    ASSERT_TRUE(tags) << tags.error();
    EXPECT_TRUE((*tags)[0].follows_display);
    EXPECT_EQ((*tags)[0].decimals, kDisplayDecimals);
    EXPECT_EQ((*tags)[0].max, 999900) << "it is no word";
    EXPECT_TRUE((*tags)[0].has_start);
    EXPECT_EQ((*tags)[0].start.counts, 1830);
    EXPECT_FALSE((*tags)[1].follows_display) << "a word has no decimals";
    EXPECT_FALSE((*tags)[1].has_start);
}

TEST(TagFile, GivesCountsOtherDecimalsRounded)
{
    EXPECT_EQ(rescaled(9999, 1, 0), 1000);
    EXPECT_EQ(rescaled(1234, 2, 0), 12);
    EXPECT_EQ(rescaled(5, 1, 0), 1) << "ties go away from zero";
    EXPECT_EQ(rescaled(-5, 1, 0), -1);
    EXPECT_EQ(rescaled(-4, 1, 0), 0);
    EXPECT_EQ(rescaled(12, 0, 2), 1200);
    EXPECT_EQ(rescaled(12, 2, 2), 12);
}

TEST(TagFile, NamesTheLineThatIsWrong)
{
    EXPECT_EQ(fault_of("1,a,INT,,,,,\nx,b,INT,,,,,\n"), "t.csv:3: tag 'x' is no number from 0 to 65535");
    EXPECT_THAT(fault_of("1,a,FLOAT,,,,,\n"), StartsWith("t.csv:2: type 'FLOAT'"));
    EXPECT_THAT(fault_of("1,a,INT,5,,,,\n"), HasSubstr("decimals '5'"));
    EXPECT_THAT(fault_of("1,a,INT,2,-400.00,,,\n"), HasSubstr("does not fit"));
    EXPECT_THAT(fault_of("1,a,INT,0,-1,40000,,\n"), HasSubstr("16-bit"));
    EXPECT_THAT(fault_of("1,a,INT,0,5,4,,\n"), HasSubstr("above"));
    EXPECT_THAT(fault_of("1,a,INT,0,,,xx,\n"), HasSubstr("access 'xx'"));
    EXPECT_THAT(fault_of("1,a,ENUM,0,,,rw,Stop\n"), HasSubstr("values 'Stop'"));
    EXPECT_THAT(fault_of("1,\"a,INT\n"), HasSubstr("quotation mark"));
    EXPECT_THAT(fault_of("1,a,INT,0,,,rw,,9\n"), HasSubstr("9 fields"));
    EXPECT_THAT(parse_tags("name\nx\n", "t.csv").error(), HasSubstr("'tag'"));
    EXPECT_THAT(load_tags("/nonexistent/t.csv").error(), HasSubstr("cannot be read"));
}

TEST(TagFile, ShowsValuesAsPeopleWriteThem)
{
    EXPECT_EQ(displayed({.decimals = 2}, {-5}), "-0.05");
    EXPECT_EQ(displayed({.decimals = 0}, {-5000}), "-5000");
    EXPECT_EQ(displayed({.type = TagKind::word}, {0x1B0B}), ">1B0B");
    EXPECT_EQ(displayed({.type = TagKind::enumeration, .labels = {{2, "Jog"}}}, {2}), "2 (Jog)");
}

TEST(TagFile, TakesValuesAndLabelsFromPeople)
{
    const SimTag mode{.type = TagKind::enumeration, .max = 3, .labels = {{2, "Jog"}}};
    EXPECT_EQ(value_of_text(mode, "Jog")->counts, 2);
    EXPECT_EQ(value_of_text(mode, "3")->counts, 3);
    EXPECT_FALSE(value_of_text(mode, "4"));
    EXPECT_FALSE(value_of_text(mode, "Dance"));
}

} // namespace
} // namespace dpslave::sim
