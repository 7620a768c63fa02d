// SPDX-License-Identifier: Apache-2.0
#include "control/lines.hpp"
#include "dpctl/decode/hex.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace dpslave::dpctl {
namespace {

std::uint16_t word_of(const char* argument)
{
    const auto numbers = read_numbers(argument);
    return numbers && numbers->size() == 1 ? numbers->front().word : 0xDEAD;
}

struct Written {
    const char* name;
    const char* argument;
    std::uint16_t word;
};
class HexNumber : public testing::TestWithParam<Written> {};

TEST_P(HexNumber, IsThisWord)
{
    EXPECT_EQ(word_of(GetParam().argument), GetParam().word);
}

// HA389815 ch. 6 and app. C, HA463561U002 data encoding and hex table (X-29: the printed 045E, 0556 and 052E
// are slips).
INSTANTIATE_TEST_SUITE_P(
    OfTheManuals, HexNumber,
    testing::Values(Written{"Tag288", "288", 0x0120}, Written{"Tag55", "55", 0x0037},
                    Written{"Tag56", "56", 0x0038}, Written{"Tag271", "271", 0x010F},
                    Written{"Printed045E", "1119", 0x045F}, Written{"Printed0556", "1317", 0x0525},
                    Written{"Printed052E", "1327", 0x052F}, Written{"LowerCaseInPrint", "507", 0x01FB},
                    Written{"Encoded300", "300.00", 0x7530}, Written{"EncodedMinus300", "-300.00", 0x8AD0},
                    Written{"BoolOne", "1", 0x0001}, Written{"Program9003", "9003", 0x232B},
                    Written{"Program8867", "8867", 0x22A3}),
    [](const auto& row) { return row.param.name; });
INSTANTIATE_TEST_SUITE_P(Forms, HexNumber,
                         testing::Values(Written{"Prefix", "0x120", 288},
                                         Written{"CapitalPrefix", "0XfF", 255},
                                         Written{"Greater", ">120", 288}, Written{"Suffix", "0120h", 288},
                                         Written{"Plus", "+12.5", 125}, Written{"Lowest", "-32768", 0x8000},
                                         Written{"Highest", "65535", 0xFFFF}),
                         [](const auto& row) { return row.param.name; });

TEST(Hex, RefusesWhatIsNoNumberOf16Bits)
{
    for (const char* argument : {"65536", "-32769", "0x10000", "99999999999999", "", "-", "12a", "0x",
                                 "1.2.3", "--5", "5-", "9-3", "1.0-2.0", "0-65536", "-3-5"})
        EXPECT_FALSE(read_numbers(argument)) << argument;
    EXPECT_EQ(read_numbers("65536").error(), "65536 does not fit into 16 bits: -32768 to 65535");
    EXPECT_EQ(read_numbers("9-3").error(), "'9-3': the first number must not be above the last");
}

TEST(Hex, ShowsDecimalSignedHexadecimalAndTheOctetsOfUserPrmData)
{
    std::vector<Number16> numbers;
    for (const char* argument : {"288", "0x8AD0", "-300.00"})
        numbers.push_back(read_numbers(argument)->front());

    EXPECT_EQ(render_numbers(numbers, false), test::lines(R"(
 NUMBER  DECIMAL  SIGNED  HEX   OCTETS
    288      288     288  0120  01 20
 0x8AD0    35536  -30000  8AD0  8A D0
-300.00    35536  -30000  8AD0  8A D0
)"));
    EXPECT_EQ(hex_json(numbers)["numbers"][0],
              Json::parse(R"({"text":"288","value":288,"signed":288,"hex":"0120","octets":[1,32]})"));
}

TEST(Hex, PrintsARangeTenInALineAsTheManualsDo)
{
    EXPECT_EQ(render_range(*read_numbers("8-31"), false), test::lines(R"(
       0     1     2     3     4     5     6     7     8     9
 0                                                  0008  0009
10  000A  000B  000C  000D  000E  000F  0010  0011  0012  0013
20  0014  0015  0016  0017  0018  0019  001A  001B  001C  001D
30  001E  001F
)"));
}

/// Every cell read back: row + column is the number (HA389815 app. C has 0 to 559, HA463561U002 0 to 1499).
TEST(Hex, EveryCellOfTheTablesOfTheManualsIsRight)
{
    std::istringstream lines{render_range(*read_numbers("0-1499"), false)};
    std::string line;
    std::getline(lines, line);
    long expected = 0;
    while (std::getline(lines, line)) {
        std::istringstream cells{line};
        long row = -1;
        cells >> row;
        EXPECT_EQ(row, expected);
        std::string cell;
        while (cells >> cell) EXPECT_EQ(std::stol(cell, nullptr, 16), expected++);
    }
    EXPECT_EQ(expected, 1500);
}

} // namespace
} // namespace dpslave::dpctl
