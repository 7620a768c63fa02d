// SPDX-License-Identifier: Apache-2.0
// `dpctl gsd` as it is called in a shell: exit codes, what is printed, files whole or not at all.
#include "dpctl/cli/cli.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "gsd/second_hand.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dpslave {
namespace {

using test::content_of;
using test::kSource;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

struct Ran {
    int exit = -1;
    std::string out, err;
};

Ran gsd_command(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "gsd");
    std::ostringstream out, err;
    dpctl::Terminal terminal{out, err};
    const int exit = dpctl::run(arguments, terminal);
    return {exit, out.str(), err.str()};
}

/// `gsd make` with the profiles of this tree.
Ran make(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), {"make", "--profiles", (kSource / "config/profiles").string()});
    return gsd_command(std::move(arguments));
}

std::vector<std::string> names_in(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{folder})
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

TEST(GsdCheckCommand, PrintsFindingsAsCompilersDoAndEndsWithASummary)
{
    const std::string file = kSource / "gsd/manual/620/EURO0533.GSD";
    const Ran ran = gsd_command({"check", file, "--profiles", kSource / "config/profiles"});
    EXPECT_EQ(ran.exit, dpctl::kFine) << "warnings alone are no refusal";
    EXPECT_THAT(ran.out,
                AllOf(StartsWith(file + ": warning: GSD_Revision is missing"),
                      HasSubstr(file + ":37: warning: Min_Slave_Intervall is here a second time"),
                      HasSubstr(file + ": 0 errors, 3 warnings\n"),
                      HasSubstr(file + ": judged as a file for 620: it fits: its modules are taken")));
    EXPECT_EQ(gsd_command({"check", "--strict", file}).exit, dpctl::kNo);
}

TEST(GsdCheckCommand, PassesAMadeFile)
{
    const std::string file = kSource / "gsd/605/605_1649.GSD";
    const Ran ran = gsd_command({"check", "--strict", file, "--profiles", kSource / "config/profiles"});
    EXPECT_EQ(ran.exit, dpctl::kFine);
    EXPECT_THAT(ran.out, StartsWith(file + ": no errors and no warnings\n" + file +
                                    ": judged as a file for 605: it fits"));
}

TEST(GsdCheckCommand, RefusesWhatCannotBeReadOrIsTooLong)
{
    const test::Folder folder;
    EXPECT_THAT(gsd_command({"check", folder.path() / "none.gsd"}).err, HasSubstr("none.gsd cannot be read"));
    EXPECT_EQ(gsd_command({"check", folder.path() / "none.gsd"}).exit, dpctl::kNo);
    EXPECT_EQ(gsd_command({"check", folder.path()}).exit, dpctl::kNo) << "a folder";
    const auto large = folder.write("large.gsd", std::string(1024 * 1024 + 1, ' '));
    EXPECT_THAT(gsd_command({"check", large}).err, HasSubstr("larger than 1 MiB"));
}

TEST(GsdCheckCommand, SaysOfAnotherKindOfFileOnlyThatItIsNoGsdFile)
{
    const Ran ran = gsd_command({"check", (kSource / "README.md").string()});
    EXPECT_EQ(ran.exit, 1);
    EXPECT_THAT(ran.out, HasSubstr("this is no GSD file"));
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("warning:")));
}

TEST(GsdCheckCommand, PrintsNoControlCharactersOfAFile)
{
    const test::Folder folder;
    const auto file = folder.write("EXMP0001.GSD", "#Profibus_DP\r\nCol\x1B[31mour\xFC = 1\r\n");
    const std::string out = gsd_command({"check", file}).out;
    EXPECT_EQ(out.find('\x1B'), std::string::npos);
    EXPECT_THAT(out, HasSubstr("\"Col\\x1B[31mour\xC3\xBC\"")) << "Latin-1 shown in UTF-8";
}

TEST(GsdCheckCommand, AsksTheDaemonForTheStationAndJudgesTheFileAgainstIt)
{
    const test::FixtureDaemon daemon;
    const std::string profiles = kSource / "config/profiles";
    const std::string file = kSource / "gsd/605/605_1649.GSD";
    const auto check = [&](const std::string& station, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"check",         file,         "--station", station, "--socket",
                                           daemon.socket(), "--profiles", profiles};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return gsd_command(arguments);
    };
    const Ran ran = check("unwinder");
    EXPECT_EQ(ran.exit, dpctl::kNo) << ran.err;
    EXPECT_THAT(ran.out, AllOf(HasSubstr("unwinder: line 8: error: Set_Prm would be refused: the "
                                         "Ident_Number is that of another device, octet "
                                         "5, expected Ident_Number 0x0533, got 0x1649"),
                               HasSubstr("unwinder: warning: a single reply took ")));
    EXPECT_THAT(ran.err, HasSubstr("Run dpctl tune: it says which MaxTsdr this machine needs.\n"));
    EXPECT_THAT(check("unwinder", {"--json"}).out, HasSubstr("\"code\":\"prm_ident\""));
    EXPECT_EQ(check("nobody").exit, dpctl::kUsage);
    EXPECT_EQ(gsd_command({"check", file, "--station", "unwinder", "--socket", "/nonexistent"}).exit,
              dpctl::kNoDaemon);
}

TEST(GsdMakeCommand, PrintsTheFileWithoutOutput)
{
    const Ran ran = make({"--profile", "590"});
    EXPECT_EQ(ran.exit, dpctl::kFine);
    EXPECT_EQ(ran.out, content_of(kSource / "gsd/590/590_0533.GSD"));
    EXPECT_EQ(ran.err, "");
}

TEST(GsdMakeCommand, WritesAWholeFileAndNothingBesides)
{
    const test::Folder folder;
    const auto file = folder.path() / "UNWI0533.GSD";
    const Ran ran = make({"--profile", "590", "--in", "55,57", "--out", "56", "--demand", "--output", file});
    EXPECT_EQ(ran.exit, dpctl::kFine) << ran.err;
    EXPECT_EQ(
        ran.out + ran.err,
        "warning: tag 56 is in no tag table, so it may be read only: look into the manual of the device.\n");
    EXPECT_THAT(names_in(folder.path()), ElementsAre("UNWI0533.GSD"));
    EXPECT_THAT(test::second_hand(content_of(file)).cfg(), ElementsAre(0x73, 0x50, 0x50, 0x60));
    const mode_t mask = ::umask(0);
    ::umask(mask);
    struct stat found {};
    ASSERT_EQ(::stat(file.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0666 & ~mask) << "readable as any other file";
}

TEST(GsdMakeCommand, LeavesAFileAloneThatIsThereUnlessItIsForced)
{
    const test::Folder folder;
    const auto file = folder.write("MINE0533.GSD", "mine");
    const Ran refused = make({"--profile", "590", "--output", file});
    EXPECT_EQ(refused.exit, dpctl::kNo);
    EXPECT_THAT(refused.err, HasSubstr("it exists already: choose another name, or replace it with --force"));
    EXPECT_EQ(content_of(file), "mine");
    EXPECT_EQ(make({"--profile", "590", "--force", "--output", file}).exit, dpctl::kFine);
    EXPECT_EQ(content_of(file), content_of(kSource / "gsd/590/590_0533.GSD"));
    EXPECT_THAT(names_in(folder.path()), ElementsAre("MINE0533.GSD"));
}

TEST(GsdMakeCommand, WritesNothingWhenItRefuses)
{
    const test::Folder folder;
    const auto file = folder.path() / "X.GSD";
    const Ran ran = make({"--profile", "590", "--in", "4000", "--output", file});
    EXPECT_EQ(ran.exit, dpctl::kNo);
    EXPECT_THAT(
        ran.err,
        HasSubstr("a tag in User_Prm_Data is too large, octet 8, expected a tag up to 2047, got 4000"));
    EXPECT_THAT(names_in(folder.path()), IsEmpty());
    EXPECT_EQ(make({"--profile", "590", "--output", folder.path() / "no folder" / "X.GSD"}).exit, dpctl::kNo);
}

TEST(GsdMakeCommand, WarnsOfLengthsThatSomeMastersCannotTake)
{
    const Ran ran = make({"--profile", "605", "--in", "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17"});
    EXPECT_EQ(ran.exit, dpctl::kFine);
    EXPECT_THAT(ran.err, HasSubstr("warning: 34 input octets are more than 32 octets"));
}

TEST(GsdMakeCommand, WarnsOfAFileNameThatToolsDoNotFind)
{
    const test::Folder folder;
    const Ran ran =
        make({"--profile", "2408f", "--ident", "0x1234", "--output", folder.path() / "EURO2400.GSD"});
    EXPECT_EQ(ran.exit, dpctl::kFine);
    EXPECT_THAT(ran.err, HasSubstr("does not end in 1234, the Ident_Number"));
}

TEST(GsdMakeCommand, TakesAMappingFileAndLetsTheCommandLineGoBefore)
{
    const std::string mapping = kSource / "gsd/mappings/gain-scheduling.toml";
    const auto file = test::second_hand(make({"--mapping", mapping, "--ident", "0x1234"}).out);
    EXPECT_THAT(file.octets("User_Prm_Data"), ElementsAre(0, 1, 0, 6, 0, 8, 0, 9, 0, 18, 0, 17));
    const auto other =
        test::second_hand(make({"--mapping", mapping, "--ident", "0x1234", "--in", "0x5,75"}).out);
    EXPECT_EQ(other.number("Ident_Number"), 0x1234);
    EXPECT_THAT(other.octets("User_Prm_Data"), ElementsAre(0, 5, 0, 75, 0, 6, 0, 8, 0, 9, 0, 18, 0, 17));
    const test::Folder folder;
    const auto bad = folder.write("bad.toml", "profile = 5\n");
    EXPECT_THAT(make({"--mapping", bad}).err, StartsWith(bad.string() + ":1:"));
}

TEST(GsdMakeCommand, TakesInputsAndOutputsInAnyOrderAsOneList)
{
    const Ran ran = make({"--profile", "605", "--order", "out:3,in:1,in-out:9,out:2"});
    EXPECT_EQ(ran.exit, dpctl::kFine) << ran.err;
    EXPECT_THAT(test::second_hand(ran.out).cfg(), ElementsAre(0x60, 0x50, 0x70, 0x60));
    EXPECT_THAT(make({"--profile", "605", "--order", "in:1,2"}).err, HasSubstr("--order 2: write in:1"));
    EXPECT_EQ(make({"--profile", "605", "--order", "in:1", "--out", "2"}).exit, dpctl::kUsage);

    const test::Folder folder;
    const auto mapping = folder.write("m.toml", "profile = \"605\"\nlist = [\"out:3\", \"in:1\"]\n");
    EXPECT_THAT(test::second_hand(make({"--mapping", mapping, "--in", "7"}).out).octets("User_Prm_Data"),
                ElementsAre(0, 0, 0, 0, 7, 0, 3))
        << "the inputs of the command line instead of those of the list";
}

TEST(GsdMakeCommand, MakesFilesForEveryProfileWhoseIdentTheSiteMustSay)
{
    for (const char* name : {"584sv", "590plus", "690plus", "2408f", "2404f"}) {
        const Ran refused = make({"--profile", name});
        EXPECT_EQ(refused.exit, dpctl::kNo) << name;
        EXPECT_THAT(refused.err, HasSubstr("\nGive the Ident_Number with --ident.\n")) << name;
        const Ran ran = make({"--profile", name, "--ident", "0x7EA5"});
        EXPECT_EQ(ran.exit, dpctl::kFine) << name;
        EXPECT_THAT(test::findings_of(ran.out, gsd::Reading::strict, "SITE7EA5.GSD"), IsEmpty()) << name;
    }
}

TEST(GsdMakeCommand, NamesTheProfilesThatThereAre)
{
    const Ran ran = make({"--profile", "591"});
    EXPECT_EQ(ran.exit, dpctl::kNo);
    EXPECT_THAT(ran.err, HasSubstr("the profiles there: 2404f, 2408f, 584s, 584sv, 590,"));
    EXPECT_EQ(make({"--profile", "../profiles/590"}).exit, dpctl::kNo);
    EXPECT_EQ(make({}).exit, dpctl::kUsage);
}

/// A new device is data: a profile and a tag table in a folder of their own, and no line of C++.
TEST(GsdMakeCommand, MakesTheFileOfADeviceThatTheSiteAdded)
{
    const test::Folder folder;
    std::string profile = content_of(kSource / "config/profiles/605.toml");
    profile = test::with(profile, "ident = 0x1649", "ident = 0x1D01");
    profile = test::with(profile, "\"SSD Drives 605\"", "\"Line shaft 7\"");
    profile = test::with(profile, "max_parameters         = 30", "max_parameters         = 4");
    folder.write("profiles/mine.toml", profile);
    std::filesystem::copy(kSource / "config/tags", folder.path() / "tags");
    const Ran ran = gsd_command({"make", "--profiles", folder.path() / "profiles", "--profile", "mine"});
    ASSERT_EQ(ran.exit, dpctl::kFine) << ran.err;
    const auto file = test::second_hand(ran.out);
    EXPECT_EQ(file.number("Ident_Number"), 0x1D01);
    EXPECT_EQ(file.keys.at("Model_Name"), "\"Line shaft 7\"");
    EXPECT_EQ(file.number("Max_Module"), 5);
    EXPECT_THAT(test::findings_of(ran.out, gsd::Reading::strict, "MINE1D01.GSD"), IsEmpty());
}

TEST(GsdMakeCommand, RefusesNumbersThatAreNone)
{
    for (const char* text : {"0", "x", "70000", "-1", "1.5", "0x", "5;6"})
        EXPECT_EQ(make({"--profile", "590", std::string{"--in="} + text}).exit, dpctl::kUsage) << text;
    EXPECT_EQ(make({"--profile", "590", "--ident", "0x10000"}).exit, dpctl::kUsage);
    EXPECT_EQ(make({"--profile", "590", "--max-tsdr", "10"}).exit, dpctl::kUsage);
}

TEST(GsdShowCommand, PrintsTheMapWithNamesOctetsAndWords)
{
    const test::Folder folder;
    const auto file = folder.write("SITE7EA5.GSD", make({"--profile", "2408f", "--ident", "0x7EA5"}).out);
    const Ran ran =
        gsd_command({"show", file, "--profile", "2408f", "--profiles", kSource / "config/profiles"});
    EXPECT_EQ(ran.exit, dpctl::kFine) << ran.err;
    EXPECT_EQ(ran.out, "EUROTHERM CONTROLS, 2408f/2404f, Ident_Number 0x7EA5\n"
                       "Standard parameter mapping\n"
                       "\n"
                       "Inputs, from the slave to the master: 8 octets, 4 words\n"
                       "  octets    word    tag    value\n"
                       "  0-1       1       1      Process variable\n"
                       "  2-3       2       5      Working setpoint\n"
                       "  4-5       3       3      Output power %\n"
                       "  6-7       4       75     Summary output status word\n"
                       "\n"
                       "Outputs, from the master to the slave: 8 octets, 4 words\n"
                       "  octets    word    tag    value\n"
                       "  0-1       1       24     Setpoint 1\n"
                       "  2-3       2       25     Setpoint 2\n"
                       "  4-5       3       15     Select setpoint\n"
                       "  6-7       4       274    Acknowledge all alarms\n"
                       "\n"
                       "octets: places in the Data_Exchange telegram, counted from 0\n"
                       "word: counted from 1 after Demand Data; D1 to D4 are Demand Data\n");
}

TEST(GsdShowCommand, OfADriveShowsNoExtendedTagsAndCountsDemandDataByItself)
{
    const test::Folder folder;
    const auto file = folder.write("UNWI0533.GSD", make({"--profile", "590", "--in", "55", "--demand"}).out);
    const Ran ran =
        gsd_command({"show", file, "--profile", "590", "--profiles", kSource / "config/profiles"});
    EXPECT_EQ(ran.out.find("extended tag"), std::string::npos) << ran.out;
    EXPECT_THAT(ran.out, AllOf(HasSubstr("  0-1       D1      -      Demand Data: answer and tag"),
                               HasSubstr("  2-3       D2      -      Demand Data: reserved"),
                               HasSubstr("  8-9       1       55 ")));
}

TEST(GsdShowCommand, NamesTheParametersOfATableOfTheUser)
{
    const test::Folder folder;
    const auto table = folder.write("mine.csv", "tag,name,type,decimals\n55,Dancer position,INT,2\n");
    const Ran made = make({"--profile", "590", "--table", table, "--in", "55"});
    EXPECT_EQ(made.exit, dpctl::kFine) << made.err;
    const auto file = folder.write("UNWI0533.GSD", made.out);
    EXPECT_THAT(gsd_command({"show", file, "--table", table}).out, HasSubstr("Dancer position"));
    EXPECT_EQ(gsd_command({"show", file, "--table", kSource / "none.csv"}).exit, dpctl::kNo);
}

TEST(GsdShowCommand, ListsTheModulesWhereThereIsNoMapYet)
{
    const Ran ran = gsd_command({"show", kSource / "gsd/manual/584s-590/EURO0533.GSD"});
    EXPECT_EQ(ran.exit, dpctl::kFine);
    EXPECT_THAT(ran.out, AllOf(HasSubstr("13 at most"),
                               HasSubstr("Process-Data-Input                 2 octets in   0 out")));
}

TEST(GsdShowCommand, RefusesWhatIsNoGsd)
{
    EXPECT_EQ(gsd_command({"show", kSource / "README.md"}).exit, dpctl::kNo);
}

TEST(GsdTypesCommand, WritesAllFiveOrNone)
{
    const test::Folder folder;
    EXPECT_EQ(gsd_command({"types", "--output", folder.path()}).exit, dpctl::kFine);
    EXPECT_THAT(names_in(folder.path()),
                ElementsAre("EU0533TD.200", "EU0533TE.200", "EU0533TF.200", "EU0533TI.200", "EU0533TS.200"));
    EXPECT_EQ(content_of(folder.path() / "EU0533TD.200"), content_of(kSource / "gsd/et200/EU0533TD.200"));

    std::filesystem::remove(folder.path() / "EU0533TE.200");
    const Ran again = gsd_command({"types", "--brief", "--output", folder.path()});
    EXPECT_EQ(again.exit, dpctl::kNo);
    EXPECT_THAT(again.err, HasSubstr("so no file is written"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "EU0533TE.200"));

    EXPECT_EQ(gsd_command({"types", "--brief", "--force", "--output", folder.path()}).exit, dpctl::kFine);
    EXPECT_THAT(content_of(folder.path() / "EU0533TF.200"), HasSubstr("\r\nEURO 584/590/620 ;\r\n"));
    EXPECT_EQ(gsd_command({"types", "--output", folder.path() / "none"}).exit, dpctl::kNo);
}

TEST(GsdCommand, PrintsTheReplyOfThePageAsJson)
{
    const std::string file = kSource / "gsd/590/590_0533.GSD";
    const std::string profiles = kSource / "config/profiles";
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"check", file},
                                               {"show", file, "--profiles", profiles},
                                               {"import", file, "--profiles", profiles},
                                               {"diff", file, file},
                                               {"make", "--profile", "590", "--profiles", profiles},
                                               {"make", "--in", "x"},
                                               {"check", "none.gsd"},
                                               {"types", "--output", "no folder"}}) {
        const Ran text = gsd_command(arguments);
        std::vector<std::string> with_json = arguments;
        with_json.emplace_back("--json");
        const Ran ran = gsd_command(with_json);
        const auto reply = dpctl::Json::parse(ran.out, nullptr, false);
        ASSERT_TRUE(reply.is_object()) << ran.out;
        EXPECT_EQ(reply["exit"], text.exit);
        EXPECT_EQ(ran.exit, text.exit);
        EXPECT_EQ(ran.err, "");
    }
    std::ostringstream out, err;
    dpctl::Terminal terminal{out, err};
    EXPECT_EQ(dpctl::run({"--json", "gsd", "check", file}, terminal), dpctl::kFine);
    EXPECT_THAT(out.str(), HasSubstr("\"findings\":[]"));
}

TEST(GsdImportCommand, WritesTheMappingThatMakesTheFileAgain)
{
    const test::Folder folder;
    const std::string profiles = kSource / "config/profiles";
    const std::string first = make({"--profile", "605", "--order", "out:3,in:1,in-out:9"}).out;
    const auto file = folder.write("SITE1649.GSD", first);
    const auto mapping = folder.path() / "site.toml";
    const Ran ran = gsd_command({"import", file, "--profiles", profiles, "--output", mapping});
    EXPECT_EQ(ran.exit, dpctl::kFine) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, AllOf(HasSubstr("tag 3 is in no tag table"), Not(HasSubstr("gets lost"))));
    EXPECT_EQ(make({"--mapping", mapping}).out, first);
    EXPECT_EQ(gsd_command({"import", file, "--profiles", profiles, "--output", mapping}).exit, dpctl::kNo)
        << "the mapping is there already";
    EXPECT_THAT(gsd_command({"import", file, "--profiles", profiles}).out, StartsWith("profile = \"605\"\n"));
}

TEST(GsdImportCommand, KeepsTheTableOfTheUserInTheMappingWhichMakesTheFileAgain)
{
    const test::Folder folder;
    const std::string profiles = kSource / "config/profiles";
    const auto table = folder.write("mine.csv", "tag,name,type\n55,Z\xFCge,INT\n"); // in ISO 8859-1
    const std::string first = make({"--profile", "590", "--table", table, "--in", "55"}).out;
    ASSERT_THAT(first, HasSubstr("; 1 in tag 55 Z\xFCge\r\n"));
    const auto file = folder.write("UNWI0533.GSD", first);
    const auto mapping = folder.path() / "unwinder.toml";
    const Ran ran = gsd_command(
        {"import", file, "--profile", "590", "--profiles", profiles, "--table", table, "--output", mapping});
    EXPECT_EQ(ran.exit, dpctl::kFine) << ran.err;
    EXPECT_EQ(ran.err, "");
    std::filesystem::remove(table);
    EXPECT_EQ(make({"--mapping", mapping}).out, first);

    const auto other = folder.write("other.csv", "tag,name\n55,Speed\n");
    EXPECT_THAT(make({"--mapping", mapping, "--table", other}).out, HasSubstr("; 1 in tag 55 Speed\r\n"))
        << "the table of the command line goes before that of the mapping";
    EXPECT_THAT(gsd_command({"import", file, "--profile", "590", "--profiles", profiles}).err,
                HasSubstr("name of tag 55 = Z\xC3\xBCge gets lost"));
}

TEST(GsdImportCommand, AsksForTheProfileWhereTheFileDoesNotSayIt)
{
    const Ran ran = gsd_command(
        {"import", kSource / "gsd/manual/584s-590/EURO0533.GSD", "--profiles", kSource / "config/profiles"});
    EXPECT_EQ(ran.exit, dpctl::kNo);
    EXPECT_THAT(ran.err, HasSubstr("Name the profile, one of 584s, 590."));
}

TEST(GsdDiffCommand, PrintsMeaningAndLines)
{
    const test::Folder folder;
    const auto left = folder.write("L.GSD", make({"--profile", "590", "--in", "55"}).out);
    const auto right = folder.write("R.GSD", make({"--profile", "590", "--in", "57"}).out);
    const Ran ran =
        gsd_command({"diff", left, right, "--profile", "590", "--profiles", kSource / "config/profiles"});
    EXPECT_EQ(ran.exit, dpctl::kNo);
    EXPECT_THAT(ran.out, AllOf(StartsWith("Set_Prm: 00 37 "), HasSubstr("The files say different things.\n"),
                               HasSubstr("\n- "), HasSubstr("\n+ ")));
    EXPECT_EQ(gsd_command({"diff", left, left}).out, "Both files say the same.\n");
    EXPECT_EQ(gsd_command({"diff", left, folder.path() / "none"}).exit, dpctl::kNo);
}

TEST(GsdCommand, NeedsASubcommandAndHelpsWithEach)
{
    EXPECT_EQ(gsd_command({}).exit, dpctl::kUsage);
    for (const char* command : {"check", "show", "make", "import", "diff", "configure", "types"}) {
        const Ran help = gsd_command({command, "--help"});
        EXPECT_EQ(help.exit, dpctl::kFine) << command;
        EXPECT_THAT(help.out, HasSubstr("Exit status: 1 a file is faulty; all others: as in dpctl --help."))
            << command;
    }
}

} // namespace
} // namespace dpslave
