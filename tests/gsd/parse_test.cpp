// SPDX-License-Identifier: Apache-2.0
// The lexical rules of a GSD, wire reference 9.1.
#include "dpslave/gsd/document.hpp"

#include <gmock/gmock.h>

namespace dpslave::gsd {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

Document section(const std::string& lines)
{
    return parse("#Profibus_DP\r\n" + lines);
}

std::vector<std::string> remarks(const Document& document)
{
    std::vector<std::string> out;
    for (const Remark& remark : document.remarks)
        out.push_back(std::to_string(remark.line) +
                      (remark.weight == Weight::error     ? ": error: "
                       : remark.weight == Weight::warning ? ": warning: "
                                                          : ": pedantic: ") +
                      remark.what);
    return out;
}

TEST(GsdParser, ReadsKeywordsInAnyCaseWithAndWithoutBlanksAroundTheEqualsSign)
{
    const Document document = section("Ident_Number=0x0533\r\nMODEL_NAME   =   \"590\"\r\n");
    EXPECT_EQ(document.number("ident_number"), 0x0533U);
    EXPECT_EQ(document.text("Model_Name"), "590");
    EXPECT_THAT(remarks(document), IsEmpty());
}

TEST(GsdParser, CountsLinesFromOneAlsoBehindContinuedOnes)
{
    const Document document = section("User_Prm_Data = 0x00,\\\r\n   0x01\r\nMax_Module = 13\r\n");
    EXPECT_EQ(document.find("User_Prm_Data")->line, 2U);
    EXPECT_EQ(document.find("Max_Module")->line, 4U);
    EXPECT_THAT(document.octets("User_Prm_Data"), ElementsAre(0, 1));
}

TEST(GsdParser, TakesNumbersInDecimalAndHexadecimalAndNothingElse)
{
    const Document document = section("Max_Module = 0x0d\r\nMax_Input_Len = 32\r\nMax_Output_Len = 20h\r\n"
                                      "Max_Data_Len = -1\r\nModul_Offset = 99999999999\r\n");
    EXPECT_EQ(document.number("Max_Module"), 13U);
    EXPECT_EQ(document.number("Max_Input_Len"), 32U);
    EXPECT_EQ(document.number("Max_Output_Len"), std::nullopt);
    EXPECT_EQ(document.number("Max_Data_Len"), std::nullopt);
    EXPECT_EQ(document.number("Modul_Offset"), std::nullopt);
}

TEST(GsdParser, LeavesASemicolonInATextAloneAndRemovesComments)
{
    const Document document = section("Vendor_Name = \"a;b\" ;comment with \"quotes\r\n; nothing else\r\n");
    EXPECT_EQ(document.text("Vendor_Name"), "a;b");
    EXPECT_THAT(document.keywords, SizeIs(1));
    EXPECT_THAT(remarks(document), IsEmpty());
}

TEST(GsdParser, TakesTheLastOfARepeatedKeywordAsToolsDo)
{
    EXPECT_EQ(section("Max_Module = 1\r\nMax_Module = 2\r\n").number("Max_Module"), 2U);
}

TEST(GsdParser, ReadsTheNumberOfAnIndexedKeyword)
{
    const Document document = section("Unit_Diag_Bit(07) = \"tripped\"\r\n");
    EXPECT_EQ(document.keywords.at(0).index, 7U);
    EXPECT_EQ(document.keywords.at(0).keyword, "Unit_Diag_Bit");
}

TEST(GsdParser, TakesModulesApart)
{
    const Document document =
        section("Module = \"4 words=8\" 0x73, 80,0x60 ; three\r\n12\r\nPreset = 1\r\nEndModule\r\n");
    ASSERT_THAT(document.modules, SizeIs(1));
    const Module& module = document.modules[0];
    EXPECT_EQ(module.name, "4 words=8");
    EXPECT_THAT(module.identifiers, ElementsAre(0x73, 0x50, 0x60));
    EXPECT_EQ(module.reference, 12U);
    EXPECT_TRUE(module.preset);
    EXPECT_THAT(remarks(document), IsEmpty());
}

TEST(GsdParser, EndsTheSectionAtTheNextOne)
{
    const Document document = section("Max_Module = 1\r\n#Other\r\nMax_Module = 2\r\n");
    EXPECT_EQ(document.number("Max_Module"), 1U);
}

TEST(GsdParser, ReadsNothingWithoutASection)
{
    const Document document = parse("Max_Module = 1\r\n");
    EXPECT_FALSE(document.has_section);
    EXPECT_THAT(document.keywords, IsEmpty());
    EXPECT_THAT(remarks(document), testing::Contains(StartsWith("0: error: there is no line #Profibus_DP")));
    EXPECT_FALSE(parse("").has_section);
}

TEST(GsdParser, ClosesAModuleThatLacksEndModuleBeforeTheNextOneAndBeforeKeywordsOfTheDevice)
{
    const Document document = section("Module = \"a\" 0x50\r\nModule = \"b\" 0x60\r\nMax_Module = 2\r\n");
    EXPECT_THAT(document.modules, SizeIs(2));
    EXPECT_EQ(document.number("Max_Module"), 2U);
    EXPECT_THAT(
        remarks(document),
        ElementsAre("2: error: Module \"a\" 0x50 has no EndModule: write EndModule before line 3.",
                    "3: error: Module \"b\" 0x60 has no EndModule: write EndModule before \"Max_Module\" in "
                    "line 4."));
}

TEST(GsdParser, ReportsAnEndWithoutItsBeginning)
{
    EXPECT_THAT(remarks(section("EndModule\r\nPrmText=1\r\nEndModule\r\nEndPrmText\r\n")),
                ElementsAre(StartsWith("2: error: EndModule without a Module"),
                            StartsWith("4: error: EndModule inside the PrmText of line 3")));
}

/// What is odd about the text itself, and the remarks on it.
struct Odd {
    const char* name;
    std::string lines; ///< from line 2 on
    std::vector<const char*> remarks;
};
void PrintTo(const Odd& odd, std::ostream* out)
{
    *out << odd.name;
}

class OddText : public testing::TestWithParam<Odd> {};

TEST_P(OddText, IsReportedWithItsLine)
{
    const auto seen = remarks(section(GetParam().lines));
    ASSERT_THAT(seen, SizeIs(GetParam().remarks.size())) << testing::PrintToString(seen);
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_THAT(seen[i], StartsWith(GetParam().remarks[i]));
}

const std::string kLong80 = "Vendor_Name = \"a\" ;" + std::string(61, 'x') + "\r\n";
const std::string kLong81 = "Vendor_Name = \"a\" ;" + std::string(62, 'x') + "\r\n";

INSTANTIATE_TEST_SUITE_P(
    Gsd, OddText,
    testing::Values(
        Odd{"ALineOf80CharactersIsNone", kLong80, {}},
        Odd{"ALineOf81Characters", kLong81, {"2: warning: the line has 81 characters"}},
        Odd{"LineFeedAlone",
            "Max_Module = 1\nMax_Input_Len = 2\n",
            {"2: pedantic: the line ends with LF alone"}},
        Odd{"NoLineEndAtTheEnd", "Max_Module = 1", {"2: warning: the last line has no line end"}},
        Odd{"TabBehindTheContinuation",
            "User_Prm_Data = 1,\\\t\r\n2\r\n",
            {"2: warning: something follows the \\"}},
        Odd{"CommentBehindTheContinuation",
            "User_Prm_Data = 1,\\ ;one\r\n2\r\n",
            {"2: warning: something follows the \\"}},
        Odd{"ContinuationOfNothing",
            "User_Prm_Data = 1,\\\r\n",
            {"2: error: the last line is continued, but there is none after it"}},
        Odd{"TextWithoutItsEnd",
            "Vendor_Name = \"a\r\nMax_Module = 1\r\n",
            {"2: error: the text has no closing quote"}},
        Odd{"TextContinued", "Vendor_Name = \"a\\\r\nb\"\r\n", {"2: warning: a text is continued"}},
        Odd{"Latin1Text",
            "Vendor_Name = \"Gr\xFC\xDF"
            "e\"\r\n",
            {}},
        Odd{"Utf8Text",
            "Vendor_Name = \"Gr\xC3\xBC\xC3\x9F"
            "e\"\r\nModel_Name = \"\xC2\xB0\"\r\n",
            {"2: warning: a character is coded in UTF-8"}},
        Odd{"Utf8InACommentIsHarmless",
            "; Gr\xC3\xBC\xC3\x9F"
            "e\r\n",
            {}},
        Odd{"CharacterOfWindowsAlone", "Vendor_Name = \"5 \x80\"\r\n", {}},
        Odd{"TypographicQuotesOfUtf8",
            "Vendor_Name = \xE2\x80\x9C"
            "EUROTHERM\xE2\x80\x9D\r\nModel_Name = \xE2\x80\x9E"
            "590\xE2\x80\x9C\r\n",
            {"2: error: typographic quotes", "3: error: typographic quotes"}},
        Odd{"TypographicQuotesOfWindows",
            "Vendor_Name = \x93"
            "EUROTHERM\x94\r\n",
            {"2: error: typographic quotes"}},
        Odd{"ControlCharacter",
            std::string{"Vendor_Name = \"a\x01\"\r\n"},
            {"2: error: the line has a control character"}},
        Odd{"EndOfFileCharacterInAComment", "; a\x1A\r\n", {"2: error: the line has a control character"}},
        Odd{"NeitherKeywordNorModule", "Hello\r\n", {"2: warning: \"Hello\" is neither Keyword = value"}},
        Odd{"NoKeyword", "= 5\r\n", {"2: warning: \"= 5\" is neither Keyword = value"}},
        Odd{"NoNumberInParentheses",
            "Unit_Diag_Bit(x) = \"a\"\r\n",
            {"2: error: \"Unit_Diag_Bit(x)\" has no number"}},
        Odd{"StrangeLineInAModule",
            "Module = \"a\" 0x50\r\n1\r\nData_Area_Beg\r\nData_Area_End\r\n2\r\nEndModule\r\n",
            {"6: error: \"2\" is neither the module's reference number nor Keyword = value"}},
        Odd{"ParenthesisNotClosed",
            "Unit_Diag_Bit(3 = \"a\"\r\n",
            {"2: error: \"Unit_Diag_Bit(3\" has no number"}},
        Odd{"ModuleWithoutQuotes",
            "Module = a 0x50\r\nEndModule\r\n",
            {"2: error: the module has no name in quotes"}},
        Odd{"ModuleWithoutIdentifiers",
            "Module = \"a\"\r\nEndModule\r\n",
            {"2: error: the module's identifiers \"\" are no octets"}},
        Odd{"ModuleWithATooLargeIdentifier",
            "Module = \"a\" 0x150\r\nEndModule\r\n",
            {"2: error: the module's identifiers \"0x150\" are no octets"}},
        Odd{"MissingEndModuleAtTheEnd",
            "Module = \"a\" 0x50\r\n",
            {"2: error: Module \"a\" 0x50 has no EndModule: write EndModule before the end of the section"}}),
    [](const auto& one) { return std::string{one.param.name}; });

struct NotRead {
    const char* name;
    std::string octets;
    const char* why;
};
class UnreadableFile : public testing::TestWithParam<NotRead> {};
TEST_P(UnreadableFile, IsNamedForWhatItIsInOneSentence)
{
    const Document document = parse(GetParam().octets);
    EXPECT_FALSE(document.has_section);
    EXPECT_THAT(remarks(document), ElementsAre(StartsWith(std::string{"1: error: "} + GetParam().why)));
    EXPECT_THAT(document.not_read.what, StartsWith(GetParam().why));
}
INSTANTIATE_TEST_SUITE_P(
    Of, UnreadableFile,
    testing::Values(NotRead{"Utf16", std::string{"\xFF\xFE#\0P\0", 6}, "the file is UTF-16"},
                    NotRead{"Utf16OfTheOtherOrder", std::string{"\xFE\xFF\0#\0P", 6}, "the file is UTF-16"},
                    NotRead{"Utf16WithoutAMark", std::string{"#\0P\0", 4}, "the file is UTF-16"},
                    NotRead{"CrAlone", "#Profibus_DP\rMax_Module = 1\r", "the lines end with CR alone"},
                    NotRead{"ComEt200", "Typbeschreibungsdatei DP-Normslaves\r\n1\r\n",
                            "this is a type file of COM ET 200"}),
    [](const auto& one) { return std::string{one.param.name}; });

TEST(GsdParser, TakesTheEndOfFileCharacterOfDos)
{
    for (const std::string end : {"\x1A\r\n", "\x1A\x1A\x1A", "\x1A\x1A\r\n\x1A"}) {
        const Document several = parse("#Profibus_DP\r\nMax_Module = 1\r\n" + end);
        EXPECT_EQ(several.number("Max_Module"), 1U);
        EXPECT_THAT(remarks(several), IsEmpty());
    }
    const Document document = parse("#Profibus_DP\r\nMax_Module = 1\r\n\x1A");
    EXPECT_EQ(document.number("Max_Module"), 1U);
    EXPECT_THAT(remarks(document), IsEmpty());
}

TEST(GsdParser, LetsTheLineOfAnInfoTextBeLong)
{
    const std::string text(256, 'x');
    const Document document = parse("#Profibus_DP\r\nInfo_Text = \"" + text + "\"\r\n");
    EXPECT_EQ(document.text("Info_Text"), text);
    EXPECT_THAT(remarks(document), IsEmpty());
}

TEST(GsdParser, NamesTheLineThatIsNearlyTheSection)
{
    EXPECT_THAT(remarks(parse("; comment\r\n#Profibus-DP\r\nMax_Module = 1\r\n")),
                testing::Contains(StartsWith("2: error: \"#Profibus-DP\": the line that begins")));
}

TEST(GsdParser, WarnsOfAByteOrderMarkInFrontOfAComment)
{
    const Document document = parse("\xEF\xBB\xBF; a file\r\n#Profibus_DP\r\nMax_Module = 1\r\n");
    EXPECT_EQ(document.number("Max_Module"), 1U);
    EXPECT_THAT(remarks(document),
                ElementsAre(StartsWith("1: warning: the file begins with a UTF-8 byte order mark")));
}

TEST(GsdParser, ReportsAByteOrderMarkAndReadsOn)
{
    const Document document = parse("\xEF\xBB\xBF#Profibus_DP\r\nMax_Module = 1\r\n");
    EXPECT_EQ(document.number("Max_Module"), 1U);
    EXPECT_THAT(remarks(document),
                ElementsAre(StartsWith("1: error: the file begins with a UTF-8 byte order mark")));
}

TEST(GsdParser, ReportsWhatStandsBeforeTheSection)
{
    EXPECT_THAT(remarks(parse("; comment\r\n\r\nFile of the 590\r\nMax_Module = 1\r\n#Profibus_DP\r\n")),
                ElementsAre(StartsWith("4: error: \"Max_Module\" comes before #Profibus_DP")))
        << "any other text may stand there";
}

TEST(GsdParser, TakesTheSectionsNameInAnyCaseAndSaysSoToThePedantic)
{
    EXPECT_THAT(remarks(parse("#PROFIBUS_DP\r\n")),
                ElementsAre(StartsWith("1: pedantic: the standard spells")));
}

} // namespace
} // namespace dpslave::gsd
