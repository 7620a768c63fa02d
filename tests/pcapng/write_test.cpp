// SPDX-License-Identifier: Apache-2.0
#include "dpslave/pcapng/pcapng.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace dpslave::pcapng;
using testing::ElementsAreArray;

namespace {

Octets le32(std::initializer_list<std::uint32_t> words)
{
    Octets octets;
    for (const std::uint32_t word : words)
        for (int shift = 0; shift < 32; shift += 8)
            octets.push_back(static_cast<std::uint8_t>(word >> shift));
    return octets;
}

TEST(PcapngFile, BeginsWithASectionAndOneBlockForEachInterface)
{
    const Octets file = file_header("ab", "c", {{257, "bus", ""}});

    const Octets expected = le32({
        0x0A0D0D0A, 48,         0x1A2B3C4D, 0x00000001,
        0xFFFFFFFF, 0xFFFFFFFF,                // version 1.0, length not known
        0x00010001, 0x00000063,                // comment "c"
        0x00020004, 0x00006261,                // program "ab"
        0,          48,                        //
        1,          40,         257,        0, // PROFIBUS_DL, no limit
        0x00030002, 0x00737562,                // name "bus"
        0x00010009, 0x00000009,                // nanoseconds
        0,          40,
    });
    EXPECT_THAT(file, ElementsAreArray(expected));
}

TEST(PcapngFile, APacketHasItsTimeWithTheHighHalfFirst)
{
    const Octets packet = block(Packet{
        .interface = 1, .unix_ns = 0x0102030405060708, .direction = Direction::inbound, .octets = {0xE5}});

    EXPECT_THAT(packet,
                ElementsAreArray(le32({6, 48, 1, 0x01020304, 0x05060708, 1, 1, 0xE5, 0x00040002, 1, 0, 48})));
}

TEST(PcapngFile, FlagsNameDirectionAndFaults)
{
    const auto flags_of = [](Packet packet) {
        const Octets octets = block(packet);
        std::uint32_t flags = 0;
        for (std::size_t i = 9; i <= 12; ++i) flags = flags << 8 | octets[octets.size() - i];
        return flags;
    };

    EXPECT_EQ(flags_of({.direction = Direction::outbound}), 0x00000002U);
    EXPECT_EQ(flags_of({.checksum_error = true}), 0x01000000U);
    EXPECT_EQ(flags_of({.character_error = true}), 0x80000000U);
}

TEST(PcapngFile, StatisticsSayWhatWasReceivedAndDropped)
{
    EXPECT_THAT(block(Statistics{.interface = 2, .unix_ns = 3, .received = 10, .dropped = 4}),
                ElementsAreArray(le32({5, 52, 2, 0, 3, 0x00080004, 10, 0, 0x00080005, 4, 0, 0, 52})));
}

} // namespace
