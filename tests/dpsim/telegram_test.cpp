// SPDX-License-Identifier: Apache-2.0
// Telegrams as the wire reference prints them, sections 2.1, 4.2, 4.8 and 4.10.
#include "dpsim/common/telegram.hpp"
#include "octets.hpp"

#include <gtest/gtest.h>

namespace dpslave::sim {
namespace {

Frame srd(std::uint8_t fc, std::uint8_t sap, Octets data)
{
    return {.da = 5, .sa = 2, .fc = fc, .dsap = sap, .ssap = std::uint8_t{62}, .data = std::move(data)};
}

struct Golden {
    const char* name;
    Frame frame;
    Fixed fixed;
    const char* octets;
};

class GoldenTelegram : public testing::TestWithParam<Golden> {};

TEST_P(GoldenTelegram, IsMadeOctetForOctet)
{
    EXPECT_EQ(encode(GetParam().frame, GetParam().fixed), wire(GetParam().octets));
}

TEST_P(GoldenTelegram, IsTakenApartIntoTheSameParts)
{
    const Octets octets = wire(GetParam().octets);
    ASSERT_EQ(*frame_length(octets), octets.size());
    const auto frame = decode(octets);
    ASSERT_TRUE(frame) << frame.error();
    EXPECT_EQ(frame->da, GetParam().frame.da);
    EXPECT_EQ(frame->sa, GetParam().frame.sa);
    EXPECT_EQ(frame->fc, GetParam().frame.fc);
    EXPECT_EQ(frame->dsap, GetParam().frame.dsap);
    EXPECT_EQ(frame->ssap, GetParam().frame.ssap);
    EXPECT_EQ(frame->data, GetParam().frame.data);
}

const Frame kEight{.da = 5, .sa = 2, .fc = 0x7D, .data = {1, 2, 3, 4, 5, 6, 7, 8}};

INSTANTIATE_TEST_SUITE_P(
    WireReference, GoldenTelegram,
    testing::Values(
        Golden{"FdlStatus", {.da = 5, .sa = 2, .fc = 0x49}, Fixed::never, "10 05 02 49 50 16"},
        Golden{"FdlStatusReply", {.da = 2, .sa = 5, .fc = 0x00}, Fixed::never, "10 02 05 00 07 16"},
        Golden{"SlaveDiag", srd(0x6D, 60, {}), Fixed::never, "68 05 05 68 85 82 6D 3C 3E EE 16"},
        Golden{"SetPrm", srd(0x5D, 61, {0x88, 0x14, 0x01, 0x0B, 0x47, 0x11, 0x01}), Fixed::never,
               "68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16"},
        Golden{"ChkCfg", srd(0x7D, 62, {0x11, 0x21}), Fixed::never, "68 07 07 68 85 82 7D 3E 3E 11 21 32 16"},
        Golden{"EightOctetsAsSd2", kEight, Fixed::never,
               "68 0B 0B 68 05 02 7D 01 02 03 04 05 06 07 08 A8 16"},
        Golden{"EightOctetsAsSd3", kEight, Fixed::when_eight, "A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16"},
        Golden{"SixIdentifiersAsSd3", srd(0x5D, 62, {0x10, 0x10, 0x11, 0x20, 0x20, 0x21}), Fixed::when_eight,
               "A2 85 82 5D 3E 3E 10 10 11 20 20 21 72 16"},
        Golden{"Operate",
               {.da = 127,
                .sa = 2,
                .fc = 0x46,
                .dsap = std::uint8_t{58},
                .ssap = std::uint8_t{62},
                .data = {0, 0}},
               Fixed::never,
               "68 07 07 68 FF 82 46 3A 3E 00 00 3F 16"},
        Golden{"ServiceNotActivated", {.da = 2, .sa = 5, .fc = 0x03}, Fixed::never, "10 02 05 03 0A 16"},
        Golden{"DiagnosisPending",
               {.da = 2, .sa = 5, .fc = 0x0A, .data = {0x12, 0x34}},
               Fixed::never,
               "68 05 05 68 02 05 0A 12 34 57 16"}),
    [](const auto& test) { return test.param.name; });

struct Broken {
    const char* name;
    const char* octets;
    const char* why;
};

class BrokenTelegram : public testing::TestWithParam<Broken> {};

TEST_P(BrokenTelegram, IsNamedForWhatIsWrongWithIt)
{
    const Octets octets = wire(GetParam().octets);
    const auto length = frame_length(octets);
    const std::string why = length ? decode(octets).error() : length.error();
    EXPECT_NE(why.find(GetParam().why), std::string::npos) << why;
}

INSTANTIATE_TEST_SUITE_P(Flaws, BrokenTelegram,
                         testing::Values(Broken{"Delimiter", "11 05 02 49 50 16", "start delimiter"},
                                         Broken{"LengthTwice", "68 05 06 68 85 82 6D 3C 3E EE 16", "LEr"},
                                         Broken{"SecondDelimiter", "68 05 05 10 85 82 6D 3C 3E EE 16",
                                                "second SD2"},
                                         Broken{"LengthThree", "68 03 03 68 05 02 49 50 16", "4..249"},
                                         Broken{"Checksum", "10 05 02 49 51 16", "FCS"},
                                         Broken{"End", "10 05 02 49 50 17", "ends with"},
                                         Broken{"MissingSap", "10 85 02 49 D0 16", "SAP"}),
                         [](const auto& test) { return test.param.name; });

TEST(Telegram, NeedsFourOctetsOfAnSd2ForItsLength)
{
    EXPECT_EQ(*frame_length(wire("68 05 05")), 0U);
}

TEST(Telegram, RecognisesTokenAndShortAcknowledgement)
{
    const auto token = decode(wire("DC 04 02"));
    EXPECT_EQ(token->kind, FrameKind::token);
    EXPECT_EQ(token->da, 4);
    EXPECT_EQ(decode(wire("E5"))->kind, FrameKind::short_ack);
}

} // namespace
} // namespace dpslave::sim
