// SPDX-License-Identifier: Apache-2.0
// The form of a GSD file (wire reference 9.1), as files of many makers have it: read by the second hand.
#include "dpsim/common/gsd_file.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

GsdFile read(const std::string& text)
{
    const auto file = parse_gsd(text);
    EXPECT_TRUE(file) << (file ? "" : file.error());
    return file ? *file : GsdFile{};
}

std::string value_of(const GsdFile& file, std::string_view key)
{
    const GsdEntry* const entry = file.entries.find(key);
    EXPECT_NE(entry, nullptr) << key;
    return entry == nullptr ? "" : entry->value;
}

TEST(GsdFile, IsReadFromItsSectionOnAndNotBefore)
{
    const GsdFile file = read("Ident_Number = 1\n#Profibus_DP\nIdent_Number = 2\n#Other\nIdent_Number = 3\n");
    EXPECT_EQ(value_of(file, "Ident_Number"), "2");
    EXPECT_THAT(file.entries.all, SizeIs(1));
    EXPECT_EQ(file.entries.all[0].line, 3U);
}

TEST(GsdFile, WithoutTheSectionIsNone)
{
    EXPECT_EQ(parse_gsd("Ident_Number = 1\n").error(), "there is no line #Profibus_DP: it is no GSD file");
    EXPECT_FALSE(parse_gsd(""));
    EXPECT_FALSE(parse_gsd("; #Profibus_DP\n"));
}

TEST(GsdFile, MayBeginWithAByteOrderMarkBeforeAComment)
{
    EXPECT_EQ(value_of(read("\xEF\xBB\xBF; any\n#Profibus_DP\nA=1\n"), "A"), "1");
    EXPECT_EQ(value_of(read("\xEF\xBB\xBF#Profibus_DP\nA=1\n"), "A"), "1");
}

TEST(GsdFile, HasAnyEndOfLineAndTheLastLineMayHaveNone)
{
    for (const std::string end : {"\n", "\r\n", "\r", "\r\r\n"}) {
        const GsdFile file = read("#Profibus_DP" + end + "A = 1 ; one" + end + "B = 2");
        EXPECT_EQ(value_of(file, "A"), "1");
        EXPECT_EQ(value_of(file, "B"), "2");
    }
}

TEST(GsdFile, HasKeywordsInAnyCaseAndBlanksAnywhereAroundThem)
{
    const GsdFile file =
        read("#PROFIBUS_dp\n\t ident_NUMBER=0X1AF \nExt_User_Prm_Data_Const ( 3 ) = 1 , 2\n");
    EXPECT_EQ(value_of(file, "Ident_Number"), "0X1AF");
    const GsdEntry* const entry = file.entries.find("ext_user_prm_data_const");
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->at, 3U);
    EXPECT_EQ(entry->value, "1,2");
}

TEST(GsdFile, TakesTheLastOfTwoEqualKeywords)
{
    EXPECT_EQ(value_of(read("#Profibus_DP\nA=1\na=2\n"), "A"), "2");
}

TEST(GsdFile, HasCommentsThatBeginBehindAnythingButNotInsideOfAText)
{
    const GsdFile file = read("#Profibus_DP\n"
                              "Model_Name = \"a; b = c\" ; not \"this\"\n"
                              "; Ident_Number = 1\n"
                              "Revision = \"V1\";x\n");
    EXPECT_EQ(file.entries.text("Model_Name"), "a; b = c");
    EXPECT_EQ(file.entries.text("Revision"), "V1");
    EXPECT_EQ(file.entries.find("Ident_Number"), nullptr);
}

TEST(GsdFile, ContinuesALineBehindABackslashAlsoInATextAndUnderABlankOrAComment)
{
    const GsdFile file = read("#Profibus_DP\r\n"
                              "User_Prm_Data = 0x01,\\\r\n   0x02,\\ \r\n 0x03, \\ ; three\r\n 4\r\n"
                              "Info_Text = \"one; \\\r\ntwo\"\r\n"
                              "; a comment \\\r\n"
                              "A = 1\r\n");
    EXPECT_EQ(value_of(file, "User_Prm_Data"), "0x01,0x02,0x03,4");
    EXPECT_EQ(file.entries.text("Info_Text"), "one; two");
    EXPECT_EQ(value_of(file, "A"), "1") << "a comment does not continue";
    EXPECT_EQ(file.entries.all.back().line, 9U) << "lines are those of the file";
}

TEST(GsdFile, LetsATextWithoutItsSecondQuotationMarkEndWithItsLine)
{
    const GsdFile file = read("#Profibus_DP\nModel_Name = \"open\nA = 1\n");
    EXPECT_EQ(file.entries.text("Model_Name"), "open");
    EXPECT_EQ(value_of(file, "A"), "1");
}

TEST(GsdFile, HasNumbersThatAreDecimalWithZerosBeforeThemOrHexadecimal)
{
    EXPECT_EQ(gsd_number("12"), 12);
    EXPECT_EQ(gsd_number("012"), 12) << "octal numbers are none of a GSD";
    EXPECT_EQ(gsd_number("08"), 8);
    EXPECT_EQ(gsd_number("0x1aF"), 0x1AF);
    EXPECT_EQ(gsd_number("0XFF"), 0xFF);
    EXPECT_EQ(gsd_number("-128"), -128);
    EXPECT_EQ(gsd_number("4294967295"), 4294967295);
    for (const char* wrong : {"", "-", "0x", "1h", "1.5", "1 2", "+1", "4294967296", "--1", "0x-1"})
        EXPECT_EQ(gsd_number(wrong), std::nullopt) << wrong;
}

TEST(GsdFile, HasListsOfOctets)
{
    EXPECT_EQ(gsd_octets("0x00, 255 ,010"), (Octets{0, 255, 10}));
    EXPECT_EQ(gsd_octets(""), Octets{});
    for (const char* wrong : {"256", "-1", "1,,2", ",1", "1,", "0x1 0x2", "a"})
        EXPECT_EQ(gsd_octets(wrong), std::nullopt) << wrong;
}

TEST(GsdFile, HasModulesWithIdentifiersAndLinesOfTheirOwn)
{
    const GsdFile file = read("#Profibus_DP\n"
                              "Module = \"Two; words, in\" 0x51 , \\\n 0x00 ; any\n"
                              "1\n"
                              "Preset = 1\n"
                              "Info_Text = \"of the module\"\n"
                              "ENDMODULE\n"
                              "MODULE=\"\xC4\"0x20\n"
                              "EndModule\n"
                              "Max_Module = 2\n");
    ASSERT_THAT(file.modules, SizeIs(2));
    EXPECT_EQ(file.modules[0].name, "Two; words, in");
    EXPECT_THAT(file.modules[0].identifiers, ElementsAre(0x51, 0x00));
    EXPECT_TRUE(file.modules[0].entries.is_on("preset"));
    EXPECT_EQ(file.modules[0].fault, "");
    EXPECT_EQ(file.modules[1].name, "\xC3\x84") << "ISO 8859-1 becomes UTF-8";
    EXPECT_THAT(file.modules[1].entries.all, IsEmpty());
    EXPECT_EQ(file.entries.find("Info_Text"), nullptr) << "it is no line of the device";
    EXPECT_EQ(value_of(file, "Max_Module"), "2");
}

TEST(GsdFile, SaysWhyAModuleCannotBePluggedAndReadsTheOthers)
{
    const GsdFile file = read("#Profibus_DP\nModule=\"a\" 0x1G\nEndModule\nModule=b 0x10\nEndModule\n"
                              "Module=\"c\"\nEndModule\nModule=\"d\" 0x10\nModule=\"e\" 0x20\n");
    ASSERT_THAT(file.modules, SizeIs(5));
    EXPECT_EQ(file.modules[0].fault, "line 2: '0x1G' are no identifier octets");
    EXPECT_EQ(file.modules[1].fault, "line 4: the name of the module has no quotation marks");
    EXPECT_EQ(file.modules[2].fault, "line 6: '' are no identifier octets");
    EXPECT_EQ(file.modules[3].fault, "") << "EndModule is missing";
    EXPECT_THAT(file.modules[4].identifiers, ElementsAre(0x20));
}

TEST(GsdFile, HasParametersOfEachType)
{
    struct Row {
        const char* type;
        std::size_t octets;
        unsigned first_bit;
        std::uint32_t mask, value;
    };
    for (const Row& row :
         {Row{"Unsigned8 5 0-10", 1, 0, 0xFF, 5}, Row{"UNSIGNED16 0x0102", 2, 0, 0xFFFF, 0x102},
          Row{"Unsigned32 4294967295 0-4294967295", 4, 0, 0xFFFFFFFF, 0xFFFFFFFF},
          Row{"Signed8 -1 -128-127", 1, 0, 0xFF, 0xFF}, Row{"Signed16 -2 -10-10", 2, 0, 0xFFFF, 0xFFFE},
          Row{"signed32 -2147483648", 4, 0, 0xFFFFFFFF, 0x80000000}, Row{"Bit(7) 1 0-1", 1, 7, 1, 1},
          Row{"bit ( 0 )\t0 0-1", 1, 0, 1, 0}, Row{"BitArea(4-6) 5 0,1,2,5", 1, 4, 7, 5},
          Row{"BitArea ( 6 - 4 ) 2", 1, 4, 7, 2}}) {
        const GsdFile file =
            read("#Profibus_DP\nExtUserPrmData = 7 \"name (1) = x\"\n" + std::string{row.type} +
                 " ; any\nPrm_Text_Ref = 1\nEndExtUserPrmData\nA=1\n");
        ASSERT_THAT(file.parameters, SizeIs(1)) << row.type;
        const PrmBlock& parameter = file.parameters[0];
        EXPECT_EQ(parameter.fault, "") << row.type;
        EXPECT_EQ(parameter.reference, 7);
        EXPECT_EQ(parameter.octets, row.octets) << row.type;
        EXPECT_EQ(parameter.first_bit, row.first_bit) << row.type;
        EXPECT_EQ(parameter.mask, row.mask) << row.type;
        EXPECT_EQ(parameter.value, row.value) << row.type;
        EXPECT_THAT(file.entries.all, SizeIs(1)) << "Prm_Text_Ref is none of the device";
    }
}

TEST(GsdFile, SaysWhyAParameterCannotBeUsed)
{
    for (const char* wrong :
         {"Unsigned8 256", "Unsigned8 -1", "Signed8 128", "Signed8 -129", "Unsigned64 1", "Bit(8) 0",
          "Bit() 0", "Bit 0", "Bit(1 0", "Bit(1) 2", "Bit(1-2) 1", "BitArea(1) 1", "BitArea(1-8) 1",
          "BitArea(4-6) 8", "Unsigned8", "Unsigned8 x"}) {
        const GsdFile file =
            read("#Profibus_DP\nExtUserPrmData=1 \"a\"\n" + std::string{wrong} + "\nEndExtUserPrmData\n");
        ASSERT_THAT(file.parameters, SizeIs(1)) << wrong;
        EXPECT_THAT(file.parameters[0].fault, testing::StartsWith("line 3: ")) << wrong;
    }
    const GsdFile file = read("#Profibus_DP\nExtUserPrmData=1 \"a\"\nEndExtUserPrmData\n");
    EXPECT_EQ(file.parameters[0].fault, "line 2: the parameter has no type and no default");
}

TEST(GsdFile, ThatCannotBeReadIsNamed)
{
    EXPECT_EQ(load_gsd("/nowhere/X.GSD").error(),
              "/nowhere/X.GSD: cannot be read; give another one with --gsd FILE");
    EXPECT_EQ(load_gsd(test::source_path("LICENSE")).error(),
              test::source_path("LICENSE: there is no line #Profibus_DP: it is no GSD file"));
}

} // namespace
} // namespace dpslave::sim
