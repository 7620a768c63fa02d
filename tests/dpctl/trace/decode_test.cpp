// SPDX-License-Identifier: Apache-2.0
// dpctl trace --decode: what a telegram says, with the examples of the manuals. The octets are made by hand.
#include "dpctl/decode_bench.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/trace/trace_decode.hpp"
#include "support/paths.hpp"

#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace dpslave::test {
namespace {

using dpctl::Decoded;
using dpctl::meaning;
using dpctl::TraceDecoder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using trace::Entry;
using What = Entry::What;
using Octets = std::vector<std::uint8_t>;

constexpr std::uint8_t kMaster = 2, kSlave = 5, kRequest = 0x5D, kReply = 0x08;

Octets octets(const std::string& text)
{
    return *dpctl::read_octets({text});
}

/// An SD2 with its length and checksum.
Octets sd2(std::uint8_t da, std::uint8_t sa, std::uint8_t fc, const std::string& rest)
{
    Octets body{da, sa, fc};
    for (const std::uint8_t octet : octets(rest)) body.push_back(octet);
    unsigned sum = 0;
    for (const std::uint8_t octet : body) sum += octet;
    const auto length = static_cast<std::uint8_t>(body.size());
    Octets frame{0x68, length, length, 0x68};
    frame.insert(frame.end(), body.begin(), body.end());
    frame.push_back(static_cast<std::uint8_t>(sum));
    frame.push_back(0x16);
    return frame;
}

Entry on_line(What what, Octets octets)
{
    Entry one;
    one.what = what;
    one.octets = std::move(octets);
    return one;
}
Entry request(const std::string& data)
{
    return on_line(What::telegram, sd2(kSlave, kMaster, kRequest, data));
}
Entry reply(const std::string& data)
{
    return on_line(What::reply, sd2(kMaster, kSlave, kReply, data));
}
/// With the SAPs of a service.
Entry request_to(std::uint8_t sap, const std::string& data)
{
    return on_line(What::telegram,
                   sd2(kSlave | 0x80, kMaster | 0x80, kRequest, dpslave::hex(Octets{sap, 62}) + " " + data));
}
Entry reply_of(std::uint8_t sap, const std::string& data)
{
    return on_line(What::telegram,
                   sd2(kMaster | 0x80, kSlave | 0x80, kReply, dpslave::hex(Octets{62, sap}) + " " + data));
}

/// HA389815 ch. 6: tags 55, 56 and 288, the rest is 0; watchdog 5 s, groups 1.
const std::string kPrm590 =
    "B8 FA 02 0B 05 33 01 00 37 00 38 01 20 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00";
/// Demand Data, then read, write, read.
const std::string kCfg590 = "73 50 60 50";

profile::Profile shipped(const std::string& name, const std::string& table = {})
{
    auto profile = profile::load_profile(io::read_regular_file, source_path("config/profiles"), name);
    if (!profile) throw std::runtime_error(to_string(profile.error().front()));
    if (!table.empty())
        profile->tags = *profile::load_tags(io::read_regular_file, source_path("config/tags/") + table);
    return *std::move(profile);
}

std::string value_of(const std::optional<Decoded>& part, const std::string& name)
{
    if (!part) return "nothing is decoded";
    for (const Decoded::Line& line : part->lines)
        if (line.name == name) return line.value;
    return "there is no line " + name;
}

class TraceDecode : public testing::Test {
protected:
    void is_590() { decoder.set_device(kSlave, shipped("590", "example.csv")); }
    void is_2408f()
    {
        decoder.set_device(kSlave, shipped("2408f"));
        // One input, Process variable.
        decoder.set_layout(kSlave, octets("88 0A 0A 0B 00 01 00 00 01"), octets("73 50"));
    }
    /// The registers of Demand Data, and of the reply one input behind them.
    std::string demand_request(const std::string& registers)
    {
        return value_of(decoder.decode(request(registers)), "Demand Data");
    }
    std::string demand_reply(const std::string& registers)
    {
        return value_of(decoder.decode(reply(registers + " 00 00")), "Demand Data");
    }

    TraceDecoder decoder;
};

TEST_F(TraceDecode, NamesTheOctetsOfSetPrmAndTheTagsOfOurStation)
{
    is_590();

    const auto part = decoder.decode(request_to(61, kPrm590));

    ASSERT_TRUE(part);
    EXPECT_THAT(part->faults, IsEmpty());
    EXPECT_EQ(value_of(part, "watchdog"), "5.0 s");
    EXPECT_EQ(meaning(*part, 1), "Station_status: Lock_Req, Sync_Req, Freeze_Req, WD_On");
    EXPECT_EQ(meaning(*part, 4), "min T_SDR: 11 T_bit");
    EXPECT_EQ(meaning(*part, 6), "Ident_Number, low octet: 0x0533");
    EXPECT_EQ(meaning(*part, 7), "Group_Ident: groups 1");
    EXPECT_EQ(meaning(*part, 9), "tag of parameter 1, low octet: 55 Example: speed feedback");
    EXPECT_EQ(meaning(*part, 13), "tag of parameter 3, low octet: 288 Example: status word");
    EXPECT_EQ(meaning(*part, 15), "tag of parameter 4, low octet: 0, none");
}

TEST_F(TraceDecode, NamesTheIdentifiersOfChkCfg)
{
    is_590();

    const auto part = decoder.decode(request_to(62, kCfg590));

    ASSERT_TRUE(part);
    EXPECT_EQ(meaning(*part, 1), "Demand Data: 4 words in and 4 words out");
    EXPECT_EQ(meaning(*part, 3), "1 word out");
    EXPECT_EQ(value_of(part, "lengths"), "12 octets in, 10 octets out");
}

TEST_F(TraceDecode, ShowsTheValuesOfDataExchangeByTheSetPrmAndChkCfgBefore)
{
    is_590();
    decoder.decode(request_to(61, kPrm590));
    decoder.decode(request_to(62, kCfg590));

    const auto outputs = decoder.decode(request("00 00 00 00 00 00 00 00 10 68"));
    const auto inputs = decoder.decode(reply("00 00 00 00 00 00 00 00 13 BA 1C 00"));

    EXPECT_EQ(value_of(outputs, "Demand Data"), "no command");
    EXPECT_EQ(value_of(outputs, "56 Example: speed setpoint"), "42.00");
    ASSERT_EQ(outputs->lines.size(), 2U);
    EXPECT_EQ(value_of(inputs, "55 Example: speed feedback"), "50.50");
    EXPECT_THAT(value_of(inputs, "288 Example: status word"), HasSubstr(">1C00 (Zero speed"));
}

TEST_F(TraceDecode, HasTheLayoutOfTheDaemonUntilTheMasterSendsAnotherOne)
{
    is_590();
    decoder.set_layout(kSlave, octets(kPrm590), octets("50 60 50"));
    EXPECT_EQ(value_of(decoder.decode(request("10 68")), "56 Example: speed setpoint"), "42.00");

    decoder.decode(request_to(61, kPrm590));
    EXPECT_EQ(value_of(decoder.decode(request("10 68")), "outputs"), "10 68 (2 octets)")
        << "it is not configured yet";
    decoder.decode(request_to(62, "50 50 60"));
    EXPECT_THAT(value_of(decoder.decode(request("10 68")), "288 Example: status word"), HasSubstr(">1068"));
}

TEST_F(TraceDecode, DataOfAnUnknownLayoutOrOfAnotherLengthAreOctets)
{
    EXPECT_EQ(value_of(decoder.decode(request("10 68")), "outputs"), "10 68 (2 octets)");
    is_590();
    decoder.set_layout(kSlave, octets(kPrm590), octets("50 60 50"));

    const auto part = decoder.decode(request("10 68 00"));

    EXPECT_EQ(value_of(part, "outputs"), "10 68 00 (3 octets)");
    EXPECT_THAT(part->faults, ElementsAre("the configuration has 2 octets of outputs, here are 3"));
}

/// 2408f/2404f handbook, worked example 1: tag 270 is written, then 76 is read again and again.
TEST_F(TraceDecode, SaysWorkedExample1OfTheHandbookInWords)
{
    is_2408f();

    EXPECT_EQ(demand_request("00 00 00 00 00 00 00 00"), "no command");
    EXPECT_EQ(demand_request("21 0E 00 00 00 00 00 01"), "write 1 (Tune) to tag 270 Autotune enable");
    EXPECT_EQ(demand_reply("11 0E 00 00 00 00 00 01"),
              "write 1 (Tune) to tag 270 Autotune enable: done, value 1 (Tune)");
    EXPECT_EQ(demand_reply("71 0E 00 00 00 00 00 02"),
              "write 1 (Tune) to tag 270 Autotune enable: rejected with error code 2");
    EXPECT_EQ(demand_request("10 4C 00 00 00 00 00 00"), "read tag 76 Control status word");
    EXPECT_THAT(demand_reply("10 4C 00 00 00 00 10 00"),
                AllOf(HasSubstr("read tag 76 Control status word: done, value >1000 (Autotune enabled)")));
}

/// Worked example 2: tags from 8328 on by the extended commands.
TEST_F(TraceDecode, SaysWorkedExample2OfTheHandbookInWords)
{
    is_2408f();

    EXPECT_EQ(demand_request("30 00 20 88 00 00 00 00"), "read tag 8328 Program 1 general: Holdback type");
    EXPECT_EQ(demand_reply("00 00 00 00 00 00 00 00"),
              "read tag 8328 Program 1 general: Holdback type: not answered yet");
    EXPECT_THAT(demand_reply("30 00 20 88 00 00 00 01"),
                HasSubstr("read tag 8328 Program 1 general: Holdback type: done, value 1 (Low)"));
    EXPECT_EQ(demand_reply("90 88 20 88 00 00 00 00"),
              "read tag 8328 Program 1 general: Holdback type: rejected with error code 0");
}

TEST_F(TraceDecode, AnAnswerOfDemandDataWithoutItsRequestNamesItsTag)
{
    is_2408f();

    EXPECT_THAT(demand_reply("11 0E 00 00 00 00 00 01"), HasSubstr("tag 270 Autotune enable: done, value 1"));
    EXPECT_EQ(demand_reply("71 0E 00 00 00 00 00 01"), "tag 270 Autotune enable: rejected with error code 1");
}

TEST_F(TraceDecode, NamesTheOctetsOfADiagnosisAndTheTripOfATechnologyBox)
{
    decoder.set_device(kSlave, shipped("605"));

    const auto part = decoder.decode(reply_of(60, "08 0C 00 02 16 49 04 01 12 34"));

    ASSERT_TRUE(part);
    EXPECT_EQ(meaning(*part, 1), "Station_status_1: Ext_Diag");
    EXPECT_EQ(meaning(*part, 4), "Master_Add: owned by master 2");
    EXPECT_EQ(meaning(*part, 7), "device-related block of 4 octets");
    EXPECT_THAT(meaning(*part, 8), HasSubstr("OVERVOLT"));
}

constexpr const char* kGsd = "#Profibus_DP\r\n"
                             "GSD_Revision = 1\r\n"
                             "Model_Name = \"Valve \x1B[31m island\"\r\n"
                             "Ident_Number = 0x4711\r\n"
                             "Unit_Diag_Bit(0) = \"Application error\"\r\n"
                             "Unit_Diag_Bit(9) = \"Short circuit of coil 2\"\r\n"
                             "Unit_Diag_Bit(4000000000) = \"no such bit\"\r\n"
                             "Unit_Diag_Area = 16-19\r\n"
                             "Value(3) = \"No air\"\r\n"
                             "Unit_Diag_Area_End\r\n"
                             "Unit_Diag_Area = 9-4\r\n"
                             "Unit_Diag_Area_End\r\n";

TEST_F(TraceDecode, HasTheTextsOfAnotherDeviceFromItsGsdAsSoonAsItsIdentWasSeen)
{
    decoder.add_texts(0x4711, dpctl::diagnosis_texts(gsd::parse(kGsd)));

    const auto part = decoder.decode(reply_of(60, "08 0C 00 02 47 11 04 01 02 03"));

    ASSERT_TRUE(part);
    EXPECT_EQ(value_of(part, "device"), "Valve \\x1B[31m island (by its GSD)");
    EXPECT_EQ(meaning(*part, 8), "device-related, octet 1: Application error");
    EXPECT_EQ(meaning(*part, 9), "device-related, octet 2: Short circuit of coil 2");
    EXPECT_EQ(meaning(*part, 10), "device-related, octet 3: No air");
    const auto other = decoder.decode(reply_of(60, "08 0C 00 02 47 12 04 01 02 03"));
    EXPECT_EQ(meaning(*other, 8), "device-related, octet 1");
}

TEST_F(TraceDecode, SaysNothingBelowATelegramWithoutDataAndWhatIsWrongWithAPiece)
{
    EXPECT_FALSE(decoder.decode(on_line(What::telegram, octets("10 05 02 49 50 16"))));
    EXPECT_FALSE(decoder.decode(on_line(What::reply, octets("E5"))));
    EXPECT_FALSE(decoder.decode(on_line(What::telegram, octets("DC 04 02"))));
    EXPECT_FALSE(decoder.decode(on_line(What::lost, {})));

    const auto piece = decoder.decode(on_line(What::piece, octets("68 05 05 68 05 02 5D 00 00 65 16 FF FF")));
    ASSERT_TRUE(piece);
    EXPECT_THAT(piece->faults, ElementsAre("FCS is 0x65 and should be 0x64"));
    EXPECT_THAT(piece->lines, IsEmpty());
}

TEST_F(TraceDecode, ADamagedSetPrmTeachesNothing)
{
    is_590();
    decoder.set_layout(kSlave, octets(kPrm590), octets("50 60 50"));
    Octets damaged = sd2(kSlave | 0x80, kMaster | 0x80, kRequest, "3D 3E " + kPrm590);
    damaged[12] ^= 1;

    decoder.decode(on_line(What::piece, damaged));

    EXPECT_EQ(value_of(decoder.decode(request("10 68")), "56 Example: speed setpoint"), "42.00");
}

TEST_F(TraceDecode, KnowsWhichTelegramsMayChangeTheMeaningOfTheData)
{
    EXPECT_EQ(dpctl::layout_changed_by(request_to(61, kPrm590)), kSlave);
    EXPECT_EQ(dpctl::layout_changed_by(request_to(62, kCfg590)), kSlave);
    EXPECT_EQ(dpctl::layout_changed_by(request("10 68")), std::nullopt);
    EXPECT_EQ(dpctl::layout_changed_by(on_line(What::piece, octets("FF"))), std::nullopt);
}

/// No sequence of octets may bring it down, whatever the telegrams before have said.
TEST_F(TraceDecode, SurvivesAnyOctets)
{
    is_2408f();
    decoder.set_device(6, shipped("590plus"));
    decoder.add_texts(0x4711, dpctl::diagnosis_texts(gsd::parse(kGsd)));
    std::uint32_t state = 1;
    const auto next = [&state] {
        return static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24);
    };
    constexpr std::array<std::uint8_t, 4> kSaps{60, 61, 62, 59};
    for (int round = 0; round < 20'000; ++round) {
        std::string data;
        if (round % 2 == 0) data = dpslave::hex(Octets{kSaps[next() % 4], 62}) + " ";
        if (round % 8 == 0) data += kPrm590.substr(0, 21) + (next() % 2 == 0 ? "47 11" : "") + " ";
        for (std::size_t i = next() % 40U + 1; i > 0; --i) data += dpslave::hex(Octets{next()}) + " ";
        const auto slave = static_cast<std::uint8_t>((5 + next() % 2) | (round % 2 == 0 ? 0x80 : 0));
        const auto master = static_cast<std::uint8_t>(kMaster | (round % 2 == 0 ? 0x80 : 0));
        const bool asks = next() % 2 == 0;
        Octets frame = asks ? sd2(slave, master, kRequest, data) : sd2(master, slave, kReply, data);
        if (next() % 8 == 0) frame.resize(next() % frame.size());
        const What what = static_cast<What>(next() % 6);
        const auto part = decoder.decode(on_line(what, frame));
        if (!part) continue;
        EXPECT_FALSE(render_details(*part, 4, dpctl::Look{false, 80}).empty());
    }
}

TEST(DpctlTraceDecode, PrintsBelowTheLineOfATelegramAndAsJson)
{
    const FixtureDaemon daemon;

    const Ran text = dpctl(
        {"--socket", daemon.socket(), "trace", "--decode", "--profiles", source_path("config/profiles")});
    EXPECT_EQ(text.exit, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("Set_Prm  ["));
    EXPECT_THAT(text.out, HasSubstr("\n    lock      Lock: the slave belongs to this master\n"));
    EXPECT_THAT(text.err, HasSubstr("unwinder is decoded without the names of its tags: 590.csv"));

    const Ran json =
        dpctl({"--socket", daemon.socket(), "--json", "trace", "--decode", "--service", "set_prm"});
    std::istringstream lines{json.out};
    bool is_decoded = false;
    for (std::string one; std::getline(lines, one);) {
        const Json entry = Json::parse(one);
        if (entry.at("what") == "telegram") is_decoded = entry.at("decoded").at("octets").size() >= 7;
    }
    EXPECT_TRUE(is_decoded) << json.out;
}

TEST(DpctlTraceDecode, NamesAFolderWithoutAGsdAndAFileThatIsNone)
{
    const FixtureDaemon daemon;
    const auto folder = std::filesystem::temp_directory_path() / ("dpctl-gsd-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const std::vector<std::string> command{"--socket", daemon.socket(), "trace",
                                           "--decode", "--gsd",         folder.string()};

    const Ran empty = dpctl(command);
    EXPECT_EQ(empty.exit, 1);
    EXPECT_THAT(empty.err, HasSubstr("there is no GSD file (*.gsd, *.gse ...) in " + folder.string()));

    std::ofstream{folder / "odd.gsd"} << "nonsense";
    std::ofstream{folder / "good.GSE"} << kGsd;
    const Ran odd = dpctl(command);
    EXPECT_EQ(odd.exit, 0);
    EXPECT_THAT(odd.err,
                AllOf(HasSubstr("odd.gsd is left out: it has no Ident_Number"), Not(HasSubstr("good.GSE"))));
    EXPECT_EQ(dpctl({"--socket", daemon.socket(), "trace", "--decode", "--gsd", "/none"}).exit, 1);
    EXPECT_EQ(dpctl({"--socket", daemon.socket(), "trace", "--gsd", folder.string()}).exit, 2);
    std::filesystem::remove_all(folder);
}

TEST(TraceTime, WhichMayBeWrongByMoreThanACharacterIsSaid)
{
    Entry heard = request("10 68");
    heard.baud = Baud::k187_5;
    heard.uncertainty = std::chrono::nanoseconds{58'666}; // 11 bits at 187.5 kbit/s
    EXPECT_EQ(dpctl::how_exact(heard), std::nullopt);
    heard.uncertainty = std::chrono::nanoseconds{58'667};
    EXPECT_EQ(dpctl::how_exact(heard), "on the line up to 0.059 ms earlier");
    heard.what = What::piece;
    heard.uncertainty = std::chrono::milliseconds{16};
    EXPECT_EQ(dpctl::how_exact(heard), "on the line up to 16.000 ms earlier");
    heard.what = What::reply; // its write was seen
    EXPECT_EQ(dpctl::how_exact(heard), std::nullopt);
}

} // namespace
} // namespace dpslave::test
