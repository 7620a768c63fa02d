// SPDX-License-Identifier: Apache-2.0
/// Records of a drive line as text, JSON and packets. The frames are those of the reference, written by hand.
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/trace/line_entry.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>

namespace dpslave::test {
namespace {

using dpctl::LineEntry;
using dpctl::UnixOffset;
using drive::Judgement;
using drive::LineProtocol;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using trace::Kind;

constexpr UnixOffset kOffset{std::chrono::seconds{1'700'000'000}};
constexpr Instant kAt{std::chrono::microseconds{1'500'000}};

std::vector<std::uint8_t> octets_of(const std::string& text)
{
    std::vector<std::uint8_t> octets;
    for (std::size_t i = 0; i + 1 < text.size(); i += 3)
        octets.push_back(static_cast<std::uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
    return octets;
}

trace::Record record(Kind kind, LineProtocol protocol, const std::string& octets, Judgement judgement)
{
    trace::Record one;
    one.head = {.kind = kind,
                .detail = static_cast<std::uint8_t>(judgement),
                .rate = static_cast<std::uint8_t>(protocol),
                .address = 0x01,
                .at = kAt,
                .begun = kAt - std::chrono::milliseconds{2}};
    one.octets.assign(octets_of(octets));
    return one;
}

LineEntry entry(Kind kind, LineProtocol protocol, const std::string& octets,
                Judgement judgement = Judgement::taken)
{
    return *dpctl::line_entry_of(record(kind, protocol, octets, judgement), "p3");
}
std::string ei_question(const std::string& octets)
{
    return words_of(entry(Kind::asked, LineProtocol::ei_ascii, octets));
}
std::string ei_answer(const std::string& octets, Judgement judgement = Judgement::taken)
{
    return words_of(entry(Kind::answered, LineProtocol::ei_ascii, octets, judgement));
}
std::string modbus_question(const std::string& octets)
{
    return words_of(entry(Kind::asked, LineProtocol::modbus_rtu, octets));
}
std::string modbus_answer(const std::string& octets, Judgement judgement = Judgement::taken)
{
    return words_of(entry(Kind::answered, LineProtocol::modbus_rtu, octets, judgement));
}

class DpctlLineTrace : public testing::Test {
protected:
    DpctlLineTrace()
    {
        ::setenv("TZ", "UTC", 1);
        ::tzset();
    }
    static std::string line(const LineEntry& one)
    {
        return line_of(one, words_of(one), kOffset, kAt - std::chrono::milliseconds{3});
    }
};

TEST_F(DpctlLineTrace, EiAsciiIsReadWriteAndValue)
{
    EXPECT_EQ(ei_question("04 30 30 31 31 50 56 05"), "read PV");
    EXPECT_EQ(ei_question("04 30 30 31 31 02 53 4C 32 32 2E 30 03 02"), "write SL = 22.0, BCC right");
    EXPECT_EQ(ei_answer("02 50 56 31 36 2E 34 03 18"), "PV = 16.4, BCC right: taken");
    EXPECT_EQ(ei_answer("02 45 45 3E 30 31 43 37 03 48"), "EE = >01C7 (invalid mnemonic), BCC right: taken");
    EXPECT_EQ(ei_answer("06"), "ACK: taken");
    EXPECT_EQ(ei_answer("15", Judgement::refused), "NAK: the drive refuses");
    EXPECT_EQ(ei_answer("04", Judgement::refused), "EOT: the drive refuses");
    EXPECT_EQ(ei_answer("04 30 30 31 31 50 56 05", Judgement::echo), "read PV: echo of the question");
}

TEST_F(DpctlLineTrace, ModbusIsWhatItsFunctionDoes)
{
    EXPECT_EQ(modbus_question("01 03 01 93 00 01 75 DB"), "read register 403, CRC right");
    EXPECT_EQ(modbus_question("01 04 00 0A 00 03 90 09"), "read registers 10 to 12 by function 4, CRC right");
    EXPECT_EQ(modbus_question("01 06 00 02 04 D2 AA 97"), "write register 2 = 1234, CRC right");
    EXPECT_EQ(modbus_question("01 10 00 02 00 02 04 00 01 00 02 A2 77"),
              "write registers 2 to 3 = 1 2, CRC right");
    EXPECT_EQ(modbus_question("01 08 00 00 12 34 ED 7C"), "loop back 1234, CRC right");
    EXPECT_EQ(modbus_answer("01 03 02 00 00 B8 44"), "value 0, CRC right: taken");
    EXPECT_EQ(modbus_answer("01 03 04 00 07 FF FF 4A 42"), "values 7 65535, CRC right: taken");
    EXPECT_EQ(modbus_answer("01 06 00 02 04 D2 AA 97"), "written register 2 = 1234, CRC right: taken");
    EXPECT_EQ(modbus_answer("01 10 00 02 00 02 E0 08"), "written registers 2 to 3, CRC right: taken");
    EXPECT_EQ(modbus_answer("01 83 02 C0 F1", Judgement::refused),
              "exception 2 to function 3, CRC right: the drive refuses");
    EXPECT_EQ(modbus_answer("01 2B 0E BF 34", Judgement::foreign),
              "function 43, CRC right: foreign: it answers nothing that was asked");
}

TEST_F(DpctlLineTrace, AWrongCheckSumIsCalledWrongAndWhatIsNoFrameHasNoWords)
{
    EXPECT_EQ(ei_answer("02 50 56 31 36 2E 34 03 19", Judgement::bad_checksum),
              "PV = 16.4, BCC wrong: not taken: wrong checksum");
    EXPECT_EQ(modbus_answer("01 03 02 00 00 B8 45", Judgement::bad_checksum),
              "value 0, CRC wrong: not taken: wrong checksum");
    EXPECT_EQ(ei_answer("02 50 56", Judgement::truncated), "not taken: it broke off, or its length is wrong");
    EXPECT_EQ(modbus_answer("FF", Judgement::no_frame), "no frame");
    EXPECT_EQ(modbus_answer("01 03 02 00 FF", Judgement::noise_before), "noise before the frame");
}

TEST_F(DpctlLineTrace, AnyOctetsHaveWords)
{
    for (const char* octets : {"", "02", "04 30", "04 30 30 31 31", "04 30 30 31 31 02", "04 30 30 31 31 05",
                               "01", "01 03", "01 03 02", "01 10 00 02 00 02 E0 08", "01 83 02 C0"})
        for (std::size_t i = 0; i < drive::kJudgements; ++i)
            for (const auto protocol : {LineProtocol::ei_ascii, LineProtocol::modbus_rtu})
                for (const Kind kind : {Kind::asked, Kind::answered}) {
                    const auto one = entry(kind, protocol, octets, static_cast<Judgement>(i));
                    EXPECT_TRUE(kind == Kind::asked || !words_of(one).empty()) << octets;
                }
}

TEST_F(DpctlLineTrace, ALineHasTimeDeltaDirectionDriveWordsAndOctets)
{
    EXPECT_EQ(line(entry(Kind::asked, LineProtocol::ei_ascii, "04 30 30 31 31 50 56 05")),
              "22:13:21.498000  +0.001000 > 01  read PV  [8] 04 30 30 31 31 50 56 05");
    EXPECT_EQ(line(entry(Kind::answered, LineProtocol::modbus_rtu, "01 03 02 00 00 B8 44")),
              "22:13:21.498000  +0.001000 < 1   value 0, CRC right: taken  [7] 01 03 02 00 00 B8 44");
    EXPECT_EQ(line(entry(Kind::no_answer, LineProtocol::ei_ascii, "")),
              "22:13:21.498000  +0.001000 < 01  no answer");
}

TEST_F(DpctlLineTrace, BadIsWhatWasNotTaken)
{
    const auto passes = [](const LineEntry& one) {
        return dpctl::passes({.address = {}, .service = {}, .bad = true}, one, words_of(one));
    };
    EXPECT_FALSE(passes(entry(Kind::asked, LineProtocol::ei_ascii, "04")));
    EXPECT_FALSE(passes(entry(Kind::answered, LineProtocol::ei_ascii, "06")));
    EXPECT_FALSE(passes(entry(Kind::answered, LineProtocol::ei_ascii, "06", Judgement::echo)));
    for (const Judgement judgement : {Judgement::refused, Judgement::late, Judgement::foreign})
        EXPECT_TRUE(passes(entry(Kind::answered, LineProtocol::ei_ascii, "06", judgement)));
    EXPECT_TRUE(passes(entry(Kind::no_answer, LineProtocol::ei_ascii, "")));
    EXPECT_TRUE(passes(gap_before(entry(Kind::asked, LineProtocol::ei_ascii, "04"), 3)));
}

TEST_F(DpctlLineTrace, JsonHasTheJudgementByItsName)
{
    const LineEntry one =
        entry(Kind::answered, LineProtocol::ei_ascii, "02 50 56 31 36 2E 34 03 18", Judgement::late);

    EXPECT_EQ(json_of(one, words_of(one), kOffset),
              dpctl::Json({{"what", "answer"},
                           {"line", "p3"},
                           {"protocol", "ei-ascii"},
                           {"drive", "01"},
                           {"first_ns", 1'700'000'001'498'000'000},
                           {"last_ns", 1'700'000'001'500'000'000},
                           {"words", "PV = 16.4, BCC right: late: it answers an older question"},
                           {"judgement", "late"},
                           {"octets", "02 50 56 31 36 2E 34 03 18"},
                           {"lost", 0}}));
}

TEST_F(DpctlLineTrace, APacketHasDirectionFaultsAndTheJudgementAsComment)
{
    const auto packet = [](Kind kind, Judgement judgement) {
        return *packet_of(entry(kind, LineProtocol::ei_ascii, "15", judgement), kOffset);
    };
    const auto question = packet(Kind::asked, Judgement::taken);
    EXPECT_EQ(question.direction, pcapng::Direction::outbound);
    EXPECT_THAT(question.comments, IsEmpty());
    const auto refused = packet(Kind::answered, Judgement::refused);
    EXPECT_EQ(refused.direction, pcapng::Direction::inbound);
    EXPECT_THAT(refused.comments, ElementsAre("the drive refuses"));
    EXPECT_FALSE(refused.checksum_error);
    EXPECT_TRUE(packet(Kind::answered, Judgement::bad_checksum).checksum_error);
    EXPECT_TRUE(packet(Kind::answered, Judgement::bad_character).character_error);
    EXPECT_TRUE(packet(Kind::answered, Judgement::truncated).checksum_error);
    EXPECT_THAT(packet_of(entry(Kind::no_answer, LineProtocol::modbus_rtu, ""), kOffset)->comments,
                ElementsAre("1: no answer"));
    EXPECT_FALSE(packet_of(gap_before(entry(Kind::asked, LineProtocol::ei_ascii, "04"), 3), kOffset));
}

TEST_F(DpctlLineTrace, ARecordOfTheBusOrOfAnotherVersionIsNone)
{
    EXPECT_FALSE(
        dpctl::line_entry_of(record(Kind::heard, LineProtocol::ei_ascii, "06", Judgement::taken), "p3"));
    EXPECT_FALSE(dpctl::line_entry_of(
        record(Kind::asked, static_cast<LineProtocol>(2), "06", Judgement::taken), "p3"));
    EXPECT_FALSE(dpctl::line_entry_of(
        record(Kind::answered, LineProtocol::ei_ascii, "06", static_cast<Judgement>(drive::kJudgements)),
        "p3"));
}

} // namespace
} // namespace dpslave::test
