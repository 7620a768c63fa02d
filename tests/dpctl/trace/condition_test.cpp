// SPDX-License-Identifier: Apache-2.0
// dpctl trace --stop-on: at which telegram it ends.
#include "dpctl/decode/decode.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/trace/trace_condition.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using dpctl::read_condition;
using dpctl::StopCondition;
using testing::AllOf;
using testing::HasSubstr;
using trace::Entry;
using What = Entry::What;

Entry seen(What what, std::vector<std::uint8_t> octets = {}, std::uint8_t address = 0)
{
    Entry one;
    one.what = what;
    one.octets = std::move(octets);
    one.address = address;
    return one;
}
Entry heard(const std::string& octets)
{
    return seen(What::telegram, *dpctl::read_octets({octets}));
}

// Master 2 and the stations 5 and 7, by hand.
const Entry kDiagTo5 = heard("68 05 05 68 85 82 6D 3C 3E EE 16");
const Entry kDiagTo7 = heard("68 05 05 68 87 82 6D 3C 3E F0 16");
const Entry kReplyOf5 = heard("68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16");
const Entry kSetPrm = heard("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16");
const Entry kAcknowledge = heard("E5");
const Entry kGlobalControl = heard("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16");
const Entry kToken = heard("DC 04 02");
const Entry kPiece = seen(What::piece, {0x10, 0x05});

/// The index of the entry at which it ends; nothing: at none.
std::optional<std::size_t> end_of(const std::string& condition, const std::vector<Entry>& entries)
{
    auto read = read_condition(condition);
    if (!read) throw std::runtime_error(read.error());
    StopCondition stop{*read};
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (stop.holds(entries[i], dpctl::words_of(entries[i]))) return i;
    return std::nullopt;
}

TEST(StopOn, BadIsWhatIsNoTelegramOrARequestWithoutAReplyOfOurs)
{
    EXPECT_EQ(end_of("bad", {kDiagTo5, kReplyOf5, kPiece}), 2U);
    EXPECT_EQ(end_of("bad", {kDiagTo5, seen(What::unanswered, {}, 5)}), 1U);
    EXPECT_EQ(end_of("bad", {seen(What::lost), seen(What::rate), kToken}), std::nullopt);
}

TEST(StopOn, AServiceIsAPartOfItsNameInAnyCase)
{
    EXPECT_EQ(end_of("service=set_prm", {kDiagTo5, kReplyOf5, kSetPrm}), 2U);
    EXPECT_EQ(end_of("service=chk_cfg", {kDiagTo5, kReplyOf5, kSetPrm}), std::nullopt);
}

TEST(StopOn, SenderAndReceiverAreAddresses)
{
    EXPECT_EQ(end_of("from=5", {kDiagTo5, kAcknowledge, kReplyOf5}), 2U);
    EXPECT_EQ(end_of("to=5", {kReplyOf5, kDiagTo7, kDiagTo5}), 2U);
    EXPECT_EQ(end_of("to=127", {kDiagTo5, kGlobalControl}), 1U);
}

TEST(StopOn, SeveralConditionsMustAllHoldForOneTelegram)
{
    EXPECT_EQ(end_of("from=2,service=set_prm,to=5", {kDiagTo5, kReplyOf5, kSetPrm}), 2U);
    EXPECT_EQ(end_of("from=5,service=set_prm", {kDiagTo5, kReplyOf5, kSetPrm}), std::nullopt);
}

TEST(StopOn, ARequestIsUnansweredWhenSomethingElseFollowsThanItsAnswer)
{
    EXPECT_EQ(end_of("unanswered", {kDiagTo5, kReplyOf5, kSetPrm, kAcknowledge, kToken}), std::nullopt);
    EXPECT_EQ(end_of("unanswered", {kDiagTo7, kDiagTo5}), 1U) << "of a station that is not there";
    EXPECT_EQ(end_of("unanswered", {kDiagTo7, kPiece, kDiagTo7}), 2U) << "a damaged answer is none";
    EXPECT_EQ(end_of("unanswered", {kDiagTo7, kReplyOf5}), 1U) << "another station answers";
    EXPECT_EQ(end_of("unanswered", {kGlobalControl, kToken, kToken}), std::nullopt) << "no answer is meant";
    EXPECT_EQ(end_of("unanswered", {kDiagTo7, seen(What::lost), kDiagTo5}), std::nullopt)
        << "its answer may be among those that are missing";
}

TEST(StopOn, ARequestToOneOfOurStationsIsUnansweredAsSoonAsTheDaemonSaysSo)
{
    EXPECT_EQ(end_of("unanswered", {kDiagTo5, seen(What::unanswered, {}, 5), kDiagTo5}), 1U);
    EXPECT_EQ(end_of("unanswered", {seen(What::unanswered, {}, 5)}), 0U);
}

TEST(StopOn, TheOtherWordsBesideUnansweredAreAboutTheRequest)
{
    EXPECT_EQ(end_of("unanswered,to=7", {kDiagTo5, kDiagTo7, kDiagTo5}), 2U);
    EXPECT_EQ(end_of("unanswered,service=set_prm", {kSetPrm, seen(What::unanswered, {}, 5)}), 1U);
    EXPECT_EQ(end_of("unanswered,service=set_prm", {kDiagTo5, seen(What::unanswered, {}, 5)}), std::nullopt);
}

TEST(StopOn, ARefusedConditionNamesTheLegalOnes)
{
    for (const char* wrong : {"", "foo", "bad,", "bad=1", "service", "service=", "from=", "from=128", "to=x",
                              "from=-1", "from=5 ", "station="}) {
        const auto read = read_condition(wrong);
        ASSERT_FALSE(read) << wrong;
        EXPECT_THAT(read.error(), AllOf(HasSubstr("bad, unanswered, service=NAME, station=STATION"),
                                        HasSubstr("from=ADDRESS, to=ADDRESS")));
    }
}

TEST(StopOn, OfARunningDaemonEndsBehindTheTelegramWithStatusZero)
{
    const FixtureDaemon daemon;

    const Ran bad = dpctl({"--socket", daemon.socket(), "--json", "trace", "--stop-on", "bad"});
    EXPECT_EQ(bad.exit, 0) << bad.err;
    EXPECT_THAT(bad.out, HasSubstr("\"what\":\"piece\""));
    EXPECT_THAT(bad.out, testing::Not(HasSubstr("\"what\":\"unanswered\""))) << "what comes behind it";

    const Ran never = dpctl({"--socket", daemon.socket(), "trace", "--stop-on", "from=99"});
    EXPECT_EQ(never.exit, 1) << "it did not hold";
    EXPECT_EQ(dpctl({"--socket", daemon.socket(), "trace", "--stop-on", "foo"}).exit, 2);
    EXPECT_EQ(dpctl({"--socket", daemon.socket(), "trace", "--stop-on", "station=nothing"}).exit, 2);
}

TEST(StopOn, ShowsTheTelegramAtWhichItEndsAlsoWhereAFilterWouldHideIt)
{
    const FixtureDaemon daemon;

    const Ran ran =
        dpctl({"--socket", daemon.socket(), "--json", "trace", "--station", "99", "--stop-on", "bad"});

    EXPECT_EQ(ran.exit, 0);
    EXPECT_THAT(ran.out, HasSubstr("\"what\":\"piece\""));
}

} // namespace
} // namespace dpslave::test
