// SPDX-License-Identifier: Apache-2.0
/// Answers that come too late, and octets without a request, on a line that has the only clock.
#include "wire_line.hpp"

#include <gtest/gtest.h>

namespace dpslave::modbus::test {
namespace {

TEST(ModbusLateAnswer, IsNotTakenForTheOneToTheNextRequest)
{
    WireBench bench;
    bench.drive().set_units({{.unit = 1, .reads_by_4 = true, .has_loopback = false}});
    bench.answers("01 03 02 00 07");
    ASSERT_EQ(bench.read(number(2)), AccessError::none);
    bench.is_silent();
    ASSERT_EQ(bench.read(number(1)), AccessError::no_answer);
    bench.line.arrives(framed("01 03 02 11 11")); // what register 1 had to say
    Octets both = framed("01 03 02 11 11");       // and once more: with the next answer
    for (const std::uint8_t octet : framed("01 04 02 22 22")) both.push_back(octet);
    bench.says(both);

    const AccessError error = bench.read(number(2));

    EXPECT_TRUE(error == AccessError::none && bench.word == 0x2222) << bench.drive().last_trouble();
}

TEST(ModbusLateAnswer, IsNotTakenForTheAnswerToAWriteEither)
{
    WireBench bench;
    bench.is_silent();
    ASSERT_EQ(bench.write(number(1), 5), AccessError::no_answer);

    EXPECT_EQ(bench.write(number(2), 5), AccessError::deferred) << "its answer would look like a late one";
    EXPECT_EQ(bench.line.requests, 1U);
}

TEST(ModbusLateAnswer, ThatIsTornKeepsNothingFromTheNextRequest)
{
    WireBench bench;
    bench.drive().set_units({{.unit = 1, .reads_by_4 = true, .has_loopback = false}});
    bench.answers("01 03 02 00 07");
    ASSERT_EQ(bench.read(number(2)), AccessError::none);
    bench.says(octets("01 03 02 11"));
    ASSERT_EQ(bench.read(number(1)), AccessError::no_answer);
    bench.line.arrives(octets("11 55 66")); // its rest
    bench.answers("01 04 02 22 22");

    ASSERT_EQ(bench.read(number(2)), AccessError::none);

    EXPECT_EQ(bench.word, 0x2222);
}

TEST(ModbusLateAnswer, OfAnotherLengthIsPassedOverWhileTheRightOneIsAwaited)
{
    WireBench bench;
    Octets both = framed("01 03 04 11 11 11 11");
    for (const std::uint8_t octet : framed("01 03 02 22 22")) both.push_back(octet);
    bench.says(both);

    ASSERT_EQ(bench.read(number(2)), AccessError::none);

    EXPECT_EQ(bench.word, 0x2222);
}

TEST(ModbusLateAnswer, OfAnotherUnitIsPassedOver)
{
    WireBench bench;
    bench.is_silent();
    ASSERT_EQ(bench.read(number(1), 1), AccessError::no_answer);
    Octets both = framed("01 03 02 11 11"); // unit 1, late
    for (const std::uint8_t octet : framed("02 03 02 22 22")) both.push_back(octet);
    bench.says(both);

    ASSERT_EQ(bench.read(number(1), 2), AccessError::none);

    EXPECT_EQ(bench.word, 0x2222);
}

TEST(ModbusStaleOctets, AreGoneBeforeARequest)
{
    WireBench bench;
    bench.line.arrives(framed("01 03 02 11 11"));
    bench.answers("01 03 02 22 22");

    ASSERT_EQ(bench.read(number(1)), AccessError::none);

    EXPECT_EQ(bench.word, 0x2222);
}

TEST(ModbusStaleOctets, BehindAnAnswerAreGoneBeforeTheNextRequest)
{
    WireBench bench;
    Octets more = framed("01 03 02 11 11");
    for (const std::uint8_t octet : framed("01 03 02 33 33")) more.push_back(octet);
    bench.says(more);
    bench.answers("01 03 02 22 22");

    ASSERT_EQ(bench.read(number(1)), AccessError::none);
    EXPECT_EQ(bench.word, 0x1111);
    ASSERT_EQ(bench.read(number(2)), AccessError::none);
    EXPECT_EQ(bench.word, 0x2222);
}

TEST(ModbusStaleOctets, BehindAWrongCheckSumAreGoneBeforeTheRepetition)
{
    WireBench bench;
    bench.drive().set_units({{.unit = 1, .reads_by_4 = true, .has_loopback = false}});
    bench.answers("01 03 02 00 07");
    ASSERT_EQ(bench.read(number(1)), AccessError::none);
    bench.says(octets("01 03 02 11 11 00 00 55 55 55"));
    bench.answers("01 04 02 22 22");

    ASSERT_EQ(bench.read(number(1)), AccessError::no_answer);
    ASSERT_EQ(bench.read(number(1)), AccessError::none);

    EXPECT_EQ(bench.word, 0x2222);
}

} // namespace
} // namespace dpslave::modbus::test
