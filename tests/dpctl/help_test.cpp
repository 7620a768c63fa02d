// SPDX-License-Identifier: Apache-2.0
// The command line of dpctl: usage, --help, --version. No daemon is asked.
#include "dpctl_bench.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::Not;

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
        std::vector<std::string>{}, std::vector<std::string>{"explode"},
        std::vector<std::string>{"status", "--loud"}, std::vector<std::string>{"counters", "extra"},
        std::vector<std::string>{"status", "5", "6"}, std::vector<std::string>{"read"},
        std::vector<std::string>{"read", "-1"}, std::vector<std::string>{"read", "65536"},
        std::vector<std::string>{"read", "--every", "1ms", "7"},
        std::vector<std::string>{"top", "--every", "soon"},
        std::vector<std::string>{"read", "--every", "1s", "--list"}, std::vector<std::string>{"write", "56"},
        std::vector<std::string>{"write", "56", "1", "2"}, std::vector<std::string>{"tec"},
        std::vector<std::string>{"tec", "set", "TYPE"}, std::vector<std::string>{"tec", "5"},
        std::vector<std::string>{"hex"}, std::vector<std::string>{"status", "--quiet"},
        std::vector<std::string>{"status", "--drive"}, std::vector<std::string>{"status", "--wait"},
        std::vector<std::string>{"status", "--wait", "-1"},
        std::vector<std::string>{"status", "--wait", "1", "--follow"}, std::vector<std::string>{"decode"},
        std::vector<std::string>{"tag", "7", "--table", "x.csv", "--profile", "590"},
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
    EXPECT_THAT(ran.out, HasSubstr("  0  success\n"));
    EXPECT_THAT(ran.out, HasSubstr("  1  refused by the daemon or the drive, a faulty answer or input, not "
                                   "found, or the answer is no (status --wait, doctor, survey, tune)\n"));
    EXPECT_THAT(ran.out, HasSubstr("  2  wrong usage, or no such station\n"));
    EXPECT_THAT(ran.out, HasSubstr("  3  no daemon"));
    EXPECT_THAT(ran.out, HasSubstr("org.dpslaved.Control.varlink"));
}

TEST(DpctlHelp, HasACommandOfEachKindUnderItsHeading)
{
    const std::string all = dpctl({"--help"}).out;
    std::size_t at = 0;
    for (const char* line :
         {"\nLook:\n",      "\n  status ",  "\n  show ",    "\n  io ",      "\n  diag ", "\n  counters ",
          "\n  doctor ",    "\nWatch:\n",   "\n  trace ",   "\n  bus ",     "\n  top ",  "\n  events ",
          "\n  metrics ",   "\nOperate:\n", "\n  read ",    "\n  write ",   "\n  tec ",  "\n  survey ",
          "\n  log-level ", "\n  reload ",  "\n  tune ",    "\nOffline:\n", "\n  tag ",  "\n  hex ",
          "\n  decode ",    "\n  gsd ",     "\nVersion:\n", "\n  version "}) {
        const std::size_t found = all.find(line, at > 0 ? at - 1 : 0);
        ASSERT_NE(found, std::string::npos) << line;
        at = found + std::string_view{line}.size();
    }
}

class DpctlOwnHelp : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(DpctlOwnHelp, ShowsExitCodesAndWhatJsonPrints)
{
    const auto& [command, exits] = GetParam();

    const std::string own = dpctl({command, "--help"}).out;

    EXPECT_THAT(own, HasSubstr("\nExit codes: " + std::string{exits}));
    EXPECT_THAT(own, HasSubstr("--json prints "));
}

constexpr const char* kShows =
    "0 success, 1 refused or faulty, 2 wrong usage or no such station, 3 no daemon.";
constexpr const char* kNeedsNone = "0 success, 1 not found or faulty, 2 wrong usage; no daemon is needed.";
INSTANTIATE_TEST_SUITE_P(
    All, DpctlOwnHelp,
    testing::Values(
        std::pair{"status", "0 success, with --wait: in exchange; 1 refused or faulty, with --wait: not in "
                            "exchange;\n2 wrong usage or no such station; 3 no daemon."},
        std::pair{"show", kShows}, std::pair{"io", kShows}, std::pair{"diag", kShows},
        std::pair{"counters", kShows}, std::pair{"bus", kShows}, std::pair{"write", kShows},
        std::pair{"events", kShows},
        std::pair{"top", "0 success, also q and Ctrl-C; 1 refused or faulty; 2 wrong usage or no such "
                         "station; 3 no daemon."},
        std::pair{"read",
                  "0 success, with --every: Ctrl-C; 1 refused or faulty; 2 wrong usage, no such station or "
                  "no such tag; 3 no daemon."},
        std::pair{"log-level", "0 success, 1 refused or faulty, 2 wrong usage, 3 no daemon."},
        std::pair{"tec", kShows},
        std::pair{"doctor",
                  "0 all is well, 1 something was found, 2 wrong usage or no such station, 3 no daemon."},
        std::pair{
            "survey",
            "0 complete, 1 refused, faulty or not complete, 2 wrong usage or no such station, 3 no daemon."},
        std::pair{"metrics",
                  "0 success, 1 a faulty answer or the file cannot be written, 2 wrong usage, 3 no daemon."},
        std::pair{"reload", "0 applied, or can be; 1 refused or faulty; 2 wrong usage; 3 no daemon."},
        std::pair{"tune", "0 success, 1 the rate of the bus cannot be held or something must be corrected,\n"
                          "2 wrong usage, 3 no PORT and no daemon."},
        std::pair{"version",
                  "0 success, also without a daemon; 1 a faulty answer; 2 wrong usage; 3 this user may not "
                  "open the socket."},
        std::pair{"tag", kNeedsNone}, std::pair{"hex", kNeedsNone}, std::pair{"decode", kNeedsNone}),
    [](const auto& row) {
        std::string name{row.param.first};
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

TEST(DpctlHelp, ShowsTheFormOfJsonAndExamplesWhereNoDaemonIsNeeded)
{
    for (const char* subcommand : {"tag", "hex", "decode"}) {
        const std::string own = dpctl({subcommand, "--help"}).out;
        EXPECT_THAT(own, HasSubstr("--json prints {\""));
        EXPECT_THAT(own, HasSubstr(std::string{"Examples:\n  dpctl "} + subcommand));
    }
}

} // namespace
} // namespace dpslave::test
