// SPDX-License-Identifier: Apache-2.0
/// Tags in the IEEE area of the 2000 series: address 2 x tag + 8000h, two registers, high word first.
/// The singles were made by another program.
#include "modbus/ieee.hpp"
#include "scripted_slave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::modbus::test {
namespace {

using testing::ElementsAre;
using testing::Optional;

drive::Tag ieee(std::uint8_t decimals)
{
    drive::Tag row = at_register(number(2, decimals), 0x8004);
    row.is_real = true;
    return row;
}

drive::Tag ieee_of_type(drive::TagType type)
{
    drive::Tag row = ieee(0);
    row.is_real = false;
    row.type = type;
    return row;
}

drive::Tag unsigned_ieee(std::uint8_t decimals)
{
    drive::Tag row = ieee(decimals);
    row.is_unsigned = true;
    return row;
}

TEST(ModbusIeee, ReadsBothRegistersInOneRequest)
{
    Bench line;
    line.slave().answers("01 03 04 44 79 F9 9A"); // 999.9

    ASSERT_EQ(line.read(ieee(1)), AccessError::none);

    EXPECT_EQ(line.word(), 9999);
    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 80 04 00 02 AC 0A"));
}

TEST(ModbusIeee, WritesBothRegistersWithFunction16)
{
    Bench line;
    line.slave().answers("01 10 80 04 00 02");

    EXPECT_EQ(line.write(ieee(1), 250), AccessError::none); // 25.0

    EXPECT_THAT(line.slave().requested(), ElementsAre("01 10 80 04 00 02 04 41 C8 00 00 06 58"));
}

TEST(ModbusIeee, TakesEnumerationsWordsAndIntegersFromTheFirstRegister)
{
    Bench line;
    for (const auto type : {drive::TagType::enumeration, drive::TagType::word, drive::TagType::boolean,
                            drive::TagType::number}) {
        line.slave().answers("01 03 04 00 05 80 00");
        line.slave().answers("01 10 80 04 00 02");

        EXPECT_EQ(line.read(ieee_of_type(type)), AccessError::none);
        EXPECT_EQ(line.word(), 5);
        EXPECT_EQ(line.write(ieee_of_type(type), 1), AccessError::none);
        EXPECT_THAT(line.slave().requested().back(), testing::StartsWith("01 10 80 04 00 02 04 00 01 80 00"));
    }
}

TEST(ModbusIeee, SaysWhichValueDoesNotFit)
{
    Bench line;
    line.slave().answers("01 03 04 46 FF FF 00"); // 32767.5

    EXPECT_EQ(line.read(ieee(0)), AccessError::does_not_fit) << "the drive's, not that of a master";

    EXPECT_EQ(line.word(), kUntouched);
    EXPECT_EQ(line.drive().last_trouble(),
              "the drive itself has 32767.5 in tag 2, which with 0 decimals does not fit 16 bits");
}

TEST(ModbusIeee, SaysThatTheDriveHasNoNumberOrAnInfiniteOne)
{
    Bench line;
    line.slave().answers("01 03 04 7F C0 00 00");
    line.slave().answers("01 03 04 FF 80 00 00");

    EXPECT_EQ(line.read(ieee(0)), AccessError::does_not_fit);
    EXPECT_EQ(line.drive().last_trouble(), "the drive itself has no number in tag 2 (NaN)");
    EXPECT_EQ(line.read(ieee(0)), AccessError::does_not_fit);
    EXPECT_EQ(line.drive().last_trouble(), "the drive itself has an infinite value in tag 2");
    EXPECT_EQ(line.word(), kUntouched);
}

TEST(ModbusIeee, HasTheExceptionsOfOneTag)
{
    Bench line;
    line.slave().answers("01 83 02");
    line.slave().answers("01 90 03");
    line.slave().answers("01 90 03");

    EXPECT_EQ(line.read(ieee(0)), AccessError::invalid_tag);
    EXPECT_EQ(line.write(ieee(0), 1), AccessError::out_of_range);
    EXPECT_EQ(line.write(read_only(ieee(0)), 1), AccessError::read_only);
}

TEST(ModbusIeee, BeginsAtRegister8000hOfARow)
{
    EXPECT_FALSE(is_ieee(number(0x9000)));
    EXPECT_FALSE(is_ieee(at_register(number(2), 0x7FFF)));
    EXPECT_TRUE(is_ieee(at_register(number(0), 0x8000)));
}

struct Single {
    const char* name;
    IeeePair pair;
    std::uint8_t decimals;
    std::optional<int> counts;
};
class ModbusRounding : public testing::TestWithParam<Single> {};

TEST_P(ModbusRounding, IsToNearestAndTiesAwayFromZero)
{
    const auto word = word_of(ieee(GetParam().decimals), GetParam().pair);

    const auto counts = word ? std::optional<int>{static_cast<std::int16_t>(*word)} : std::nullopt;
    EXPECT_EQ(counts, GetParam().counts);
}

INSTANTIATE_TEST_SUITE_P(
    X23, ModbusRounding,
    testing::Values(
        Single{"IntegerOf999_9", {0x4479, 0xF99A}, 0, 1000}, // the manual's two examples
        Single{"IntegerOf12_34", {0x4145, 0x70A4}, 0, 12},   //
        Single{"FullOf999_9", {0x4479, 0xF99A}, 1, 9999}, Single{"FullOf12_34", {0x4145, 0x70A4}, 2, 1234},
        Single{"FewerDigitsThanDecimals", {0x4145, 0x70A4}, 3, 12'340},
        Single{"Tie", {0x4020, 0x0000}, 0, 3},          // 2.5
        Single{"NegativeTie", {0xC020, 0x0000}, 0, -3}, // -2.5
        Single{"Half", {0x3F00, 0x0000}, 0, 1},
        Single{"TieInDecimalThoughNotInTheSingle", {0x3EB3, 0x3333}, 1, 4}, // 0.35
        Single{"NegativeFull", {0xC3A3, 0xD70A}, 2, -32'768},               // -327.68
        Single{"NegativeToZero", {0xBECC, 0xCCCD}, 0, 0},                   // -0.4
        Single{"NegativeZero", {0x8000, 0x0000}, 4, 0}, Single{"TheSmallestThereIs", {0x0000, 0x0001}, 4, 0},
        Single{"Largest", {0x46FF, 0xFECD}, 0, 32'767}, // 32767.4
        Single{"TooLarge", {0x46FF, 0xFF00}, 0, {}},    // 32767.5
        Single{"Least", {0xC700, 0x0066}, 0, -32'768},  // -32768.4
        Single{"TooSmall", {0xC700, 0x0080}, 0, {}},    // -32768.5
        Single{"TooLargeForItsDecimals", {0x4479, 0xF99A}, 2, {}},
        Single{"TooLargeByFar", {0x7F7F, 0xFFFF}, 0, {}}, Single{"Infinity", {0x7F80, 0x0000}, 0, {}},
        Single{"NotANumber", {0x7FC0, 0x0000}, 0, {}}),
    [](const auto& single) { return single.param.name; });

TEST(ModbusIeee, HasAllSixteenBitsOfAnUnsignedTag)
{
    EXPECT_THAT(word_of(unsigned_ieee(0), {0x477F, 0xFF00}), Optional(65'535));
    EXPECT_EQ(word_of(unsigned_ieee(0), {0x477F, 0xFF80}), std::nullopt); // 65535.5
    EXPECT_EQ(word_of(unsigned_ieee(0), {0xBF80, 0x0000}), std::nullopt); // -1
    EXPECT_THAT(pair_of(unsigned_ieee(0), 0xFFFF), ElementsAre(0x477F, 0xFF00));
    EXPECT_THAT(pair_of(ieee(0), 0xFFFF), ElementsAre(0xBF80, 0x0000));
}

TEST(ModbusIeee, GivesBackEveryWordThatWasWritten)
{
    for (std::uint8_t decimals = 0; decimals <= 4; ++decimals) {
        for (unsigned word = 0; word <= 0xFFFF; ++word) {
            const auto as_word = static_cast<std::uint16_t>(word);
            ASSERT_EQ(word_of(ieee(decimals), pair_of(ieee(decimals), as_word)), as_word);
            ASSERT_EQ(word_of(unsigned_ieee(decimals), pair_of(unsigned_ieee(decimals), as_word)), as_word);
        }
    }
}

} // namespace
} // namespace dpslave::modbus::test
