// SPDX-License-Identifier: Apache-2.0
// A GSD file against the station that runs, before commissioning.
#include "station.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using configurator::RunningStation;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> codes(const json& reply)
{
    std::vector<std::string> all;
    for (const json& finding : reply["findings"])
        all.push_back(finding["severity"].get<std::string>() + ' ' + finding.value("code", ""));
    return all;
}

/// A Set_Prm of a 620 with these tags, and zeros behind them.
std::string last_prm_with(const std::string& tags)
{
    std::string octets = "88 01 0A 0B 05 33 00 " + tags;
    while (octets.size() < 3 * (7 + 24) - 1) octets += " 00";
    return octets;
}

TEST(StationCheck, PassesTheFileOfTheStation)
{
    const json reply = judge(file_of({"out:58"}), unwinder(), "mine.csv");
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "lines");
    EXPECT_THAT(codes(reply), IsEmpty());
    EXPECT_THAT(texts(reply, "lines"), HasSubstr("unwinder: the file fits with 1 word."));
}

TEST(StationCheck, FindsAnotherIdent)
{
    RunningStation station = unwinder();
    station.keys.ident = 0x1234;
    const json reply = judge(file_of({"out:58"}), station, "mine.csv");
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(codes(reply), ElementsAre("error prm_ident"));
    EXPECT_THAT(texts(reply, "lines"), HasSubstr("expected Ident_Number 0x1234, got 0x0533"));
}

TEST(StationCheck, FindsARateThatTheFileDoesNotOfferAndOneThatTheStationDoesNotHave)
{
    const std::string file = with(file_of({"out:58"}), "187.5_supp", "3M_supp");
    EXPECT_THAT(codes(judge(file, unwinder(), "mine.csv")), Contains("error rate"));

    RunningStation station = unwinder();
    station.rates.pop_back();
    EXPECT_THAT(codes(judge(file_of({"out:58"}), station, "mine.csv")), ElementsAre("warning rate"));
}

TEST(StationCheck, FindsAMasterThatDoesNotWaitLongEnough)
{
    RunningStation station = unwinder();
    station.rates[3].second = 120;
    const json reply = judge(file_of({"out:58"}), station, "mine.csv");
    EXPECT_THAT(codes(reply), ElementsAre("error max_tsdr"));
    EXPECT_THAT(texts(reply, "lines"), HasSubstr("MaxTsdr_187.5 is 60 in the file and 120 in the station"));
}

TEST(StationCheck, ComparesMaxTsdrWithTheRepliesThatWereMeasured)
{
    RunningStation station = unwinder();
    station.usual_reply = 60;
    station.slowest_reply = 61;
    EXPECT_THAT(codes(judge(file_of({"out:58"}), station, "mine.csv")), ElementsAre("warning measured"));
    station.usual_reply = 61;
    EXPECT_THAT(codes(judge(file_of({"out:58"}), station, "mine.csv")), ElementsAre("error measured"));
    station.slowest_reply = station.usual_reply = 60;
    EXPECT_THAT(codes(judge(file_of({"out:58"}), station, "mine.csv")), IsEmpty());
}

TEST(StationCheck, FindsOutputsOnReadOnlyTagsAndTagsWithoutAScale)
{
    const json reply = judge(file_of({"out:55", "in:57", "in:99"}), unwinder(), "mine.csv");
    EXPECT_THAT(codes(reply), ElementsAre("warning read_only", "warning no_scale", "warning no_scale"));
    EXPECT_EQ(reply["findings"][0]["tag"], 55);
    EXPECT_EQ(reply["findings"][1]["tag"], 57) << "no decimals";
    EXPECT_EQ(reply["findings"][2]["tag"], 99) << "in no table";

    RunningStation station = unwinder();
    station.unscaled = {57};
    EXPECT_THAT(codes(judge(file_of({"in:57"}), station, "mine.csv")), ElementsAre("error no_scale"));
    station.protocol = "modbus-rtu";
    EXPECT_THAT(codes(judge(file_of({"in:57"}), station, "mine.csv")), IsEmpty());
}

TEST(StationCheck, NamesTheFirstOctetWhereTheMasterSentSomethingElse)
{
    RunningStation station = unwinder();
    station.last_prm = "88 01 0A 0B 05 33 00 00 3A 00 39";
    station.last_cfg = "60 50";
    const json reply = judge(file_of({"out:58"}), station, "mine.csv");
    EXPECT_THAT(codes(reply), ElementsAre("warning last_sent", "warning last_sent"));
    EXPECT_THAT(texts(reply, "lines"),
                testing::AllOf(
                    HasSubstr("last Set_Prm of the master is another than that of the file: in octet 11 the "
                              "master sent 0x39, the file has 0x00"),
                    HasSubstr("in octet 2 the master sent 0x50, the file's ends there")));

    station.last_prm = last_prm_with("00 3A");
    station.last_cfg = "60";
    EXPECT_THAT(codes(judge(file_of({"out:58"}), station, "mine.csv")), IsEmpty());
}

TEST(StationCheck, DoesNotCompareTheTagsOfAFileThatLeavesThemToTheMastersTool)
{
    RunningStation station = unwinder();
    station.last_prm = last_prm_with("00 3A");
    station.last_cfg = "60";
    const json mapping{{"profile", "620"}};
    const json reply = judge(made_file(mapping), station, "mine.csv");
    EXPECT_THAT(codes(reply), IsEmpty());
    EXPECT_THAT(texts(reply, "lines"),
                HasSubstr("the plant uses the modules PROZESS_DATA_SCHREIBEN with the tags 58."));

    station.last_prm = "88 01 0A 0B 05 33 00 00 3A";
    EXPECT_THAT(codes(judge(made_file(mapping), station, "mine.csv")), ElementsAre("warning last_sent"))
        << "its length is another";
}

TEST(StationCheck, SaysWhichModulesAndTagsOfAFileThePlantUses)
{
    RunningStation station = unwinder();
    station.last_prm = last_prm_with("00 3A 00 37");
    station.last_cfg = "73 60 50";
    const std::string file = made_file({{"profile", "620"}, {"tags", {58, 55}}});
    const json reply = judge(file, station, "mine.csv");
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "lines");
    EXPECT_THAT(codes(reply), IsEmpty()) << texts(reply, "lines");
    EXPECT_THAT(texts(reply, "lines"),
                HasSubstr("the plant uses the modules DEMAND_DATA, PROZESS_DATA_SCHREIBEN, "
                          "PROZESS_DATA_LESEN with the tags 58, 55."));

    station.last_cfg = "73 70 50";
    EXPECT_THAT(codes(judge(file, station, "mine.csv")), Contains("warning last_sent"))
        << "none of its modules is 70";
}

TEST(StationCheck, CountsOneErrorAsOne)
{
    RunningStation station = unwinder();
    station.keys.ident = 0x1234;
    EXPECT_THAT(texts(judge(file_of({"out:58"}), station, "mine.csv"), "lines"),
                HasSubstr("unwinder: 1 error, 0 warnings"));
}

TEST(StationCheck, DoesNotCallAFileWithErrorsFit)
{
    const json reply = judge(with(file_of({"out:58"}), "EndModule", ""), unwinder(), "mine.csv");
    EXPECT_EQ(reply["exit"], 1) << texts(reply, "lines");
    EXPECT_THAT(texts(reply, "lines"), testing::Not(HasSubstr("the file fits")));
}

TEST(StationCheck, FindsTheFileOfAnotherDevice)
{
    RunningStation station = unwinder();
    station.keys.ident = 0x1649;
    EXPECT_THAT(codes(judge(file_of({"in-out:9"}, "605"), station)), Contains("error prm_length"));
    EXPECT_EQ(judge("no GSD", unwinder())["exit"], 1);
    station.profile = "of a site";
    EXPECT_EQ(judge(file_of({"in:9"}), station)["exit"], 1);
}

} // namespace
} // namespace dpslave::test
