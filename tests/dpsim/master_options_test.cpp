// SPDX-License-Identifier: Apache-2.0
// What the options of `dpsim master` send: HA389815 chapter 6, HA463561U002, 2408f/2404f handbook chapter 5.
#include "dpsim/master/master_options.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using testing::HasSubstr;

MasterSettings settings_of(const MasterTexts& texts)
{
    MasterSettings settings;
    EXPECT_EQ(complete(settings, texts), "");
    return settings;
}

std::string fault_of(const MasterTexts& texts)
{
    MasterSettings settings;
    return complete(settings, texts);
}

TEST(MasterOptions, OfTheOptionBoardAlwaysMake24Octets)
{
    MasterTexts texts;
    texts.tags = "55,56w,288";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(hex(s.user_prm), "00 37 00 38 01 20 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
    EXPECT_EQ(s.cfg, wire("73 50 60 50"));
    EXPECT_EQ(s.ident, 0x0533);
    EXPECT_TRUE(s.sync_freeze);
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
    EXPECT_TRUE(s.sync_freeze);
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
    texts.ident = "4711";
    texts.prm = "000000 010F";
    texts.cfg = "70";
    const MasterSettings s = settings_of(texts);
    EXPECT_EQ(s.ident, 4711);
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
    EXPECT_THAT(complete(settings, texts), HasSubstr("--others 4: they have the addresses 90 to 93"));
    texts.slave = 94;
    EXPECT_EQ(complete(settings, texts), "");
}

} // namespace
} // namespace dpslave::sim
