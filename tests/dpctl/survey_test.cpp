// SPDX-License-Identifier: Apache-2.0
// dpctl survey: its files, what it shows, and the program against a daemon.
#include "control/lines.hpp"
#include "dpctl/tags/survey.hpp"
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace dpslave::test {
namespace {

using dpctl::progress_bar;
using dpctl::progress_line;
using dpctl::SurveyFiles;
using profile::SurveyAnswer;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

SurveyAnswer said(const char* text)
{
    return {SurveyAnswer::Kind::text, text, 0};
}
SurveyAnswer denied(const char* why)
{
    return {SurveyAnswer::Kind::denied, why, 0};
}

std::string content(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream{file}.rdbuf();
    return text.str();
}
void put(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream{file} << text;
}

// ---------------------------------------------------------------- the files

class SurveyFilesTest : public testing::Test {
protected:
    SurveyFiles open(bool resume = false, const std::filesystem::path& begin_with = {}) const
    {
        auto files = SurveyFiles::open("unwinder", table, begin_with, resume);
        if (!files) throw std::runtime_error(files.error());
        return *std::move(files);
    }
    TempFolder folder;
    const std::filesystem::path table = folder.path() / "unwinder.csv";
    const std::filesystem::path record = folder.path() / "unwinder.survey.csv";
};

TEST_F(SurveyFilesTest, ARecordGoesOnWhereItEnded)
{
    {
        SurveyFiles files = open();
        files.seen[1].add(said("12.5"));
        files.seen[2].add(denied("invalid tag"));
        EXPECT_EQ(files.save(), std::nullopt);
    }
    const SurveyFiles files = open(true);
    EXPECT_EQ(files.record(), record.string());
    EXPECT_EQ(files.seen.at(1).last, "12.5");
    EXPECT_EQ(files.seen.at(2).denied, "invalid tag");
}

TEST_F(SurveyFilesTest, ARecordByOneRuleIsNotContinuedByAnother)
{
    {
        auto files =
            SurveyFiles::open("unwinder by rule pno", table, {}, false, profile::MnemonicCells::fill);
        ASSERT_TRUE(files);
        files->seen[1].add(said("12.5"));
        EXPECT_EQ(files->save(), std::nullopt);
    }
    const auto files =
        SurveyFiles::open("unwinder by rule ac", table, {}, true, profile::MnemonicCells::fill);
    ASSERT_FALSE(files);
    EXPECT_THAT(files.error(), HasSubstr("'unwinder by rule pno', not of 'unwinder by rule ac'"));
}

TEST_F(SurveyFilesTest, WithoutResumeTheRecordBeginsAnewAndTheTableKeepsWhatWasSeen)
{
    {
        SurveyFiles files = open();
        files.seen[1].add(said("12.55"));
        EXPECT_EQ(files.save(), std::nullopt);
    }
    SurveyFiles files = open();
    EXPECT_TRUE(files.seen.empty());
    files.seen[1].add(said("-3."));
    EXPECT_EQ(files.save(), std::nullopt);
    EXPECT_THAT(content(table), HasSubstr("1,,INT,2,,,,,,,,no,-3,12.55\n"));
}

TEST_F(SurveyFilesTest, WhatIsConfirmedWhileTheSurveyRunsStays)
{
    SurveyFiles files = open();
    files.seen[1].add(said("12.5"));
    files.seen[2].add(said("1."));
    EXPECT_EQ(files.save(), std::nullopt);
    std::string text = content(table);
    text.replace(text.find("1,,INT,1,,,,,,,,no"), 18, "1,SPEED,INT,2,,,,,,,,yes");
    put(table, text);

    files.seen[1].add(said("99."));
    EXPECT_EQ(files.save(), std::nullopt);

    EXPECT_THAT(content(table), HasSubstr("1,SPEED,INT,2,,,,,,,,yes,12.5,12.5\n"));
    EXPECT_THAT(files.joined().waiting, ElementsAre(2));
    EXPECT_THAT(files.joined().added, ElementsAre(1, 2)) << "both are this survey's";
}

TEST_F(SurveyFilesTest, ANewTableBeginsWithTheRowsOfTheOneInForce)
{
    const auto in_force = folder.path() / "590plus.csv";
    put(in_force, "tag,name,type\n537,SEQ STATUS,WORD\n");

    EXPECT_EQ(open(false, in_force).rows_taken_over(), 1U);
    EXPECT_THAT(content(table), HasSubstr("537,SEQ STATUS,WORD"));
    EXPECT_EQ(open(false, in_force).rows_taken_over(), 0U) << "the table is there by now";
    EXPECT_EQ(content(in_force), "tag,name,type\n537,SEQ STATUS,WORD\n");
}

TEST_F(SurveyFilesTest, ATableInForceThatASpreadsheetHasSavedIsTakenOverToo)
{
    const auto in_force = folder.path() / "590plus.csv";
    put(in_force, "\xEF\xBB\xBFtag,name,type\r\n537,SEQ STATUS,WORD\r\n");

    EXPECT_EQ(open(false, in_force).rows_taken_over(), 1U);
    EXPECT_THAT(content(table), HasSubstr("537,SEQ STATUS,WORD"));
}

TEST_F(SurveyFilesTest, SayWhyTheRowsOfTheTableInForceAreMissing)
{
    const SurveyFiles none = open(false, folder.path() / "not-there.csv");
    EXPECT_THAT(none.not_taken_over(), HasSubstr("not-there.csv: the file cannot be read"));
    EXPECT_EQ(none.rows_taken_over(), 0U);
}

TEST_F(SurveyFilesTest, ATableThatCannotBeReadIsNotReplaced)
{
    const std::string large(std::size_t{1024} * 1024 + 1, 'x');
    put(table, large);

    EXPECT_THAT(SurveyFiles::open("unwinder", table, {}, false).error(),
                testing::AllOf(HasSubstr("cannot be read"), HasSubstr("larger than 1 MiB")));

    EXPECT_EQ(content(table).size(), large.size());
}

TEST_F(SurveyFilesTest, OfOneSurveyAreNotThoseOfAnotherAtTheSameTime)
{
    {
        SurveyFiles first = open();
        EXPECT_THAT(SurveyFiles::open("unwinder", table, {}, true).error(),
                    testing::AllOf(HasSubstr("another survey writes this file"), HasSubstr("--output")));
        first.seen[1].add(said("12.5"));
        EXPECT_EQ(first.save(), std::nullopt);
        EXPECT_THAT(SurveyFiles::open("unwinder", table, {}, true).error(), HasSubstr("another survey"))
            << "also when the file was written anew";
        EXPECT_TRUE(SurveyFiles::open("unwinder", folder.path() / "other.csv", {}, false));
    }
    EXPECT_EQ(open(true).seen.size(), 1U) << "its end gives them free";
}

TEST_F(SurveyFilesTest, AreWrittenWholeOrNotAtAll)
{
    SurveyFiles files = open();
    files.seen[1].add(said("12.5"));
    EXPECT_EQ(files.save(), std::nullopt);
    const std::string before = content(table);
    put(table, "no,table\n1,2\n");
    files.seen[2].add(said("1."));

    EXPECT_THAT(files.save().value_or(""), HasSubstr("no column tag"));

    EXPECT_EQ(content(table), "no,table\n1,2\n") << "what is no table is left alone";
    EXPECT_THAT(content(record), HasSubstr("\n2,")) << "what was read is kept";
    put(table, before);
    EXPECT_EQ(files.save(), std::nullopt);
    EXPECT_THAT(content(table), HasSubstr("\n2,"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder.path()}, {}), 2) << "no leftovers";
}

TEST_F(SurveyFilesTest, OfAnotherStationAreNotGoneOnWith)
{
    {
        SurveyFiles files = open();
        files.seen[1].add(said("12.5"));
        EXPECT_EQ(files.save(), std::nullopt);
    }
    EXPECT_THAT(SurveyFiles::open("rewinder", table, {}, true).error(),
                HasSubstr("the record of station 'unwinder', not of 'rewinder'"));
}

TEST_F(SurveyFilesTest, ThatAreLinksAreWrittenWhereTheyLead)
{
    namespace fs = std::filesystem;
    const TempFolder elsewhere;
    fs::create_symlink(elsewhere.path() / "t.csv", table); // leads to no file yet
    put(elsewhere.path() / "r.csv", "");
    fs::create_symlink(elsewhere.path() / "r.csv", folder.path() / "second");
    fs::create_symlink("second", record);

    SurveyFiles files = open();
    files.seen[1].add(said("12.5"));
    EXPECT_EQ(files.save(), std::nullopt);

    EXPECT_TRUE(fs::is_symlink(table));
    EXPECT_TRUE(fs::is_symlink(record));
    EXPECT_THAT(content(elsewhere.path() / "t.csv"), HasSubstr("\n1,"));
    EXPECT_THAT(content(elsewhere.path() / "r.csv"), HasSubstr("\n1,"));
}

TEST_F(SurveyFilesTest, KeepTheirPermissionsAndNewOnesHaveThoseOfTheUser)
{
    namespace fs = std::filesystem;
    const auto mode_of = [](const fs::path& file) { return fs::status(file).permissions(); };
    put(table, "tag\n");
    fs::permissions(table, fs::perms{0660});
    const mode_t before = ::umask(027);
    SurveyFiles files = open();
    files.seen[1].add(said("12.5"));
    EXPECT_EQ(files.save(), std::nullopt);
    ::umask(before);

    EXPECT_EQ(mode_of(table), fs::perms{0660});
    EXPECT_EQ(mode_of(record), fs::perms{0640});
}

TEST_F(SurveyFilesTest, SayAtOnceWhatIsWrong)
{
    EXPECT_THAT(SurveyFiles::open("unwinder", table, {}, true).error(),
                testing::AllOf(HasSubstr("cannot be read: No such file"), HasSubstr("leave out --resume")));
    EXPECT_THAT(SurveyFiles::open("unwinder", folder.path() / "none" / "t.csv", {}, false).error(),
                HasSubstr("cannot be written"));
    EXPECT_THAT(SurveyFiles::open("unwinder", "/dev/null", {}, false).error(),
                HasSubstr("not a regular file"));
    put(table, "name\nSPEED\n");
    EXPECT_THAT(SurveyFiles::open("unwinder", table, {}, false).error(), HasSubstr("no column tag"));
}

// ---------------------------------------------------------------- what is shown

TEST(SurveyProgressLine, SaysWhatWasAskedAndHowLongItTakes)
{
    dpctl::SurveyProgress p{412, 1612, 58, 354, 0, 0.256, seconds{65}, false};
    EXPECT_EQ(progress_line(p),
              "412 of 1612 tags asked: 58 answer, 354 denied, 0 silent; about 1 min 10 s left");
    EXPECT_EQ(progress_bar(p), "[#####---------------] " + progress_line(p));
    p.left = seconds{59};
    EXPECT_THAT(progress_line(p), HasSubstr("about 59 s left"));
    p.left = seconds{601};
    EXPECT_THAT(progress_line(p), HasSubstr("about 11 min left"));
    p.left = std::nullopt;
    EXPECT_THAT(progress_line(p), HasSubstr("the speed is not measured yet"));
    p.left = seconds{120};
    p.is_time_given = true;
    EXPECT_THAT(progress_line(p), HasSubstr("; 2 min left")) << "given, not estimated";
    p.waits_for_drive = true;
    EXPECT_THAT(progress_line(p), HasSubstr("0 silent; the drive does not answer, waiting for it"));
}

TEST(SurveyReportText, SaysWhatWaitsWhatWasDeniedAndWhatContradicts)
{
    dpctl::SurveyReport report{"unwinder", "unwinder.csv", "unwinder.survey.csv", 6, true, {}, {}};
    report.seen[1].add(said("12.5"));
    report.seen[2].add(denied("invalid tag"));
    report.seen[3].add(denied("invalid tag"));
    report.seen[4].add({});
    report.seen[5].add(denied("EOT, EE >04C8 (read of a write-only parameter)"));
    report.seen[6].add(said(">01"));
    report.joined = {
        "", {6}, {1, 6}, {"tag 55 (SPEED), line 2: its row says 1 decimal, the drive answers with 2"}};

    EXPECT_EQ(render_survey(report), lines(R"(
unwinder: 6 of 6 tags asked: 2 answer, 3 denied, 1 silent
denied (EOT, EE >04C8 (read of a write-only parameter)): 5
denied (invalid tag): 2, 3
silent: 4
unwinder.csv: 2 rows wait for confirmation, 1 of them new
The drive contradicts:
  tag 55 (SPEED), line 2: its row says 1 decimal, the drive answers with 2
Next: compare these rows with the drive's manual, above all the decimals, and set confirmed to yes.
)"));
    const Json json = survey_json(report);
    EXPECT_EQ(json["answering"], 2);
    EXPECT_EQ(json["denied"][1], Json::parse(R"({"reason":"invalid tag","tags":[2,3]})"));
    EXPECT_EQ(json["silent"], Json::parse("[4]"));
    EXPECT_EQ(json["waiting"], Json::parse("[1,6]"));
}

// ---------------------------------------------------------------- the program

class SurveyProgram : public testing::Test {
protected:
    std::vector<std::string> command(std::vector<std::string> more) const
    {
        std::vector<std::string> all{"--socket", daemon.socket(), "survey",
                                     "unwinder", "--output",      table.string()};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    FixtureDaemon daemon;
    TempFolder folder;
    const std::filesystem::path table = folder.path() / "t.csv";
};

TEST_F(SurveyProgram, AsksEveryTagWritesTheRowsAndReports)
{
    const Ran ran = dpctl(command({}));

    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_THAT(ran.out, HasSubstr("unwinder: 6 of 6 tags asked: 4 answer, 1 denied, 1 silent\n"));
    EXPECT_THAT(ran.out, HasSubstr("4 rows wait for confirmation, 4 of them new\n"));
    EXPECT_THAT(content(table), HasSubstr("\n1,,INT,1,,,,a1,,,,no,12.5,12.5\n"
                                          "4,,WORD,,,,,a4,,,,no,>1B0B,>1B0B\n"
                                          "5,,INT,0,,,,a5,,,,no,30,30\n"
                                          "9,,INT,0,,,,a9,,,,no,7,7\n"))
        << "tag 5 was Busy, then lost, and was asked again";
    EXPECT_THAT(content(folder.path() / "t.survey.csv"), HasSubstr("\n3,a3,0,3,0,")) << "silent: three times";
}

TEST_F(SurveyProgram, AsksOnlyTheTagsOfItsOptionsAndAsOftenAsTheySay)
{
    const Ran ran = dpctl(command({"--tags", "1,4-4", "--passes", "3", "--json"}));

    EXPECT_EQ(ran.exit, 0) << ran.err;
    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json["asked"], 2);
    EXPECT_EQ(json["complete"], true);
    EXPECT_THAT(content(folder.path() / "t.survey.csv"), HasSubstr("\n1,a1,3,0,0,"));
}

TEST_F(SurveyProgram, EndsAtCtrlCWithAllThatWasReadAndGoesOnFromThere)
{
    Dpctl running{command({"--tags", "1,2", "--for", "10m"})};
    ASSERT_TRUE(running.prints("2 tags to ask"));
    running.signal(SIGINT);
    const Ran ran = running.wait();
    EXPECT_THAT(ran.out, HasSubstr("unwinder: "));
    EXPECT_THAT(ran.err, HasSubstr("--resume"));
    EXPECT_EQ(ran.exit, 1);
    EXPECT_TRUE(std::filesystem::exists(table));

    const Ran resumed = dpctl(command({"--resume"}));
    EXPECT_EQ(resumed.exit, 0) << resumed.err;
    EXPECT_THAT(resumed.out, HasSubstr("6 of 6 tags asked"));
}

TEST_F(SurveyProgram, GoesOnUntilItsTimeIsOver)
{
    const Ran ran = dpctl(command({"--tags", "1", "--for", "1s"}));

    EXPECT_EQ(ran.exit, 0) << ran.err;
    const auto record = profile::read_record(content(folder.path() / "t.survey.csv"), "r", "unwinder");
    ASSERT_TRUE(record);
    EXPECT_GT(record->at(1).answers, 3U);
}

TEST_F(SurveyProgram, ShowsABarOnATerminal)
{
    Dpctl running{command({"--tags", "1,4", "--for", "2s"}), Dpctl::As::this_user, true};
    EXPECT_TRUE(running.prints("[###"));
    EXPECT_TRUE(running.prints("2 of 2 tags asked"));
    EXPECT_EQ(running.wait().exit, 0);
}

TEST_F(SurveyProgram, CountsOnlyTheTagsOfThisRunWhereTheRecordHasOthers)
{
    ASSERT_EQ(dpctl(command({"--tags", "1-2"})).exit, 0);
    Dpctl running{command({"--resume", "--tags", "4", "--for", "2s"}), Dpctl::As::this_user, true};
    EXPECT_TRUE(running.prints("] 1 of 1 tag asked: 1 answer, 0 denied, 0 silent;"));
    EXPECT_EQ(running.wait().exit, 0);
}

TEST_F(SurveyProgram, ATableThatBecomesNoneUnderItsHandsIsLeftAloneAndTheRecordKeepsWhatWasRead)
{
    Dpctl running{command({"--tags", "1,4", "--for", "1s"})};
    ASSERT_TRUE(running.prints("2 tags to ask"));
    put(table, "no,table\n1,2\n");

    const Ran ran = running.wait();

    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.err, testing::AllOf(HasSubstr("no column tag"), HasSubstr("Remove the cause"),
                                        HasSubstr("--resume")));
    EXPECT_EQ(content(table), "no,table\n1,2\n");
    EXPECT_THAT(content(folder.path() / "t.survey.csv"), HasSubstr("\n4,a4,"));
}

TEST_F(SurveyProgram, AContradictedRowIsNoSuccess)
{
    put(table, "tag,type,decimals\n1,INT,0\n");
    const Ran ran = dpctl(command({"--tags", "1"}));
    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.out, HasSubstr("its row says 0 decimals, the drive answers with 1"));
    EXPECT_EQ(content(table), "tag,type,decimals\n1,INT,0\n");
}

TEST_F(SurveyProgram, WrongArgumentsAreUsage)
{
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--tags", "5-1"},
                                                  {"--for", "soon"},
                                                  {"--passes", "0"},
                                                  {"--passes", "2", "--for", "1m"}})
        EXPECT_EQ(dpctl(command(wrong)).exit, 2) << wrong[0];
    EXPECT_FALSE(std::filesystem::exists(table));
}

TEST_F(SurveyProgram, SaysWhichStationsThereAre)
{
    const Ran ran = dpctl({"--socket", daemon.socket(), "survey", "other"});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_THAT(ran.err, HasSubstr("no station 'other'"));
}

} // namespace
} // namespace dpslave::test
