// SPDX-License-Identifier: Apache-2.0
/// Tests what goes over the line, octet by octet. The frames of the 2000 series handbook (HA026230) are known
/// by their printed checksums; the others were computed by another program.
#include "scripted_slave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace dpslave::modbus::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ModbusRead, TakesTheTagForTheRegisterWithoutAnOffset)
{
    Bench line;
    line.slave().says(octets("01 03 02 00 B7 F8 32"));

    ASSERT_EQ(line.read(number(1, 1)), AccessError::none) << line.drive().last_trouble();

    EXPECT_EQ(line.word(), 183); // 18.3
    EXPECT_EQ(line.drive().last_trouble(), "");
    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 00 01 00 01 D5 CA"));
}

TEST(ModbusRead, TakesABlockInOneRequest)
{
    Bench line;
    line.slave().says(octets("02 03 04 00 B7 00 D8 79 4F")); // the handbook's: PV 18.3, target setpoint 21.6
    std::array<std::uint16_t, 2> words{};

    ASSERT_EQ(line.drive().read({.unit = 2}, number(1, 1), words), AccessError::none);

    EXPECT_THAT(words, ElementsAre(183, 216));
    EXPECT_THAT(line.slave().requested(), ElementsAre("02 03 00 01 00 02 95 F8"));
}

TEST(ModbusRead, TakesAsManyAs123TagsAtOnce)
{
    Bench line;
    std::string answer = "01 03 F6";
    for (int i = 0; i < 123; ++i)
        answer += " 12 " + std::string{"0123456789ABCDEF"[i / 16]} + "0123456789ABCDEF"[i % 16];
    line.slave().answers(answer);
    std::vector<std::uint16_t> words(123);

    ASSERT_EQ(line.drive().read({.unit = 1}, number(1000), words), AccessError::none);

    std::vector<std::uint16_t> expected(123);
    std::iota(expected.begin(), expected.end(), std::uint16_t{0x1200});
    EXPECT_EQ(words, expected);
    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 03 E8 00 7B 85 99"));
}

TEST(ModbusRead, ReachesTheFirstAndTheLastRegister)
{
    Bench line;
    line.slave().answers("01 03 02 FF FF");
    line.slave().answers("01 03 02 80 00");

    ASSERT_EQ(line.read(number(0)), AccessError::none);
    EXPECT_EQ(line.word(), 0xFFFF);
    ASSERT_EQ(line.read(number(0xFFFF)), AccessError::none);
    EXPECT_EQ(line.word(), 0x8000);

    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 00 00 00 01 84 0A", "01 03 FF FF 00 01 84 2E"));
}

TEST(ModbusRead, UsesTheRegisterOfTheRowForOneTagAndTheTagInABlock)
{
    Bench line;
    line.slave().answers("01 03 02 00 05");
    line.slave().answers("01 03 04 00 06 00 07");
    const drive::Tag row = at_register(number(1), 8328);
    std::array<std::uint16_t, 2> words{};

    EXPECT_EQ(line.read(row), AccessError::none);
    EXPECT_EQ(line.drive().read({.unit = 1}, row, words), AccessError::none);

    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 20 88 00 01 0F E0", "01 03 00 01 00 02 95 CB"));
}

TEST(ModbusRead, GivesWordsOfEveryTypeAsTheDriveHasThem)
{
    Bench line;
    for (const auto type : {drive::TagType::number, drive::TagType::word, drive::TagType::boolean,
                            drive::TagType::enumeration}) {
        drive::Tag row = number(75, 1);
        row.type = type;
        line.slave().answers("01 03 02 27 0F");
        EXPECT_EQ(line.read(row), AccessError::none);
        EXPECT_EQ(line.word(), 0x270F); // 999.9 in full resolution
    }
}

TEST(ModbusWrite, WritesOneWordWithFunction6)
{
    Bench line;
    line.slave().says(octets("01 06 00 02 00 FA A8 49"));

    EXPECT_EQ(line.write(number(2, 1), 250), AccessError::none) << line.drive().last_trouble();

    EXPECT_THAT(line.slave().requested(), ElementsAre("01 06 00 02 00 FA A8 49"));
}

TEST(ModbusWrite, WritesABlockWithFunction16)
{
    Bench line;
    line.slave().says(octets("02 10 00 A4 00 03 C1 D8"));
    const std::array<std::uint16_t, 3> setpoints{123, 150, 250};

    EXPECT_EQ(line.drive().write({.unit = 2}, number(164, 1), setpoints), AccessError::none);

    EXPECT_THAT(line.slave().requested(),
                ElementsAre("02 10 00 A4 00 03 06 00 7B 00 96 00 FA 20 71")); // as printed
}

TEST(ModbusWrite, WritesAsManyAs123TagsAtOnce)
{
    Bench line;
    line.slave().answers("01 10 00 64 00 7B");
    const std::vector<std::uint16_t> words(123, 0x0102);

    EXPECT_EQ(line.drive().write({.unit = 1}, number(100), words), AccessError::none);

    ASSERT_EQ(line.slave().requested().size(), 1U);
    EXPECT_EQ(octets(line.slave().requested()[0]).size(), 255U);
    EXPECT_THAT(line.slave().requested()[0], testing::StartsWith("01 10 00 64 00 7B F6 01 02 01 02"));
}

TEST(ModbusWrite, SaysSoWhenTheDriveTookAnotherValue)
{
    Bench line;
    line.slave().answers("01 06 00 02 01 F4");

    EXPECT_EQ(line.write(number(2, 1), 600), AccessError::out_of_range);

    EXPECT_EQ(line.drive().last_trouble(), "the drive took 50.0 instead of 60.0");
}

TEST(ModbusCall, RefusesWhatNoRequestCanHold)
{
    Bench line;
    std::vector<std::uint16_t> words(124);
    drive::Tag text = number(1);
    text.type = drive::TagType::string;

    EXPECT_EQ(line.drive().read({.unit = 1}, number(1), words), AccessError::unsupported_type);
    EXPECT_EQ(line.drive().write({.unit = 1}, number(1), words), AccessError::unsupported_type);
    EXPECT_EQ(line.drive().read({.unit = 1}, number(1), {}), AccessError::unsupported_type);
    EXPECT_EQ(line.drive().write({.unit = 1}, number(1), {}), AccessError::unsupported_type);
    EXPECT_EQ(line.read(text), AccessError::unsupported_type);
    EXPECT_EQ(line.write(text, 1), AccessError::unsupported_type);

    EXPECT_THAT(line.drive().last_trouble(), HasSubstr("STRING"));
    EXPECT_THAT(line.slave().requested(), IsEmpty());
}

TEST(ModbusCall, SendsToTheUnits1To247Only)
{
    Bench line;
    line.slave().answers("F7 03 02 00 01");

    EXPECT_EQ(line.read(number(1), 247), AccessError::none);
    for (const std::uint8_t unit : octets("00 F8 FF")) {
        EXPECT_EQ(line.read(number(1), unit), AccessError::no_answer);
        EXPECT_EQ(line.write(number(1), 5, unit), AccessError::no_answer);
        EXPECT_NE(line.drive().probe({.unit = unit}), AccessError::none);
        EXPECT_EQ(line.drive().last_trouble(),
                  "unit " + std::to_string(unit) + " is no Modbus address (1 to 247)");
    }

    EXPECT_THAT(line.slave().requested(), ElementsAre("F7 03 00 01 00 01 C1 5C"));
}

TEST(ModbusProbe, ReadsRegister1)
{
    Bench line;
    line.slave().answers("01 03 02 00 B7");

    EXPECT_EQ(line.drive().probe({.unit = 1}), AccessError::none);

    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 00 01 00 01 D5 CA"));
}

TEST(ModbusProbe, FindsNoDriveOnASilentLine)
{
    Bench line{20ms};

    EXPECT_NE(line.drive().probe({.unit = 1}), AccessError::none);

    EXPECT_EQ(line.drive().last_trouble(), "no answer");
    EXPECT_THAT(line.slave().requested(1), ElementsAre("01 03 00 01 00 01 D5 CA"));
}

struct GapAtRate {
    std::uint32_t baud;
    char parity;
    std::uint16_t gap;
};
class ModbusBlockRule : public testing::TestWithParam<GapAtRate> {};

/// The numbers of the EI-ASCII and Modbus reference, section 6: 20 characters and 5 ms cost as much as this
/// many words too many.
TEST_P(ModbusBlockRule, JoinsTagsWhereReadingOverTheGapIsCheaper)
{
    io::Pty cable;
    std::atomic<bool> is_open{false};
    const auto drive = ModbusRtu::open(
        {.port = cable.path(), .baud = GetParam().baud, .parity = GetParam().parity}, is_open);
    ASSERT_TRUE(drive) << drive.error();

    const drive::BlockRule rule = (*drive)->block_rule();

    EXPECT_EQ(rule.max_gap, GetParam().gap);
    EXPECT_EQ(rule.max_tags, 123);
    EXPECT_EQ(rule.max_written, 123);
}
INSTANTIATE_TEST_SUITE_P(Rates, ModbusBlockRule,
                         testing::Values(GapAtRate{9600, 'N', 12}, GapAtRate{9600, 'E', 12},
                                         GapAtRate{19'200, 'N', 14}, GapAtRate{1200, 'N', 10},
                                         GapAtRate{115'200, 'N', 38}),
                         [](const auto& at) { return std::to_string(at.param.baud) + at.param.parity; });

} // namespace
} // namespace dpslave::modbus::test
