// SPDX-License-Identifier: Apache-2.0
// Tests what a master sends that knows nothing but a GSD (wire reference 4.4, 4.5, 9.2). All octets are
// written by hand.
#include "dpsim/master/gsd_station.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

GsdStation station(const std::string& lines, const std::vector<std::string>& modules = {})
{
    const auto file = parse_gsd("#Profibus_DP\nIdent_Number = 0x4711\n" + lines);
    EXPECT_TRUE(file);
    const auto found = station_of(*file, modules);
    EXPECT_TRUE(found) << (found ? "" : found.error());
    return found ? *found : GsdStation{};
}

std::string fault(const std::string& lines, const std::vector<std::string>& modules = {})
{
    const auto file = parse_gsd("#Profibus_DP\nIdent_Number = 0x4711\n" + lines);
    EXPECT_TRUE(file);
    const auto found = station_of(*file, modules);
    return found ? "" : found.error();
}

const std::string kOneModule = "Module = \"2 in, 2 out\" 0x11,0x21\n1\nEndModule\n";
const std::string kThreeModules = "Modular_Station = 1\nMax_Module = 4\n"
                                  "Module = \"Word in\" 0x50\nEndModule\n"
                                  "Module = \"Word, out\" 0x60\nEndModule\n"
                                  "Module = \"WORD IN\" 0x70\nEndModule\n"
                                  "Module = \"Empty\" 0x00\nEndModule\n";

TEST(GsdStation, OfACompactFileHasItsOneModule)
{
    const GsdStation found = station("Vendor_Name = \"Maker\"\nModel_Name=\"Thing\"\nModular_Station = 0\n"
                                     "Sync_Mode_supp = 1\nFreeze_Mode_supp = 0\n"
                                     "User_Prm_Data_Len = 3\nUser_Prm_Data = 1,2,3\n" +
                                     kOneModule);
    EXPECT_EQ(found.vendor, "Maker");
    EXPECT_EQ(found.model, "Thing");
    EXPECT_EQ(found.ident, 0x4711);
    EXPECT_TRUE(found.sync);
    EXPECT_FALSE(found.freeze);
    EXPECT_EQ(found.user_prm, wire("01 02 03"));
    EXPECT_EQ(found.cfg, wire("11 21"));
    EXPECT_EQ(found.lengths.inputs, 2U);
    EXPECT_EQ(found.lengths.outputs, 2U);
    EXPECT_THAT(found.modules, ElementsAre("2 in, 2 out"));
}

TEST(GsdStation, FillsOrCutsTheOldStyleToItsLength)
{
    EXPECT_EQ(station("User_Prm_Data_Len = 4\nUser_Prm_Data = 1,2\n" + kOneModule).user_prm,
              wire("01 02 00 00"));
    EXPECT_EQ(station("User_Prm_data_Len = 0x1\nUser_Prm_Data = 1,2\n" + kOneModule).user_prm, wire("01"));
    EXPECT_EQ(station("User_Prm_Data_Len = 2\n" + kOneModule).user_prm, wire("00 00"));
    EXPECT_EQ(station("User_Prm_Data = 1,2\n" + kOneModule).user_prm, Octets{})
        << "the default of User_Prm_Data_Len is 0";
}

TEST(GsdStation, PutsConstantsAndDefaultsOfTheNewStyleTogether)
{
    const std::string lines = "ExtUserPrmData=1 \"bit\"\nBit(7) 1 0-1\nEndExtUserPrmData\n"
                              "ExtUserPrmData=2 \"area\"\nBitArea(1-3) 2 0-7\nEndExtUserPrmData\n"
                              "ExtUserPrmData=3 \"word\"\nUnsigned16 0x0102 0-65535\nEndExtUserPrmData\n"
                              "ExtUserPrmData=4 \"long\"\nSigned32 -2 -5-5\nEndExtUserPrmData\n"
                              "Max_User_Prm_Data_Len = 20\n"
                              "Ext_User_Prm_Data_Ref(3) = 1\n"
                              "Ext_User_Prm_Data_Ref(3) = 2\n"
                              "Ext_User_Prm_Data_Ref(4) = 3\n"
                              "Ext_User_Prm_Data_Ref(7) = 4\n"
                              "Ext_User_Prm_Data_Const(0) = 0xC0,0x60,0x00,0x0F\n";
    EXPECT_EQ(station(lines + kOneModule).user_prm, wire("C0 60 00 85 01 02 00 FF FF FF FE"))
        << "bits that no parameter has stay those of the constant; the maximum is not filled up";
}

TEST(GsdStation, TakesTheNewStyleWhereBothAreThere)
{
    EXPECT_EQ(
        station("User_Prm_Data_Len = 2\nUser_Prm_Data = 1,2\nExt_User_Prm_Data_Const(0) = 9\n" + kOneModule)
            .user_prm,
        wire("09"));
    EXPECT_EQ(station("User_Prm_Data_Len = 2\nUser_Prm_Data = 1,2\nMax_User_Prm_Data_Len = 5\n" + kOneModule)
                  .user_prm,
              Octets{});
}

TEST(GsdStation, AppendsThePartsOfTheModulesInTheOrderOfTheSlots)
{
    const std::string lines = "Modular_Station = 1\nUser_Prm_Data_Len = 1\nUser_Prm_Data = 0xAA\n"
                              "ExtUserPrmData=1 \"mode\"\nBitArea(0-1) 3 0-3\nEndExtUserPrmData\n"
                              "Module = \"a\" 0x42,0x01,0xAA,0xBB\nExt_Module_Prm_Data_Len = 3\n"
                              "Ext_User_Prm_Data_Const(0) = 0x10\nExt_User_Prm_Data_Ref(1) = 1\nEndModule\n"
                              "Module = \"b\" 0xC1,0x00,0x41,0x05\nExt_Module_Prm_Data_Len = 1\n"
                              "Ext_User_Prm_Data_Const(0) = 0x20,0x21\nEndModule\n"
                              "Module = \"c\" 0x00\nExt_User_Prm_Data_Const(1) = 7\nEndModule\n";
    const GsdStation found = station(lines, {"b", "c", "A", "b"});
    EXPECT_EQ(found.user_prm, wire("AA 20 00 07 10 03 00 20"));
    EXPECT_EQ(found.cfg, wire("C1 00 41 05 00 42 01 AA BB C1 00 41 05"));
    EXPECT_EQ(found.lengths.inputs, 4U + 2 + 4) << "a length octet in words, one in octets";
    EXPECT_EQ(found.lengths.outputs, 1U + 1);
}

TEST(GsdStation, TakesNamesInAnyCaseAndPlacesInTheFile)
{
    EXPECT_EQ(station(kThreeModules, {"#3", "wORD, oUT", "#1", "empty"}).cfg, wire("70 60 50 00"));
    EXPECT_THAT(station(kThreeModules, {"#3"}).modules, ElementsAre("WORD IN"));
}

TEST(GsdStation, RefusesNamesThatAreNoneOrSeveralAndListsTheModules)
{
    const std::string list = "The modules are:\n  #1 Word in (50)\n  #2 Word, out (60)\n  #3 WORD IN (70)\n"
                             "  #4 Empty (00)";
    EXPECT_EQ(fault(kThreeModules, {"Word"}), "no module is called 'Word'. " + list);
    EXPECT_EQ(fault(kThreeModules, {"Empty", "word in"}),
              "several modules are called 'word in': write the place of the one that is meant, as '#1'. " +
                  list);
    EXPECT_EQ(fault(kThreeModules, {"#5"}), "there is no module #5. " + list);
    EXPECT_EQ(fault(kThreeModules, {"#0"}), "there is no module #0. " + list);
    EXPECT_EQ(fault(kThreeModules, {""}), "no module is called ''. " + list);
    EXPECT_EQ(fault(kThreeModules),
              "no module is plugged from the start: write --modules NAME,... with the names, "
              "or places as '#1', in the order of the slots. " +
                  list);
}

TEST(GsdStation, WithoutNamesHasThePresetModules)
{
    const std::string preset =
        "Modular_Station = 1\nModule=\"a\" 0x10\nEndModule\n"
        "Module=\"b\" 0x20\nPreset = 1\nEndModule\nModule=\"c\" 0x30\nPreset=1\nEndModule\n";
    EXPECT_EQ(station(preset).cfg, wire("20 30"));
    EXPECT_EQ(station(preset, {"a"}).cfg, wire("10")) << "names are all that is plugged";
}

TEST(GsdStation, OfACompactFileWithSeveralModulesWantsToKnowWhich)
{
    const std::string several = "Module=\"a\" 0x10\nEndModule\nModule=\"b\" 0x20\nEndModule\n";
    EXPECT_THAT(fault(several), HasSubstr("write --modules"));
    EXPECT_EQ(station(several, {"b"}).cfg, wire("20"));
}

TEST(GsdStation, OfAModularFileWithOneModuleWantsToKnowHowOften)
{
    const std::string one = "Modular_Station = 1\n" + kOneModule;
    EXPECT_THAT(fault(one), HasSubstr("write --modules"));
    EXPECT_EQ(station(one, {"#1", "#1"}).cfg, wire("11 21 11 21"));
}

TEST(GsdStation, IsRefusedWhereItHasMoreThanTheFileAllows)
{
    EXPECT_THAT(fault(kThreeModules, {"#1", "#1", "#1", "#1", "#1"}), HasSubstr("Max_Module = 4, but"));
    EXPECT_THAT(fault(kThreeModules + "Max_Input_Len = 3\n", {"#1", "#1"}), HasSubstr("Max_Input_Len = 3"));
    EXPECT_THAT(fault(kThreeModules + "Max_Output_Len = 3\n", {"#2", "#2"}), HasSubstr("Max_Output_Len = 3"));
    EXPECT_THAT(fault(kThreeModules + "Max_Data_Len = 3\n", {"#1", "#2"}), HasSubstr("make 4"));
    EXPECT_THAT(fault("Max_User_Prm_Data_Len = 2\nExt_User_Prm_Data_Const(0) = 1,2,3\n" + kOneModule),
                HasSubstr("Max_User_Prm_Data_Len = 2, but the modules make 3"));
    EXPECT_EQ(fault("Max_Input_Len = 1\nMax_Module = 0\n" + kOneModule), "")
        << "these are of modular stations";
}

TEST(GsdStation, IsRefusedWhereNoTelegramCanCarryIt)
{
    EXPECT_THAT(fault("Module=\"a\" 0x40\nEndModule\n"), HasSubstr("its length octet is missing"));
    EXPECT_THAT(fault("Module=\"a\" 0x40,0xFF,0x40,0xFF\nEndModule\n"), HasSubstr("244 are the limit"));
    EXPECT_THAT(fault("Ext_User_Prm_Data_Const(236) = 1,2\n" + kOneModule),
                HasSubstr("ends after octet 236"));
    EXPECT_EQ(station("Ext_User_Prm_Data_Const(236) = 1\n" + kOneModule).user_prm.size(), 237U);
    EXPECT_THAT(
        fault(
            "Ext_User_Prm_Data_Const(236) = 1\nModule=\"a\" 0x10\nExt_User_Prm_Data_Const(0)=1\nEndModule\n"),
        HasSubstr("User_Prm_Data of 238 octets"));
}

TEST(GsdStation, SaysInWhichLineAFileIsWrong)
{
    EXPECT_EQ(fault("User_Prm_Data_Len = 238\n" + kOneModule),
              "line 3: User_Prm_Data_Len = 238, but it is a number from 0 to 237");
    EXPECT_EQ(fault("User_Prm_Data_Len = 2\nUser_Prm_Data = 1,256\n" + kOneModule),
              "line 4: '1,256' is no list of octets");
    EXPECT_EQ(fault("Ext_User_Prm_Data_Const = 1\n" + kOneModule),
              "line 3: Ext_User_Prm_Data_Const has no offset in brackets");
    EXPECT_EQ(fault("Ext_User_Prm_Data_Const(0) = x\n" + kOneModule), "line 3: 'x' is no list of octets");
    EXPECT_EQ(fault("Ext_User_Prm_Data_Ref(0) = 8\n" + kOneModule), "line 3: there is no ExtUserPrmData = 8");
    EXPECT_EQ(
        fault("ExtUserPrmData=8 \"a\"\nOctetString 1\nEndExtUserPrmData\nExt_User_Prm_Data_Ref(0) = 8\n" +
              kOneModule),
        "line 4: 'OctetString 1' is no type of a parameter that is known");
    EXPECT_EQ(fault("Module=\"a\" x\nEndModule\n"), "line 3: 'x' are no identifier octets");
    EXPECT_EQ(fault("Modular_Station = 0\n"), "there is no module in it");
    EXPECT_EQ(station_of(*parse_gsd("#Profibus_DP\n" + kOneModule), {}).error(),
              "there is no Ident_Number in it");
    EXPECT_EQ(fault("Ident_Number = 0x10000\n" + kOneModule),
              "line 3: Ident_Number = 0x10000, but it is a number from 0 to 65535");
}

TEST(GsdStation, DoesNotMakeTheParametersOfProfisafe)
{
    EXPECT_EQ(fault("Module=\"safe\" 0x10\nF_Ext_User_Prm_Data_Const(0) = 1\nEndModule\n"),
              "module 'safe' has parameters of PROFIsafe, which dpsim does not make");
}

TEST(GsdTelegrams, AreSetPrmAndChkCfgOfAMasterWithThatFile)
{
    const std::string text =
        "#Profibus_DP\nIdent_Number = 0x1649\nFreeze_Mode_supp = 1\nModular_Station = 1\n"
        "User_Prm_Data_Len = 2\nUser_Prm_Data = 0x0A,0x0B\n"
        "Module = \"in\" 0x50\nEndModule\nModule = \"out\" 0x60\nEndModule\n";
    MasterSettings others;
    others.watchdog = std::chrono::milliseconds{70}; // 7 x 10 ms
    others.min_tsdr = 12;
    others.group = 0x81;
    const auto telegrams = gsd_telegrams(text, {"out", "in"}, others);
    ASSERT_TRUE(telegrams);
    EXPECT_EQ(telegrams->set_prm[1] * telegrams->set_prm[2], 7);
    EXPECT_EQ(telegrams->set_prm[0], 0x98) << "lock, Freeze, watchdog; the file has no Sync";
    EXPECT_EQ((Octets{telegrams->set_prm.begin() + 3, telegrams->set_prm.end()}), wire("0C 16 49 81 0A 0B"));
    EXPECT_EQ(telegrams->chk_cfg, wire("60 50"));

    others.freeze = false;
    others.watchdog = std::chrono::milliseconds{0};
    EXPECT_EQ(gsd_telegrams(text, {"in"}, others)->set_prm, wire("80 01 01 0C 16 49 81 0A 0B"));
    EXPECT_THAT(gsd_telegrams(text, {}).error(), HasSubstr("#2 out (60)"));
    EXPECT_THAT(gsd_telegrams("", {}).error(), HasSubstr("#Profibus_DP"));
}

} // namespace
} // namespace dpslave::sim
