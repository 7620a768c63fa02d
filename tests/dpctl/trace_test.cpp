// SPDX-License-Identifier: Apache-2.0
#include "dpctl/trace/trace_text.hpp"
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>

namespace dpslave::test {
namespace {

using dpctl::TraceFilter;
using dpctl::UnixOffset;
using testing::ElementsAre;
using testing::HasSubstr;
using trace::Entry;
using What = Entry::What;

constexpr UnixOffset kOffset{std::chrono::seconds{1'700'000'000}};
constexpr Instant kAt{std::chrono::microseconds{1'500'000}};

Entry entry(What what, std::vector<std::uint8_t> octets = {})
{
    Entry one;
    one.what = what;
    one.at = one.first = one.last = kAt;
    one.octets = std::move(octets);
    return one;
}

/// FDL_Status of master 2 to station 5.
Entry fdl_status()
{
    return entry(What::telegram, {0x10, 0x05, 0x02, 0x49, 0x50, 0x16});
}

class DpctlTrace : public testing::Test {
protected:
    DpctlTrace()
    {
        ::setenv("TZ", "UTC", 1);
        ::tzset();
    }
    static std::string line(const Entry& one, std::optional<Instant> before = std::nullopt)
    {
        return dpctl::line_of(one, dpctl::words_of(one), kOffset, before);
    }
    static bool passes(const TraceFilter& filter, const Entry& one)
    {
        return dpctl::passes(filter, one, dpctl::words_of(one));
    }
};

TEST_F(DpctlTrace, ALineHasTimeDeltaAddressesServiceAndOctets)
{
    EXPECT_EQ(line(fdl_status(), kAt - std::chrono::microseconds{250}),
              "22:13:21.500000  +0.000250   2 > 5   request, FDL status  [6] 10 05 02 49 50 16");
}

TEST_F(DpctlTrace, AShortAcknowledgeNamesNoAddresses)
{
    EXPECT_THAT(line(entry(What::reply, {0xE5})), HasSubstr("   - > -   SC  [1] E5"));
}

TEST_F(DpctlTrace, WhatIsNoTelegramNamesItsFlaw)
{
    Entry piece = entry(What::piece, {0x10, 0x05});
    piece.flaw = fdl::Flaw::unfinished;

    EXPECT_THAT(line(piece), HasSubstr("no telegram: " + std::string{fdl::text(fdl::Flaw::unfinished)}));
}

TEST_F(DpctlTrace, APartOfATelegramIsCutAndNoFlaw)
{
    const Entry cut = entry(What::cut, {0x50, 0x16});

    EXPECT_THAT(line(cut), HasSubstr("  - > -   cut: "));
    EXPECT_FALSE(passes({.address = {}, .service = {}, .bad = true}, cut));
    const auto words = dpctl::words_of(cut);
    EXPECT_EQ(json_of(cut, words, kOffset).at("what"), "cut");
    EXPECT_EQ(json_of(cut, words, kOffset).at("flaw"), nullptr);
    const auto packet = packet_of(cut, words, kOffset);
    ASSERT_TRUE(packet);
    EXPECT_FALSE(packet->checksum_error);
    EXPECT_THAT(packet->comments, ElementsAre(words.service));
}

TEST_F(DpctlTrace, OctetsThatAreNoTelegramAreNamedSoWhateverTheRecordSays)
{
    for (const std::vector<std::uint8_t>& octets :
         {std::vector<std::uint8_t>{}, {0x68}, {0x10, 0x05}, {0xE5, 0xE5}, {0x68, 0x05, 0x05, 0x68, 0x05}})
        EXPECT_THAT(line(entry(What::reply, octets)), HasSubstr("  - > -   no telegram"));
}

TEST_F(DpctlTrace, EachReasonForNoReplyIsASentence)
{
    Entry one = entry(What::unanswered);
    one.address = 7;
    for (std::size_t i = 0; i < fdl::kUnansweredReasons; ++i) {
        one.why = static_cast<fdl::Unanswered::Why>(i);
        EXPECT_THAT(line(one), HasSubstr("  7 > -   no reply: "));
        EXPECT_THAT(line(one), testing::Not(HasSubstr("?")));
    }
}

TEST_F(DpctlTrace, FiltersByAddressServiceAndFault)
{
    const Entry status = fdl_status();
    Entry piece = entry(What::piece, {0xFF});

    EXPECT_TRUE(passes({.address = 2, .service = {}}, status));
    EXPECT_TRUE(passes({.address = 5, .service = {}}, status));
    EXPECT_FALSE(passes({.address = 6, .service = {}}, status));
    EXPECT_TRUE(passes({.address = {}, .service = "STATUS"}, status));
    EXPECT_FALSE(passes({.address = {}, .service = "diag"}, status));
    EXPECT_FALSE(passes({.address = {}, .service = {}, .bad = true}, status));
    EXPECT_TRUE(passes({.address = {}, .service = {}, .bad = true}, piece));
    EXPECT_TRUE(passes({.address = 6, .service = "x", .bad = true}, entry(What::lost)))
        << "a gap is always shown";
}

TEST_F(DpctlTrace, APacketHasTheTimeOfItsFirstCharacterItsDirectionAndItsFaults)
{
    Entry piece = entry(What::piece, {0x00, 0x10});
    piece.flaw = fdl::Flaw::character;
    piece.bad_characters = 1;
    piece.first = kAt - std::chrono::milliseconds{1};

    const auto packet = dpctl::packet_of(piece, dpctl::words_of(piece), kOffset);

    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->unix_ns, 1'700'000'001'499'000'000);
    EXPECT_EQ(packet->direction, pcapng::Direction::inbound);
    EXPECT_TRUE(packet->checksum_error);
    EXPECT_TRUE(packet->character_error);
    EXPECT_THAT(packet->comments, ElementsAre(HasSubstr("no telegram")));
    EXPECT_FALSE(dpctl::packet_of(entry(What::lost), {}, kOffset));
}

TEST_F(DpctlTrace, OfARunningDaemonHasOneDocumentALine)
{
    const FixtureDaemon daemon;

    const Ran ran = dpctl({"--socket", daemon.socket(), "--json", "trace"});

    ASSERT_EQ(ran.exit, 0) << ran.err;
    std::istringstream lines{ran.out};
    std::vector<std::string> what;
    for (std::string one; std::getline(lines, one);) what.push_back(Json::parse(one).at("what"));
    EXPECT_THAT(what, ElementsAre("lost", "telegram", "reply", "piece", "unanswered"));
}

TEST_F(DpctlTrace, WhoseRecordsCannotBeReadSaysSoAndWhatToCompare)
{
    // No base64; and three octets that are no record behind the last one.
    for (const char* behind_the_records : {"!", "AAAA"}) {
        const FixtureDaemon daemon{behind_the_records};

        const Ran ran = dpctl({"--socket", daemon.socket(), "trace"});

        EXPECT_EQ(ran.exit, 1);
        EXPECT_THAT(ran.err, HasSubstr("records of the daemon cannot be read"));
        EXPECT_THAT(ran.err, HasSubstr("dpctl version"));
    }
}

TEST_F(DpctlTrace, OfThePastThatEndsWithADriveLineHasWhatIsUnfinishedOnTheBus)
{
    const FixtureDaemon daemon;
    const TempFolder folder;
    const std::string file = (folder.path() / "all.pcapng").string();

    const Ran ran = dpctl({"--socket", daemon.socket(), "trace", "--output", file});

    ASSERT_EQ(ran.exit, 0) << ran.err;
    std::ifstream in{file, std::ios::binary};
    const std::string octets{std::istreambuf_iterator<char>{in}, {}};
    EXPECT_THAT(octets, HasSubstr("\x68\x0D\x0D"));
    EXPECT_THAT(octets, HasSubstr("no telegram"));
}

TEST_F(DpctlTrace, ThatCannotCreateItsFileSaysWhich)
{
    const FixtureDaemon daemon;

    const Ran ran = dpctl({"--socket", daemon.socket(), "trace", "--output", "/none/bus.pcapng"});

    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.err, HasSubstr("/none/bus.pcapng"));
}

} // namespace
} // namespace dpslave::test
