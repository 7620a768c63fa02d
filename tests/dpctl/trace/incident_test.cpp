// SPDX-License-Identifier: Apache-2.0
// The list of incidents, the head of one, and the start-up that stands before its telegrams.
#include "dpctl/trace/incident.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>

namespace dpslave::dpctl {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;
using What = trace::Entry::What;
using Octets = std::vector<std::uint8_t>;

class DpctlIncident : public testing::Test {
protected:
    DpctlIncident()
    {
        ::setenv("TZ", "UTC", 1);
        ::tzset();
    }
};

report::IncidentStation unwinder()
{
    return {.name = "unwinder",
            .address = 5,
            .profile = "590",
            .state = "Data_Exch",
            .master = 2,
            .set_prm = "B8 05 04 0B 00 00 00",
            .chk_cfg = "51"};
}

/// A request of Data_Exchange of master 2 to station 5 with this FC.
trace::Entry data_exchange(std::uint8_t fc)
{
    trace::Entry entry;
    entry.baud = Baud::k93_75;
    entry.at = entry.first = entry.last = Instant{seconds{100}};
    const auto sum = static_cast<std::uint8_t>(0x05 + 0x02 + fc + 0x12 + 0x34);
    entry.octets = {0x68, 0x05, 0x05, 0x68, 0x05, 0x02, fc, 0x12, 0x34, sum, 0x16};
    return entry;
}

TEST_F(DpctlIncident, TheListHasTheirCountsAndWhatWasNotKept)
{
    report::ListIncidentsReply reply;
    reply.incidents = {{.number = 3,
                        .kind = "left",
                        .station = "unwinder",
                        .reason = "watchdog",
                        .text = "unwinder: left Data_Exch",
                        .count = 2,
                        .first_unix_ns = 1'700'000'000'000'000'000,
                        .last_unix_ns = 1'700'000'060'000'000'000,
                        .also = 1},
                       {.number = 4, .kind = "flaws", .text = "the bus is disturbed", .count = 1}};
    reply.not_kept = 2;
    reply.failures = 1;
    reply.trouble = "/x: no space";

    EXPECT_EQ(render_incidents(reply, Look{false, 120}),
              "NUMBER  FIRST                    COUNT  LAST                     WHAT\n"
              "     3  2023-11-14 22:13:20.000      2  2023-11-14 22:14:20.000  unwinder: left Data_Exch "
              "(and 1 more)\n"
              "     4  1970-01-01 00:00:00.000      1  -                        the bus is disturbed\n"
              "2 further ones were not kept: too many within a short time\n"
              "1 file could not be written; the last one: /x: no space\n");
}

TEST_F(DpctlIncident, WithoutOneTheListSaysSo)
{
    EXPECT_EQ(render_incidents({}, Look{}), "no incident\n");
}

TEST_F(DpctlIncident, TheHeadNamesWhatFollowedAndTheParametersOfTheStation)
{
    report::IncidentHead head{.number = 7, .what = {.text = "unwinder: left Data_Exch"}, .unix_ns = 0};
    head.also = {{.text = "rewinder: left Data_Exch"}};
    head.stations = {unwinder()};
    report::IncidentStation other;
    other.name = "new\nline";
    other.state = "Wait_Prm";
    head.stations.push_back(other);

    EXPECT_EQ(render_incident(head), "incident 7, 1970-01-01 00:00:00.000: unwinder: left Data_Exch\n"
                                     "  then: rewinder: left Data_Exch\n"
                                     "  unwinder: address 5, profile 590, Data_Exch, master 2\n"
                                     "    Set_Prm  B8 05 04 0B 00 00 00\n"
                                     "    Chk_Cfg  51\n"
                                     "  new\\x0Aline: address 0, profile , Wait_Prm\n"
                                     "    Set_Prm  -\n"
                                     "    Chk_Cfg  -\n");
}

TEST_F(DpctlIncident, TheStartUpStandsBeforeTheFirstTelegram)
{
    const auto entries = start_up({unwinder()}, {data_exchange(0x5D)});

    ASSERT_EQ(entries.size(), 4U);
    EXPECT_EQ(entries[0].octets, (Octets{0x68, 0x0C, 0x0C, 0x68, 0x85, 0x82, 0x5D, 0x3D, 0x3E, 0xB8, 0x05,
                                         0x04, 0x0B, 0x00, 0x00, 0x00, 0xAB, 0x16}));
    EXPECT_EQ(entries[1].octets, Octets{0xE5});
    EXPECT_EQ(entries[1].what, What::reply);
    EXPECT_EQ(entries[2].octets,
              (Octets{0x68, 0x06, 0x06, 0x68, 0x85, 0x82, 0x7D, 0x3E, 0x3E, 0x51, 0x51, 0x16}));
    for (std::size_t i = 1; i < entries.size(); ++i) EXPECT_LT(entries[i - 1].last, entries[i].first);
    EXPECT_LT(entries.back().last, Instant{seconds{100}});
    EXPECT_EQ(entries.back().baud, Baud::k93_75);
}

TEST_F(DpctlIncident, TheFirstTelegramIsNoRepeatOfTheStartUp)
{
    EXPECT_EQ(start_up({unwinder()}, {data_exchange(0x5D)}).at(2).octets.at(6), 0x7D);
    EXPECT_EQ(start_up({unwinder()}, {data_exchange(0x7D)}).at(2).octets.at(6), 0x5D);
}

TEST_F(DpctlIncident, ThereIsNoneBeforeTheStartUpItself)
{
    trace::Entry set_prm = data_exchange(0x5D);
    set_prm.octets = {0x68, 0x06, 0x06, 0x68, 0x85, 0x82, 0x5D, 0x3D, 0x3E, 0x00, 0xDF, 0x16};

    EXPECT_TRUE(start_up({unwinder()}, {set_prm, data_exchange(0x7D)}).empty());
}

TEST_F(DpctlIncident, OfSeveralStationsEachIsStartedAfterTheOther)
{
    report::IncidentStation other = unwinder();
    other.address = 6;

    trace::Entry to_other = data_exchange(0x7D);
    to_other.octets[4] = 0x06;
    ++to_other.octets[9]; // its checksum

    const auto entries = start_up({unwinder(), other}, {data_exchange(0x5D), to_other});

    ASSERT_EQ(entries.size(), 8U);
    for (std::size_t i = 1; i < entries.size(); ++i) EXPECT_LT(entries[i - 1].last, entries[i].first);
    EXPECT_EQ(entries[2].octets.at(4), 0x85);
    EXPECT_EQ(entries[6].octets.at(4), 0x86);
    EXPECT_EQ(entries[6].octets.at(6), 0x5D) << "of each its own frame count bit";
}

/// A request of master 2 to station 5 with SAPs, at this second.
trace::Entry at_sap(std::uint8_t dsap, int second)
{
    trace::Entry entry;
    const auto sum = static_cast<std::uint8_t>(0x85 + 0x82 + 0x5D + dsap + 0x3E);
    entry.octets = {0x68, 0x05, 0x05, 0x68, 0x85, 0x82, 0x5D, dsap, 0x3E, sum, 0x16};
    entry.at = entry.first = entry.last = Instant{seconds{second}};
    return entry;
}

TEST_F(DpctlIncident, TheCauseIsTheLastTelegramThatItsReasonNamesUpToTheMoment)
{
    trace::Entry exchange = data_exchange(0x5D);
    exchange.first = Instant{seconds{4}};
    trace::Entry of_another_master = at_sap(61, 5);
    of_another_master.octets[5] = 0x83;
    ++of_another_master.octets[9];
    const std::vector<trace::Entry> entries{at_sap(61, 1), at_sap(62, 2),     at_sap(60, 3),
                                            exchange,      of_another_master, at_sap(61, 9)};
    const auto cause = [&](const char* kind, const char* reason) {
        report::IncidentHead head{.what = {.kind = kind, .station = "unwinder", .reason = reason},
                                  .at_ns = std::chrono::nanoseconds{seconds{6}}.count()};
        head.stations = {unwinder()};
        return cause_in(head, entries);
    };

    EXPECT_EQ(cause("refused", "prm_ident"), 4U) << "of whichever master";
    EXPECT_EQ(cause("refused", "foreign_set_prm"), 4U);
    EXPECT_EQ(cause("refused", "cfg_too_few"), 1U);
    EXPECT_EQ(cause("left", "unlock"), 0U) << "of its own master, and not what came later";
    EXPECT_EQ(cause("left", "cfg_fault"), 1U);
    EXPECT_EQ(cause("left", "output_length"), 3U);
    EXPECT_EQ(cause("left", "watchdog"), 3U) << "the last sign of the master";
    EXPECT_EQ(cause("flaws", "checksum"), std::nullopt) << "each of them is bad";
    EXPECT_EQ(cause("drive", "silent"), std::nullopt) << "it is on the drive line";
}

TEST_F(DpctlIncident, TheCauseOnADriveLineIsTheSilenceOrTheAnswerThatWasRefused)
{
    const auto frame = [](LineEntry::What what, drive::Judgement judgement, int second) {
        LineEntry entry;
        entry.what = what;
        entry.judgement = judgement;
        entry.first = Instant{seconds{second}};
        return entry;
    };
    using enum LineEntry::What;
    const std::vector<LineEntry> frames{
        frame(answer, drive::Judgement::bad_checksum, 1), frame(silence, drive::Judgement::taken, 2),
        frame(answer, drive::Judgement::late, 3),         frame(answer, drive::Judgement::taken, 4),
        frame(answer, drive::Judgement::foreign, 1),      frame(silence, drive::Judgement::taken, 9)};
    const auto cause = [&](const char* kind, const char* reason) {
        return cause_in(report::IncidentHead{.what = {.kind = kind, .reason = reason},
                                             .at_ns = std::chrono::nanoseconds{seconds{6}}.count()},
                        frames);
    };

    EXPECT_EQ(cause("answer", "damaged"), 0U);
    EXPECT_EQ(cause("drive", "silent"), 1U);
    EXPECT_EQ(cause("answer", "late"), 2U);
    EXPECT_EQ(cause("answer", "foreign"), 4U);
    EXPECT_EQ(cause("drive", "port"), std::nullopt);
    EXPECT_EQ(cause("left", "unlock"), std::nullopt);
}

TEST_F(DpctlIncident, ThereIsNoStartUpOfWhatIsNotKnownForCertain)
{
    const std::vector<trace::Entry> behind{data_exchange(0x5D)};
    std::vector<report::IncidentStation> unknown(7, unwinder());
    unknown[0].set_prm.clear();
    unknown[1].chk_cfg.clear();
    unknown[2].master.reset();
    unknown[3].state = "Wait_Prm";
    unknown[4].address = 127;
    unknown[5].master = -1;
    unknown[6].set_prm = "B8 0";

    for (std::size_t i = 0; i < unknown.size(); ++i) EXPECT_TRUE(start_up({unknown[i]}, behind).empty()) << i;
    EXPECT_TRUE(start_up({unwinder()}, {}).empty()) << "there is no telegram behind it";
}

} // namespace
} // namespace dpslave::dpctl
