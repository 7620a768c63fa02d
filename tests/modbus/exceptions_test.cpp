// SPDX-License-Identifier: Apache-2.0
/// Tests what each exception means for the access (EI-ASCII and Modbus reference, section 4), and which
/// octets are no answer at all.
#include "modbus/pdu.hpp"
#include "wire_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace dpslave::modbus::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Exception {
    const char* code;
    AccessError on_read;
    AccessError on_write;
    AccessError on_write_of_a_read_only_tag;
    const char* words;
};

/// Short enough to be waited for, long enough for the slave of a test to answer within it.

constexpr auto kNotUnderstood = AccessError::not_understood;
constexpr auto kNoAnswer = AccessError::no_answer;

class ModbusException : public testing::TestWithParam<Exception> {
protected:
    std::string answer(const char* function) const
    {
        return std::string{"01 "} + function + " " + GetParam().code;
    }
    Bench line;
};

TEST_P(ModbusException, OfAReadHasAName)
{
    line.slave().answers(answer("83"));

    EXPECT_EQ(line.read(number(1)), GetParam().on_read);

    EXPECT_EQ(line.word(), kUntouched);
    EXPECT_EQ(line.drive().last_trouble(), GetParam().words);
    EXPECT_EQ(line.drive().last_answer().empty(), GetParam().on_read != AccessError::invalid_tag);
    EXPECT_THAT(GetParam().words, StartsWith(std::string{line.drive().last_answer()}));
}

TEST_P(ModbusException, OfABlockHasTheSameName)
{
    line.slave().answers(answer("83"));
    std::array<std::uint16_t, 3> words{};

    EXPECT_EQ(line.drive().read({.unit = 1}, number(1), words), GetParam().on_read);
}

TEST_P(ModbusException, OfAWriteIsJudgedByTheTable)
{
    line.slave().answers(answer("86"));
    line.slave().answers(answer("86"));

    EXPECT_EQ(line.write(number(1), 5), GetParam().on_write);
    EXPECT_EQ(line.write(read_only(number(1)), 5), GetParam().on_write_of_a_read_only_tag);

    EXPECT_EQ(line.drive().last_trouble(), GetParam().words);
}

TEST_P(ModbusException, OfAWrittenBlockDoesNotSayWhichTagItWas)
{
    line.slave().answers(answer("90"));
    const std::array<std::uint16_t, 2> words{1, 2};

    EXPECT_EQ(line.drive().write({.unit = 1}, read_only(number(1)), words), GetParam().on_write);
}

TEST_P(ModbusException, ToAProbeIsAnAnswerUnlessAGatewaySpeaks)
{
    line.slave().answers(answer("83"));

    EXPECT_EQ(line.drive().probe({.unit = 1}) == AccessError::none, GetParam().on_read != kNoAnswer);
}

INSTANTIATE_TEST_SUITE_P(
    Codes, ModbusException,
    testing::Values(
        Exception{"00", kNotUnderstood, kNotUnderstood, kNotUnderstood,
                  "exception 0 (unknown to the protocol)"},
        Exception{"01", kNotUnderstood, kNotUnderstood, kNotUnderstood, "exception 1 (illegal function)"},
        Exception{"02", AccessError::invalid_tag, AccessError::invalid_tag, AccessError::read_only,
                  "exception 2 (illegal data address)"},
        Exception{"03", AccessError::invalid_tag, AccessError::out_of_range, AccessError::read_only,
                  "exception 3 (illegal data value)"},
        Exception{"04", kNotUnderstood, kNotUnderstood, kNotUnderstood, "exception 4 (device failure)"},
        Exception{"05", kNotUnderstood, kNotUnderstood, kNotUnderstood,
                  "exception 5 (acknowledge: the device takes longer)"},
        Exception{"06", kNotUnderstood, kNotUnderstood, kNotUnderstood, "exception 6 (device busy)"},
        Exception{"07", kNotUnderstood, kNotUnderstood, kNotUnderstood, "exception 7 (negative acknowledge)"},
        Exception{"08", kNotUnderstood, kNotUnderstood, kNotUnderstood, "exception 8 (memory parity error)"},
        Exception{"0A", kNoAnswer, kNoAnswer, kNoAnswer, "exception 10 (gateway: no path to the device)"},
        Exception{"0B", kNoAnswer, kNoAnswer, kNoAnswer,
                  "exception 11 (gateway: the device does not answer)"},
        Exception{"63", kNotUnderstood, kNotUnderstood, kNotUnderstood,
                  "exception 99 (unknown to the protocol)"}),
    [](const auto& exception) { return std::string{"Code"} + exception.param.code; });

TEST(ModbusTrouble, IsForgottenByTheNextCall)
{
    Bench line;
    line.slave().answers("01 83 02");
    line.slave().answers("01 03 02 00 07");

    EXPECT_EQ(line.read(number(1)), AccessError::invalid_tag);
    EXPECT_EQ(line.read(number(2)), AccessError::none);

    EXPECT_EQ(line.drive().last_trouble(), "");
}

struct NoAnswer {
    const char* name;
    Octets octets;
    const char* words;
};

std::string long_answer(const char* head, int octets)
{
    std::string text = head;
    for (int i = 0; i < octets; ++i) text += " 55";
    return text;
}

class ModbusNoAnswer : public testing::TestWithParam<NoAnswer> {};

/// The request is the read of register 1 of unit 1.
TEST_P(ModbusNoAnswer, IsNotAccepted)
{
    WireBench bench;
    bench.says(GetParam().octets);

    EXPECT_EQ(bench.read(number(1)), kNoAnswer);

    EXPECT_EQ(bench.word, kUntouched);
    EXPECT_THAT(bench.drive().last_trouble(), StartsWith(GetParam().words));
}

INSTANTIATE_TEST_SUITE_P(
    Frames, ModbusNoAnswer,
    testing::Values(
        NoAnswer{"Silence", {}, "no answer"},
        NoAnswer{"WrongCheckSum", octets("01 03 02 00 B7 F8 33"), "an answer with a wrong checksum"},
        NoAnswer{"CheckSumTheWrongWayRound", octets("01 03 02 00 B7 32 F8"),
                 "an answer with a wrong checksum"},
        NoAnswer{"OneBitWrong", octets("01 03 02 00 A7 F8 32"), "an answer with a wrong checksum"},
        NoAnswer{"OneOctet", octets("01"),
                 "an answer with a wrong checksum or parity, or one that broke off"},
        NoAnswer{"HalfAnAnswer", octets("01 03 02 00"),
                 "an answer with a wrong checksum or parity, or one that broke off"},
        NoAnswer{"WithoutItsLastOctet", octets("01 03 02 00 B7 F8"),
                 "an answer with a wrong checksum or parity, or one that broke off"},
        NoAnswer{"AnotherUnit", framed("02 03 02 00 B7"), "an answer of unit 2"},
        NoAnswer{"TheBroadcastUnit", framed("00 03 02 00 B7"), "an answer of unit 0"},
        NoAnswer{"AnotherFunction", framed("01 04 02 00 B7"), "an answer that does not fit the request: 04"},
        NoAnswer{"TwoWords", framed("01 03 04 00 B7 00 D8"),
                 "an answer that does not fit the request: 03 04"},
        NoAnswer{"NoWord", framed("01 03 00"), "an answer that does not fit the request: 03 00"},
        NoAnswer{"HalfAWord", framed("01 03 01 00"), "an answer that does not fit the request: 03 01"},
        NoAnswer{"ExceptionOfAnotherFunction", framed("01 86 02"),
                 "an answer that does not fit the request: 86 02"},
        NoAnswer{"LongerThanAnyFrame", octets(long_answer("01 03 FF", 300)),
                 "an answer with a wrong checksum"},
        NoAnswer{"Noise", octets("00 FF 7F 00 55 AA 00 00 12"), "noise and no answer"}),
    [](const auto& what) { return what.param.name; });

TEST(ModbusNoAnswerToARead, IsOneWhoseCountAndLengthDoNotAgree)
{
    const Request two_words = read_registers(1, 2);

    EXPECT_TRUE(answers(two_words, octets("03 04 00 B7 00 D8")));
    EXPECT_FALSE(answers(two_words, octets("03 02 00 B7 00 D8")));
    EXPECT_FALSE(answers(two_words, octets("03 04 00 B7 00")));
    EXPECT_FALSE(answers(two_words, octets("03")));
    EXPECT_FALSE(answers(two_words, {}));
}

TEST(ModbusNoAnswerToAWrite, IsTheEchoOfAnotherRegisterOrCount)
{
    WireBench bench;
    const std::array<std::uint16_t, 2> words{1, 2};
    bench.answers("01 06 00 03 00 05");
    EXPECT_EQ(bench.write(number(2), 5), kNoAnswer);
    EXPECT_THAT(bench.drive().last_trouble(), HasSubstr("does not fit the request: 06 00 03 00 05"));

    bench.answers("01 10 00 02 00 01");
    EXPECT_EQ(bench.drive().write({.unit = 1}, number(2), words), kNoAnswer);
    EXPECT_THAT(bench.drive().last_trouble(), HasSubstr("does not fit the request: 10 00 02 00 01"));
}

// ---- a question of a search

TEST(ModbusLook, AsksOneRegisterAndTakesAnExceptionForAnAnswerButNotThatOfAGateway)
{
    using Kind = drive::Sight::Kind;
    Bench line;
    line.slave().answers("01 03 02 24 80");
    line.slave().answers("01 83 02");
    line.slave().answers("01 83 0B"); // the gateway speaks for a unit that is silent
    const auto look = [&] {
        return line.drive().look({.group = 0, .unit = 1}, {.mnemonic = {}, .reg = 122});
    };

    EXPECT_EQ(look().text, ">2480");
    EXPECT_EQ(look().kind, Kind::denied);
    EXPECT_EQ(look().kind, Kind::silence);
    for (const std::string& one : line.slave().requested(3))
        EXPECT_THAT(one, StartsWith("01 03 00 7A 00 01"));
}

} // namespace
} // namespace dpslave::modbus::test
