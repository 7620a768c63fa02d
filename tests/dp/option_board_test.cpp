// SPDX-License-Identifier: Apache-2.0
/// HA389815 ch. 6, and the acceptance rows: how a master chooses the parameters of the option
/// board.
#include "bench.hpp"

namespace test {
namespace {

using dpslave::Parameter;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::State;

constexpr std::string_view kDiagFree = "DL 00 0C 00 02 05 33";
constexpr std::string_view kPrmFault = "DL 42 05 00 FF 05 33";
constexpr std::string_view kCfgFault = "DL 06 05 00 FF 05 33";

Parameter input(std::uint16_t tag)
{
    return {tag, true, false};
}
Parameter output(std::uint16_t tag)
{
    return {tag, false, true};
}

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

TEST_F(OptionBoard, GetCfgTellsTheAcceptedIdentifiers)
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

/// What the same code must say for devices that differ only in data.
class TechnologyBox : public DpBench {
protected:
    TechnologyBox() : DpBench(technology_box()) {}
    static std::string prm(std::string_view user, std::string_view status = "88 14 01 0B")
    {
        return std::string{status} + " 16 49 01 " + std::string{user};
    }
};

TEST_F(TechnologyBox, TakesTheExampleOfTagsFromOctet3)
{
    start_up(prm("00 00 00 01 0F 01 0D 01 10 00 FF"), "60 60 50 50");

    const auto layout = seen().layout;
    EXPECT_EQ(layout.parameters[0], output(271));
    EXPECT_EQ(layout.parameters[1], output(269));
    EXPECT_EQ(layout.parameters[2], input(272));
    EXPECT_EQ(layout.parameters[3], input(255));
}

TEST_F(TechnologyBox, TakesTheFormOf63OctetsPaddedWithZeros)
{
    Octets user = octets("00 00 00 01 0F 01 0D 01 10 00 FF");
    user.resize(63);
    start_up(prm(show(user)), "60 60 50 50");

    EXPECT_EQ(seen().layout.count, 4);
}

TEST_F(TechnologyBox, OneIdentifierReadsAndWritesTheSameParameter)
{
    start_up(prm("00 00 00 00 10 00 20"), "70 50");
    inputs_are({0x1111, 0x2222});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("AA BB"), "DL 11 11 22 22");

    EXPECT_EQ(seen().outputs[0], 0xAABB);
    EXPECT_EQ(seen().layout.parameters[0], (Parameter{16, true, true}));
}

TEST_F(TechnologyBox, NoUserPrmDataIsNoTags)
{
    start_up("88 14 01 0B 16 49 01", "73");

    EXPECT_EQ(seen().layout.count, 0);
}

TEST_F(TechnologyBox, RefusesAZeroBetweenTags)
{
    master.set_prm(prm("00 00 00 00 10 00 00 00 20"));

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_zero_tag, 13, 1, 0}));
}

TEST_F(TechnologyBox, RefusesAnOddLength)
{
    master.set_prm(prm("00 00 00 00 10 00"));

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_length, 0, 5, 6}));
}

TEST_F(TechnologyBox, RefusesDpV1FunctionsAndSaysWhichOctet)
{
    master.set_prm(prm("80 00 00"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 8, 0x00, 0x80}));
    master.set_prm(prm("44 00 00"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 8, 0x04, 0x44}));
    master.set_prm(prm("00 01 00"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 9, 0x00, 0x01}));
    master.set_prm(prm("00 00 08"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 10, 0x00, 0x08}));
}

TEST_F(TechnologyBox, WdBaseMakesTheWatchdogCountMilliseconds)
{
    master.set_prm(prm("04 00 00"));

    EXPECT_EQ(seen().watchdog, std::chrono::milliseconds{20});
}

TEST_F(TechnologyBox, TheBitsOfTheAsicsStartAndStopCheckDoNoHarm)
{
    master.set_prm(prm("03 00 00"));

    EXPECT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(seen().watchdog, std::chrono::milliseconds{200});
}

class Controller : public DpBench {
protected:
    Controller() : DpBench(controller()) {}
};

TEST_F(Controller, TakesAsManyTagsAsThereAreOctets)
{
    start_up("88 14 01 0B 24 08 01 00 01 3F FF 00 05", "50 60 50");

    EXPECT_EQ(seen().layout.count, 3);
    EXPECT_EQ(seen().layout.parameters[1], output(16'383));
}

TEST_F(Controller, RefusesATagThatIsZero)
{
    master.set_prm("88 14 01 0B 24 08 01 00 01 00 00");

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_zero_tag, 10, 1, 0}));
}

TEST_F(Controller, ExchangesAllOf117Words)
{
    Octets prm = octets("88 14 01 0B 24 08 01");
    for (std::uint8_t tag = 1; tag <= 117; ++tag) {
        prm.push_back(0);
        prm.push_back(tag);
    }
    start_up(show(prm), show(Octets(117, 0x50)));
    std::vector<std::uint16_t> words(117, 0xBEEF);
    inputs_are(words);

    const std::string reply = master.data_exchange("");

    EXPECT_EQ(reply.size(), 2 + 3 * 234u);
    EXPECT_EQ(reply.substr(reply.size() - 5), "BE EF");
}

} // namespace
} // namespace test
