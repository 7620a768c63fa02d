// SPDX-License-Identifier: Apache-2.0
/// The checks of Set_Prm and Chk_Cfg by themselves, for devices that no shipped profile describes.
#include "bench.hpp"

#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/set_prm.hpp"

namespace test {
namespace {

using dpslave::dp::Personality;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::TagList;

/// What is wrong with a Set_Prm of the device with these User_Prm_Data.
RefusalDetail prm_refusal(const Personality& device, const Octets& user)
{
    Octets telegram = octets("80 00 00 0B 05 33 01");
    telegram.insert(telegram.end(), user.begin(), user.end());
    const auto taken = dpslave::dp::check_set_prm(device, telegram);
    return taken ? RefusalDetail{} : taken.error();
}

RefusalDetail cfg_refusal(const Personality& device, const std::vector<std::uint16_t>& tags,
                          std::string_view cfg)
{
    const auto taken = dpslave::dp::check_chk_cfg(device, tags, octets(cfg));
    return taken ? RefusalDetail{} : taken.error();
}

TEST(SetPrmCheck, RefusesUserPrmDataThatEndBeforeTheTagsBegin)
{
    Personality device = option_board();
    device.prm = {.tags_at = 3, .min_length = 1, .max_length = 63, .list = TagList::exact};

    EXPECT_EQ(prm_refusal(device, {0, 0}), (RefusalDetail{Refusal::prm_length, 0, 3, 2}));
    EXPECT_EQ(prm_refusal(device, {0, 0, 0}), RefusalDetail{});
}

TEST(SetPrmCheck, RefusesMoreTagsThanAStationCanHave)
{
    Personality device = option_board();
    device.prm = {.max_length = 237, .list = TagList::exact};

    EXPECT_EQ(prm_refusal(device, Octets(236, 1)), (RefusalDetail{Refusal::prm_length, 0, 234, 236}));
    EXPECT_EQ(prm_refusal(device, Octets(234, 1)), RefusalDetail{});
    device.prm.tags_at = 1;
    EXPECT_EQ(prm_refusal(device, Octets(237, 1)), (RefusalDetail{Refusal::prm_length, 0, 235, 237}));
}

TEST(SetPrmCheck, RefusesMoreUserPrmDataThanATelegramHolds)
{
    Personality device = option_board();
    device.prm = {.max_length = 300, .list = TagList::none};

    EXPECT_EQ(prm_refusal(device, Octets(238, 1)), (RefusalDetail{Refusal::prm_length, 0, 237, 238}));
    EXPECT_EQ(prm_refusal(device, Octets(237, 1)), RefusalDetail{});
}

TEST(ChkCfgCheck, NamesDemandDataWhereTheDeviceHasNoOtherIdentifier)
{
    Personality device = option_board();
    device.identifiers.clear();

    EXPECT_EQ(cfg_refusal(device, {}, "73 50"), (RefusalDetail{Refusal::cfg_identifier, 2, 0x73, 0x50}));
}

TEST(ChkCfgCheck, RefusesTooManyIdentifiersWhateverTheyAre)
{
    const Personality without_demand = example_device(); // at most 8 parameters
    EXPECT_EQ(cfg_refusal(without_demand, {}, "FF FF FF FF FF FF FF FF FF"),
              (RefusalDetail{Refusal::cfg_too_long, 9, 8, 9}));
    EXPECT_EQ(cfg_refusal(without_demand, {}, "FF FF FF FF FF FF FF FF").why, Refusal::cfg_identifier);

    const Personality with_demand = option_board(); // Demand Data, and at most 12
    EXPECT_EQ(cfg_refusal(with_demand, {}, "73 FF FF FF FF FF FF FF FF FF FF FF FF FF"),
              (RefusalDetail{Refusal::cfg_too_long, 14, 13, 14}));
    EXPECT_EQ(cfg_refusal(with_demand, {}, "73 FF FF FF FF FF FF FF FF FF FF FF FF").why,
              Refusal::cfg_identifier);
}

/// The option board of a plant whose GSD has identifiers of several words, and one of the special format
///
Personality of_a_plant()
{
    Personality device = option_board();
    device.identifiers = {{0x52, 3, 0}, {0x60, 0, 1}, {octets("C0 41 41"), 2, 2}};
    return device;
}

TEST(ChkCfgCheck, MakesEachWordOfAnIdentifierOneTagInTheOrderOfChkCfg)
{
    const std::vector<std::uint16_t> tags{1, 5, 3, 24, 7, 8};
    const auto taken = dpslave::dp::check_chk_cfg(of_a_plant(), tags, octets("73 52 60 C0 41 41"));
    ASSERT_TRUE(taken);
    EXPECT_TRUE(taken->demand);
    EXPECT_EQ(taken->in_length, 8U + 2 * 5);
    EXPECT_EQ(taken->out_length, 8U + 2 * 3);
    ASSERT_EQ(taken->layout.count, 6);
    using dpslave::LayoutEntry;
    const std::array<LayoutEntry, 6> wanted{LayoutEntry{1, true, false}, {5, true, false}, {3, true, false},
                                            {24, false, true},           {7, true, true},  {8, true, true}};
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(taken->layout.parameters[i], wanted[i]) << i;
}

TEST(ChkCfgCheck, CountsWordsAgainstTheTagsAndTheLimit)
{
    EXPECT_EQ(cfg_refusal(of_a_plant(), {1, 5}, "52"), (RefusalDetail{Refusal::cfg_too_many, 1, 2, 3}));
    EXPECT_EQ(cfg_refusal(of_a_plant(), {1, 5, 3}, "52 60"), (RefusalDetail{Refusal::cfg_too_many, 2, 3, 4}));
    EXPECT_EQ(cfg_refusal(of_a_plant(), {1, 5, 3, 4}, "52"), (RefusalDetail{Refusal::cfg_too_few, 0, 4, 3}));
    EXPECT_EQ(cfg_refusal(of_a_plant(), {}, "73 52 52 52 52 52"),
              (RefusalDetail{Refusal::cfg_too_long, 6, 13, 16}))
        << "at most 12 words";
}

TEST(ChkCfgCheck, NamesTheOctetOfAnIdentifierThatDiffers)
{
    EXPECT_EQ(cfg_refusal(of_a_plant(), {1}, "C0 41 40"),
              (RefusalDetail{Refusal::cfg_identifier, 3, 0x41, 0x40}));
    EXPECT_EQ(cfg_refusal(of_a_plant(), {1}, "60 C0 41"),
              (RefusalDetail{Refusal::cfg_identifier, 2, 0xC0, 0xC0}))
        << "it is cut short";
    EXPECT_EQ(cfg_refusal(of_a_plant(), {1}, "50"), (RefusalDetail{Refusal::cfg_identifier, 1, 0x52, 0x50}))
        << "only those of the station are taken";
}

TEST(ChkCfgCheck, RefusesDemandDataAloneWhereTheDeviceNeedsAParameter)
{
    Personality device = option_board();
    EXPECT_EQ(cfg_refusal(device, {}, "73"), RefusalDetail{});

    device.may_have_no_parameters = false;

    EXPECT_EQ(cfg_refusal(device, {}, "73"), (RefusalDetail{Refusal::cfg_too_few, 0, 1, 0}));
    EXPECT_EQ(cfg_refusal(device, {55}, "73 50"), RefusalDetail{});
}

TEST(ChkCfgCheck, NamesTheFirstOctetBehindTheAcceptedOnes)
{
    const Octets more = octets("11 21 99"); // what lies behind the accepted ones does not count
    const dpslave::Bytes accepted = dpslave::Bytes{more}.first(2);

    EXPECT_EQ(dpslave::dp::cfg_difference(accepted, octets("11 21 11")),
              (RefusalDetail{Refusal::cfg_changed, 3, 0, 0x11}));
}

} // namespace
} // namespace test
