// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/explain.hpp"
#include "dpctl/cli/table.hpp"
#include "dpctl/cli/words.hpp"

#include <gtest/gtest.h>

namespace dpslave::dpctl {
namespace {

TEST(DpctlWords, RatesAreInKilobitOrMegabit)
{
    EXPECT_EQ(rate(9600), "9.6 kbit/s");
    EXPECT_EQ(rate(45450), "45.45 kbit/s");
    EXPECT_EQ(rate(187500), "187.5 kbit/s");
    EXPECT_EQ(rate(500000), "500 kbit/s");
    EXPECT_EQ(rate(1500000), "1.5 Mbit/s");
}

TEST(DpctlWords, AgesGrowFromMillisecondsToDays)
{
    EXPECT_EQ(age(std::nullopt), "-");
    EXPECT_EQ(age(0.4), "0 ms");
    EXPECT_EQ(age(12.0), "12 ms");
    EXPECT_EQ(age(3'400), "3.4 s");
    EXPECT_EQ(age(300'000), "5 min");
    EXPECT_EQ(age(3'720'000), "1 h 2 min");
    EXPECT_EQ(age(93'600'000), "1 d 2 h");
}

TEST(DpctlWords, WordsAreDecimalAndHexadecimal)
{
    EXPECT_EQ(word(1250), "1250 (0x04E2)");
    EXPECT_EQ(word(std::nullopt), "-");
}

TEST(DpctlTable, AlignsByCharactersAndLeavesNoBlanksAtTheEnd)
{
    Table table({"NAME", ">N", "LAST"});
    table.add({"drive", "7", "x"});
    table.add({"Walze \xC3\xA4", "123", ""});

    EXPECT_EQ(table.str(false, 1), " NAME       N  LAST\n"
                                   " drive      7  x\n"
                                   " Walze \xC3\xA4  123\n");
}

TEST(DpctlTable, CountsTwoColumnsForALetterOfEastAsiaAndBreaksBetweenThem)
{
    Table table({"NAME", "LAST"});
    table.add({"\u4E2D\u6587", "x"});
    table.add({"ab", "y"});

    EXPECT_EQ(table.str(false), "NAME  LAST\n\u4E2D\u6587  x\nab    y\n");
    EXPECT_EQ(wrapped("\u4E2D\u6587\u4E2D", 1), (std::vector<std::string>{"\u4E2D", "\u6587", "\u4E2D"}));
    EXPECT_EQ(wrapped("\u4E2D\u6587\u4E2D", 5), (std::vector<std::string>{"\u4E2D\u6587", "\u4E2D"}));
}

TEST(DpctlTable, PaintsOnlyWhereColoursAreWanted)
{
    Table table({"S"});
    table.add({Cell{"bad", Tone::bad}});

    EXPECT_EQ(table.str(false), "S\nbad\n");
    EXPECT_EQ(table.str(true), "\033[1mS\033[0m\n\033[31mbad\033[0m\n");
}

struct Explained {
    const char* name;
    const char* error;
    const char* parameters;
    const char* sentence;
};
class ErrorReply : public testing::TestWithParam<Explained> {};

TEST_P(ErrorReply, IsASentence)
{
    EXPECT_EQ(explain({Json::parse(GetParam().parameters), GetParam().error, false}), GetParam().sentence);
}

INSTANTIATE_TEST_SUITE_P(
    All, ErrorReply,
    testing::Values(
        Explained{"NoSuchStation", "org.dpslaved.Control.NoSuchStation",
                  R"({"station":"x","known":["unwinder","rewinder"]})",
                  "there is no station 'x'; there are: unwinder, rewinder"},
        Explained{"NoSuchLine", "org.dpslaved.Control.NoSuchLine", R"({"line":"x","known":["p3","p4"]})",
                  "there is no drive line 'x'; there are: p3, p4"},
        Explained{"StationRequired", "org.dpslaved.Control.StationRequired",
                  R"({"known":["unwinder","rewinder"]})",
                  "there are several stations, name one: unwinder, rewinder"},
        Explained{"OnlyListens", "org.dpslaved.Control.OnlyListens", "{}",
                  "the daemon only listens, so it has no station: 'listen' is set in [bus] of its "
                  "configuration. See who is on the bus: dpctl bus"},
        Explained{"NotPermitted", "org.dpslaved.Control.NotPermitted", R"({"group":"dpslaved"})",
                  "only root and members of the group 'dpslaved' may do this; try: sudo dpctl ..., or let "
                  "root add you: "
                  "adduser YOUR_NAME dpslaved"},
        Explained{"NotPermittedWithoutGroup", "org.dpslaved.Control.NotPermitted", R"({"group":""})",
                  "only root may do this; try: sudo dpctl ..."},
        Explained{"DriveRefused", "org.dpslaved.Control.DriveRefused",
                  R"({"tag":56,"reason":"read only","code":1})",
                  "tag 56: read only (Demand Data: error code 1)"},
        Explained{"DriveSilent", "org.dpslaved.Control.DriveRefused",
                  R"({"tag":56,"reason":"no answer","code":null})", "tag 56: no answer"},
        Explained{"BadValue", "org.dpslaved.Control.BadValue",
                  R"({"tag":56,"value":"x","reason":"no number"})",
                  "tag 56: the value 'x' does not fit: no number"},
        Explained{"NoTecOption", "org.dpslaved.Control.NoTecOption", R"({"station":"unwinder"})",
                  "the device of station 'unwinder' has no TEC OPTION function block; technology boxes have "
                  "one"},
        Explained{"BadTecValue", "org.dpslaved.Control.BadTecValue",
                  R"({"parameter":"TYPE","value":"ARCNET","reason":"no such type"})",
                  "TYPE cannot be set to 'ARCNET': no such type"},
        Explained{"ReadOnly", "org.dpslaved.Control.ReadOnly", "{}",
                  "the daemon only shows: 'read_only' is set in [control] of its configuration; to write, "
                  "remove it and reload"},
        Explained{"Busy", "org.dpslaved.Control.Busy", "{}",
                  "the daemon has too many connections or requests at once; try again"},
        Explained{
            "InvalidParameter", "org.varlink.service.InvalidParameter", R"({"parameter":"station"})",
            "the daemon does not know the parameter 'station': dpctl and dpslaved are of different versions"},
        Explained{"MethodNotFound", "org.varlink.service.MethodNotFound",
                  R"({"method":"org.dpslaved.Control.Watch"})",
                  "the daemon does not know org.dpslaved.Control.Watch: dpctl and dpslaved are of different "
                  "versions"},
        Explained{
            "InterfaceNotFound", "org.varlink.service.InterfaceNotFound",
            R"({"interface":"org.dpslaved.Control"})",
            "the program that answers on this socket does not know org.dpslaved.Control: it is not dpslaved"},
        Explained{"Unknown", "org.example.Odd", R"({"a":1})", R"(org.example.Odd {"a":1})"},
        Explained{"WithoutItsParameters", "org.dpslaved.Control.DriveRefused", "{}", "tag -: ?"}),
    [](const auto& row) { return row.param.name; });

Exit exit_of_reason(const char* reason)
{
    const Json parameters{{"tag", 56}, {"reason", reason}, {"code", nullptr}};
    return exit_of({parameters, "org.dpslaved.Control.DriveRefused", false});
}

TEST(ExitStatus, TellsADriveThatDidNotAnswerFromOneThatRefused)
{
    EXPECT_EQ(exit_of_reason("the drive does not answer"), 4);
    EXPECT_EQ(exit_of_reason("the drive line has not come to it within 5 minutes"), 4);
    EXPECT_EQ(exit_of_reason("read only"), 5);
}

} // namespace
} // namespace dpslave::dpctl
