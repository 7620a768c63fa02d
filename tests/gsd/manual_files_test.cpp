// SPDX-License-Identifier: Apache-2.0
// The two listings of HA389815 appendix A as they are printed (A-100 to A-111, X-02), against the files that
// are shipped.
#include "second_hand.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using test::findings_of;
using test::kSource;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view k584sAnd590 = R"(#Profibus_DP
Vendor_Name = "EUROTHERM"
Model_Name = "584S/590"
Revision = "Revision_1"
Ident_Number = 0x0533
Protocol_Ident = 0 ;PROFIBUS DP
Station_Type = 0 ;DP-Slave
FMS_supp = 0
Hardware_Release = "HW_V2.0"
Software_Release = "SW_V5.0"
9.6_supp = 1
19.2_supp = 1
93.75_supp = 1
187.5_supp = 1
500_supp = 1
1.5M_supp = 1
MaxTsdr_9.6 = 60
MaxTsdr_19.2 = 60
MaxTsdr_93.75 = 60
MaxTsdr_187.5 = 60
MaxTsdr_500 = 100
MaxTsdr_1.5M = 150
Redundancy = 0
Repeater_Ctrl_Sig = 2 ;TTL
24V_Pins = 0
Freeze_Mode_supp = 1
Sync_Mode_supp = 1
Auto_Baud_supp = 1
Set_Slave_Add_supp = 0
Min_Slave_Intervall = 20
;User_Prm_Data
User_Prm_data_Len = 0x18 ;maximum 12 values
User_Prm_Data = 0x00,0x00,0x00,0x00,0x00,0x00,0x00,0x00,\
0x00,0x00,0x00,0x00,0x00,0x00,0x00,0x00,\
0x00,0x00,0x00,0x00,0x00,0x00,0x00,0x00
;Diag_Data
Max_Diag_Data_Len = 0x06
;Exchange_Data
Modular_Station = 1
Max_Module = 0x0d
Max_Input_Len = 0x20
Max_Output_Len = 0x20
Max_Data_Len = 0x0040
Module = "Demand-Data" 0x73
EndModule
Module = "Process-Data-Input" 0x50
EndModule
Module = "Process-Data-Output" 0x60
EndModule
)";

constexpr std::string_view k620 = R"(#Profibus_DP
Vendor_Name = "EUROTHERM"
Model_Name = "620"
Revision = "Revision_1"
Ident_Number = 0x0533
Protocol_Ident = 0           ;PROFIBUS DP
Station_Type = 0            ;DP-Slave
FMS_supp = 0
Hardware_Release = "HW_V2.3"
Software_Release = "SW_V4.0"
9.6_supp = 1
19.2_supp = 1
93.75_supp = 1
187.5_supp = 1
500_supp = 1
1.5M_supp = 1
MaxTsdr_9.6 = 60
MaxTsdr_19.2 = 60
MaxTsdr_93.75 = 60
MaxTsdr_187.5 = 60
MaxTsdr_500 = 100
MaxTsdr_1.5M = 150
Redundancy = 0
Repeater_Ctrl_Sig = 2       ;TTL
24V_Pins = 0
Freeze_Mode_supp = 1
Sync_Mode_supp = 1
Auto_Baud_supp = 1
Set_Slave_Add_supp = 0
Min_Slave_Intervall = 20
;User_Prm_Data
User_Prm_data_Len = 24      ;maximum 12 values
User_Prm_Data = 0x00,0x00,0x00,0x00,0x00,0x00,0x00,0x00,\
                0x00,0x00,0x00,0x00,0x00,0x00,0x00,0x00,\
                0x00,0x00,0x00,0x00,0x00,0x00,0x00,0x00
;Diag_Data
Min_Slave_Intervall = 20
;Exchange_Data
Modular_Station = 1
Max_Module = 13
Max_Input_Len = 32
Max_Output_Len = 32
Max_Data_Len = 40
Module = "DEMAND_DATA" 0x73
EndModule
Module = "PROZESS_DATA_LESEN" 0x50
EndModule
Module = "PROZESS_DATA_SCHREIBEN" 0x60
EndModule
)";

/// The manual's files have CR LF.
std::string with_cr_lf(std::string_view text)
{
    std::string out;
    for (const char each : text) out += each == '\n' ? std::string{"\r\n"} : std::string{each};
    return out;
}

std::string shipped(const char* folder)
{
    return test::content_of(kSource / "gsd/manual" / folder / "EURO0533.GSD");
}

TEST(ManualGsd, OfThe584SAnd590IsTheFirstListingOfAppendixA)
{
    EXPECT_EQ(shipped("584s-590"), with_cr_lf(k584sAnd590));
}

TEST(ManualGsd, OfThe620IsTheSecondListingOfAppendixA)
{
    EXPECT_EQ(shipped("620"), with_cr_lf(k620));
}

TEST(ManualGsd, OfThe584SAnd590IsReadByTheMastersTools)
{
    EXPECT_THAT(findings_of(shipped("584s-590"), gsd::Reading::tolerant, "EURO0533.GSD"),
                ElementsAre(StartsWith("0: warning: GSD_Revision is missing")));
}

TEST(ManualGsd, OfThe620LacksMaxDiagDataLenWhereMinSlaveIntervallIsRepeated)
{
    EXPECT_THAT(findings_of(shipped("620"), gsd::Reading::tolerant, "EURO0533.GSD"),
                ElementsAre(StartsWith("0: warning: GSD_Revision is missing"),
                            StartsWith("0: warning: Max_Diag_Data_Len is missing: add Max_Diag_Data_Len = 6"),
                            "37: warning: Min_Slave_Intervall is here a second time (first in line 30): "
                            "remove one of them."));
}

TEST(ManualGsd, SpellsUserPrmDataLenAsNoStandardDoesWhichStrictReadingReports)
{
    EXPECT_THAT(
        findings_of(shipped("584s-590"), gsd::Reading::strict, "EURO0533.GSD"),
        testing::Contains("32: error: \"User_Prm_data_Len\": the standard spells it \"User_Prm_Data_Len\"."));
}

TEST(ManualGsd, LongestDataOf40AndOf64AreBothAccepted)
{
    for (const char* folder : {"584s-590", "620"})
        EXPECT_THAT(findings_of(shipped(folder), gsd::Reading::strict),
                    Not(testing::Contains(HasSubstr("Max_Data_Len"))))
            << folder;
}

} // namespace
} // namespace dpslave
