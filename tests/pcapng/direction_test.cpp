// SPDX-License-Identifier: Apache-2.0
// Who sent a packet, where the capture does not say it. The telegrams are those of the wire reference.
#include "dpslave/pcapng/pcapng.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace dpslave::pcapng;
using testing::HasSubstr;
using testing::Not;

namespace {

/// A capture of one packet without a direction.
Capture of(Octets octets, std::uint16_t link_type = 257)
{
    Capture capture;
    capture.interfaces.push_back({.link_type = link_type, .name = {}, .description = {}});
    capture.packets.push_back({.octets = std::move(octets)});
    return capture;
}

Direction assumed_of(Octets octets)
{
    Capture capture = of(std::move(octets));
    assume_directions(capture);
    return capture.packets.at(0).direction;
}

TEST(CaptureDirection, BitSixOfTheFunctionCodeTellsARequestFromAReply)
{
    EXPECT_EQ(assumed_of({0x10, 0x05, 0x02, 0x49, 0x50, 0x16}), Direction::inbound);
    EXPECT_EQ(assumed_of({0x10, 0x02, 0x05, 0x00, 0x07, 0x16}), Direction::outbound);
    EXPECT_EQ(assumed_of({0x68, 0x05, 0x05, 0x68, 0x85, 0x82, 0x6D, 0x3C, 0x3E, 0xEE, 0x16}),
              Direction::inbound);
    EXPECT_EQ(assumed_of({0x68, 0x05, 0x05, 0x68, 0x02, 0x05, 0x08, 0x12, 0x34, 0x55, 0x16}),
              Direction::outbound);
    EXPECT_EQ(assumed_of({0xA2, 0x05, 0x02, 0x5D, 1, 2, 3, 4, 5, 6, 7, 8, 0x88, 0x16}), Direction::inbound);
    EXPECT_EQ(assumed_of({0xA2, 0x02, 0x05, 0x08, 1, 2, 3, 4, 5, 6, 7, 8, 0x33, 0x16}), Direction::outbound);
}

TEST(CaptureDirection, AShortAcknowledgeIsAReplyAndATokenIsNone)
{
    EXPECT_EQ(assumed_of({0xE5}), Direction::outbound);
    EXPECT_EQ(assumed_of({0xDC, 0x03, 0x02}), Direction::inbound);
}

TEST(CaptureDirection, WhatIsNoTelegramWasHeard)
{
    EXPECT_EQ(assumed_of({0x10, 0x02, 0x05, 0x00, 0x08, 0x16}), Direction::inbound) << "a wrong checksum";
    EXPECT_EQ(assumed_of({0x10, 0x02, 0x05, 0x00, 0x07, 0x17}), Direction::inbound) << "no end delimiter";
    EXPECT_EQ(assumed_of({0x10, 0x02, 0x05}), Direction::inbound);
    EXPECT_EQ(assumed_of({0x68, 0x05, 0x04, 0x68, 0x02, 0x05, 0x08, 0x12, 0x34, 0x55, 0x16}),
              Direction::inbound);
    EXPECT_EQ(assumed_of({0x68, 0x00, 0x00, 0x68, 0x00, 0x16}), Direction::inbound) << "nothing in it";
    EXPECT_EQ(assumed_of({0xFF}), Direction::inbound);
}

TEST(CaptureDirection, APacketThatHasOneKeepsItAndNothingIsAssumed)
{
    Capture capture = of({0x10, 0x02, 0x05, 0x00, 0x07, 0x16});
    capture.packets[0].direction = Direction::inbound; // a reply of another station

    EXPECT_EQ(assume_directions(capture).packets, 0U);
    EXPECT_EQ(capture.packets[0].direction, Direction::inbound);
}

TEST(CaptureDirection, OfADriveLineAndOfAPacketWithoutOctetsNothingIsAssumed)
{
    Capture drive = of({0xE5}, 148), comment = of({});

    EXPECT_EQ(assume_directions(drive).packets, 0U);
    EXPECT_EQ(assume_directions(comment).packets, 0U);
    EXPECT_EQ(drive.packets[0].direction, Direction::unknown);
}

TEST(CaptureDirection, WhatWasAssumedIsSaidWithTheStationsThatReplied)
{
    Capture capture = of({0x10, 0x02, 0x05, 0x00, 0x07, 0x16});
    capture.packets.push_back({.octets = {0x68, 0x05, 0x05, 0x68, 0x82, 0x88, 0x08, 0x3E, 0x3C, 0x8C, 0x16}});
    const Assumed assumed = assume_directions(capture);

    EXPECT_THAT(in_words(assumed), HasSubstr("2 packets of the bus"));
    EXPECT_THAT(in_words(assumed), HasSubstr("bit 6"));
    EXPECT_THAT(in_words(assumed), HasSubstr("Its stations are then 5, 8"));
    EXPECT_THAT(in_words({.packets = 1}), Not(HasSubstr("stations")));
}

} // namespace
