// SPDX-License-Identifier: Apache-2.0
#include "dpslave/arguments/command_line.hpp"
#include "dpslave/arguments/exit_status.hpp"
#include "dpslave/arguments/options.hpp"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace dpslave::arguments {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using namespace std::chrono_literals;

struct Read {
    std::optional<int> exit;
    std::string out, err;
};

/// A program with the commands `look` and `files make`.
Read read(std::vector<std::string> words)
{
    CLI::App app{"A program for the test, whose description is so long that it has to be broken into lines",
                 "prog"};
    app.require_subcommand(1);
    app.footer(
        "Examples:\n  dpctl look this --with a,very,long --list of --options that --need more,than,one "
        "--line\n  dpctl look                            an explanation that does not fit behind the example\n" +
        std::string{kExitTable});
    bool follow = false, once = false;
    std::string station, value, level;
    std::chrono::nanoseconds wait = 1s;
    CLI::App& look = *app.add_subcommand("look", "Looks at what there is, and says it in a sentence so long "
                                                 "that it does not fit one line");
    CLI::Option* const followed = look.add_flag("-f,--follow", follow, "Go on");
    look.add_flag("--once", once, "Only once")->excludes(followed);
    add_time(look, "--wait", wait, "How long to wait for what is looked at, a text that has to be broken",
             {0s, 1h});
    add_choice(look, "--level", level, {"debug", "info"}, "The level")->needs(followed);
    add_text(look, "STATION", station, "", "Name or address")->required();
    CLI::App& files = *app.add_subcommand("files", "Files");
    files.require_subcommand(1);
    CLI::App& make = *files.add_subcommand("make", "Makes one");
    std::vector<std::string> only;
    for (CLI::App* const one : {&look, &make})
        add_list(*one, "--only", only, "LIST", "Only these", Between::commas_and_blanks);
    std::ostringstream out, err;
    const auto exit = read_command_line(app, "prog 1.2.3", std::move(words), out, err);
    return {exit, out.str(), err.str()};
}

std::string fault(std::vector<std::string> words)
{
    const Read result = read(std::move(words));
    EXPECT_EQ(result.exit, kUsage);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("\nRun with --help for more information.\n"));
    EXPECT_THAT(result.err, StartsWith("prog: "));
    return result.err.substr(6, result.err.find('\n') - 6);
}

TEST(CommandLine, IsRead)
{
    EXPECT_EQ(read({"look", "5", "-f", "--wait", "5m"}).exit, std::nullopt);
    EXPECT_EQ(read({"files", "make"}).exit, std::nullopt);
    EXPECT_EQ(read({"look", "--only", "1", "5"}).exit, std::nullopt) << "5 is the station";
    EXPECT_EQ(read({"files", "make", "--only", "1", "2"}).exit, std::nullopt);
}

TEST(CommandLine, NamesTheCommandThatWasMeant)
{
    EXPECT_EQ(fault({"lok"}), "there is no command 'lok'; did you mean 'look'?");
    EXPECT_EQ(fault({"files", "mak"}), "there is no command 'mak'; did you mean 'make'?");
    EXPECT_EQ(fault({"entirely-else"}), "there is no command 'entirely-else'");
    EXPECT_EQ(fault({"files"}), "name a command: make");
}

TEST(CommandLine, WithAWrongCommandIsWrongEvenBesideHelp)
{
    EXPECT_EQ(fault({"wrong", "--help"}), "there is no command 'wrong'");
    EXPECT_EQ(fault({"--help", "wrong"}), "there is no command 'wrong'");
    EXPECT_EQ(fault({"files", "wrong", "-h"}), "there is no command 'wrong'");
}

TEST(CommandLine, NamesTheOptionThatWasMeant)
{
    EXPECT_EQ(fault({"look", "5", "--folow"}), "there is no option '--folow'; did you mean '--follow'?");
    EXPECT_EQ(fault({"look", "5", "--wiat=5"}), "there is no option '--wiat'; did you mean '--wait'?");
    EXPECT_EQ(fault({"look", "--stattion"}), "there is no option '--stattion'") << "STATION is missing, too";
    EXPECT_EQ(fault({"look", "5", "--entirely-else"}), "there is no option '--entirely-else'");
    EXPECT_EQ(fault({"look", "5", "-x"}), "there is no option '-x'");
}

TEST(CommandLine, IsRefusedInSentencesOfTheProject)
{
    EXPECT_EQ(fault({"look"}), "STATION is missing");
    EXPECT_EQ(fault({"look", "5", "6"}), "the word '6' is one too many");
    EXPECT_EQ(fault({"look", "5", "--wait"}), "--wait needs a value: --wait TIME");
    EXPECT_EQ(fault({"look", "5", "--wait", "1", "--wait", "2"}), "--wait can be given only once");
    EXPECT_EQ(fault({"look", "5", "--follow=yes"}), "--follow takes no value");
    EXPECT_EQ(fault({"look", "5", "--level", "info"}), "--level needs --follow");
    EXPECT_EQ(fault({"look", "5", "--once", "-f"}), "--follow and --once exclude each other");
    EXPECT_EQ(fault({"look", "5", "-f", "--level", "x"}), "--level: \"x\": write \"debug\" or \"info\"");
}

TEST(CommandLine, PrintsItsVersion)
{
    for (const auto& words :
         {std::vector<std::string>{"--version"}, {"look", "--version"}, {"files", "make", "--version"}}) {
        EXPECT_EQ(read(words).out, "prog 1.2.3\n");
        EXPECT_EQ(read(words).exit, kFine);
    }
}

TEST(Help, FitsEightyColumns)
{
    for (const auto& words : {std::vector<std::string>{"--help"}, {"look", "-h"}, {"files", "--help"}}) {
        const Read help = read(words);
        EXPECT_EQ(help.exit, kFine);
        std::istringstream lines{help.out};
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
    }
}

TEST(Help, BreaksWhatDoesNotFit)
{
    const std::string help = read({"--help"}).out;
    EXPECT_THAT(help,
                HasSubstr("  look                    Looks at what there is, and says it in a sentence so\n"
                          "                          long that it does not fit one line\n"));
    EXPECT_THAT(help, HasSubstr("  dpctl look this --with a,very,long --list of --options that --need \\\n"
                                "      more,than,one --line\n"));
    EXPECT_THAT(help, HasSubstr("  dpctl look\n      an explanation that does not fit behind the example\n"));
    EXPECT_THAT(help, HasSubstr("  4  no answer in time\n"));
}

TEST(Help, ShowsTypesAndDefaultsOnce)
{
    const std::string help = read({"look", "--help"}).out;
    EXPECT_THAT(help, HasSubstr("Usage: prog look [OPTIONS] STATION\n"));
    EXPECT_THAT(help, HasSubstr("  -f, --follow            Go on\n"));
    EXPECT_THAT(help,
                HasSubstr("  --wait TIME             How long to wait for what is looked at, a text that\n"
                          "                          has to be broken (default: 1s)\n"));
    EXPECT_THAT(help, HasSubstr("  --level debug|info      The level\n"));
    EXPECT_THAT(help, HasSubstr("  STATION                 Name or address\n"));
    EXPECT_THAT(help, Not(HasSubstr("--version")));
    EXPECT_THAT(read({"--help"}).out, HasSubstr("--version"));
}

} // namespace
} // namespace dpslave::arguments
