// SPDX-License-Identifier: Apache-2.0
// View I/O map of the configurator (C-044), and the limits of some masters.
#include "second_hand.hpp"

#include "dpslave/gsd/io_map.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using gsd::io_map;
using gsd::IoMap;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

gsd::Document section(const std::string& lines)
{
    return gsd::parse("#Profibus_DP\r\n" + lines);
}

/// "0-1 tag 1 Process Variable"
std::vector<std::string> in_words(const std::vector<gsd::IoValue>& values)
{
    std::vector<std::string> out;
    for (const gsd::IoValue& value : values)
        out.push_back(std::to_string(value.octet) + "-" + std::to_string(value.octet + value.octets - 1) +
                      (value.tag ? " tag " + std::to_string(*value.tag) : "") + " " + value.what);
    return out;
}

/// The sentences alone.
std::vector<std::string> advice_on_lengths(std::size_t in, std::size_t out)
{
    std::vector<std::string> texts;
    for (const gsd::Advice& advice : gsd::advice_on_lengths(in, out)) texts.push_back(advice.text);
    return texts;
}

TEST(IoMap, OfEuro2400NamesEachWordWithItsTag)
{
    const gsd::Document document =
        section("User_Prm_Data_Len = 16\r\n"
                "User_Prm_Data = 0,1,0,5,0,3,0,75,0,24,0,25,0,15,1,18\r\n"
                "Module = \"m\" 0x50,0x50,0x50,0x50,0x60,0x60,0x60,0x60\r\nEndModule\r\n");
    const IoMap map =
        io_map(document, {.tags_at = 0, .names = {{1, "Process Variable"}, {274, "Acknowledge"}}});
    EXPECT_TRUE(map.fixed);
    EXPECT_EQ(map.in_octets, 8U);
    EXPECT_EQ(map.out_octets, 8U);
    EXPECT_THAT(in_words(map.inputs), ElementsAre("0-1 tag 1 Process Variable", "2-3 tag 5 tag 5",
                                                  "4-5 tag 3 tag 3", "6-7 tag 75 tag 75"));
    EXPECT_THAT(in_words(map.outputs), ElementsAre("0-1 tag 24 tag 24", "2-3 tag 25 tag 25",
                                                   "4-5 tag 15 tag 15", "6-7 tag 274 Acknowledge"));
    EXPECT_THAT(map.advice, IsEmpty());
}

TEST(IoMap, PutsDemandDataInFrontAndCountsItInBothDirections)
{
    const gsd::Document document = section("User_Prm_Data_Len = 4\r\nUser_Prm_Data = 0,7,0,8\r\n"
                                           "Module = \"m\" 0x73,0x60,0x50\r\nEndModule\r\n");
    const IoMap map = io_map(document, {});
    EXPECT_THAT(in_words(map.inputs),
                ElementsAre("0-1 Demand Data: answer and tag", "2-3 Demand Data: extended tag",
                            "4-5 Demand Data: reserved", "6-7 Demand Data: value or error code",
                            "8-9 tag 8 tag 8"));
    EXPECT_THAT(in_words(map.outputs),
                ElementsAre("0-1 Demand Data: command and tag", "2-3 Demand Data: extended tag",
                            "4-5 Demand Data: reserved", "6-7 Demand Data: value", "8-9 tag 7 tag 7"));
}

TEST(IoMap, HasAParameterOfBothDirectionsInBothLists)
{
    const IoMap map = io_map(section("User_Prm_Data_Len = 5\r\nUser_Prm_Data = 0,0,0,1,15\r\n"
                                     "Module = \"m\" 0x70\r\nEndModule\r\n"),
                             {});
    EXPECT_THAT(in_words(map.inputs), ElementsAre("0-1 tag 271 tag 271"))
        << "an odd length: three octets, then tags";
    EXPECT_THAT(in_words(map.outputs), ElementsAre("0-1 tag 271 tag 271"));
}

TEST(IoMap, GoesThroughThePresetModulesInTheirOrder)
{
    const IoMap map = io_map(section("Modular_Station = 1\r\nFixPresetModules = 1\r\n"
                                     "User_Prm_Data_Len = 4\r\nUser_Prm_Data = 0,1,0,2\r\n"
                                     "Module = \"a\" 0x50\r\nPreset = 1\r\nEndModule\r\n"
                                     "Module = \"not plugged\" 0x50\r\nEndModule\r\n"
                                     "Module = \"b\" 0x50\r\nPreset = 1\r\nEndModule\r\n"),
                             {});
    EXPECT_THAT(in_words(map.inputs), ElementsAre("0-1 tag 1 tag 1", "2-3 tag 2 tag 2"));
}

TEST(IoMap, IsOpenWhereTheMastersToolPutsModulesTogether)
{
    const IoMap map = io_map(gsd::parse(test::content_of(test::kSource / "gsd/manual/620/EURO0533.GSD")), {});
    EXPECT_FALSE(map.fixed);
    EXPECT_THAT(map.inputs, IsEmpty());
}

TEST(IoMap, OfAForeignFileGoesByTheNamesOfItsModules)
{
    const IoMap map = io_map(section("Module = \"2 in 2 out\" 0x11,0x21\r\nEndModule\r\n"), {});
    EXPECT_THAT(in_words(map.inputs), ElementsAre("0-1 2 in 2 out"));
    EXPECT_THAT(in_words(map.outputs), ElementsAre("0-1 2 in 2 out"));
}

TEST(IoMap, TakesTheUserPrmDataOfAForeignFileForNoTags)
{
    const std::string module = "Module = \"m\" 0x50,0x60\r\nEndModule\r\n";
    for (const char* prm : {"User_Prm_Data_Len = 4\r\nUser_Prm_Data = 0,1,0,0\r\n",
                            "User_Prm_Data_Len = 6\r\nUser_Prm_Data = 0,1,0,2,0,3\r\n",
                            "User_Prm_Data_Len = 2\r\nUser_Prm_Data = 0,1\r\n", ""})
        EXPECT_THAT(in_words(io_map(section(prm + module), {}).inputs), ElementsAre("0-1 m")) << prm;
    EXPECT_THAT(
        in_words(io_map(section("User_Prm_Data_Len = 6\r\nUser_Prm_Data = 0,1,0,2\r\n" + module), {}).inputs),
        ElementsAre("0-1 tag 1 tag 1"));
}

TEST(AdviceOnLengths, IsGivenAbove32OctetsAndAgainAbove32Words)
{
    EXPECT_THAT(advice_on_lengths(32, 32), IsEmpty());
    EXPECT_THAT(advice_on_lengths(34, 32), ElementsAre(HasSubstr("34 input octets are more than 32 octets")));
    EXPECT_THAT(advice_on_lengths(2, 64), ElementsAre(HasSubstr("64 output octets are more than 32 octets")));
    EXPECT_THAT(advice_on_lengths(2, 66), ElementsAre(HasSubstr("66 output octets are more than 32 octets"),
                                                      HasSubstr("66 output octets are more than 32 words")));
}

TEST(AdviceOnLengths, CountsBothDirectionsTogetherForThe117Words)
{
    EXPECT_THAT(advice_on_lengths(116, 118), SizeIs(4));
    EXPECT_THAT(advice_on_lengths(118, 118),
                testing::Contains(HasSubstr("118 input and output words together")));
}

} // namespace
} // namespace dpslave
