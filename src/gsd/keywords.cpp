// SPDX-License-Identifier: Apache-2.0
#include "keywords.hpp"

#include "text.hpp"

#include "dpslave/base/edit_distance.hpp"

#include <algorithm>

namespace dpslave::gsd {
namespace {

constexpr Keyword number(std::string_view name, std::uint32_t min, std::uint32_t max,
                         std::uint8_t revision = 0)
{
    return {name, Kind::number, min, max, revision, kUnit, false, false};
}
constexpr Keyword boolean(std::string_view name, std::uint8_t revision = 0)
{
    return {name, Kind::boolean, 0, 1, revision, kUnit, false, false};
}
constexpr Keyword text(std::string_view name, std::uint32_t longest, std::uint8_t revision = 0,
                       std::uint8_t places = kUnit)
{
    return {name, Kind::text, 0, longest, revision, places, false, false};
}
constexpr Keyword indexed(std::string_view name, Kind kind, std::uint32_t max, std::uint8_t revision,
                          std::uint8_t places = kUnit)
{
    return {name, kind, 0, max, revision, places, true, false};
}
constexpr Keyword dpv1(std::string_view name, std::uint32_t max)
{
    return {name, max == 1 ? Kind::boolean : Kind::number, 0, max, 3, kUnit, false, true};
}
/// Known, but its value is not judged here.
constexpr Keyword other(std::string_view name, std::uint8_t revision, std::uint8_t places = kUnit)
{
    return {name, Kind::other, 0, 0, revision, places, false, false};
}

constexpr std::array kKeywords = std::to_array<Keyword>({
    number("GSD_Revision", 1, 5, 1),
    text("Vendor_Name", 32),
    text("Model_Name", 32),
    text("Revision", 32),
    number("Revision_Number", 1, 63, 1),
    number("Ident_Number", 0, 0xFFFF),
    number("Protocol_Ident", 0, 255),
    number("Station_Type", 0, 1),
    boolean("FMS_supp"),
    text("Hardware_Release", 32),
    text("Software_Release", 32),
    boolean("9.6_supp"),
    boolean("19.2_supp"),
    boolean("31.25_supp", 2),
    boolean("45.45_supp", 2),
    boolean("93.75_supp"),
    boolean("187.5_supp"),
    boolean("500_supp"),
    boolean("1.5M_supp"),
    boolean("3M_supp"),
    boolean("6M_supp"),
    boolean("12M_supp"),
    number("MaxTsdr_9.6", 0, 0xFFFF),
    number("MaxTsdr_19.2", 0, 0xFFFF),
    number("MaxTsdr_31.25", 0, 0xFFFF, 2),
    number("MaxTsdr_45.45", 0, 0xFFFF, 2),
    number("MaxTsdr_93.75", 0, 0xFFFF),
    number("MaxTsdr_187.5", 0, 0xFFFF),
    number("MaxTsdr_500", 0, 0xFFFF),
    number("MaxTsdr_1.5M", 0, 0xFFFF),
    number("MaxTsdr_3M", 0, 0xFFFF),
    number("MaxTsdr_6M", 0, 0xFFFF),
    number("MaxTsdr_12M", 0, 0xFFFF),
    boolean("Redundancy"),
    number("Repeater_Ctrl_Sig", 0, 2),
    number("24V_Pins", 0, 2),
    text("Implementation_Type", 32, 1),
    text("Bitmap_Device", 8, 1),
    text("Bitmap_Diag", 8, 1),
    text("Bitmap_SF", 8, 1),
    text("OrderNumber", 32),
    text("Info_Text", 256, 3, kUnit | kModule),

    boolean("Freeze_Mode_supp"),
    boolean("Sync_Mode_supp"),
    boolean("Auto_Baud_supp"),
    boolean("Set_Slave_Add_supp"),
    boolean("Fail_Safe", 1),
    boolean("Fail_Safe_required", 3),
    number("Min_Slave_Intervall", 0, 0xFFFF),
    boolean("Modular_Station"),
    number("Max_Module", 0, 255),
    number("Max_Input_Len", 0, 244),
    number("Max_Output_Len", 0, 244),
    number("Max_Data_Len", 0, 488),
    number("Max_Diag_Data_Len", 6, 244, 1),
    number("Modul_Offset", 0, 255, 1),
    {"Slave_Family", Kind::family, 0, 12, 1, kUnit, false, false},
    number("Diag_Update_Delay", 0, 255, 2),
    boolean("FixPresetModules", 1),
    number("User_Prm_Data_Len", 0, 237),
    {"User_Prm_Data", Kind::octets, 0, 237, 0, kUnit, false, false},
    number("Max_User_Prm_Data_Len", 0, 237, 1),
    indexed("Ext_User_Prm_Data_Const", Kind::octets, 237, 1, kUnit | kModule),
    indexed("Ext_User_Prm_Data_Ref", Kind::number, 0xFFFF, 1, kUnit | kModule),
    indexed("Unit_Diag_Bit", Kind::text, 32, 0),
    indexed("Unit_Diag_Bit_Help", Kind::text, 256, 3),
    indexed("Unit_Diag_Not_Bit", Kind::text, 32, 3),
    indexed("Unit_Diag_Not_Bit_Help", Kind::text, 256, 3),
    indexed("Channel_Diag", Kind::text, 32, 0, kUnit | kModule),
    indexed("Channel_Diag_Help", Kind::text, 256, 3, kUnit | kModule),
    {"Ext_Module_Prm_Data_Len", Kind::number, 0, 237, 1, kModule, false, false},
    {"Preset", Kind::boolean, 0, 1, 1, kModule, false, false},

    boolean("DPV1_Slave", 3),
    dpv1("C1_Read_Write_supp", 1),
    dpv1("C1_Max_Data_Len", 240),
    dpv1("C1_Response_Timeout", 0xFFFF),
    dpv1("C1_Read_Write_required", 1),
    dpv1("C2_Read_Write_supp", 1),
    dpv1("C2_Max_Data_Len", 240),
    dpv1("C2_Response_Timeout", 0xFFFF),
    dpv1("C2_Read_Write_required", 1),
    dpv1("C2_Max_Count_Channels", 49),
    dpv1("Max_Initiate_PDU_Length", 255),
    dpv1("Diagnostic_Alarm_supp", 1),
    dpv1("Process_Alarm_supp", 1),
    dpv1("Pull_Plug_Alarm_supp", 1),
    dpv1("Status_Alarm_supp", 1),
    dpv1("Update_Alarm_supp", 1),
    dpv1("Manufacturer_Specific_Alarm_supp", 1),
    dpv1("Diagnostic_Alarm_required", 1),
    dpv1("Process_Alarm_required", 1),
    dpv1("Pull_Plug_Alarm_required", 1),
    dpv1("Status_Alarm_required", 1),
    dpv1("Update_Alarm_required", 1),
    dpv1("Manufacturer_Specific_Alarm_required", 1),
    dpv1("Extra_Alarm_SAP_supp", 1),
    dpv1("Alarm_Sequence_Mode_Count", 32),
    dpv1("Alarm_Type_Mode_supp", 1),
    dpv1("WD_Base_1ms_supp", 1),
    dpv1("Check_Cfg_Mode", 1),
    dpv1("DPV1_Data_Types", 1),
    other("Ident_Maintenance_supp", 3),
    other("Prm_Block_Structure_supp", 4),
    other("Prm_Block_Structure_req", 4),
    other("Publisher_supp", 3),
    other("Subscriber_supp", 3),
    other("Isochron_Mode_supp", 4),
    other("Isochron_Mode_required", 4),
    other("TBASE_DP", 4),
    other("TDP_MIN", 4),
    other("TDP_MAX", 4),
    other("T_PLL_W_MAX", 4),
    other("TBASE_IO", 4),
    other("TI_MIN", 4),
    other("TO_MIN", 4),
    other("PrmCmd_supp", 4),
    other("Slave_Max_Switch_Over_Time", 4),
    other("Slave_Redundancy_supp", 4),
    other("Time_Sync_supp", 4),
});

constexpr std::array kBlocks = std::to_array<BlockKind>({
    {"Module", "EndModule"},
    {"PrmText", "EndPrmText"},
    {"ExtUserPrmData", "EndExtUserPrmData"},
    {"SlotDefinition", "EndSlotDefinition"},
    {"Physical_Interface", "End_Physical_Interface"},
    {"Unit_Diag_Area", "Unit_Diag_Area_End"},
    {"UnitDiagType", "EndUnitDiagType"},
});

} // namespace

const Keyword* find_keyword(std::string_view name)
{
    const auto found = std::find_if(kKeywords.begin(), kKeywords.end(), [&](const Keyword& keyword) {
        return same_any_case(keyword.name, name);
    });
    return found == kKeywords.end() ? nullptr : &*found;
}

const BlockKind* find_opening(std::string_view word)
{
    const auto found = std::find_if(kBlocks.begin(), kBlocks.end(),
                                    [&](const BlockKind& kind) { return same_any_case(kind.opens, word); });
    return found == kBlocks.end() ? nullptr : &*found;
}

const BlockKind* find_closing(std::string_view word)
{
    const auto found = std::find_if(kBlocks.begin(), kBlocks.end(),
                                    [&](const BlockKind& kind) { return same_any_case(kind.closes, word); });
    return found == kBlocks.end() ? nullptr : &*found;
}

bool DataArea::has(std::string_view keyword, std::string_view value)
{
    const std::string_view word = keyword.empty() ? value : keyword;
    const bool ends = same_any_case(word, "Data_Area_End");
    const bool belongs = open_ || ends || same_any_case(word, "Data_Area_Beg");
    open_ = belongs && !ends;
    return belongs;
}

std::string_view nearest_keyword(std::string_view name)
{
    constexpr std::size_t kLongest = 64; // longer ones are no slip of the pen
    constexpr std::size_t kApart = 2;
    if (name.size() < 4 || name.size() > kLongest) return {};
    const std::string wanted = to_lower(name);
    std::string_view nearest;
    std::size_t best = kApart + 1;
    const auto compare = [&](std::string_view known) {
        const std::size_t apart = edit_distance(wanted, to_lower(known), kApart);
        if (apart < best) {
            best = apart;
            nearest = known;
        }
    };
    for (const Keyword& keyword : kKeywords) compare(keyword.name);
    for (const BlockKind& kind : kBlocks) {
        compare(kind.opens);
        compare(kind.closes);
    }
    return nearest;
}

} // namespace dpslave::gsd
