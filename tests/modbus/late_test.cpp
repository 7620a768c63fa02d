// SPDX-License-Identifier: Apache-2.0
/// Answers that come too late, octets that nobody asked for, and the silence between two telegrams. Where a
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

/// Short enough to be waited for, long enough for the slave of a test to answer within it.
constexpr auto kTimeout = 400ms;

/// How long after the next call began the late answer comes: before the time for it is over.
constexpr auto kLate = 100ms;

TEST(ModbusLateAnswer, IsNotTakenForTheOneToTheNextRequest)
{
    Bench line{kTimeout};
    line.slave().is_silent();
    ASSERT_EQ(line.read(number(1)), AccessError::no_answer);
    line.slave().answers("01 03 02 22 22");
    line.slave().says_by_itself(framed("01 03 02 11 11"), kLate); // what register 1 had to say

    ASSERT_EQ(line.read(number(2)), AccessError::none);

    EXPECT_EQ(line.word(), 0x2222);
    ASSERT_THAT(line.slave().requests(), SizeIs(2));
    EXPECT_GE(line.slave().requests()[1].came, line.slave().spoke_at()) << "asked only when it had passed";
    EXPECT_THAT(line.slave().requested(), ElementsAre("01 03 00 01 00 01 D5 CA", "01 03 00 02 00 01 25 CA"));
}

TEST(ModbusLateAnswer, IsNotTakenForTheAnswerToAWriteEither)
{
    Bench line{kTimeout};
    line.slave().is_silent();
    ASSERT_EQ(line.write(number(1), 5), AccessError::no_answer);
    line.slave().answers("01 06 00 02 00 05");
    line.slave().says_by_itself(framed("01 86 03"), kLate); // the refusal of that write

    EXPECT_EQ(line.write(number(2), 5), AccessError::none);
    ASSERT_THAT(line.slave().requests(), SizeIs(2));
    EXPECT_GE(line.slave().requests()[1].came, line.slave().spoke_at());
}

TEST(ModbusLateAnswer, IsWaitedForBeforeTheSameUnitIsAskedAgain)
{
    Bench line{kTimeout};
    line.slave().is_silent();
    const auto began = Clock::now();
    ASSERT_EQ(line.read(number(1)), AccessError::no_answer);
    line.slave().answers("01 03 02 22 22");

    ASSERT_EQ(line.read(number(2)), AccessError::none);

    const auto requests = line.slave().requests();
    ASSERT_THAT(requests, SizeIs(2));
    EXPECT_GE(requests[1].came - began, 2 * kTimeout); // one for the answer, one more for a late one
}

TEST(ModbusLateAnswer, ThatIsTornKeepsNothingFromTheNextRequest)
{
    Bench line{kTimeout};
    line.slave().says(octets("01 03 02 11"));
    ASSERT_EQ(line.read(number(1)), AccessError::no_answer);
    line.arrives(octets("11 55 66")); // its rest
    line.slave().answers("01 03 02 22 22");

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
    Bench line{kTimeout};
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
    line.slave().says(octets("01 03 02 11 11 00 00 55 55 55"));
    line.slave().answers("01 03 02 22 22");

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
