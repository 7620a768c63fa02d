// SPDX-License-Identifier: Apache-2.0
// Tests what the options of `dpsim master` send: HA389815 chapter 6, HA463561U002, 2408f/2404f handbook
// chapter 5.
#include "dpsim/master/master_options.hpp"
#include "octets.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using testing::HasSubstr;

MasterSettings settings_of(const MasterTexts& texts)
{
    MasterSettings settings;
    const auto notes = complete(settings, texts);
    EXPECT_TRUE(notes) << (notes ? "" : notes.error());
    return settings;
}

std::string fault_of(const MasterTexts& texts)
{
    MasterSettings settings;
    const auto notes = complete(settings, texts);
    return notes ? "" : notes.error();
}

TEST(MasterOptions, OfTheOptionBoardAlwaysMake24Octets)
{
    MasterTexts texts;
    texts.tags = "55,56w,288";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(hex(s.user_prm), "00 37 00 38 01 20 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
    EXPECT_EQ(s.cfg, wire("73 50 60 50"));
    EXPECT_EQ(s.ident, 0x0533);
    EXPECT_TRUE(s.sync && s.freeze);
}

TEST(MasterOptions, OfTheTechnologyBoxPutTheTagsBehindThreeOctetsOfDpv1)
{
    MasterTexts texts;
    texts.family = "technology-box";
    texts.ident = "0x1649";
    texts.tags = "271w,269w,272,255";
    texts.no_demand = true;
    MasterSettings s = settings_of(texts);
    EXPECT_EQ(s.user_prm, wire("00 00 00 01 0F 01 0D 01 10 00 FF")) << "the example of the manual";
    EXPECT_EQ(s.cfg, wire("60 60 50 50"));
    EXPECT_EQ(s.ident, 0x1649);
    EXPECT_TRUE(s.sync && s.freeze);
    texts.prm_length = 63;
    s = settings_of(texts);
    ASSERT_EQ(s.user_prm.size(), 63U);
    EXPECT_EQ(s.user_prm[10], 0xFF);
    EXPECT_EQ(s.user_prm[11], 0x00);
}

TEST(MasterOptions, LetOneTagBeReadAndWritten)
{
    MasterTexts texts;
    texts.family = "technology-box";
    texts.ident = "0x1649";
    texts.tags = "269rw,272";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(s.cfg, wire("73 70 50"));
    EXPECT_EQ(s.user_prm, wire("00 00 00 01 0D 01 10"));
    const auto lengths = cfg_lengths(s.cfg);
    EXPECT_EQ(lengths->inputs, 12U);
    EXPECT_EQ(lengths->outputs, 10U);
}

TEST(MasterOptions, OfAControllerSendTheTagsAloneAndAskForNoSyncOrFreeze)
{
    MasterTexts texts;
    texts.family = "controller";
    texts.ident = "0x2408";
    texts.tags = "1,5,3,75,24w,25w,15w,274w";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(s.user_prm, wire("00 01 00 05 00 03 00 4B 00 18 00 19 00 0F 01 12"));
    EXPECT_EQ(s.cfg, wire("73 50 50 50 50 60 60 60 60"));
    EXPECT_EQ(set_prm_unit(s)[0], 0x88) << "lock and watchdog";
}

TEST(MasterOptions, CanLeaveUserPrmDataOut)
{
    MasterTexts texts;
    texts.prm = "none";
    EXPECT_EQ(set_prm_unit(settings_of(texts)).size(), 7U);
    texts.prm.clear();
    EXPECT_EQ(set_prm_unit(settings_of(texts)).size(), 31U) << "24 octets of the option board otherwise";
    texts.family = "technology-box";
    texts.ident = "0x1649";
    EXPECT_EQ(set_prm_unit(settings_of(texts)).size(), 7U);
}

TEST(MasterOptions, TakeUserPrmDataAndCfgDataAsTheyAre)
{
    MasterTexts texts;
    texts.ident = "0x4711";
    texts.prm = "000000 010F";
    texts.cfg = "70";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(s.ident, 0x4711);
    EXPECT_EQ(s.user_prm, wire("00 00 00 01 0F"));
    EXPECT_EQ(s.cfg, wire("70"));
}

TEST(MasterOptions, ThatCannotBeAreExplained)
{
    MasterTexts texts;
    texts.family = "controller";
    EXPECT_THAT(fault_of(texts), HasSubstr("needs --ident"));
    texts = {};
    texts.tags = "1,2,3,4,5,6,7,8,9,10,11,12,13";
    EXPECT_THAT(fault_of(texts), HasSubstr("12 tags are the limit"));
    texts.tags = "55x";
    EXPECT_THAT(fault_of(texts), HasSubstr("'55x' is no tag number"));
    texts.tags = "w";
    EXPECT_THAT(fault_of(texts), HasSubstr("is no tag number"));
    texts = {};
    texts.tags = "1,2";
    texts.prm_length = 3;
    EXPECT_THAT(fault_of(texts), HasSubstr("the tags alone make 4 octets"));
    texts = {};
    texts.ident = "0x10000";
    EXPECT_THAT(fault_of(texts), HasSubstr("--ident"));
    texts = {};
    texts.prm = std::string(476, '0');
    EXPECT_THAT(fault_of(texts), HasSubstr("238 octets"));
    texts = {};
    texts.baud = 12'000'000;
    EXPECT_THAT(fault_of(texts), HasSubstr("--baud"));
    texts = {};
    texts.address = 5;
    EXPECT_THAT(fault_of(texts), HasSubstr("same address"));
}

TEST(MasterOptions, RefuseAnAddressThatIsOneOfTheOtherStations)
{
    MasterSettings settings;
    settings.others = 4;
    MasterTexts texts;
    texts.slave = 93;
    EXPECT_THAT(complete(settings, texts).error(), HasSubstr("--others 4: they have the addresses 90 to 93"));
    texts.slave = 94;
    EXPECT_TRUE(complete(settings, texts));
}

MasterTexts with_gsd(const std::string& file, const std::string& modules = "")
{
    MasterTexts texts;
    texts.gsd = test::source_path("gsd/") + file;
    texts.modules = modules;
    return texts;
}

TEST(MasterOptions, TakeIdentParametersAndModulesOutOfAGsd)
{
    const MasterSettings s = settings_of(with_gsd("605/605_1649.GSD", "demand-data, Process-Data-Input,#3"));
    EXPECT_EQ(s.ident, 0x1649);
    EXPECT_EQ(s.user_prm, Octets(63, 0));
    EXPECT_EQ(s.cfg, wire("73 50 60"));
    EXPECT_TRUE(s.sync && s.freeze) << "the file has both";
    MasterTexts texts = with_gsd("605/605_1649.GSD", "#1");
    texts.no_sync_freeze = true;
    EXPECT_FALSE(settings_of(texts).sync || settings_of(texts).freeze);
}

TEST(MasterOptions, SayWhatTheGsdGaveAndWhichOctetsTheTagsOverwrite)
{
    MasterSettings settings;
    MasterTexts texts = with_gsd("605/605_1649.GSD", "Demand-Data,Process-Data-In-Output");
    texts.family = "technology-box";
    texts.tags = "271,0x10D";
    const auto notes = complete(settings, texts);
    ASSERT_TRUE(notes);
    EXPECT_THAT(*notes,
                testing::ElementsAre(
                    texts.gsd + ": Parker SSD Drives SSD Drives 605, 10 input and 10 output octets, "
                                "modules: Demand-Data, Process-Data-In-Output",
                    "--tags: octets 3 to 6 of User_Prm_Data are 01 0F 01 0D; the file has 00 00 00 00"));
    Octets wanted(63, 0);
    wanted[3] = wanted[5] = 0x01;
    wanted[4] = 0x0F;
    wanted[6] = 0x0D;
    EXPECT_EQ(settings.user_prm, wanted);
}

TEST(MasterOptions, PutTheTagsOfAnOptionBoardFirst)
{
    MasterTexts texts = with_gsd("590/590_0533.GSD", "Demand-Data,Process-Data-Input");
    texts.tags = "55";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(hex(s.user_prm), "00 37 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
    EXPECT_EQ(s.cfg, wire("73 50"));
}

TEST(MasterOptions, WithAGsdThatCannotBeAreExplained)
{
    EXPECT_THAT(fault_of(with_gsd("none.GSD")), HasSubstr("none.GSD: cannot be read"));
    const std::string without_modules = fault_of(with_gsd("590/590_0533.GSD"));
    EXPECT_THAT(without_modules,
                HasSubstr("590_0533.GSD: no module is plugged from the start: write --modules"));
    EXPECT_THAT(without_modules, HasSubstr("\n  #3 Process-Data-Output (60)"));
    MasterTexts texts = with_gsd("590/590_0533.GSD", "Demand-Data");
    texts.tags = "55w";
    EXPECT_THAT(fault_of(texts), HasSubstr("write the numbers alone"));
    texts.tags = "x";
    EXPECT_THAT(fault_of(texts), HasSubstr("'x' is no tag number"));
    texts.tags = "1,2,3,4,5,6,7,8,9,10,11,12,13";
    EXPECT_THAT(fault_of(texts), HasSubstr("13 tags end at octet 26 of User_Prm_Data, but the file has 24"));
    texts = with_gsd("605/605_1649.GSD", "Demand-Data");
    texts.tags = "271";
    EXPECT_THAT(fault_of(texts),
                HasSubstr("the ident 0x1649 is none of the option board. Say with --family"));
}

} // namespace
} // namespace dpslave::sim
