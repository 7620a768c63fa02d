// SPDX-License-Identifier: Apache-2.0
/// Requests and what answers them, octet by octet and without a line (MODBUS Application Protocol V1.1b3).
#include "modbus/pdu.hpp"
#include "scripted_slave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace dpslave::modbus::test {
namespace {

using testing::ElementsAre;

std::vector<std::uint8_t> all_of(const Request& request)
{
    return {request.bytes().begin(), request.bytes().end()};
}

TEST(ModbusPdu, RequestsAreBuiltAsTheProtocolSays)
{
    EXPECT_EQ(all_of(read_registers(0x0102, 0x0304)), octets("03 01 02 03 04"));
    EXPECT_EQ(all_of(read_registers(0x0102, 0x0304, kReadInputRegisters)), octets("04 01 02 03 04"));
    EXPECT_EQ(all_of(write_register(0x0102, 0x0304)), octets("06 01 02 03 04"));
    EXPECT_EQ(all_of(loopback(0x1234)), octets("08 00 00 12 34"));
    EXPECT_EQ(all_of(write_registers(0x0102, std::array<std::uint16_t, 2>{0x1122, 0x3344})),
              octets("10 01 02 00 02 04 11 22 33 44"));
}

TEST(ModbusPdu, TheLongestAnswerIsThatOfARead)
{
    EXPECT_EQ(longest_answer(octets("03 00 01 00 01")), 4u);
    EXPECT_EQ(longest_answer(octets("04 00 01 00 7B")), 248u);
    for (const char* request : {"06 00 01 00 7B", "08 00 00 00 7B", "10 00 01 00 02 04 11 22 33 44"})
        EXPECT_EQ(longest_answer(octets(request)), 5u) << request;
}

struct Pair {
    const char* request;
    const char* answer;
    bool fits;
};
class ModbusAnswer : public testing::TestWithParam<Pair> {};

TEST_P(ModbusAnswer, FitsItsRequestOrDoesNot)
{
    EXPECT_EQ(answers(octets(GetParam().request), octets(GetParam().answer)), GetParam().fits)
        << GetParam().request << " -> " << GetParam().answer;
}

INSTANTIATE_TEST_SUITE_P(
    Pdu, ModbusAnswer,
    testing::Values(Pair{"03 00 01 00 02", "", false}, Pair{"03 00 01 00 02", "03 04 11 22 33 44", true},
                    Pair{"03 00 01 00 02", "03 02 11 22 33 44", false},    // says another count
                    Pair{"03 00 01 00 02", "03 04 11 22 33", false},       // too short
                    Pair{"03 00 01 00 02", "03 04 11 22 33 44 55", false}, // too long
                    Pair{"03 00 01 00 02", "04 04 11 22 33 44", false},    // another function
                    Pair{"04 00 01 00 02", "04 04 11 22 33 44", true},
                    Pair{"04 00 01 00 02", "04 03 11 22 33 44", false}, Pair{"03 00 01 00 02", "83 02", true},
                    Pair{"03 00 01 00 02", "83", false}, Pair{"03 00 01 00 02", "83 02 00", false},
                    Pair{"03 00 01 00 02", "84 02", false}, Pair{"06 00 01 00 07", "06 00 01 00 07", true},
                    Pair{"06 00 01 00 07", "06 00 01 00 08", true},  // what it took is judged elsewhere
                    Pair{"06 00 01 00 07", "06 00 02 00 07", false}, // another register
                    Pair{"06 00 01 00 07", "06 00 01 00", false},
                    Pair{"08 00 00 12 34", "08 00 00 12 34", true},
                    Pair{"08 00 00 12 34", "08 00 00 12 35", false},
                    Pair{"10 00 01 00 01 02 11 22", "10 00 01 00 01", true},
                    Pair{"10 00 01 00 01 02 11 22", "10 00 02 00 01", false},
                    Pair{"10 00 01 00 01 02 11 22", "10 00 01 00 02", false},
                    Pair{"05 00 01 FF 00", "05 00 01 FF 00", false})); // a function that is never asked for

TEST(ModbusPdu, AnExceptionIsKnownByItsFunctionCode)
{
    EXPECT_EQ(exception_of(octets("83 02")), 2);
    EXPECT_EQ(exception_of(octets("83 00")), 0);
    EXPECT_EQ(exception_of(octets("03 02 11 22")), std::nullopt);
}

TEST(ModbusPdu, TheGatewayHasTwoExceptionsOfItsOwn)
{
    for (unsigned code = 0; code <= 0xFF; ++code)
        EXPECT_EQ(is_of_gateway(static_cast<std::uint8_t>(code)), code == 10 || code == 11) << code;
}

TEST(ModbusPdu, EachExceptionHasItsMeaningForTheAccess)
{
    drive::Tag read_only, writable;
    read_only.access = drive::Access::read_only;
    for (unsigned code = 0; code <= 12; ++code) {
        const auto of = [code](bool is_write, const drive::Tag* row) {
            return error_of_exception(static_cast<std::uint8_t>(code), is_write, row);
        };
        AccessError on_read = AccessError::not_understood, on_write = on_read,
                    on_write_of_read_only = on_read;
        if (code == 2) {
            on_read = on_write = AccessError::invalid_tag;
            on_write_of_read_only = AccessError::read_only;
        } else if (code == 3) {
            on_read = AccessError::invalid_tag;
            on_write = AccessError::out_of_range;
            on_write_of_read_only = AccessError::read_only;
        } else if (code == 10 || code == 11) {
            on_read = on_write = on_write_of_read_only = AccessError::no_answer;
        }
        EXPECT_EQ(of(false, &read_only), on_read) << code;
        EXPECT_EQ(of(false, nullptr), on_read) << code;
        EXPECT_EQ(of(true, &writable), on_write) << code;
        EXPECT_EQ(of(true, nullptr), on_write) << code;
        EXPECT_EQ(of(true, &read_only), on_write_of_read_only) << code;
    }
}

TEST(ModbusPdu, WordsLieBehindTheCountAndBehindTheRegister)
{
    EXPECT_EQ(word_read(octets("03 04 11 22 33 44"), 0), 0x1122);
    EXPECT_EQ(word_read(octets("03 04 11 22 33 44"), 1), 0x3344);
    EXPECT_EQ(echoed_word(octets("06 00 01 12 34")), 0x1234);
}

} // namespace
} // namespace dpslave::modbus::test
