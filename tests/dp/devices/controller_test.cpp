// SPDX-License-Identifier: Apache-2.0
/// 2408f/2404f handbook ch. 4 and 5 (C-018, C-022, X-28, X-33, X-47): how a master chooses the parameters of
/// a controller.
#include "dp/bench.hpp"

namespace test {
namespace {

using dpslave::LayoutEntry;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::State;

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

constexpr std::string_view kUnlock = "40 00 00 00 24 08 00";

/// Set_Prm with the tags 1, 2 ... `count`.
std::string tags_from_1(std::size_t count)
{
    Octets prm = octets("88 14 01 0B 24 08 01");
    for (std::size_t tag = 1; tag <= count; ++tag) {
        prm.push_back(0);
        prm.push_back(static_cast<std::uint8_t>(tag));
    }
    return show(prm);
}

/// Words 0101, 0102 ... as they are on the wire.
std::string words_from(unsigned first, std::size_t count)
{
    Octets all;
    for (unsigned word = first; word < first + count; ++word) {
        all.push_back(static_cast<std::uint8_t>(word / 256));
        all.push_back(static_cast<std::uint8_t>(word % 256));
    }
    return show(all);
}

TEST_F(Controller, ExchangesEachOf117WordsInItsPlaceInEitherDirection)
{
    start_up(tags_from_1(117), show(Octets(117, 0x60)));
    EXPECT_EQ(master.data_exchange(words_from(0x0101, 117)), "SC");
    EXPECT_EQ(master.rd_outp(), "DL " + words_from(0x0101, 117));
    const auto outputs = slave.take_outputs();
    ASSERT_TRUE(outputs);
    for (std::size_t i = 0; i < 117; ++i) EXPECT_EQ(outputs->words[i], 0x0101 + i);
    EXPECT_EQ(outputs->layout.count, 117);
    master.set_prm(kUnlock);

    start_up(tags_from_1(117), show(Octets(117, 0x50)));
    std::vector<std::uint16_t> words(117);
    for (std::size_t i = 0; i < 117; ++i) words[i] = static_cast<std::uint16_t>(0x0201 + i);
    inputs_are(words);
    diagnosis_is_read();
    EXPECT_EQ(master.data_exchange(""), "DL " + words_from(0x0201, 117));
    EXPECT_EQ(master.rd_inp(), "DL " + words_from(0x0201, 117));
}

TEST_F(Controller, TakesNoTagsWithDemandDataAlone)
{
    start_up(tags_from_1(0), "73");

    EXPECT_EQ(seen().layout.count, 0);
}

TEST_F(Controller, RefusesAnOddLength)
{
    master.set_prm("88 14 01 0B 24 08 01 00 01 00");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_length, 0, 2, 3}));
    master.set_prm("88 14 01 0B 24 08 01 00");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_length, 0, 0, 1}));
    EXPECT_EQ(master.slave_diag(), "DL 42 05 00 FF 24 08 03 00 00");
}

TEST_F(Controller, RefusesATagAbove16383)
{
    master.set_prm("88 14 01 0B 24 08 01 3F FF 40 00");

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_tag_too_large, 10, 16'383, 16'384}));
}

TEST_F(Controller, RefusesAnotherNumberOfIdentifiersThanOfTags)
{
    master.set_prm(tags_from_1(3));
    master.chk_cfg("73 50 60");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_few, 0, 3, 2}));
    master.set_prm(tags_from_1(3));
    master.chk_cfg("50 60 50 60");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_many, 4, 3, 4}));
}

TEST_F(Controller, RefusesOtherIdentifiersThan50And60AndAFirst73)
{
    for (const std::string_view octet : {"70", "73", "51", "D0", "00", "FF"}) {
        master.set_prm(tags_from_1(2));
        master.chk_cfg("50 " + std::string{octet});
        EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_identifier, 2, 0x50, octets(octet)[0]}));
        EXPECT_EQ(master.slave_diag(), "DL 06 05 00 FF 24 08 03 00 00");
    }
}

TEST_F(Controller, CountsInputsAndOutputsTogetherUpTo117Words)
{
    start_up(tags_from_1(117), show(Octets(60, 0x50)) + " " + show(Octets(57, 0x60)));
    EXPECT_EQ(master.data_exchange(Octets(114)).size(), 2 + 3 * 120u);
    master.set_prm(kUnlock);

    master.set_prm(tags_from_1(117));
    master.chk_cfg(show(Octets(60, 0x50)) + " " + show(Octets(58, 0x60)));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 118, 117, 118}));
    EXPECT_EQ(state(), State::wait_prm);
}

TEST_F(Controller, Has109TagsBesideDemandData)
{
    start_up(tags_from_1(109), "73 " + show(Octets(55, 0x60)) + " " + show(Octets(54, 0x50)));
    EXPECT_EQ(seen().layout.count, 109);
    EXPECT_EQ(seen().layout.parameters[54], output(55));
    EXPECT_EQ(master.data_exchange(Octets(8 + 110)).size(), 2 + 3 * (8 + 108u));
    master.set_prm(kUnlock);

    master.set_prm(tags_from_1(110));
    master.chk_cfg("73 " + show(Octets(110, 0x60)));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 111, 110, 111}));
}

TEST_F(Controller, DemandDataAloneCanBeTooLongForADeviceOfFewWords)
{
    personality.max_words = 7;
    master.set_prm(tags_from_1(0));
    master.chk_cfg("73");

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 1, 0, 1}));
}

TEST_F(Controller, RefusesASetPrmThatAsksForSyncOrFreeze)
{
    for (const std::string_view status : {"A8", "98", "B8"}) {
        master.set_prm(std::string{status} + " 14 01 0B 24 08 01");
        EXPECT_EQ(master.slave_diag(), "DL 12 05 00 FF 24 08 03 00 00"); // Not_Supported
        EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_not_supported, 1, 0x88, octets(status)[0]}));
    }
}

TEST_F(Controller, IgnoresSyncAndFreezeButExecutesTheClearDataBesideThem)
{
    start_up(tags_from_1(2), "60 50");
    inputs_are({0, 1});
    diagnosis_is_read();
    master.control("28 00");
    inputs_are({0, 2});
    EXPECT_EQ(master.data_exchange("00 07"), "DL 00 02");
    EXPECT_EQ(seen().outputs[0], 7);

    master.control("2A 00"); // Sync, Freeze, Clear_Data

    EXPECT_EQ(seen().outputs[0], 0);
    EXPECT_FALSE(seen().sync);
    EXPECT_FALSE(seen().freeze);
}

} // namespace
} // namespace test
