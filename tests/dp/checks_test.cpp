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
