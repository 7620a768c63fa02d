// SPDX-License-Identifier: Apache-2.0
// Tests what a master sends for a GSD file, octet by octet with the lines (wire reference 4.4, 4.5, 9.1).
#include "dpslave/gsd/sent.hpp"

#include <gmock/gmock.h>

namespace dpslave::gsd {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Document section(const std::string& lines)
{
    return parse("#Profibus_DP\r\n" + lines);
}

/// User_Prm_Data with the modules that are plugged.
std::vector<std::uint8_t> user_of(const std::string& lines)
{
    const Document document = section(lines);
    return sent_by_master(document, plugged_modules(document)).user.octets;
}

TEST(SentByMaster, HasUserPrmDataOfTheLengthThatIsSaid)
{
    EXPECT_THAT(user_of("User_Prm_Data_Len = 3\r\nUser_Prm_Data = 1,2\r\n"), ElementsAre(1, 2, 0));
    EXPECT_THAT(user_of("User_Prm_Data_Len = 1\r\nUser_Prm_Data = 1,2\r\n"), ElementsAre(1));
    EXPECT_THAT(user_of("User_Prm_Data = 1,2\r\n"), IsEmpty());
}

TEST(SentByMaster, HasTheConstantsOfTheNewStyleInTheirPlaces)
{
    EXPECT_THAT(user_of("Max_User_Prm_Data_Len = 5\r\nExt_User_Prm_Data_Const(0) = 1,2,3\r\n"
                        "Ext_User_Prm_Data_Const(3) = 9,9,9\r\n"),
                ElementsAre(1, 2, 3, 9, 9));
}

TEST(SentByMaster, HasTheDefaultsOfTheNewStyleOverTheConstants)
{
    EXPECT_THAT(user_of("ExtUserPrmData = 1 \"Tag\"\r\nUnsigned16 288 1-2047\r\nEndExtUserPrmData\r\n"
                        "ExtUserPrmData = 2 \"Mode\"\r\nBitArea(4-5) 2 0-3\r\nEndExtUserPrmData\r\n"
                        "ExtUserPrmData = 3 \"Offset\"\r\nSigned16 -2 -9-9\r\nEndExtUserPrmData\r\n"
                        "Max_User_Prm_Data_Len = 6\r\nExt_User_Prm_Data_Ref(1) = 1\r\n"
                        "Ext_User_Prm_Data_Ref(0) = 2\r\nExt_User_Prm_Data_Ref(3) = 3\r\n"
                        "Ext_User_Prm_Data_Const(0) = 0xFF,7,7\r\n"),
                ElementsAre(0xEF, 1, 32, 0xFF, 0xFE));
}

TEST(SentByMaster, HasWhatEachModuleAddsInTheOrderOfTheModules)
{
    const Document document =
        section("ExtUserPrmData = 1 \"Tag\"\r\nUnsigned16 55 1-2047\r\nEndExtUserPrmData\r\n"
                "Modular_Station = 1\r\nMax_Module = 2\r\nMax_User_Prm_Data_Len = 9\r\n"
                "Ext_User_Prm_Data_Const(0) = 0,0,0\r\n"
                "Module = \"in\" 0x50\r\n1\r\nExt_Module_Prm_Data_Len = 2\r\n"
                "Ext_User_Prm_Data_Ref(0) = 1\r\nEndModule\r\n"
                "Module = \"out\" 0x60\r\n2\r\nExt_Module_Prm_Data_Len = 2\r\n"
                "Ext_User_Prm_Data_Const(0) = 1,32\r\nEndModule\r\n");
    const Sent sent = sent_by_master(document, {&document.modules[1], &document.modules[0]});
    EXPECT_THAT(sent.user.octets, ElementsAre(0, 0, 0, 1, 32, 0, 55));
    EXPECT_THAT(sent.user.lines, ElementsAre(8, 8, 8, 17, 17, 12, 12));
    EXPECT_THAT(sent.cfg.octets, ElementsAre(0x60, 0x50));
    EXPECT_THAT(sent.cfg.lines, ElementsAre(14, 9));
}

TEST(SentByMaster, AsksForSyncAndFreezeOnlyWhereTheFileOffersThem)
{
    const auto status = [](const std::string& lines) {
        return set_prm_of(sent_by_master(section(lines), {}))[0];
    };
    EXPECT_EQ(status(""), 0x80);
    EXPECT_EQ(status("Sync_Mode_supp = 1\r\n"), 0xA0);
    EXPECT_EQ(status("Freeze_Mode_supp = 1\r\nSync_Mode_supp = 0\r\n"), 0x90);
}

TEST(SentByMaster, HasTheIdentInOctets5And6)
{
    EXPECT_THAT(set_prm_of(sent_by_master(section("Ident_Number = 0x0533\r\nUser_Prm_Data_Len = 1\r\n"), {})),
                ElementsAre(0x80, 0, 0, 11, 0x05, 0x33, 0, 0));
}

TEST(PluggedModules, AreTheOneOfACompactStationAndThePresetOnesOfOthers)
{
    const std::string one = "Module = \"a\" 0x50\r\nEndModule\r\n";
    EXPECT_THAT(plugged_modules(section(one)), SizeIs(1));
    const std::string two = one + "Module = \"b\" 0x60\r\nPreset = 0x01\r\nEndModule\r\n";
    for (const std::string station : {"", "Modular_Station = 1\r\n"}) {
        const Document document = section(station + two);
        ASSERT_THAT(preset_modules(document), SizeIs(1)) << station;
        EXPECT_EQ(preset_modules(document)[0]->name, "b");
        EXPECT_EQ(plugging_of(document), Plugging::choice) << "it may be taken out";
        EXPECT_THAT(plugged_modules(document), IsEmpty());
        const Document fixed = section(station + "FixPresetModules = 1\r\n" + two);
        EXPECT_EQ(plugging_of(fixed), Plugging::fixed);
        EXPECT_THAT(plugged_modules(fixed), SizeIs(1));
    }
    EXPECT_EQ(plugging_of(section(one + one)), Plugging::choice) << "no source says which of them is plugged";
}

Document three_modules()
{
    return section("Modular_Station = 1\r\nMax_Module = 3\r\nModule = \"In\" 0x50\r\nEndModule\r\n"
                   "Module = \"in, out\" 0x50,0x60\r\nEndModule\r\nModule = \"Out\" 0x60\r\nEndModule\r\n");
}

TEST(SentByMaster, OfTheOldStyleHasTheParametersOfTheModulesToo)
{
    const Document document =
        section("User_Prm_Data_Len = 2\r\nUser_Prm_Data = 1,2\r\nModule = \"a\" 0x50\r\n"
                "Ext_User_Prm_Data_Const(0) = 7,8\r\nEndModule\r\n");
    const Sent sent = sent_by_master(document, {&document.modules[0], &document.modules[0]});
    EXPECT_THAT(sent.user.octets, ElementsAre(1, 2, 7, 8, 7, 8));
    EXPECT_EQ(sent.user.lines[5], document.blocks[0].body[0].line);
}

TEST(SentByMaster, OfTheNewStyleNeedsNoLength)
{
    const Document document = section("Ext_User_Prm_Data_Const(0) = 1,2,3\r\n");
    EXPECT_THAT(sent_by_master(document, {}).user.octets, ElementsAre(1, 2, 3));
}

TEST(LimitsOfAFile, AreThoseOfAModularStationOnly)
{
    const std::string limits =
        "Max_Input_Len = 2\r\nMax_Output_Len = 2\r\nMax_Data_Len = 3\r\nMax_Module = 4\r\n";
    const std::string modules = "Module = \"in\" 0x50\r\nEndModule\r\nModule = \"out\" 0x60\r\nEndModule\r\n";
    const Document modular = section("Modular_Station = 1\r\n" + limits + modules);
    const Module *in = &modular.modules[0], *out = &modular.modules[1];
    EXPECT_EQ(broken_limit(modular, {in}), "");
    EXPECT_EQ(broken_limit(modular, {in, in}),
              "Max_Input_Len in line 3 allows 2, and the modules make 4 octets.");
    EXPECT_EQ(broken_limit(modular, {out, out}),
              "Max_Output_Len in line 4 allows 2, and the modules make 4 octets.");
    EXPECT_EQ(broken_limit(modular, {in, out}),
              "Max_Data_Len in line 5 allows 3, and the modules make 4 octets.");
    const Document compact = section(limits + modules);
    EXPECT_EQ(broken_limit(compact, {&compact.modules[0], &compact.modules[0]}), "");
}

TEST(ModulesByName, AreFoundInAnyCaseAndByTheirPlace)
{
    const Document document = three_modules();
    std::string why;
    const auto found = modules_named(document, {"OUT", "#2", "in"}, why);
    ASSERT_TRUE(found) << why;
    EXPECT_THAT(*found, ElementsAre(&document.modules[2], &document.modules[1], &document.modules[0]));
}

TEST(ModulesByName, AreRefusedWithTheReason)
{
    const Document document = three_modules();
    std::string why;
    EXPECT_FALSE(modules_named(document, {"input"}, why));
    EXPECT_THAT(why, HasSubstr("no module \"input\"; it has: \"In\", \"in, out\", \"Out\""));
    EXPECT_FALSE(modules_named(document, {"#4"}, why));
    EXPECT_THAT(why, HasSubstr("it has 3 modules"));
    EXPECT_FALSE(modules_named(document, {"In", "In", "In", "In"}, why));
    EXPECT_THAT(why, HasSubstr("Max_Module in line 3 allows 3, and 4 modules are more."));
    EXPECT_FALSE(modules_named(
        section("Module = \"a\" 0x50\r\nEndModule\r\nModule = \"A\" 0x60\r\nEndModule\r\n"), {"a"}, why));
    EXPECT_THAT(why, HasSubstr("several modules have the name \"a\""));
}

TEST(ModulesInChkCfg, AreAsFewAsPossible)
{
    const Document document = three_modules();
    const auto found = modules_in(document, {0x50, 0x60, 0x60, 0x50});
    ASSERT_TRUE(found);
    EXPECT_THAT(*found, ElementsAre(&document.modules[1], &document.modules[2], &document.modules[0]));
    EXPECT_FALSE(modules_in(document, {0x50, 0x70}));
    EXPECT_TRUE(modules_in(document, {0x60, 0x60, 0x60, 0x60}))
        << "a master has sent it, whatever Max_Module says";
}

} // namespace
} // namespace dpslave::gsd
