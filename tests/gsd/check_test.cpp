// SPDX-License-Identifier: Apache-2.0
// What is wrong in a file is reported with its line and what to do (B-092, C-047; wire reference 9.2, 9.4).
#include "second_hand.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using gsd::Reading;
using test::findings_of;
using test::with;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A file that a strict reader likes; the tests spoil it.
const std::string kGood = R"(#Profibus_DP
GSD_Revision = 3
Vendor_Name = "EXAMPLE"
Model_Name = "Modular"
Revision = "1"
Ident_Number = 0x4711
Protocol_Ident = 0
Station_Type = 0
Hardware_Release = "1"
Software_Release = "1"
9.6_supp = 1
500_supp = 1
MaxTsdr_9.6 = 60
MaxTsdr_500 = 100
Slave_Family = 3@Example@Words
Fail_Safe = 0
Min_Slave_Intervall = 20
Max_Diag_Data_Len = 8
Unit_Diag_Bit(7) = "tripped"
User_Prm_Data_Len = 3
User_Prm_Data = 0x00,\
  0x01,2
Modular_Station = 1
Max_Module = 2
Max_Input_Len = 8
Max_Output_Len = 8
Max_Data_Len = 16
Module = "a word in" 0x50
1
EndModule
Module = "four words" 0x73
2
Info_Text = "both ways"
EndModule
)";

/// So many octets of empty slots.
std::string octets(std::size_t count)
{
    std::string text = "0";
    for (std::size_t i = 1; i < count; ++i) text += i % 20 == 0 ? ",\\\n0" : ",0";
    return text;
}

std::string crlf(const std::string& text)
{
    std::string out;
    for (const char each : text) out += each == '\n' ? std::string{"\r\n"} : std::string{each};
    return out;
}

std::string file(const std::string& from = "Fail_Safe = 0", const std::string& to = "Fail_Safe = 0")
{
    return crlf(with(kGood, from, to));
}

TEST(GsdCheck, FindsNothingInAGoodFile)
{
    EXPECT_THAT(findings_of(file(), Reading::strict, "EXMP4711.GSD"), IsEmpty());
}

TEST(GsdCheck, TakesTheDecimalAndTheHexadecimalFormForTheSame)
{
    EXPECT_THAT(findings_of(file("Max_Input_Len = 8", "Max_Input_Len = 0x08"), Reading::strict), IsEmpty());
}

/// A change of the good file, and what a tolerant reader then reports.
struct Bad {
    const char* name;
    const char* from;
    std::string to;
    const char* finding; ///< begins so
};
void PrintTo(const Bad& bad, std::ostream* out)
{
    *out << bad.name;
}

class BadGsd : public testing::TestWithParam<Bad> {};

TEST_P(BadGsd, IsReportedWithItsLineAndWhatToDo)
{
    EXPECT_THAT(findings_of(file(GetParam().from, GetParam().to)),
                ElementsAre(StartsWith(GetParam().finding)));
}

INSTANTIATE_TEST_SUITE_P(
    Keywords, BadGsd,
    testing::Values(
        Bad{"UnknownKeyword", "Fail_Safe = 0", "Colour = 5", "16: warning: unknown keyword \"Colour\""},
        Bad{"KeywordOfAModuleInTheDevice", "Fail_Safe = 0", "Preset = 1",
            "16: error: Preset belongs in a module"},
        Bad{"BooleanInWords", "Fail_Safe = 0", "Fail_Safe = FALSE",
            "16: error: Fail_Safe = FALSE: write 0 or 1."},
        Bad{"BooleanTooLarge", "Fail_Safe = 0", "Fail_Safe = 2", "16: error: Fail_Safe = 2: write 0 or 1."},
        Bad{"NoNumber", "Min_Slave_Intervall = 20", "Min_Slave_Intervall = 2ms",
            "17: error: Min_Slave_Intervall = 2ms is not a number"},
        Bad{"NumberOutOfRange", "Max_Diag_Data_Len = 8", "Max_Diag_Data_Len = 245",
            "18: error: Max_Diag_Data_Len = 245 is out of range: it may be 6 to 244."},
        Bad{"TextWithoutQuotes", "\"EXAMPLE\"", "EXAMPLE", "3: error: Vendor_Name is a text"},
        Bad{"TextOf33Characters", "\"EXAMPLE\"", "\"012345678901234567890123456789012\"",
            "3: error: the text of Vendor_Name has 33 characters: 32 are allowed."},
        Bad{"QuoteInAText", "\"EXAMPLE\"", "\"EX\"AMPLE", "3: error: AMPLE follows the text of Vendor_Name"},
        Bad{"UnknownFamily", "3@Example@Words", "13",
            "15: error: Slave_Family = 13: write a number from 0 to 12"},
        Bad{"OctetTooLarge", "0x01,2", "0x101,2", "21: error: User_Prm_Data is a list of octets"},
        Bad{"EmptyOctet", "0x01,2", "0x01,,2", "21: error: User_Prm_Data is a list of octets"},
        Bad{"RepeatedKeyword", "Fail_Safe = 0", "Fail_Safe = 0\nFail_Safe = 0",
            "17: warning: Fail_Safe is here a second time (first in line 16)"},
        Bad{"RepeatedDiagnosisBit", "Fail_Safe = 0", "Fail_Safe = 0\nUnit_Diag_Bit(7) = \"other\"",
            "20: warning: Unit_Diag_Bit is here a second time (first in line 17)"},
        Bad{"IndexMissing", "Unit_Diag_Bit(7)", "Unit_Diag_Bit",
            "19: error: Unit_Diag_Bit needs a number in ( and )"},
        Bad{"KeywordNewerThanTheRevision", "Fail_Safe = 0", "Fail_Safe = 0\nIsochron_Mode_supp = 1",
            "17: warning: Isochron_Mode_supp exists from GSD_Revision 4 on, and the file says 3"},
        Bad{"Dpv1KeywordWithoutDpv1", "Fail_Safe = 0", "Fail_Safe = 0\nC1_Max_Data_Len = 240",
            "17: warning: C1_Max_Data_Len has a meaning with DPV1_Slave = 1 only"}),
    [](const auto& one) { return std::string{one.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    Device, BadGsd,
    testing::Values(
        Bad{"NoVendor", "Vendor_Name = \"EXAMPLE\"\n", "",
            "0: error: Vendor_Name is missing: add Vendor_Name = \"...\"."},
        Bad{"NoIdent", "Ident_Number = 0x4711\n", "", "0: error: Ident_Number is missing"},
        Bad{"NoInterval", "Min_Slave_Intervall = 20\n", "", "0: error: Min_Slave_Intervall is missing"},
        Bad{"NoFamilyInRevision3", "Slave_Family = 3@Example@Words\n", "",
            "0: error: Slave_Family is missing"},
        Bad{"NoDiagnosisLengthInRevision3", "Max_Diag_Data_Len = 8\n", "",
            "0: error: Max_Diag_Data_Len is missing"},
        Bad{"RateWithoutMaxTsdr", "MaxTsdr_500 = 100\n", "",
            "12: error: 500_supp = 1, but MaxTsdr_500 is missing"},
        Bad{"MaxTsdrWithoutRate", "500_supp = 1\n", "",
            "13: warning: MaxTsdr_500 is here, but 500_supp is not 1"},
        Bad{"MaxTsdrThatNoSlaveMayKeep", "MaxTsdr_500 = 100", "MaxTsdr_500 = 10",
            "14: warning: MaxTsdr_500 is below 11 bit times"},
        Bad{"MaxTsdrOfZero", "MaxTsdr_500 = 100", "MaxTsdr_500 = 0",
            "14: warning: MaxTsdr_500 is below 11 bit times"},
        Bad{"NoMaxModule", "Max_Module = 2\n", "",
            "23: error: Max_Module is missing, which a modular station needs"},
        Bad{"DataBelowInput", "Max_Data_Len = 16", "Max_Data_Len = 7",
            "27: warning: Max_Data_Len is below Max_Input_Len or Max_Output_Len"},
        Bad{"DataAboveBoth", "Max_Data_Len = 16", "Max_Data_Len = 17",
            "27: warning: Max_Data_Len is above Max_Input_Len and Max_Output_Len together: write 16 or "
            "less."},
        Bad{"DiagnosisBitBeyondTheLength", "Unit_Diag_Bit(7)", "Unit_Diag_Bit(8)",
            "19: error: this bit of the diagnosis lies beyond Max_Diag_Data_Len, which would have to be 9"},
        Bad{"UserPrmDataTooShort", "User_Prm_Data_Len = 3", "User_Prm_Data_Len = 4",
            "21: error: User_Prm_Data has 3 octets, but User_Prm_Data_Len in line 20 says 4"},
        Bad{"UserPrmDataWithoutLength", "User_Prm_Data_Len = 3\n", "",
            "20: error: User_Prm_Data without User_Prm_Data_Len"},
        Bad{"BothStylesOfUserPrmData", "User_Prm_Data_Len = 3",
            "Max_User_Prm_Data_Len = 3\nUser_Prm_Data_Len = 3",
            "22: warning: User_Prm_Data and Max_User_Prm_Data_Len exclude each other"}),
    [](const auto& one) { return std::string{one.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    Modules, BadGsd,
    testing::Values(
        Bad{"MissingEndModule", "EndModule\nModule = \"four", "Module = \"four",
            "28: error: Module \"a word in\" 0x50 has no EndModule: write EndModule before line 30."},
        Bad{"MissingReferenceInRevision3", "0x73\n2\n", "0x73\n",
            "31: error: the module \"four words\" has no reference number"},
        Bad{"RepeatedReference", "0x73\n2\n", "0x73\n1\n",
            "31: error: the reference number 1 of the module \"four words\" belongs to the one of line 28 "
            "already"},
        Bad{"RepeatedName", "\"four words\"", "\"a word in\"",
            "31: warning: the module \"a word in\" is there already (line 28)"},
        Bad{"NameOf33Characters", "\"four words\"", "\"012345678901234567890123456789012\"",
            "31: error: the module's name has 33 characters"},
        Bad{"IdentifierCutShort", "0x73", "0xC2,0x00,0x01,0xAA",
            "31: error: the identifiers of the module \"four words\" are cut short"},
        Bad{"IdentifierLongerThanTheDevice", "0x50", "0x54",
            "28: error: the module \"a word in\" has 10 input octets, more than Max_Input_Len"},
        Bad{"OutputLongerThanTheDevice", "0x50", "0x64",
            "28: error: the module \"a word in\" has 10 output octets, more than Max_Output_Len"},
        Bad{"MoreIdentifiersThanATelegramHas", "0x50", octets(244) + ",0x50",
            "28: error: the module \"a word in\" has 245 identifier octets: 244 are allowed."},
        Bad{"CompactStationWithTwoModules", "Modular_Station = 1\nMax_Module = 2",
            "Modular_Station = 0\nMax_Module = 1", "31: warning: a compact station has one module"},
        Bad{"UnknownKeywordInAModule", "Info_Text", "Infotext", "33: warning: unknown keyword \"Infotext\""},
        Bad{"LongTextInAModule", "Info_Text = \"both ways\"",
            "Channel_Diag(16) = \"012345678901234567890123456789012\"",
            "33: error: the text of Channel_Diag has 33 characters"},
        Bad{"DataAreaWithoutEnd", "Info_Text", "Data_Area_Beg\nInfo_Text",
            "31: warning: the module has Data_Area_Beg without Data_Area_End"}),
    [](const auto& one) { return std::string{one.param.name}; });

TEST(GsdCheck, ReportsMorePresetModulesThanAllowed)
{
    std::string text =
        with(with(kGood, "Max_Module = 2", "Max_Module = 1"), "0x50\n1", "0x50\n1\nPreset = 1");
    text = with(text, "0x73\n2", "0x73\n2\nPreset = 1");
    EXPECT_THAT(findings_of(crlf(text)),
                ElementsAre(StartsWith("32: error: more modules are preset than Max_Module allows"),
                            StartsWith("32: error: the preset modules have 10 input and 8 output octets")));
}

TEST(GsdCheck, ReportsThatThereIsNoModuleAndNoRate)
{
    std::string text = kGood.substr(0, kGood.find("Module = \"a word"));
    for (const char* line : {"9.6_supp = 1\n", "500_supp = 1\n", "MaxTsdr_9.6 = 60\n", "MaxTsdr_500 = 100\n"})
        text = with(text, line, "");
    EXPECT_THAT(findings_of(crlf(text)), ElementsAre(StartsWith("0: error: no rate is supported"),
                                                     StartsWith("0: error: there is no module")));
}

/// Misspellings that files in the field have, and what the standard spells.
TEST(GsdCheck, NamesTheKeywordThatWasMeant)
{
    const std::pair<const char*, const char*> pairs[] = {
        {"Min_Slave_Interval = 20", "Min_Slave_Intervall"},
        {"Module_Offset = 1", "Modul_Offset"},
        {"Max_Tsdr_9.6 = 60", "MaxTsdr_9.6"},
        {"Autobaud_supp = 1", "Auto_Baud_supp"},
        {"User_Prm_DataLen = 3", "User_Prm_Data_Len"},
        {"1,5M_supp = 1", "1.5M_supp"},
    };
    for (const auto& [line, meant] : pairs)
        EXPECT_THAT(findings_of(file("Fail_Safe = 0", line)),
                    Contains(HasSubstr("the standard spells it \"" + std::string{meant} + "\"")))
            << line;
}

TEST(GsdCheck, WarnsWhereAStrictReaderRefuses)
{
    const std::string text = file("Fail_Safe = 0", "Colour = 5");
    EXPECT_THAT(findings_of(text, Reading::tolerant),
                ElementsAre(StartsWith("16: warning: unknown keyword")));
    EXPECT_THAT(findings_of(text, Reading::strict), ElementsAre(StartsWith("0: error: Fail_Safe is missing"),
                                                                StartsWith("16: error: unknown keyword")));
}

TEST(GsdCheck, NamesTheBeginOrTheEndOfABlockThatWasMeant)
{
    EXPECT_THAT(findings_of(file("Module = \"four", "Moduel = \"four")),
                Contains("31: warning: unknown keyword \"Moduel\": the standard spells it \"Module\"."));
    EXPECT_THAT(
        findings_of(file("both ways\"\nEndModule", "both ways\"\nEndModul")),
        Contains("34: error: \"EndModul\" is neither the module's reference number nor Keyword = value: the "
                 "standard spells it \"EndModule\"."));
}

/// Wire reference 9.2: 17 octets in revision 0, 244 from revision 1 on.
TEST(GsdCheck, AllowsMoreThan17IdentifierOctetsInAModuleFromRevision1On)
{
    const std::string long_module = with(kGood, "0x50", octets(17) + ",0x50");
    EXPECT_THAT(findings_of(crlf(long_module)), IsEmpty());
    EXPECT_THAT(
        findings_of(crlf(with(long_module, "GSD_Revision = 3\n", ""))),
        Contains("27: warning: the module \"a word in\" has 18 identifier octets: 17 are allowed without "
                 "GSD_Revision. Split it."));
}

TEST(GsdCheck, LetsAFileWithoutRevisionPassWithAWarning)
{
    EXPECT_THAT(findings_of(file("GSD_Revision = 3\n", "")),
                ElementsAre(StartsWith("0: warning: GSD_Revision is missing")));
}

TEST(GsdCheck, PutsFindingsInTheOrderOfTheirLines)
{
    std::string text = with(kGood, "\"EXAMPLE\"", "EXAMPLE");
    text = with(text, "Fail_Safe = 0", "Colour = 5");
    text = with(text, "Module = \"a word in\" 0x50\n1\nEndModule", "Module = \"a word in\" 0x50\n1");
    EXPECT_THAT(findings_of(crlf(text)), ElementsAre(StartsWith("3:"), StartsWith("16:"), StartsWith("28:")));
}

TEST(GsdCheck, DoesNotAskAMasterForWhatASlaveNeeds)
{
    std::string text = with(kGood, "Station_Type = 0", "Station_Type = 1");
    text = text.substr(0, text.find("Slave_Family")) + "Master_Freeze_Mode_supp = 1\nMax_Lsdu_MS = 240\n";
    EXPECT_THAT(findings_of(crlf(text)),
                ElementsAre(HasSubstr("warning: Station_Type = 1: this is the file of a master")));
}

/// Of the PROFIsafe profile and of the extensions of DP: no other keyword is suggested for them.
TEST(GsdCheck, LeavesKeywordsOfProfisafeAndOfExtensionsAlone)
{
    EXPECT_THAT(findings_of(file() + "X_Ext_Module_Prm_Data_Len = 9\r\nX_Unit_Diag_Bit(7) = \"a\"\r\n"
                                     "DXB_Max_Link_Count = 1\r\n"),
                IsEmpty());
    EXPECT_THAT(findings_of(file() + "F_Ext_User_Prm_Data_Ref(0) = 1\r\nF_ParamDescCRC = 0x1234\r\n"),
                IsEmpty());
}

/// Wire reference 9.2: the keywords between its two lines are those of data exchange between slaves.
TEST(GsdCheck, LeavesTheDataAreasOfAModuleAlone)
{
    for (const char* const begin : {"Data_Area_Beg", "Data_Area_Beg = 1", "data_area_beg ="}) {
        const std::string areas =
            std::string{"Info_Text = \"both ways\"\n"} + begin +
            "\nRelated_CFG_Identifier = 1\nIO_Direction = 0\nLength = 2\n7\nData_Area_End\n" + begin +
            "\nIO_Direction = 1\nLength = 2\nData_Area_End";
        EXPECT_THAT(findings_of(file("Info_Text = \"both ways\"", areas)), IsEmpty()) << begin;
    }
    const auto document = gsd::parse(file("0x73\n2", "0x73\nData_Area_Beg\n7\nData_Area_End\n2"));
    EXPECT_EQ(document.modules.at(1).reference, 2U) << "no number of the area is the module's";
}

TEST(GsdCheck, TakesTheTextsOfDiagnosisBitsThatAreNotSet)
{
    const std::string bits = "Unit_Diag_Bit(7) = \"tripped\"\nUnit_Diag_Bit_Help(7) = \"reset it\"\n"
                             "Unit_Diag_Not_Bit(7) = \"ready\"\nUnit_Diag_Not_Bit_Help(7) = \"start it\"";
    EXPECT_THAT(findings_of(file("Unit_Diag_Bit(7) = \"tripped\"", bits)), IsEmpty());
    EXPECT_THAT(findings_of(file("Unit_Diag_Bit(7)", "Unit_Diag_Not_Bit")),
                ElementsAre(StartsWith("19: error: Unit_Diag_Not_Bit needs a number")));
}

TEST(GsdCheck, TakesATextForANegativeValue)
{
    EXPECT_THAT(
        findings_of(file("GSD_Revision", "PrmText = 1\nText(-1) = \"down\"\nEndPrmText\nGSD_Revision")),
        IsEmpty());
}

TEST(GsdCheck, SaysOnlyThatThereIsNoSectionWhereThereIsNone)
{
    EXPECT_THAT(findings_of("MZ this is a program\r\n"),
                ElementsAre(StartsWith("0: error: there is no line #Profibus_DP")));
}

/// What a command that opens the file has to say: the program goes on without these lines.
TEST(GsdCheck, MarksTheLinesThatAreNotUnderstood)
{
    const auto unread = [](const std::string& from, const std::string& to) {
        std::vector<unsigned> lines;
        for (const gsd::Finding& one : gsd::check(gsd::parse(file(from, to)), Reading::tolerant))
            if (one.unread) lines.push_back(one.line);
        return lines;
    };
    EXPECT_THAT(unread("Max_Module = 2", "Max_Modul = 2"), ElementsAre(24U));
    EXPECT_THAT(unread("Max_Module = 2", "Max_Module 2"), ElementsAre(24U));
    EXPECT_THAT(unread("Max_Module = 2", "Max_Module = two"), ElementsAre(24U));
    EXPECT_THAT(unread("Modular_Station = 1", "Modular_Station = yes"), ElementsAre(23U));
    EXPECT_THAT(unread("\"EXAMPLE\"", "EXAMPLE"), ElementsAre(3U));
    EXPECT_THAT(unread("0x01,2", "0x01.2"), ElementsAre(21U));
    EXPECT_THAT(unread("0x73", "0y73"), ElementsAre(31U));
    EXPECT_THAT(unread("Module = \"four", "Moduel = \"four"), Contains(31U));
    EXPECT_THAT(unread("Fail_Safe = 0", "Colour = 5"), IsEmpty()) << "it may be of a standard that is newer";
    EXPECT_THAT(unread("MaxTsdr_500 = 100\n", ""), IsEmpty()) << "every line was read";
}

TEST(GsdCheck, ComparesTheFilesNameWithTheIdent)
{
    EXPECT_THAT(findings_of(file(), Reading::tolerant, "exmp4711.gsd"), IsEmpty());
    EXPECT_THAT(findings_of(file(), Reading::tolerant, "EXMP4711.GSG"), IsEmpty());
    EXPECT_THAT(findings_of(file(), Reading::tolerant, "EURO0533.GSD"),
                ElementsAre(StartsWith("6: warning: the file's name \"EURO0533.GSD\" does not end in 4711")));
    EXPECT_THAT(
        findings_of(file(), Reading::tolerant, "drive.gsd"),
        ElementsAre(StartsWith("0: warning: the file's name \"drive.gsd\" is not of the form VVVVIIII.GSD")));
    EXPECT_THAT(findings_of(file(), Reading::tolerant, "EXMP4711.txt"),
                ElementsAre(StartsWith("0: warning: the file's name \"EXMP4711.txt\" does not end in .GSD")));
}

} // namespace
} // namespace dpslave
