// SPDX-License-Identifier: Apache-2.0
// Modbus RTU as an instrument of the 2000 series speaks it (EI-ASCII and Modbus reference, section 5). CRCs
// are those that manuals print, or were computed apart from the code.
#include "modbus_bench.hpp"

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

struct Printed {
    const char* name;
    const char* octets;
    std::uint8_t first, second; ///< of the CRC, as they go over the line
};

class Crc : public testing::TestWithParam<Printed> {};

TEST_P(Crc, IsThatOfThePublishedExample)
{
    const std::uint16_t crc = crc16(wire(GetParam().octets));
    EXPECT_EQ(low(crc), GetParam().first);
    EXPECT_EQ(high(crc), GetParam().second);
}
INSTANTIATE_TEST_SUITE_P(OfModbusRtu, Crc,
                         testing::Values(Printed{"FastStatusOfUnit2", "02 07", 0x41, 0x12},
                                         Printed{"LoopbackOf1234", "01 08 00 00 12 34", 0xED, 0x7C},
                                         Printed{"ReadOfThreeRegisters", "11 03 00 6B 00 03", 0x76, 0x87},
                                         Printed{"WriteOfOneRegister", "11 06 00 01 00 03", 0x9A, 0x9B},
                                         Printed{"WriteOfTwoRegisters", "11 10 00 01 00 02 04 00 0A 01 02",
                                                 0xC6, 0xF0},
                                         Printed{"BlockWriteOfTheSeriesHandbook",
                                                 "02 10 00 A4 00 03 06 00 7B 00 96 00 FA", 0x20, 0x71}),
                         [](const auto& test) { return test.param.name; });

TEST(RequestLength, FollowsFromTheFunction)
{
    EXPECT_EQ(request_length(wire("01")), 0U);
    EXPECT_EQ(request_length(wire("01 03")), 8U);
    EXPECT_EQ(request_length(wire("01 06")), 8U);
    EXPECT_EQ(request_length(wire("01 07")), 4U);
    EXPECT_EQ(request_length(wire("01 08")), 8U);
    EXPECT_EQ(request_length(wire("01 10 00 01 00 02")), 0U);
    EXPECT_EQ(request_length(wire("01 10 00 01 00 02 04")), 13U);
    EXPECT_EQ(request_length(wire("01 2B")), std::nullopt);
}

class ModbusSlave : public InstrumentBench {};

TEST_F(ModbusSlave, AnswersFunction3And4WithTheScaledInteger)
{
    EXPECT_EQ(hears(wire("01 03 00 01 00 01 D5 CA")), wire("01 03 02 00 B7 F8 32")); // 18.3
    EXPECT_EQ(hears(wire("01 04 00 01 00 01 60 0A")), wire("01 04 02 00 B7 F9 46"));
}

TEST_F(ModbusSlave, TakesAWriteOfOneRegisterAndEchoesIt)
{
    EXPECT_EQ(hears(wire("01 06 00 18 00 C8 08 5B")), wire("01 06 00 18 00 C8 08 5B"));
    EXPECT_THAT(line.take_log(), ElementsAre("tag 24 written 20.0"));
    EXPECT_EQ(asks("01 03 00 18 00 01"), "01 03 02 00 C8");
}

TEST_F(ModbusSlave, TakesTheBlockWriteOfTheSeriesHandbook)
{
    ASSERT_TRUE(line.add({2, 0x2480, *parse_tags(instrument_table(), "2400.csv"), 1}));
    EXPECT_EQ(hears(wire("02 10 00 A4 00 03 06 00 7B 00 96 00 FA 20 71")), wire("02 10 00 A4 00 03 C1 D8"));
    EXPECT_EQ(asks("02 03 00 A4 00 03"), "02 03 06 00 7B 00 96 00 FA");
    EXPECT_EQ(asks("01 03 00 A4 00 03"), "01 03 06 00 00 00 00 00 00") << "the other one was not meant";
}

TEST_F(ModbusSlave, AnswersFunction7WithTheFastStatusByte)
{
    EXPECT_EQ(hears(wire("01 07 41 E2")), wire("01 07 00 22 30"));
    type("bit 75 5 on");
    type("bit 75 14 on");
    EXPECT_EQ(asks("01 07"), "01 07 20");
    EXPECT_EQ(asks("01 03 00 4A 00 02"), "01 03 04 00 20 40 20");
}

TEST_F(ModbusSlave, LoopsBackSubCode0Only)
{
    EXPECT_EQ(hears(wire("01 08 00 00 12 34 ED 7C")), wire("01 08 00 00 12 34 ED 7C"));
    EXPECT_EQ(asks("01 08 00 01 00 00"), "");
}

TEST_F(ModbusSlave, IsSilentForAnUnknownFunctionAWrongCrcAndAnotherUnit)
{
    EXPECT_EQ(asks("01 2B 0E 01 00"), "");
    EXPECT_EQ(asks("01 01 00 02 00 01"), "") << "bits";
    EXPECT_TRUE(hears(wire("01 03 00 01 00 01 D5 CB")).empty());
    EXPECT_EQ(asks("02 03 00 01 00 01"), "");
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 03 02 00 B7") << "after each of them it listens again";
    EXPECT_EQ(line.bad_crc(), 1U);
    EXPECT_EQ(line.unsupported(), 2U);
}

TEST_F(ModbusSlave, CarriesOutABroadcastAndDoesNotAnswer)
{
    ASSERT_TRUE(line.add({7, 0x2480, *parse_tags(instrument_table(), "2400.csv"), 1}));
    EXPECT_EQ(asks("00 06 00 19 00 64"), "");
    EXPECT_EQ(asks("01 03 00 19 00 01"), "01 03 02 00 64");
    EXPECT_EQ(asks("07 03 00 19 00 01"), "07 03 02 00 64");
    EXPECT_EQ(asks("00 03 00 19 00 01"), "") << "a read has no business there";
}

TEST_F(ModbusSlave, AnswersOnlyAfterTheTurnaround)
{
    line.on_bytes(wire("01 07 41 E2"), now);
    EXPECT_EQ(line.next_deadline(), now + 5ms);
    EXPECT_FALSE(line.take_reply(now + 4999us));
    EXPECT_EQ(line.take_reply(now + 5ms), wire("01 07 00 22 30"));
}

TEST_F(ModbusSlave, TakesARequestThatComesInPieces)
{
    line.on_bytes(wire("01 10 00 A4 00"), now);
    line.on_bytes(wire("01 02"), now + 10ms);
    line.on_bytes(wire("00 05"), now + 20ms);
    EXPECT_EQ(line.next_deadline(), kNever);
    const Octets request = wire("01 10 00 A4 00 01 02 00 05");
    line.on_bytes(Octets{low(table_crc(request)), high(table_crc(request))}, now + 30ms);
    EXPECT_EQ(line.next_deadline(), now + 35ms);
    EXPECT_EQ(line.instruments()[0].find(164)->value.counts, 5);
}

TEST_F(ModbusSlave, DropsARequestThatStopsInItsMiddle)
{
    line.on_bytes(wire("01 03 00 01"), now);
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 03 02 00 B7");
}

TEST_F(ModbusSlave, DropsAReplyThatIsOvertakenByANewRequest)
{
    line.on_bytes(wire("01 03 00 01 00 01 D5 CA"), now);
    line.on_bytes(wire("01 07 41 E2"), now + 1ms);
    EXPECT_EQ(line.take_reply(now + 10ms), wire("01 07 00 22 30"));
    EXPECT_FALSE(line.take_reply(now + 1s));
}

struct ModbusRefused {
    const char* name;
    const char* request;
    const char* answer;
};

class ModbusRefusal : public InstrumentBench, public testing::WithParamInterface<ModbusRefused> {};

TEST_P(ModbusRefusal, IsReportedByAnException)
{
    EXPECT_EQ(asks(GetParam().request), GetParam().answer);
    EXPECT_EQ(line.instruments()[0].counters.writes, 0U);
}
INSTANTIATE_TEST_SUITE_P(
    OfTheInstrument, ModbusRefusal,
    testing::Values(ModbusRefused{"ReadOfARegisterThatIsNotThere", "01 03 00 04 00 01", "01 83 02"},
                    ModbusRefused{"ReadOfABlockOverAHole", "01 03 00 01 00 05", "01 83 02"},
                    ModbusRefused{"ReadBeyondTheLastTag", "01 03 7F FF 00 02", "01 83 02"},
                    ModbusRefused{"ReadOfNothing", "01 03 00 01 00 00", "01 83 03"},
                    ModbusRefused{"ReadOf126Words", "01 03 20 88 00 7E", "01 83 03"},
                    ModbusRefused{"WriteToARegisterThatIsNotThere", "01 06 00 04 00 01", "01 86 02"},
                    ModbusRefused{"WriteToAReadOnlyRegister", "01 06 00 05 00 01", "01 86 03"},
                    ModbusRefused{"WriteAboveTheLimit", "01 06 00 18 13 89", "01 86 03"}, // 500.1
                    ModbusRefused{"WriteBelowTheLimit", "01 06 00 18 FF FF", "01 86 03"}, // -0.1
                    ModbusRefused{"BlockWriteWithAWrongCount", "01 10 00 A4 00 02 02 00 05", "01 90 03"},
                    ModbusRefused{"BlockWriteOfNothing", "01 10 00 A4 00 00 00", "01 90 03"},
                    ModbusRefused{"OutputPowerInAutomatic", "01 06 00 03 00 64", "01 86 03"},
                    ModbusRefused{"IeeeAreaByFunction6", "01 06 80 30 00 01", "01 86 02"},
                    ModbusRefused{"IeeeAreaAtAnOddAddress", "01 03 80 03 00 02", "01 83 02"},
                    ModbusRefused{"IeeeAreaHalfAValue", "01 03 80 02 00 01", "01 83 03"},
                    ModbusRefused{"IeeeAreaHalfAValueWritten", "01 10 80 30 00 01 02 42 48", "01 90 03"},
                    ModbusRefused{"IeeeAreaOfATagThatIsNotThere", "01 03 80 08 00 02", "01 83 02"}),
    [](const auto& test) { return test.param.name; });

TEST_F(ModbusSlave, TakesTheLimitsThemselves)
{
    EXPECT_EQ(asks("01 06 00 18 13 88"), "01 06 00 18 13 88"); // 500.0
    EXPECT_EQ(asks("01 06 00 18 00 00"), "01 06 00 18 00 00");
}

TEST_F(ModbusSlave, ReadsAsManyAs125Words)
{
    const std::string reply = asks("01 03 20 88 00 7D");
    EXPECT_THAT(reply, testing::StartsWith("01 03 FA"));
    EXPECT_EQ(wire(reply).size(), 253U);
}

TEST_F(ModbusSlave, DropsValuesOfABlockAtMissingAddressesWithoutAWord)
{
    EXPECT_EQ(asks("01 10 00 18 00 03 06 00 0A 00 0B 00 0C"), "01 10 00 18 00 03"); // 24, 25, 26
    EXPECT_EQ(asks("01 10 00 04 00 01 02 00 0A"), "01 10 00 04 00 01") << "a lone one looks successful";
    EXPECT_EQ(asks("01 03 00 18 00 02"), "01 03 04 00 0A 00 0B");
    EXPECT_THAT(line.take_log(), ElementsAre("tag 24 written 1.0", "tag 25 written 1.1",
                                             "tag 26 is not there, its value is dropped",
                                             "tag 4 is not there, its value is dropped"));
}

TEST_F(ModbusSlave, StopsABlockAtAReadOnlyAddressAndDropsTheRest)
{
    type("set 273 1");
    EXPECT_EQ(asks("01 10 00 02 00 07 0E 00 0A 00 0B 00 0C 00 0D 00 0E 00 0F 00 10"), "01 90 03"); // 2..8
    EXPECT_EQ(asks("01 03 00 02 00 02"), "01 03 04 00 0A 00 0B");
    EXPECT_EQ(asks("01 03 00 08 00 01"), "01 03 02 9C 40") << "40000, as before";
}

TEST_F(ModbusSlave, SkipsReadOnlyAddressesOfABlockWhenRegister220SaysSo)
{
    type("set 273 1");
    type("set 220 1");
    EXPECT_EQ(asks("01 10 00 03 00 06 0C 00 0B 00 0C 00 0D 00 0E 00 0F 00 10"), "01 10 00 03 00 06"); // 3..8
    EXPECT_EQ(asks("01 03 00 08 00 01"), "01 03 02 00 10");
    EXPECT_NE(asks("01 03 00 05 00 01"), "01 03 02 00 0D");
}

TEST_F(ModbusSlave, ReadsTheIeeeAreaAtTwiceTheTag)
{
    EXPECT_EQ(hears(wire("01 03 80 02 00 02 4C 0B")), wire("01 03 04 41 92 66 66 E4 68")); // 18.3
    EXPECT_EQ(asks("01 04 80 02 00 04"), "01 04 08 41 92 66 66 42 48 00 00") << "and the setpoint, 50.0";
    EXPECT_EQ(asks("01 03 82 1C 00 02"), "01 03 04 00 00 80 00") << "tag 270, no floating point number";
    EXPECT_EQ(asks("01 03 80 2C 00 02"), "01 03 04 00 01 80 00") << "tag 22, a whole number";
    EXPECT_EQ(asks("01 03 80 A0 00 02"), "01 03 04 40 E0 00 00") << "tag 80, scaled without decimals: 7.0";
}

TEST_F(ModbusSlave, HasTimesInTheIeeeAreaAsMillisecondsOf32Bits)
{
    EXPECT_EQ(asks("01 03 80 10 00 02"), "01 03 04 02 62 5A 00") << "tag 8: 40000 s";
    EXPECT_EQ(asks("01 03 80 48 00 02"), "01 03 04 00 01 5F 90") << "tag 36: 90 s";
    EXPECT_EQ(asks("01 03 80 7E 00 02"), "01 03 04 00 02 BF 20") << "tag 63: 3 min";
    EXPECT_EQ(asks("01 10 80 10 00 02 04 00 00 EA 60"), "01 10 80 10 00 02");
    EXPECT_EQ(asks("01 03 00 08 00 01"), "01 03 02 00 3C") << "60 s";
    EXPECT_EQ(asks("01 10 80 10 00 02 04 42 70 00 00"), "01 90 03") << "60.0 as a single is 1114636 s";
}

TEST_F(ModbusSlave, HasWordTwoOfASegmentInTheIeeeAreaAsItsTypeSays)
{
    EXPECT_EQ(asks("01 03 C1 24 00 02"), "01 03 04 41 20 00 00") << "8338: 10.0, a ramp rate";
    EXPECT_EQ(asks("01 06 20 90 00 03"), "01 06 20 90 00 03") << "8336: a dwell";
    EXPECT_EQ(asks("01 03 C1 24 00 02"), "01 03 04 00 00 27 10") << "10 s";
    EXPECT_EQ(asks("01 06 20 90 00 04"), "01 06 20 90 00 04") << "a step has neither";
    EXPECT_EQ(asks("01 03 C1 24 00 02"), "01 03 04 00 0A 80 00");
}

TEST_F(ModbusSlave, WritesTheIeeeAreaInBlocks)
{
    EXPECT_EQ(asks("01 10 80 30 00 02 04 42 5E 00 00"), "01 10 80 30 00 02"); // 55.5 into tag 24
    EXPECT_EQ(asks("01 03 00 18 00 01"), "01 03 02 02 2B");
    EXPECT_EQ(asks("01 10 80 08 00 04 08 42 5E 00 00 00 00 00 00"), "01 90 03")
        << "tag 4 dropped, 5 read only";
    EXPECT_EQ(asks("01 10 82 1C 00 02 04 00 01 80 00"), "01 10 82 1C 00 02");
    EXPECT_EQ(asks("01 03 01 0E 00 01"), "01 03 02 00 01");
    EXPECT_EQ(asks("01 10 80 30 00 02 04 7F C0 00 00"), "01 90 03") << "no number";
    EXPECT_EQ(asks("01 10 80 30 00 02 04 43 FA 33 33"), "01 90 03") << "500.4 is beyond the limit";
}

TEST_F(ModbusSlave, ShowsInTheIeeeAreaWhatNoWordCanHold)
{
    type("set 1 4000.5");
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 03 02 7F FF") << "the word stays at the end of its range";
    EXPECT_EQ(asks("01 03 80 02 00 02"), "01 03 04 45 7A 08 00");
    type("set 1 -4000.5");
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 03 02 80 01");
}

TEST_F(ModbusSlave, CountsWhatItWasAsked)
{
    asks("01 03 00 01 00 02");
    asks("01 06 00 18 00 01");
    asks("01 06 00 04 00 01");
    EXPECT_THAT(type("stats"), ElementsAre("unit 1: 1 reads of 2 words, 1 values written, 1 exceptions",
                                           HasSubstr("0 requests with a wrong CRC")));
}

TEST_F(ModbusSlave, HasAnAddressOfItsOwnFrom1To254)
{
    const auto tags = *parse_tags("tag\n1\n", "t.csv");
    EXPECT_TRUE(line.add({254, 0x2480, tags, 1}));
    EXPECT_FALSE(line.add({254, 0x2480, tags, 1})) << "taken";
    EXPECT_FALSE(line.add({0, 0x2480, tags, 1})) << "that is the broadcast address";
    EXPECT_FALSE(line.add({255, 0x2480, tags, 1}));
}

// ---- faults ----

TEST_F(ModbusSlave, IsSilentOnRequestAndCarriesNothingOut)
{
    type("silence");
    EXPECT_EQ(asks("01 06 00 18 00 01"), "");
    type("ok");
    EXPECT_EQ(asks("01 03 00 18 00 01"), "01 03 02 01 F4");
}

TEST_F(ModbusSlave, SilencesOneUnitAlone)
{
    ASSERT_TRUE(line.add({2, 0x2480, *parse_tags(instrument_table(), "2400.csv"), 1}));
    type("unit 2");
    type("silence");
    EXPECT_EQ(asks("02 03 00 01 00 01"), "");
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 03 02 00 B7");
}

TEST_F(ModbusSlave, RefusesEverythingOrWritesAloneOnRequest)
{
    type("exception 2");
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 83 02");
    EXPECT_EQ(asks("01 07"), "01 87 02");
    type("refuse");
    EXPECT_EQ(asks("01 03 00 01 00 01"), "01 03 02 00 B7");
    EXPECT_EQ(asks("01 06 00 18 00 01"), "01 86 03");
    EXPECT_EQ(asks("01 10 00 A4 00 01 02 00 05"), "01 90 03");
    type("refuse 2");
    EXPECT_EQ(asks("01 06 00 18 00 01"), "01 86 02");
}

TEST_F(ModbusSlave, SpoilsCutsAndDelaysRepliesOnRequest)
{
    type("bad-crc");
    EXPECT_EQ(hears(wire("01 07 41 E2")), wire("01 07 00 22 31"));
    type("short");
    EXPECT_EQ(hears(wire("01 07 41 E2")), wire("01 07 00 22"));
    type("garbage");
    const Octets said = hears(wire("01 07 41 E2"));
    EXPECT_EQ(said.size(), 5U);
    EXPECT_NE(said, wire("01 07 00 22 30"));
    type("slow 50ms");
    now += 1s;
    line.on_bytes(wire("01 07 41 E2"), now);
    EXPECT_EQ(line.next_deadline(), now + 55ms);
}

TEST_F(ModbusSlave, SaysWhatIsWrongWithACommand)
{
    EXPECT_THAT(type("set 24 600.0"), ElementsAre(HasSubstr("within its limits")));
    EXPECT_THAT(type("panel 99 1"), ElementsAre(HasSubstr("no tag 99")));
    EXPECT_THAT(type("exception 4"), ElementsAre(HasSubstr("exception 2")));
    EXPECT_THAT(type("bit 75 16 on"), ElementsAre(HasSubstr("bit 75 5 on")));
    EXPECT_THAT(type("tune soon"), ElementsAre(HasSubstr("tune 5s")));
    EXPECT_THAT(type("slow down"), ElementsAre(HasSubstr("slow 50ms")));
    EXPECT_THAT(type("dance"), ElementsAre(HasSubstr("no command 'dance'")));
}

} // namespace
} // namespace dpslave::sim
