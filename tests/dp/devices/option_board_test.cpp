// SPDX-License-Identifier: Apache-2.0
/// HA389815 ch. 6, and the acceptance rows: how a master chooses the parameters of the option
/// board.
#include "dp/bench.hpp"

namespace test {
namespace {

using dpslave::LayoutEntry;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;

constexpr std::string_view kDiagFree = "DL 00 0C 00 02 05 33";
constexpr std::string_view kPrmFault = "DL 42 05 00 FF 05 33";
constexpr std::string_view kCfgFault = "DL 06 05 00 FF 05 33";

TEST_F(OptionBoard, AnswersWithItsIdentNumber)
{
    EXPECT_EQ(master.slave_diag(), "DL 02 05 00 FF 05 33");
}

TEST_F(OptionBoard, RefusesAnotherIdentNumberAndSaysWhere)
{
    master.set_prm(board_prm({}, "88 14 01 0B 05 34 01"));

    EXPECT_EQ(master.slave_diag(), kPrmFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_ident, 5, 0x0533, 0x0534}));
}

TEST_F(OptionBoard, TakesTheCfgExampleOfChapter6)
{
    start_up(board_prm({1, 2, 3, 4}), "50 50 60 60");

    const auto layout = seen().layout;
    ASSERT_EQ(layout.count, 4);
    EXPECT_EQ(layout.parameters[0], input(1));
    EXPECT_EQ(layout.parameters[1], input(2));
    EXPECT_EQ(layout.parameters[2], output(3));
    EXPECT_EQ(layout.parameters[3], output(4));
    inputs_are({0x0102, 0xFFFE});
    diagnosis_is_read();
    EXPECT_EQ(master.data_exchange("11 22 33 44"), "DL 01 02 FF FE");
    EXPECT_EQ(master.rd_outp(), "DL 11 22 33 44");
}

TEST_F(OptionBoard, TakesThePrmExampleOfChapter6)
{
    const std::string prm = "88 14 01 0B 05 33 01 00 37 00 38 01 20 00 00 "
                            "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00";
    start_up(prm, "50 60 50");

    const auto layout = seen().layout;
    ASSERT_EQ(layout.count, 3);
    EXPECT_EQ(layout.parameters[0], input(55));
    EXPECT_EQ(layout.parameters[1], output(56));
    EXPECT_EQ(layout.parameters[2], input(288));
}

TEST_F(OptionBoard, WithDemandDataParametersBeginAtOctet8)
{
    start_up(board_prm({55, 56}), "73 50 60");
    inputs_are({0xABCD});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("00 00 00 00 00 00 00 00 12 34"), "DL 00 00 00 00 00 00 00 00 AB CD");
    EXPECT_EQ(slave.take_outputs()->words[1], 0x1234);
}

TEST_F(OptionBoard, MixesInputsAndOutputsInTheOrderOfTheTags)
{
    start_up(board_prm({10, 20, 30, 40, 50}), "60 50 60 50 60");
    inputs_are({0, 0x2020, 0, 0x4040});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("10 11 30 31 50 51"), "DL 20 20 40 40");

    const auto words = slave.take_outputs()->words;
    EXPECT_EQ(words[0], 0x1011);
    EXPECT_EQ(words[2], 0x3031);
    EXPECT_EQ(words[4], 0x5051);
}

TEST_F(OptionBoard, TakesTwelveParametersAndDemandData)
{
    start_up(board_prm({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 2047}), "73 50 50 50 50 50 50 60 60 60 60 60 60");

    EXPECT_EQ(seen().layout.count, 12);
    EXPECT_EQ(seen().layout.parameters[11], output(2047));
    EXPECT_EQ(master.data_exchange(Octets(20)), "DH " + show(Octets(20)));
}

TEST_F(OptionBoard, RefusesThirteenParameters)
{
    master.set_prm(board_prm({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
    master.chk_cfg("50 50 50 50 50 50 50 50 50 50 50 50 50");

    EXPECT_EQ(master.slave_diag(), kCfgFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 13, 12, 13}));
}

TEST_F(OptionBoard, RefusesFourteenIdentifiersWithDemandData)
{
    master.set_prm(board_prm({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
    master.chk_cfg("73 50 50 50 50 50 50 50 50 50 50 50 50 50");

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 14, 13, 14}));
}

TEST_F(OptionBoard, RefusesDemandDataElsewhereThanFirst)
{
    master.set_prm(board_prm({55}));
    master.chk_cfg("50 73");

    EXPECT_EQ(master.slave_diag(), kCfgFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_identifier, 2, 0x50, 0x73}));
}

TEST_F(OptionBoard, RefusesAnIdentifierThatItDoesNotHave)
{
    for (const std::string_view octet : {"70", "51", "D0", "00", "FF"}) {
        master.set_prm(board_prm({55, 56, 57}));
        master.chk_cfg("50 60 " + std::string{octet});
        EXPECT_EQ(master.slave_diag(), kCfgFault);
        EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_identifier, 3, 0x50, octets(octet)[0]}));
    }
}

TEST_F(OptionBoard, RefusesFewerIdentifiersThanTags)
{
    master.set_prm(board_prm({55, 56, 288}));
    master.chk_cfg("73 50 60");

    EXPECT_EQ(master.slave_diag(), kCfgFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_few, 0, 3, 2}));
}

TEST_F(OptionBoard, RefusesMoreIdentifiersThanTags)
{
    master.set_prm(board_prm({55, 56, 288}));
    master.chk_cfg("73 50 60 50 50 50");

    EXPECT_EQ(master.slave_diag(), kCfgFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_many, 5, 3, 5}));
}

TEST_F(OptionBoard, TheFirstZeroEndsTheTagsAndWhatFollowsDoesNotCount)
{
    start_up(board_prm({55, 0, 56, 0xFFFF}), "50");

    EXPECT_EQ(seen().layout.count, 1);
}

TEST_F(OptionBoard, TakesDemandDataAlone)
{
    start_up(board_prm({}), "73");

    EXPECT_EQ(master.slave_diag(), kDiagFree); // no inputs to wait for
    EXPECT_EQ(master.data_exchange(Octets(8)), "DL 00 00 00 00 00 00 00 00");
}

TEST_F(OptionBoard, RefusesAnEmptyCfg)
{
    master.set_prm(board_prm({}));
    EXPECT_EQ(master.chk_cfg(""), "SC");

    EXPECT_EQ(master.slave_diag(), kCfgFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_empty, 0, 1, 0}));
}

TEST_F(OptionBoard, RefusesUserPrmDataOfAnotherLength)
{
    for (const std::size_t length : {0u, 1u, 2u, 22u, 23u, 25u, 26u, 27u, 237u}) {
        Octets prm = octets("88 14 01 0B 05 33 01");
        prm.resize(prm.size() + length);
        master.set_prm(show(prm));
        EXPECT_EQ(master.slave_diag(), kPrmFault);
        EXPECT_EQ(seen().refusal,
                  (RefusalDetail{Refusal::prm_length, 0, 24, static_cast<std::uint16_t>(length)}));
    }
}

TEST_F(OptionBoard, RefusesATagAbove2047AndSaysWhichOctet)
{
    master.set_prm(board_prm({2048}));
    EXPECT_EQ(master.slave_diag(), kPrmFault);
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_tag_too_large, 8, 2047, 2048}));

    master.set_prm(board_prm({1, 2, 0x8000}));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_tag_too_large, 12, 2047, 0x8000}));
}

TEST_F(OptionBoard, ADpV1HeaderIsTakenForATagTooLarge)
{
    // DPV1_Status_1 with Fail_Safe or DPV1_Enable where the first tag belongs
    master.set_prm(
        "88 14 01 0B 05 33 01 C0 00 00 00 37 00 38 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");

    EXPECT_EQ(master.slave_diag(), kPrmFault);
    EXPECT_EQ(seen().refusal.why, Refusal::prm_tag_too_large);
}

TEST_F(OptionBoard, AFirstOctetFrom00To07IsTheHighOctetOfATag)
{
    start_up(board_prm({0x0700}), "50");

    EXPECT_EQ(seen().layout.parameters[0], input(0x0700));
}

TEST_F(OptionBoard, GetCfgReturnsTheAcceptedIdentifiers)
{
    start_up(board_prm({55, 56, 288}), "73 50 60 50");

    EXPECT_EQ(master.get_cfg(), "DL 73 50 60 50");
}

TEST_F(OptionBoard, HasNoExtendedDiagnosis)
{
    start_up(board_prm({55}), "60");
    slave.set_ext_diag(octets("03 40 30"), true);

    EXPECT_EQ(master.slave_diag(), "DL 00 0C 80 02 05 33"); // six octets, and the bit that says so
}

TEST_F(OptionBoard, AnAcceptedTelegramClearsTheRefusalOfItsKindOnly)
{
    master.set_prm(board_prm({55}));
    master.chk_cfg("60 60");
    EXPECT_EQ(seen().refusal.why, Refusal::cfg_too_many);
    master.set_prm(board_prm({55}));
    EXPECT_EQ(seen().refusal.why, Refusal::cfg_too_many);
    master.chk_cfg("60");
    EXPECT_EQ(seen().refusal.why, Refusal::none);
}

TEST_F(OptionBoard, KeepsTheLastPrmAndCfgForTheReader)
{
    master.set_prm("88 00 01 0B 05 33 01");
    master.chk_cfg("50 51");

    const auto snapshot = seen();
    EXPECT_EQ(dpslave::hex(snapshot.prm), "88 00 01 0B 05 33 01");
    EXPECT_EQ(dpslave::hex(snapshot.cfg), "50 51");
}

TEST_F(OptionBoard, DropsThemAtTheStartBehindAStopOnly)
{
    master.set_prm("88 00 01 0B 05 33 01");
    master.chk_cfg("50 51");
    slave.start(bus.now()); // it runs
    EXPECT_EQ(dpslave::hex(seen().prm), "88 00 01 0B 05 33 01");
    slave.stop(bus.now());
    EXPECT_EQ(dpslave::hex(seen().cfg), "50 51");

    slave.start(bus.now());

    EXPECT_TRUE(seen().prm.empty());
    EXPECT_TRUE(seen().cfg.empty());
}

} // namespace
} // namespace test
