// SPDX-License-Identifier: Apache-2.0
#include "page.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

json diff_of(const std::string& left, const std::string& right, const std::string& profile = "")
{
    return ask(
        {{"do", "diff"}, {"file", to_base64(left)}, {"other", to_base64(right)}, {"profile", profile}});
}

const std::string kFile =
    "#Profibus_DP\r\nIdent_Number = 0x0533\r\nModel_Name = \"A\"\r\nModule = \"m\" 0x50\r\n"
    "EndModule\r\n";

TEST(Diff, OfAFileWithItselfIsNothing)
{
    const json reply = diff_of(kFile, kFile);
    EXPECT_EQ(reply["exit"], 0);
    EXPECT_EQ(reply["same"], true);
    EXPECT_EQ(reply["lines"], json({"Both files say the same."}));
    EXPECT_EQ(reply["text"].size(), 5U);
}

TEST(Diff, ByMeaningLeavesTheFormOfWritingOutAndByLineShowsIt)
{
    const std::string other =
        "; of today\n#Profibus_DP\nIDENT_NUMBER=1331\nModel_Name=\"A\"\nModule=\"m\" 80\nEndModule\n";
    const json reply = diff_of(kFile, other);
    EXPECT_EQ(reply["exit"], 0);
    EXPECT_EQ(reply["same"], true);
    EXPECT_THAT(texts(reply, "lines"),
                AllOf(HasSubstr("+ 1: ; of today"), HasSubstr("- 2: Ident_Number = 0x0533"),
                      HasSubstr("+ 3: IDENT_NUMBER=1331"), Not(HasSubstr(": EndModule"))));
}

TEST(Diff, NamesWhatIsSaidDifferently)
{
    std::string other = with(kFile, "\"A\"", "\"B\"");
    other = with(other, "Ident_Number = 0x0533\r\n", "Freeze_Mode_supp = 1\r\n");
    const json reply = diff_of(kFile, other);
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "lines"),
                AllOf(HasSubstr("Ident_Number: 0x0533 -> not there"), HasSubstr("Model_Name: \"A\" -> \"B\""),
                      HasSubstr("Freeze_Mode_supp: not there -> 1")));
}

TEST(Diff, OfTwoMappingsNamesTheTagsOfTheWordsThatDiffer)
{
    const json reply =
        diff_of(made_file({{"profile", "2408f"}, {"ident", 1}, {"list", {"in:1", "in:5"}}}),
                made_file({{"profile", "2408f"}, {"ident", 1}, {"list", {"in:1", "in:3"}}}), "2408f");
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "lines"),
                AllOf(HasSubstr("Set_Prm: 00 01 00 05 -> 00 01 00 03"),
                      HasSubstr("input octets 2-3: tag 5 Working setpoint -> tag 3 Output power %")));
}

TEST(Diff, OfFilesThatHaveNothingInCommonEnds)
{
    std::string left = "#Profibus_DP\n", right = left;
    for (int i = 0; i < 5000; ++i) {
        left += "A" + std::to_string(i) + " = 1\n";
        right += "B" + std::to_string(i) + " = 1\n";
    }
    EXPECT_EQ(diff_of(left, right)["text"].size(), 10001U);
    EXPECT_EQ(diff_of("no GSD", kFile)["exit"], 1);
}

} // namespace
} // namespace dpslave::test
