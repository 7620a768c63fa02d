// SPDX-License-Identifier: Apache-2.0
/// Answers that come too late, octets without a request, and the silence between two telegrams. Where a
/// time is looked at, it is one that must at least have passed.
#include "scripted_slave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace dpslave::modbus::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::SizeIs;

/// The timeout of the late answers: the slave of a test answers within it, or after it.
constexpr auto kLateTimeout = 400ms;

TEST(ModbusLateAnswer, IsNotTakenForTheOneToTheNextRequest)
{
    Bench line{kLateTimeout};
    line.drive().set_units({{.unit = 1, .reads_by_4 = true, .has_loopback = false}});
    line.slave().answers("01 03 02 00 07");
    ASSERT_EQ(line.read(number(2)), AccessError::none);
    line.slave().is_silent();
    ASSERT_EQ(line.read(number(1)), AccessError::no_answer);
    line.arrives(framed("01 03 02 11 11")); // what register 1 had to say
    Octets both = framed("01 03 02 11 11"); // and once more: with the next answer
    for (const std::uint8_t octet : framed("01 04 02 22 22")) both.push_back(octet);
    line.slave().says(both);

    const AccessError error = line.read(number(2));

    EXPECT_TRUE(error == AccessError::none && line.word() == 0x2222) << line.drive().last_trouble();
}

TEST(ModbusLateAnswer, IsNotTakenForTheAnswerToAWriteEither)
{
    Bench line{kLateTimeout};
    line.slave().is_silent();
    ASSERT_EQ(line.write(number(1), 5), AccessError::no_answer);

    EXPECT_EQ(line.write(number(2), 5), AccessError::deferred) << "its answer would look like a late one";
    EXPECT_THAT(line.slave().requests(), SizeIs(1));
}

TEST(ModbusLateAnswer, ThatIsTornKeepsNothingFromTheNextRequest)
{
    Bench line{kLateTimeout};
    line.drive().set_units({{.unit = 1, .reads_by_4 = true, .has_loopback = false}});
    line.slave().answers("01 03 02 00 07");
    ASSERT_EQ(line.read(number(2)), AccessError::none);
    line.slave().says(octets("01 03 02 11"));
    ASSERT_EQ(line.read(number(1)), AccessError::no_answer);
    line.arrives(octets("11 55 66")); // its rest
    line.slave().answers("01 04 02 22 22");

    ASSERT_EQ(line.read(number(2)), AccessError::none);

    EXPECT_EQ(line.word(), 0x2222);
}

TEST(ModbusLateAnswer, OfAnotherLengthIsPassedOverWhileTheRightOneIsAwaited)
{
    Bench line;
    Octets both = framed("01 03 04 11 11 11 11");
    for (const std::uint8_t octet : framed("01 03 02 22 22")) both.push_back(octet);
    line.slave().says(both);

    ASSERT_EQ(line.read(number(2)), AccessError::none);

    EXPECT_EQ(line.word(), 0x2222);
}

TEST(ModbusLateAnswer, OfAnotherUnitIsPassedOver)
{
    Bench line{kLateTimeout};
    line.slave().is_silent();
    ASSERT_EQ(line.read(number(1), 1), AccessError::no_answer);
    Octets both = framed("01 03 02 11 11"); // unit 1, late
    for (const std::uint8_t octet : framed("02 03 02 22 22")) both.push_back(octet);
    line.slave().says(both);

    ASSERT_EQ(line.read(number(1), 2), AccessError::none);

    EXPECT_EQ(line.word(), 0x2222);
}

TEST(ModbusStaleOctets, AreGoneBeforeARequest)
{
    Bench line;
    line.arrives(framed("01 03 02 11 11"));
    line.slave().answers("01 03 02 22 22");

    ASSERT_EQ(line.read(number(1)), AccessError::none);

    EXPECT_EQ(line.word(), 0x2222);
}

TEST(ModbusStaleOctets, BehindAnAnswerAreGoneBeforeTheNextRequest)
{
    Bench line;
    Octets more = framed("01 03 02 11 11");
    for (const std::uint8_t octet : framed("01 03 02 33 33")) more.push_back(octet);
    line.slave().says(more);
    line.slave().answers("01 03 02 22 22");

    ASSERT_EQ(line.read(number(1)), AccessError::none);
    EXPECT_EQ(line.word(), 0x1111);
    ASSERT_EQ(line.read(number(2)), AccessError::none);
    EXPECT_EQ(line.word(), 0x2222);
}

TEST(ModbusStaleOctets, BehindAWrongCheckSumAreGoneBeforeTheRepetition)
{
    Bench line;
    line.drive().set_units({{.unit = 1, .reads_by_4 = true, .has_loopback = false}});
    line.slave().answers("01 03 02 00 07");
    ASSERT_EQ(line.read(number(1)), AccessError::none);
    line.slave().says(octets("01 03 02 11 11 00 00 55 55 55"));
    line.slave().answers("01 04 02 22 22");

    ASSERT_EQ(line.read(number(1)), AccessError::no_answer);
    ASSERT_EQ(line.read(number(1)), AccessError::none);

    EXPECT_EQ(line.word(), 0x2222);
}

struct Pause {
    std::uint32_t baud;
    std::chrono::microseconds length;
};
class ModbusPause : public testing::TestWithParam<Pause> {};

TEST_P(ModbusPause, DividesAnAnswerFromTheNextRequest)
{
    Bench line{20s, GetParam().baud};
    line.slave().answers("01 03 02 00 01");
    line.slave().answers("01 03 02 00 02");

    ASSERT_EQ(line.read(number(1)), AccessError::none);
    ASSERT_EQ(line.read(number(2)), AccessError::none);

    const auto requests = line.slave().requests();
    ASSERT_THAT(requests, SizeIs(2));
    EXPECT_GE(requests[1].came - requests[0].answered, GetParam().length);
}

INSTANTIATE_TEST_SUITE_P(Rates, ModbusPause,
                         testing::Values(Pause{1200, 29'166us}, Pause{9600, 3645us}, Pause{19'200, 1822us},
                                         Pause{115'200, 1750us}),
                         [](const auto& pause) { return std::to_string(pause.param.baud); });

} // namespace
} // namespace dpslave::modbus::test
