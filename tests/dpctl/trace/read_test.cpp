// SPDX-License-Identifier: Apache-2.0
// dpctl trace --read: captures from the disk, without a daemon. Those that are not files of tests/captures
// are written here octet by octet.
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/trace/trace_text.hpp"
#include "support/paths.hpp"
#include "support/wire.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace dpslave::test {
namespace {

using ::test::joined;
using ::test::Octets;
using ::test::sc;
using ::test::sd1;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using What = trace::Entry::What;

const std::string kCaptures = source_path("tests/captures/");
const std::string kProfiles = source_path("config/profiles");

/// A pcap file of these packets, a second from each other.
std::string pcap(const std::vector<Octets>& packets, std::uint32_t link_type = 257)
{
    std::string file;
    const auto number = [&file](std::size_t value) {
        for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(value >> shift & 0xFF);
    };
    for (const std::uint32_t word : {0xA1B2C3D4U, 0x00040002U, 0U, 0U, 65'535U, link_type}) number(word);
    std::size_t at = 1'700'000'000;
    for (const Octets& packet : packets) {
        for (const std::size_t word : {at++, std::size_t{0}, packet.size(), packet.size()}) number(word);
        file.append(packet.begin(), packet.end());
    }
    return file;
}

class DpctlTraceRead : public testing::Test {
protected:
    std::string file(const std::string& content, const std::string& name = "bus.pcap") const
    {
        const std::string path = (folder_.path() / name).string();
        std::ofstream{path, std::ios::binary} << content;
        return path;
    }
    static Ran read(const std::string& path, std::vector<std::string> more = {})
    {
        more.insert(more.begin(), {"trace", "--socket", "/none", "--read", path});
        return dpctl(more);
    }
    static std::vector<Json> entries(const std::string& path, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> all{"--json"};
        all.insert(all.end(), more.begin(), more.end());
        std::istringstream lines{read(path, all).out};
        std::vector<Json> found;
        for (std::string line; std::getline(lines, line);) found.push_back(Json::parse(line));
        return found;
    }
    static std::vector<std::string> whats(const std::string& path, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> found;
        for (const Json& one : entries(path, more)) found.push_back(one.at("what"));
        return found;
    }

    TempFolder folder_;
    const Octets request_ = ::test::sd2(5, 2, 0x5D, {0x12, 0x34}),
                 reply_ = ::test::sd2(2, 5, 0x08, {0x56, 0x78});
};

TEST_F(DpctlTraceRead, ShowsACaptureWithoutADaemonAndSaysNothingWhereTheCaptureSaysAll)
{
    const Ran ran = read(kCaptures + "worked/example-start-up.pcapng");

    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.err, IsEmpty());
    EXPECT_THAT(ran.out, HasSubstr("2 > 5   Set_Prm"));
    EXPECT_THAT(ran.out, HasSubstr("5 > 2   Data_Exchange, reply"));
}

TEST_F(DpctlTraceRead, BitSixTellsARequestFromAReplyWhereNoPacketHasADirectionAndItIsSaidOnce)
{
    const std::string path = file(pcap({request_, reply_, sd1(7, 2, 0x49), sc(), ::test::token(3, 2)}));

    EXPECT_THAT(whats(path), ElementsAre("telegram", "reply", "telegram", "reply", "telegram"));
    const std::string said = read(path).err;
    EXPECT_THAT(said, HasSubstr("bus.pcap: no direction is recorded with 5 packets"));
    EXPECT_THAT(said, HasSubstr("bit 6"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
}

TEST_F(DpctlTraceRead, WhatACaptureDoesNotHaveIsNullInJsonAndTheRestIsThere)
{
    const Json one = entries(file(pcap({request_}))).at(0);

    for (const char* key : {"at_ns", "last_ns", "uncertainty_ns", "baud"})
        EXPECT_TRUE(one.at(key).is_null()) << key;
    EXPECT_EQ(one.at("first_ns"), 1'700'000'000'000'000'000);
    EXPECT_EQ(one.at("from"), 2);
    EXPECT_EQ(one.at("service"), "Data_Exchange");
}

TEST_F(DpctlTraceRead, AFileThatBeginsInTheMiddleOfATelegramBeginsWithCutAndNotWithAFlaw)
{
    for (std::size_t gone = 1; gone < request_.size(); ++gone) {
        const Octets end(request_.begin() + static_cast<std::ptrdiff_t>(gone), request_.end());
        const std::string path = file(pcap({end, reply_, request_, reply_}));

        EXPECT_THAT(whats(path), ElementsAre("cut", "reply", "telegram", "reply")) << gone;
        EXPECT_THAT(read(path, {"--bad"}).out, IsEmpty()) << gone;
    }
}

TEST_F(DpctlTraceRead, TheEndOfATelegramInSeveralPacketsIsCutToItsLast)
{
    EXPECT_THAT(whats(file(pcap({{0x12, 0x34}, {0x77, 0x16}, reply_}))), ElementsAre("cut", "cut", "reply"));
}

TEST_F(DpctlTraceRead, AFlawBehindTheBeginIsStillOne)
{
    Octets wrong = reply_;
    wrong[wrong.size() - 2] ^= 1;
    const std::string path = file(pcap({{0x47, 0x16}, request_, wrong, request_, {0x68, 0x05}}));

    EXPECT_THAT(whats(path), ElementsAre("cut", "telegram", "piece", "telegram", "piece"));
    const auto bad = entries(path, {"--bad"});
    ASSERT_EQ(bad.size(), 2U);
    EXPECT_EQ(bad[0].at("flaw"), fdl::text(fdl::Flaw::checksum));
    EXPECT_EQ(bad[1].at("flaw"), fdl::text(fdl::Flaw::unfinished));
}

TEST_F(DpctlTraceRead, APacketOfSeveralTelegramsIsEachOfThem)
{
    EXPECT_THAT(whats(file(pcap({joined({request_, sd1(7, 2, 0x49)})}))),
                ElementsAre("telegram", "telegram"));
}

TEST_F(DpctlTraceRead, FiltersAndStopOnWorkAsInATrace)
{
    const std::string path = file(pcap({sd1(7, 2, 0x49), request_, reply_, sd1(9, 2, 0x49)}));

    EXPECT_EQ(entries(path, {"--station", "5"}).size(), 2U);
    EXPECT_EQ(entries(path, {"--service", "status"}).size(), 2U);
    EXPECT_EQ(entries(path, {"--stop-on", "station=5"}).size(), 2U);
    EXPECT_EQ(read(path, {"--stop-on", "to=33"}).exit, 1);
    const Ran named = read(path, {"--station", "unwinder"});
    EXPECT_EQ(named.exit, 2);
    EXPECT_THAT(named.err, HasSubstr("write the address in place of unwinder"));
}

TEST_F(DpctlTraceRead, DecodesByTheSetPrmAndChkCfgOfTheCapture)
{
    const std::string path = kCaptures + "worked/590-tags.pcapng";
    const std::vector<std::string> decode{"--decode", "--profile", "590", "--profiles", kProfiles};

    EXPECT_THAT(read(path, decode).out, HasSubstr("\n    55  >04E2\n    56  >FED4\n"));
    const std::string without = read(path, {"--decode"}).out;
    EXPECT_THAT(without, HasSubstr("Ident_Number"));
    EXPECT_THAT(without, Not(HasSubstr("\n    55  ")));
    const Ran unknown = read(path, {"--decode", "--profile", "591", "--profiles", kProfiles});
    EXPECT_EQ(unknown.exit, 1);
    EXPECT_THAT(unknown.err, HasSubstr("591.toml"));
}

TEST_F(DpctlTraceRead, WhatIsWrittenOfItIsReadAsTheSame)
{
    Octets wrong = reply_;
    wrong[wrong.size() - 2] ^= 1;
    const std::string path = file(pcap({{0x47, 0x16}, request_, reply_, wrong, request_}));
    const std::string copy = (folder_.path() / "copy.pcapng").string();

    const Ran written = read(path, {"--output", copy});

    EXPECT_EQ(written.exit, 0) << written.err;
    EXPECT_EQ(read(copy).out, read(path).out);
    EXPECT_THAT(read(copy).err, IsEmpty()) << "now it says who sent each packet";
}

TEST_F(DpctlTraceRead, ACaptureOfATraceIsReadAsThatTraceHadIt)
{
    const FixtureDaemon daemon;
    const std::string path = (folder_.path() / "trace.pcapng").string();
    // With a condition that never holds it is of the bus alone.
    ASSERT_THAT(dpctl({"--socket", daemon.socket(), "trace", "--output", path, "--stop-on", "to=99"}).out,
                HasSubstr(" packets in "));

    std::vector<std::string> live;
    std::istringstream lines{dpctl({"--socket", daemon.socket(), "--json", "trace"}).out};
    for (std::string line; std::getline(lines, line);) live.push_back(Json::parse(line).at("service"));

    std::vector<std::string> services;
    for (const Json& one : entries(path)) services.push_back(one.at("service"));
    ASSERT_EQ(live.size(), 5U);
    EXPECT_EQ(services, live);
}

TEST_F(DpctlTraceRead, ShowsTheFramesOfADriveLine)
{
    const std::string path = kCaptures + "worked/590-tags.pcapng";
    const Ran frames = read(path, {"--line", "drive"});

    EXPECT_EQ(frames.exit, 0) << frames.err;
    EXPECT_THAT(frames.out, HasSubstr(" > 01  read "));
    EXPECT_THAT(frames.out, HasSubstr(" < 01  II = >0590  ["));
    EXPECT_THAT(frames.out, Not(HasSubstr("taken"))) << "nobody said it";
    const Ran unknown = read(path, {"--line", "p4"});
    EXPECT_EQ(unknown.exit, 2);
    EXPECT_THAT(unknown.err, HasSubstr("it has no drive line 'p4'; it has: drive"));
}

TEST_F(DpctlTraceRead, WithWhatNeedsADaemonIsRefused)
{
    const std::string path = file(pcap({request_}));

    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{"--follow"}, {"--incidents"}, {"--incident", "1"}}) {
        const Ran ran = read(path, more);
        EXPECT_EQ(ran.exit, 2) << more.front();
        EXPECT_THAT(ran.err, HasSubstr(more.front()));
    }
    const Ran onto_itself = read(path, {"--output", path});
    EXPECT_EQ(onto_itself.exit, 2);
    EXPECT_THAT(onto_itself.err, HasSubstr("name another one"));
    EXPECT_EQ(entries(path).size(), 1U) << "it is still there";
}

TEST_F(DpctlTraceRead, OfAFileThatIsNoCaptureOfABusSaysWhatItIsAndWhatToDo)
{
    const auto why = [](const std::string& path) {
        const Ran ran = read(path);
        EXPECT_EQ(ran.exit, 1) << path;
        EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
        return ran.err;
    };

    EXPECT_THAT(why("/none/bus.pcap"), HasSubstr("/none/bus.pcap: there is no such file"));
    EXPECT_THAT(why("/tmp"), HasSubstr("/tmp: it is no file"));
    EXPECT_THAT(why(file("")), HasSubstr("it is empty"));
    EXPECT_THAT(why(file("hello")), HasSubstr("it is no capture"));
    EXPECT_THAT(why(file(pcap({request_}, 1))), HasSubstr("link type 257 or 147), but of link type 1:"));
    EXPECT_THAT(why(file(pcap({{0x04}}, 148))), HasSubstr("only drive lines. Show one with --line"));
}

TEST_F(DpctlTraceRead, OfAFileThatIsCutOffTheWholePacketsAreShown)
{
    std::string content = pcap({request_, reply_});
    content.resize(content.size() - 3);
    const std::string path = file(content);

    EXPECT_THAT(whats(path), ElementsAre("telegram"));
    EXPECT_THAT(read(path).err, HasSubstr("it is cut off: the complete packets before that are shown"));
}

TEST(TraceEntryOfAPacket, HasWhatTheEntryOfThePacketHad)
{
    std::vector<trace::Entry> entries(4);
    entries[0].what = What::piece;
    entries[0].flaw = fdl::Flaw::length_range;
    entries[0].octets = {0x68, 1};
    entries[1].what = What::cut;
    entries[1].octets = {0x47, 0x16};
    entries[2].what = What::piece;
    entries[2].octets = {0xE5}; // as a telegram it would be an SC
    entries[3].what = What::reply;
    entries[3].octets = {0xE5};
    for (std::size_t i = 0; i < fdl::kUnansweredReasons; ++i) {
        trace::Entry& one = entries.emplace_back();
        one.what = What::unanswered;
        one.why = static_cast<fdl::Unanswered::Why>(i);
        one.address = 7;
    }
    for (const trace::Entry& one : entries) {
        auto packet = packet_of(one, dpctl::words_of(one), {});
        ASSERT_TRUE(packet);
        packet->comments.emplace_back("a remark");

        const auto read = dpctl::entry_of(*packet);

        ASSERT_TRUE(read);
        EXPECT_EQ(read->what, one.what);
        EXPECT_EQ(read->octets, one.octets);
        EXPECT_EQ(read->flaw, one.flaw);
        EXPECT_EQ(read->why, one.why);
        EXPECT_EQ(read->address, one.address);
        EXPECT_EQ(dpctl::note_of(*packet), "a remark");
    }
}

} // namespace
} // namespace dpslave::test
