// SPDX-License-Identifier: Apache-2.0
// Captures of the older form, written octet by octet.
#include "dpslave/pcapng/pcapng.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace dpslave::pcapng;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

constexpr std::uint32_t kMicroseconds = 0xA1B2C3D4, kNanoseconds = 0xA1B23C4D;

/// A file number by number, in one byte order or the other.
struct PcapFile {
    bool big_endian = false;
    Octets octets{};

    PcapFile& number(std::uint32_t value, int size)
    {
        for (int i = 0; i < size; ++i)
            octets.push_back(static_cast<std::uint8_t>(value >> 8 * (big_endian ? size - 1 - i : i)));
        return *this;
    }
    PcapFile& head(std::uint32_t magic, std::uint32_t link_type = 257, std::uint32_t minor = 4)
    {
        number(magic, 4).number(2, 2).number(minor, 2).number(0, 4).number(0, 4);
        return number(65'535, 4).number(link_type, 4);
    }
    PcapFile& packet(std::uint32_t seconds, std::uint32_t fraction, const Octets& data)
    {
        const auto size = static_cast<std::uint32_t>(data.size());
        number(seconds, 4).number(fraction, 4).number(size, 4).number(size + 7, 4);
        octets.insert(octets.end(), data.begin(), data.end());
        return *this;
    }
};

std::string why_not(const Octets& octets)
{
    const auto capture = read(octets);
    return capture ? std::string{} : capture.error();
}

TEST(PcapReader, ReadsBothByteOrdersAndBothUnitsOfTime)
{
    for (const bool big_endian : {false, true})
        for (const std::uint32_t magic : {kMicroseconds, kNanoseconds}) {
            const PcapFile file =
                PcapFile{big_endian}.head(magic).packet(7, 5000, {0xE5}).packet(8, 0, {0xDC, 2, 3});

            bool cut = true;
            const auto capture = read(file.octets, &cut);

            ASSERT_TRUE(capture) << capture.error();
            EXPECT_FALSE(cut);
            ASSERT_EQ(capture->interfaces.size(), 1U);
            EXPECT_EQ(capture->interfaces[0].link_type, 257);
            ASSERT_EQ(capture->packets.size(), 2U);
            EXPECT_EQ(capture->packets[0].unix_ns, magic == kMicroseconds ? 7'005'000'000 : 7'000'005'000);
            EXPECT_THAT(capture->packets[0].octets, ElementsAre(0xE5));
            EXPECT_EQ(capture->packets[0].direction, Direction::unknown);
            EXPECT_THAT(capture->packets[1].octets, ElementsAre(0xDC, 2, 3));
        }
}

TEST(PcapReader, WhatStandsAboveTheLinkTypeInItsWordIsLeftOut)
{
    for (const bool big_endian : {false, true}) {
        const auto capture = read(PcapFile{big_endian}.head(kMicroseconds, 0x24000000 | 147).octets);

        ASSERT_TRUE(capture) << capture.error();
        EXPECT_EQ(capture->interfaces[0].link_type, 147);
    }
}

TEST(PcapReader, AFileWhoseWriterWasKilledGivesEachWholePacketAndSaysSo)
{
    Octets octets = PcapFile{}.head(kMicroseconds).packet(1, 0, {0xE5}).packet(2, 0, {0xDC, 2, 3}).octets;
    for (std::size_t missing = 1; missing < 16 + 3; ++missing) {
        octets.pop_back();
        bool cut = false;

        const auto capture = read(octets, &cut);

        ASSERT_TRUE(capture) << capture.error();
        EXPECT_TRUE(cut);
        EXPECT_EQ(capture->packets.size(), 1U) << missing;
    }
}

TEST(PcapReader, RefusesWhatContradictsItselfAndSaysWhere)
{
    EXPECT_THAT(why_not(PcapFile{}
                            .head(kMicroseconds)
                            .number(0, 4)
                            .number(0, 4)
                            .number(0x7FFFFFFF, 4)
                            .number(0, 4)
                            .octets),
                HasSubstr("octet 24: its length is none"));
    EXPECT_THAT(why_not(PcapFile{}.head(kMicroseconds, 257, 3).octets), HasSubstr("version 2.3"));
    Octets octets = PcapFile{}.head(kMicroseconds).octets;
    octets.pop_back();
    EXPECT_THAT(why_not(octets), HasSubstr("cut off within its head"));
}

TEST(CaptureReader, OfAFileThatIsNoCaptureSaysWhatItIsAndWhatToDo)
{
    EXPECT_THAT(why_not({}), HasSubstr("empty"));
    EXPECT_THAT(why_not({0x1F, 0x8B, 8, 0}), HasSubstr("compressed with gzip: unpack it"));
    EXPECT_THAT(why_not({0x28, 0xB5, 0x2F, 0xFD}), HasSubstr("zstd"));
    EXPECT_THAT(why_not({0x04, 0x22, 0x4D, 0x18}), HasSubstr("lz4"));
    EXPECT_THAT(why_not({0xFD, '7', 'z', 'X', 'Z', 0}), HasSubstr("xz"));
    EXPECT_THAT(why_not(PcapFile{}.head(0xA1B2CD34).octets), HasSubstr("save it as pcapng"));
    EXPECT_THAT(why_not(PcapFile{true}.head(0xA1B2CD34).octets), HasSubstr("save it as pcapng"));
    const std::string incident = "dpslaved incident 1\n{}\n";
    EXPECT_THAT(why_not({incident.begin(), incident.end()}), HasSubstr("dpctl trace --incident"));
    EXPECT_THAT(why_not({'h', 'e', 'l', 'l', 'o'}), HasSubstr("no capture"));
}

} // namespace
