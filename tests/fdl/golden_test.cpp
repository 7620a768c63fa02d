// SPDX-License-Identifier: Apache-2.0
#include "golden.hpp"
#include "support/wire.hpp"

#include "dpslave/fdl/telegram.hpp"

#include <gtest/gtest.h>

using namespace dpslave;
using namespace test;

namespace {

Octets octets_of(Bytes bytes)
{
    return {bytes.begin(), bytes.end()};
}

std::string name_of(const testing::TestParamInfo<Golden>& info)
{
    return info.param.name;
}

class GoldenTelegram : public testing::TestWithParam<Golden> {};

TEST_P(GoldenTelegram, HasTheLengthThatItsHeadAnnounces)
{
    const Octets frame = octets(GetParam().octets);

    const auto length = fdl::frame_length(frame);

    ASSERT_TRUE(length);
    EXPECT_EQ(*length, frame.size());
}

TEST_P(GoldenTelegram, SaysWhatTheReferencePrints)
{
    const Octets frame = octets(GetParam().octets);

    const auto telegram = fdl::decode(frame);

    ASSERT_TRUE(telegram) << fdl::text(telegram.error());
    EXPECT_EQ(telegram->delimiter, frame[0]);
    EXPECT_EQ(telegram->da, GetParam().da);
    EXPECT_EQ(telegram->sa, GetParam().sa);
    EXPECT_EQ(telegram->fc, GetParam().fc);
    EXPECT_EQ(telegram->dsap, GetParam().dsap);
    EXPECT_EQ(telegram->ssap, GetParam().ssap);
    EXPECT_EQ(octets_of(telegram->data), octets(GetParam().data));
    EXPECT_EQ(telegram->is_request(), (GetParam().fc & 0x40) != 0);
}

TEST_P(GoldenTelegram, IsUnderstoodInTheSameWayByTheSecondHand)
{
    const auto telegram = heard(octets(GetParam().octets));

    ASSERT_TRUE(telegram);
    EXPECT_EQ(telegram->da, GetParam().da);
    EXPECT_EQ(telegram->sa, GetParam().sa);
    EXPECT_EQ(telegram->dsap, GetParam().dsap);
    EXPECT_EQ(telegram->ssap, GetParam().ssap);
    EXPECT_EQ(telegram->data, octets(GetParam().data));
}

TEST_P(GoldenTelegram, IsEncodedOctetForOctetExceptSd3WhichASlaveSendsAsSd2)
{
    const Golden& golden = GetParam();
    const Octets data = octets(golden.data);
    Octets expected = octets(golden.octets);
    if (expected[0] == 0xA2)
        expected = golden.dsap ? sd2(golden.da, golden.sa, golden.fc, Saps{*golden.dsap, *golden.ssap}, data)
                               : sd2(golden.da, golden.sa, golden.fc, data);

    const fdl::Frame frame = expected[0] == 0x10 ? fdl::encode_sd1(golden.da, golden.sa, golden.fc)
                                                 : fdl::encode_sd2(golden.da, golden.sa, golden.fc,
                                                                   golden.dsap, golden.ssap, data);

    EXPECT_EQ(octets_of(frame), expected);
}

INSTANTIATE_TEST_SUITE_P(WireReference, GoldenTelegram, testing::ValuesIn(kGolden), name_of);

TEST(Telegram, TokenHasAddressesAndNoFc)
{
    const Octets frame = octets("DC 04 02");

    const auto telegram = fdl::decode(frame);

    ASSERT_TRUE(telegram);
    EXPECT_EQ(telegram->da, 4);
    EXPECT_EQ(telegram->sa, 2);
    EXPECT_FALSE(telegram->has_fc());
    EXPECT_FALSE(telegram->is_request());
}

TEST(Telegram, ShortAcknowledgeIsOneOctet)
{
    const Octets frame = octets("E5");

    ASSERT_TRUE(fdl::decode(frame));
    EXPECT_EQ(*fdl::frame_length(frame), 1u);
    EXPECT_EQ(octets_of(fdl::encode_sc()), frame);
}

TEST(Telegram, LongestOneHas255Octets)
{
    const Octets data(244, 0x55);

    const fdl::Frame frame = fdl::encode_sd2(2, 5, 0x08, 62, 60, data);

    EXPECT_EQ(frame.size(), 255u);
    EXPECT_EQ(octets_of(frame), sd2(2, 5, 0x08, Saps{62, 60}, data));
}

TEST(Telegram, LengthIsUnknownUntilTheHeaderOfAnSd2IsComplete)
{
    for (const char* head : {"68", "68 05", "68 05 05"}) {
        const auto length = fdl::frame_length(octets(head));
        ASSERT_TRUE(length) << head;
        EXPECT_EQ(*length, 0u) << head;
    }
}

TEST(Telegram, LengthOfTheOthersIsKnownFromTheStartDelimiter)
{
    EXPECT_EQ(*fdl::frame_length(octets("10")), 6u);
    EXPECT_EQ(*fdl::frame_length(octets("A2")), 14u);
    EXPECT_EQ(*fdl::frame_length(octets("DC")), 3u);
    EXPECT_EQ(*fdl::frame_length({}), 0u);
}

TEST(Telegram, LeIsLegalFrom4To249)
{
    for (unsigned le = 0; le <= 255; ++le) {
        const auto octet = static_cast<std::uint8_t>(le);
        const auto length = fdl::frame_length(Octets{0x68, octet, octet, 0x68});
        EXPECT_EQ(static_cast<bool>(length), le >= 4 && le <= 249) << le;
        if (length)
            EXPECT_EQ(*length, le + 6);
        else
            EXPECT_EQ(length.error(), fdl::Flaw::length_range);
    }
}

TEST(Telegram, FrameCountBitsAreBits5And4OfARequest)
{
    const Octets first = octets("68 05 05 68 85 82 6D 3C 3E EE 16");
    const Octets next = octets("68 05 05 68 85 82 5D 3C 3E DE 16");

    EXPECT_TRUE(fdl::decode(first)->fcb());
    EXPECT_FALSE(fdl::decode(first)->fcv());
    EXPECT_FALSE(fdl::decode(next)->fcb());
    EXPECT_TRUE(fdl::decode(next)->fcv());
    EXPECT_EQ(fdl::decode(next)->function(), fdl::Function::srd_high);
}

} // namespace
