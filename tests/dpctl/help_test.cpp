// SPDX-License-Identifier: Apache-2.0
// The command line of dpctl: usage, --help, --version. No daemon is asked.
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

namespace dpslave::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class DpctlUsage : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(DpctlUsage, EndsWith2AndAHint)
{
    const Ran ran = dpctl(GetParam());

    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("--help"));
}

INSTANTIATE_TEST_SUITE_P(
    All, DpctlUsage,
    testing::Values(
        std::vector<std::string>{"explode"}, std::vector<std::string>{"explode", "--help"},
        std::vector<std::string>{"status", "--loud"}, std::vector<std::string>{"counters", "extra"},
        std::vector<std::string>{"status", "5", "6"}, std::vector<std::string>{"read"},
        std::vector<std::string>{"read", "-1"}, std::vector<std::string>{"read", "65536"},
        std::vector<std::string>{"read", "--every", "1ms", "7"},
        std::vector<std::string>{"top", "--every", "soon"},
        std::vector<std::string>{"read", "--every", "1s", "--names"}, std::vector<std::string>{"write", "56"},
        std::vector<std::string>{"write", "56", "1", "2"}, std::vector<std::string>{"tec"},
        std::vector<std::string>{"tec", "set", "TYPE"}, std::vector<std::string>{"tec", "5"},
        std::vector<std::string>{"hex"}, std::vector<std::string>{"status", "--quiet"},
        std::vector<std::string>{"status", "--with-drive"}, std::vector<std::string>{"status", "--wait"},
        std::vector<std::string>{"status", "--wait", "-1"},
        std::vector<std::string>{"status", "--wait", "1", "--follow"}, std::vector<std::string>{"decode"},
        std::vector<std::string>{"tag", "7", "--table", "x.csv", "--profile", "590"},
        std::vector<std::string>{"identify"}, std::vector<std::string>{"identify", "x", "--baud", "1"},
        std::vector<std::string>{"identify", "x", "--format", "9N1"},
        std::vector<std::string>{"identify", "x", "--unit", "0x1"},
        std::vector<std::string>{"identify", "x", "--protocol", "profibus"},
        std::vector<std::string>{"identify", "x", "--rule", "590"},
        std::vector<std::string>{"identify", "x", "--tags", "5-1"},
        std::vector<std::string>{"identify", "x", "--direction", "gpio", "--gpio-chip", "c"},
        std::vector<std::string>{"identify", "x", "--gpio-line", "17"},
        std::vector<std::string>{"identify", "x", "--gpio-active-low"},
        std::vector<std::string>{"status", "--timeout", "0"},
        std::vector<std::string>{"status", "--socket"}));

TEST(DpctlHelp, SuggestsTheCommandThatIsNearest)
{
    EXPECT_THAT(dpctl({"stauts"}).err, HasSubstr("there is no command 'stauts'; did you mean 'status'?"));
    EXPECT_THAT(dpctl({"gsd", "chek", "x"}).err, HasSubstr("did you mean 'check'?"));
    EXPECT_THAT(dpctl({"--json", "docter"}).err, HasSubstr("did you mean 'doctor'?"));
    EXPECT_THAT(dpctl({"survy"}).err, HasSubstr("did you mean 'survey'?"));
    EXPECT_EQ(dpctl({"foo"}).err,
              "dpctl: there is no command 'foo'\nRun with --help for more information.\n");
    EXPECT_THAT(dpctl({"foo"}).err, Not(HasSubstr("did you mean"))) << "io is not near to it";
    EXPECT_THAT(dpctl({"entirely-else"}).err, Not(HasSubstr("did you mean")));
    EXPECT_THAT(dpctl({"status", "--nonsense"}).err, Not(HasSubstr("did you mean")));
    EXPECT_EQ(dpctl({"stauts"}).exit, 2);
}

TEST(DpctlHelp, PrintsTheVersion)
{
    EXPECT_EQ(dpctl({"--version"}).out, "dpctl " DPSLAVE_VERSION "\n");
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"status", "--version"},
                                               {"read", "--version"},
                                               {"gsd", "--version"},
                                               {"gsd", "check", "--version"},
                                               {"tec", "set", "--version"}}) {
        EXPECT_EQ(dpctl(words).out, "dpctl " DPSLAVE_VERSION "\n") << words.front();
        EXPECT_EQ(dpctl(words).exit, 0) << words.front();
    }
    EXPECT_EQ(dpctl({"--version"}).exit, 0);
}

TEST(DpctlHelp, ShowsExitCodesAndWhereTheSchemaIs)
{
    const Ran ran = dpctl({"--help"});

    EXPECT_EQ(ran.exit, 0);
    for (const char* line :
         {"\n  0  success, or the answer is yes\n",
          "\n  1  the answer is no, or an input or a reply is faulty\n",
          "\n  2  wrong usage, or the command line names what does not exist\n", "\n  3  no daemon\n",
          "\n  4  no answer in time\n", "\n  5  the daemon or the drive refused\n"})
        EXPECT_THAT(ran.out, HasSubstr(line));
    EXPECT_THAT(ran.out, HasSubstr("org.dpslaved.Control.varlink"));
}

TEST(DpctlHelp, HasACommandOfEachKindUnderItsHeading)
{
    const std::string all = dpctl({"--help"}).out;
    std::size_t at = 0;
    for (const char* line :
         {"\nLook:\n",  "\n  status ",   "\n  show ",   "\n  io ",        "\n  diag ",    "\n  counters ",
          "\n  read ",  "\n  bus ",      "\n  doctor ", "\n  tune ",      "\n  version ", "\nWatch:\n",
          "\n  trace ", "\n  top ",      "\n  events ", "\n  plot ",      "\n  metrics ", "\nOperate:\n",
          "\n  write ", "\n  tec ",      "\n  survey ", "\n  log-level ", "\n  reload ",  "\nOffline:\n",
          "\n  tag ",   "\n  identify ", "\n  hex ",    "\n  decode ",    "\n  gsd "}) {
        const std::size_t found = all.find(line, at > 0 ? at - 1 : 0);
        ASSERT_NE(found, std::string::npos) << line;
        at = found + std::string_view{line}.size();
    }
}

class DpctlOwnHelp : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(DpctlOwnHelp, SaysWhatNoMeansAndWhatJsonPrintsIn80Columns)
{
    const auto& [command, meaning] = GetParam();

    const std::string own = dpctl({command, "--help"}).out;

    EXPECT_THAT(own, HasSubstr("\nExit status: " + std::string{meaning}));
    EXPECT_THAT(own, HasSubstr("--json prints "));
    std::istringstream lines{own};
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

constexpr const char* kAsAll = "as in dpctl --help.\n";
INSTANTIATE_TEST_SUITE_P(
    All, DpctlOwnHelp,
    testing::Values(std::pair{"status", "with --wait 0 in exchange, 1 not in exchange; all others: as in\n"},
                    std::pair{"show", kAsAll}, std::pair{"io", kAsAll}, std::pair{"diag", kAsAll},
                    std::pair{"counters", kAsAll}, std::pair{"bus", kAsAll}, std::pair{"read", kAsAll},
                    std::pair{"events", kAsAll}, std::pair{"log-level", kAsAll}, std::pair{"tec", kAsAll},
                    std::pair{"tag", kAsAll}, std::pair{"hex", kAsAll}, std::pair{"decode", kAsAll},
                    std::pair{"write", "1 also if you answered no; all others: as in dpctl --help.\n"},
                    std::pair{"top", "0 also after q and Ctrl-C; "},
                    std::pair{"trace", "1 also if --stop-on was not met; "},
                    std::pair{"doctor", "0 all is well, 1 something was found; "},
                    std::pair{"survey", "0 complete, 1 not complete; "},
                    std::pair{"metrics", "1 also if the file cannot be written; "},
                    std::pair{"plot", "1 there are no values of a tag; "},
                    std::pair{"reload", "0 applied, or can be; 1 the configuration is faulty, or you"},
                    std::pair{"tune", "1 the rate of the bus cannot be held or something must be"},
                    std::pair{"version", "0 also without a daemon, 3 this user may not open the socket; "},
                    std::pair{"identify", "0 something answers, 1 nothing answered, or the port cannot be"}),
    [](const auto& row) {
        std::string name{row.param.first};
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

TEST(DpctlHelp, HasNoSentenceOfTheParser)
{
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"write", "56"},
                                               {"status", "--timeout"},
                                               {"hex"},
                                               {"status", "--quiet"},
                                               {"status", "--json=5"},
                                               {"status", "--timeout", "1", "--timeout", "2"},
                                               {"decode", "--as", "zzz", "00"},
                                               {"tec"},
                                               {"status", "--servise"},
                                               {"status", "5", "6"},
                                               {"status", "5", "--station", "6"}}) {
        const std::string err = dpctl(words).err;
        EXPECT_THAT(err, StartsWith("dpctl: "));
        for (const char* theirs : {"required", "requires", "excludes ", "expected", "convert", "Could not",
                                   "option(s)", "subcommand", "argument", "ERROR", "TEXT"})
            EXPECT_THAT(err, Not(HasSubstr(theirs))) << words.front();
    }
}

TEST(DpctlHelp, SuggestsTheOptionThatIsNearest)
{
    EXPECT_THAT(dpctl({"trace", "--servise=diag"}).err,
                HasSubstr("there is no option '--servise'; did you mean '--service'?"));
    EXPECT_THAT(dpctl({"status", "--wiht-drive"}).err, HasSubstr("did you mean '--with-drive'?"));
    EXPECT_THAT(dpctl({"read", "7", "--sockt", "x"}).err, HasSubstr("did you mean '--socket'?"));
}

TEST(DpctlHelp, RefusesWhatIsOutsideOfAClosedSetWithTheSet)
{
    EXPECT_THAT(dpctl({"decode", "--as", "zzz", "00"}).err,
                HasSubstr("--as: \"zzz\": write \"prm\", \"cfg\" or \"diag\""));
    EXPECT_THAT(dpctl({"log-level", "loud"}).err, HasSubstr("\"loud\": write \"debug\" or \"info\""));
    EXPECT_THAT(dpctl({"trace", "--service", "zzz"}).err,
                AllOf(HasSubstr("no service has this in its name"), HasSubstr("Set_Prm, Chk_Cfg")));
}

TEST(DpctlHelp, SaysWhereTheFormOfJsonIsAndShowsExamplesWhereNoDaemonIsNeeded)
{
    for (const char* subcommand : {"tag", "identify", "hex", "decode"}) {
        const std::string own = dpctl({subcommand, "--help"}).out;
        EXPECT_THAT(own, HasSubstr("--json prints a form of its own: see JSON in dpctl(1).\n"));
        EXPECT_THAT(own, HasSubstr(std::string{"Examples:\n  dpctl "} + subcommand));
    }
}

} // namespace
} // namespace dpslave::test
