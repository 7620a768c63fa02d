// SPDX-License-Identifier: Apache-2.0
// User parameters in the new style: ExtUserPrmData, PrmText and the references to them (wire
// reference 9.2, 9.4).
#include "second_hand.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using test::findings_of;
using test::with;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

/// The definitions of wire reference 9.2, used by a device and by a module.
const std::string kGoodParameters = R"(#Profibus_DP
PrmText=1
Text(0)="off"
Text(1)="on"
EndPrmText
ExtUserPrmData=1 "Filter"
Bit(0) 0 0-1
Prm_Text_Ref=1
EndExtUserPrmData
ExtUserPrmData=2 "Limit"
Unsigned16 100 0-1000
EndExtUserPrmData
ExtUserPrmData=3 "Mode"
BitArea(4-6) 2 0,1,2,5
EndExtUserPrmData
ExtUserPrmData=4 "Trim"
Signed8 -5 -10-10
EndExtUserPrmData
GSD_Revision = 3
Vendor_Name = "EXAMPLE"
Model_Name = "Parameters"
Revision = "1"
Ident_Number = 0x4711
Protocol_Ident = 0
Station_Type = 0
Hardware_Release = "1"
Software_Release = "1"
9.6_supp = 1
MaxTsdr_9.6 = 60
Slave_Family = 0
Fail_Safe = 0
Min_Slave_Intervall = 20
Max_Diag_Data_Len = 6
Max_User_Prm_Data_Len = 4
Ext_User_Prm_Data_Const(0) = 0,0,0,0
Ext_User_Prm_Data_Ref(0) = 1
Ext_User_Prm_Data_Ref(0) = 3
Ext_User_Prm_Data_Ref(1) = 2
Modular_Station = 0
Module = "a word" 0x50
1
Ext_Module_Prm_Data_Len = 1
Ext_User_Prm_Data_Ref(0) = 4
EndModule
)";

std::vector<std::string> strict_findings(const std::string& text)
{
    std::string out;
    for (const char each : text) out += each == '\n' ? std::string{"\r\n"} : std::string{each};
    return findings_of(out, gsd::Reading::strict);
}

TEST(GsdParameters, OfTheReferenceAreGood)
{
    EXPECT_THAT(strict_findings(kGoodParameters), IsEmpty());
}

struct BadDefinition {
    const char* name;
    const char* from;
    const char* to;
    const char* finding;
};
void PrintTo(const BadDefinition& bad, std::ostream* out)
{
    *out << bad.name;
}

class BadParameter : public testing::TestWithParam<BadDefinition> {};

TEST_P(BadParameter, IsReportedWithItsLine)
{
    EXPECT_THAT(strict_findings(with(kGoodParameters, GetParam().from, GetParam().to)),
                ElementsAre(StartsWith(GetParam().finding)));
}

INSTANTIATE_TEST_SUITE_P(
    Gsd, BadParameter,
    testing::Values(
        BadDefinition{"DefaultAboveItsRange", "Unsigned16 100 0-1000", "Unsigned16 1001 0-1000",
                      "11: error: the default 1001 is not among the legal values"},
        BadDefinition{"DefaultNotInTheList", "BitArea(4-6) 2 0,1,2,5", "BitArea(4-6) 3 0,1,2,5",
                      "14: error: the default 3 is not among the legal values"},
        BadDefinition{"DefaultAboveItsType", "Bit(0) 0 0-1", "Bit(0) 2 0-2",
                      "7: error: the default 2 is not among"},
        BadDefinition{"DefaultBelowItsType", "Signed8 -5 -10-10", "Signed8 -129",
                      "17: error: the default -129 is not among"},
        BadDefinition{"UnknownType", "Unsigned16 100 0-1000", "Float32 100",
                      "10: error: this ExtUserPrmData has no line with type"},
        BadDefinition{"BitBeyondItsOctet", "Signed8 -5 -10-10", "Bit(8) 0 0-1",
                      "16: error: this ExtUserPrmData has no line with type"},
        BadDefinition{"NoNumber", "ExtUserPrmData=2", "PrmText=x\nEndPrmText\nExtUserPrmData=2",
                      "10: error: PrmText has no number"},
        BadDefinition{"RepeatedText", "ExtUserPrmData=2", "PrmText=1\nEndPrmText\nExtUserPrmData=2",
                      "10: error: PrmText 1 is there already"},
        BadDefinition{"RepeatedDefinition", "ExtUserPrmData=2",
                      "ExtUserPrmData=1\nBit(0) 0\nEndExtUserPrmData\nExtUserPrmData=2",
                      "10: error: ExtUserPrmData 1 is there already"},
        BadDefinition{"UnknownText", "Prm_Text_Ref=1", "Prm_Text_Ref=2",
                      "8: error: there is no PrmText 2 before this line"},
        BadDefinition{"BeyondTheLength", "Ext_User_Prm_Data_Ref(1) = 2", "Ext_User_Prm_Data_Ref(3) = 2",
                      "38: error: this reaches beyond Max_User_Prm_Data_Len = 4"},
        BadDefinition{"OverlappingBits", "Ext_User_Prm_Data_Ref(1) = 2", "Ext_User_Prm_Data_Ref(0) = 2",
                      "38: error: this parameter lies on bits that another one has already"},
        BadDefinition{"ConstantsBeyondTheLength", "= 0,0,0,0", "= 0,0,0,0,0",
                      "35: error: this reaches beyond Max_User_Prm_Data_Len"},
        BadDefinition{"NoLengthInTheModule", "Ext_Module_Prm_Data_Len = 1\n", "",
                      "42: error: Ext_Module_Prm_Data_Len is missing"}),
    [](const auto& one) { return std::string{one.param.name}; });

TEST(GsdParameters, ThatOverlapOrLackTheirLengthAreAWarningInFilesOfOthers)
{
    const auto tolerant = [](const std::string& text) {
        std::string out;
        for (const char each : text) out += each == '\n' ? std::string{"\r\n"} : std::string{each};
        return findings_of(out, gsd::Reading::tolerant);
    };
    EXPECT_THAT(
        tolerant(with(kGoodParameters, "Ext_User_Prm_Data_Ref(1) = 2", "Ext_User_Prm_Data_Ref(0) = 2")),
        ElementsAre(StartsWith("38: warning: this parameter lies on bits")));
    EXPECT_THAT(tolerant(with(kGoodParameters, "Ext_Module_Prm_Data_Len = 1\n", "")),
                ElementsAre(StartsWith("42: warning: Ext_Module_Prm_Data_Len is missing")));
}

TEST(GsdParameters, MustBeDefinedBeforeTheyAreUsed)
{
    const std::string late = "ExtUserPrmData=2 \"Limit\"\nUnsigned16 100 0-1000\nEndExtUserPrmData\n";
    EXPECT_THAT(strict_findings(with(kGoodParameters, late, "") + late),
                ElementsAre(StartsWith("35: error: there is no ExtUserPrmData 2 before this line")));
    EXPECT_THAT(strict_findings(with(kGoodParameters, late, "")),
                ElementsAre(StartsWith("35: error: there is no ExtUserPrmData 2 before this line")));
}

} // namespace
} // namespace dpslave
