// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/number.hpp"

#include <gtest/gtest.h>

namespace dpslave {
namespace {

TEST(TypedNumber, IsDecimalWithOrWithoutLeadingZeros)
{
    EXPECT_EQ(read_number("70"), 70);
    EXPECT_EQ(read_number("070"), 70);
    EXPECT_EQ(read_number("000089"), 89);
    EXPECT_EQ(read_number("-010"), -10);
    EXPECT_EQ(read_number("0"), 0);
    EXPECT_EQ(read_number("9223372036854775807"), INT64_MAX);
}

TEST(TypedNumber, IsHexadecimalOnlyBehind0x)
{
    EXPECT_EQ(read_number("0x46"), 70);
    EXPECT_EQ(read_number("0X0046"), 70);
    EXPECT_EQ(read_number("-0x10"), -16);
    for (const char* const text : {"1A", "0x", "0x-5", "46h", ">46", "x46", "0b11", "0o17"})
        EXPECT_EQ(read_number(text), std::nullopt) << text;
}

TEST(TypedNumber, IsNothingWhereMoreOrLessIsTyped)
{
    for (const char* const text : {"", "-", "--5", "+5", " 5", "5 ", "1.5", "1e3", "9223372036854775808"})
        EXPECT_EQ(read_number(text), std::nullopt) << text;
}

TEST(TypedNumber, IsNothingBeyondItsLimits)
{
    EXPECT_EQ(read_number("0126", 0, 126), 126);
    EXPECT_EQ(read_number("0127", 0, 126), std::nullopt);
    EXPECT_EQ(read_number("-1", 0, 126), std::nullopt);
}

TEST(TypedIdent, Behind0xOrOfUpToThreeDigitsIsTaken)
{
    EXPECT_EQ(read_ident("0x1649").number, 0x1649);
    EXPECT_EQ(read_ident("0x533").number, 0x533);
    EXPECT_EQ(read_ident("533").number, 533);
    EXPECT_EQ(read_ident("010").number, 10);
}

TEST(TypedIdent, OfFourDigitsWithout0xIsRefusedWithBothReadings)
{
    EXPECT_EQ(read_ident("1649").number, std::nullopt);
    EXPECT_EQ(read_ident("1649").fault, "1649 could mean 0x1649 or 1649 = 0x0671: write 0x1649 or 0x0671");
    EXPECT_EQ(read_ident("0533").fault, "0533 could mean 0x0533 or 0533 = 0x0215: write 0x0533 or 0x0215");
    EXPECT_EQ(read_ident("16AB").fault, "16AB: write 0x16AB");
    EXPECT_EQ(read_ident("40000").fault, "40000 is 0x9C40: write 0x9C40");
}

TEST(TypedIdent, OfNoNumberSaysWhatToWrite)
{
    for (const char* const text : {"", "0", "0x0", "0x10000", "70000", "five", "-5"}) {
        EXPECT_EQ(read_ident(text).number, std::nullopt) << text;
        EXPECT_NE(read_ident(text).fault.find("write a number from 0x0001 to 0xFFFF, such as 0x1649"),
                  std::string::npos)
            << text;
    }
}

TEST(NumberOption, PutsThePlainDecimalInPlaceOfWhatWasTyped)
{
    std::string text = "0070";
    EXPECT_EQ((NumberOption{0, 65535}(text)), "");
    EXPECT_EQ(text, "70");
    text = "0x10";
    EXPECT_EQ((NumberOption{0, 65535}(text)), "");
    EXPECT_EQ(text, "16");
}

TEST(NumberOption, NamesTheLimitsOfWhatItRefuses)
{
    std::string text = "0127";
    EXPECT_EQ((NumberOption{0, 126}(text)), "0127: write a number from 0 to 126");
    EXPECT_EQ(text, "0127");
}

} // namespace
} // namespace dpslave
