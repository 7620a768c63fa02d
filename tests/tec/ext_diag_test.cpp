// SPDX-License-Identifier: Apache-2.0
/// The four octets of the extended diagnosis and the trip codes, and both in words (B-080, B-082 to B-084).
#include "dpslave/tec/option_block.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dpslave::tec {
namespace {

using Block = std::array<std::uint8_t, 4>;

TEST(TecExtDiag, OfTheManualsExample)
{
    EXPECT_EQ(ext_diag(TripForm::code, 1, 0x6AB5), (Block{0x04, 0x01, 0x6A, 0xB5}));
    EXPECT_EQ(trip_words(0x01), "1: LINK OVERVOLTS");
}

TEST(TecExtDiag, WithNothingToSayIsZerosBehindItsHeader)
{
    EXPECT_EQ(ext_diag(TripForm::code, 0, 0), (Block{0x04, 0x00, 0x00, 0x00}));
    EXPECT_EQ(ext_diag(TripForm::tripped, 0, 0), (Block{0x04, 0x00, 0x00, 0x00}));
}

TEST(TecExtDiag, TheCodeIsTheLowOctetOfTheTripWord)
{
    EXPECT_EQ(ext_diag(TripForm::code, 0xFF15, 0xFFFF), (Block{0x04, 0x15, 0xFF, 0xFF}));
    EXPECT_EQ(ext_diag(TripForm::code, 0xFF00, 0), (Block{0x04, 0x00, 0x00, 0x00}));
}

TEST(TecExtDiag, Bits5To7AreZeroAndNoTripIsHiddenByThat)
{
    for (unsigned code = 0; code <= 255; ++code) {
        const std::uint8_t trip = ext_diag(TripForm::code, static_cast<std::uint16_t>(code), 0)[1];
        EXPECT_EQ(trip, code <= 31 ? code : 31u);
    }
}

TEST(TecExtDiag, OfADriveThatDoesNotSayWhyIs31ForAnyTrip)
{
    for (const std::uint16_t word : std::array<std::uint16_t, 5>{0x0001, 0x0015, 0x0100, 0x8000, 0xFFFF})
        EXPECT_EQ(ext_diag(TripForm::tripped, word, 0x0102), (Block{0x04, 31, 0x01, 0x02})) << word;
    EXPECT_EQ(trip_words(31), "31: TRIPPED");
}

TEST(TecTripWords, NameTheCodesOfTheManualAndNoOthers)
{
    const char* const printed[32] = {"NO TRIP",
                                     "LINK OVERVOLTS",
                                     "LINK UNDERVOLTS",
                                     "LINK OVERCURRENT",
                                     "HEATSINK TEMPERATURE",
                                     "EXTERNAL TRIP",
                                     "INPUT 1 BREAK",
                                     "INPUT 2 BREAK",
                                     "MOTOR STALLED",
                                     "I*T",
                                     "BRAKE RESISTOR",
                                     "BRAKE SWITCH",
                                     "OPERATOR STATION",
                                     "LOST COMMUNICATIONS",
                                     "",
                                     "",
                                     "",
                                     "MOTOR TEMPERATURE",
                                     "CURRENT LIMIT",
                                     "",
                                     "24V FAILURE",
                                     "LOW SPEED CURRENT",
                                     "",
                                     "",
                                     "",
                                     "",
                                     "",
                                     "",
                                     "",
                                     "",
                                     "",
                                     "TRIPPED"};
    for (unsigned code = 0; code < 32; ++code) {
        const std::string name = *printed[code] == '\0' ? "not named in the manual" : printed[code];
        EXPECT_EQ(trip_words(static_cast<std::uint8_t>(code)), std::to_string(code) + ": " + name);
    }
}

TEST(TecTripWords, LeaveBits5To7Aside)
{
    EXPECT_EQ(trip_words(0x21), "1: LINK OVERVOLTS");
    EXPECT_EQ(trip_words(0xE0), "0: NO TRIP");
}

TEST(TecExtDiagWords, SayOctetByOctetWhatTheBlockOfTheExampleSays)
{
    const Block block{0x04, 0x01, 0x6A, 0xB5};

    EXPECT_EQ(ext_diag_words(block, 1), "trip code 1: LINK OVERVOLTS");
    EXPECT_EQ(ext_diag_words(block, 2), "EXT DIAGNOSTIC, high octet");
    EXPECT_EQ(ext_diag_words(block, 3), "EXT DIAGNOSTIC, low octet: >6AB5");
    EXPECT_EQ(ext_diag_words(Block{0x04, 31, 0, 0}, 1), "trip code 31: TRIPPED");
}

TEST(TecExtDiagWords, ReadNothingBehindTheEndOfTheBlock)
{
    const Block block{0x04, 0x01, 0x6A, 0xB5};

    EXPECT_EQ(ext_diag_words(Bytes{block}.first(3), 2), "EXT DIAGNOSTIC, high octet");
    for (const std::size_t i : {std::size_t{0}, std::size_t{4}, std::size_t{99}})
        EXPECT_EQ(ext_diag_words(block, i), "") << "no octet of what the block says";
    EXPECT_EQ(ext_diag_words(Bytes{block}.first(3), 3), "");
}

} // namespace
} // namespace dpslave::tec
