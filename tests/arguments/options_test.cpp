// SPDX-License-Identifier: Apache-2.0
#include "dpslave/arguments/options.hpp"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::arguments {
namespace {

using testing::ElementsAre;
using namespace std::chrono_literals;

/// What the parser refuses with, or empty.
std::string fault_of(CLI::App& app, const std::string& words)
{
    try {
        app.parse(words);
        return {};
    } catch (const CLI::ParseError& error) {
        return error.what();
    }
}

TEST(TimeOption, TakesEachUnit)
{
    CLI::App app;
    std::chrono::nanoseconds time = 5s;
    std::optional<std::chrono::nanoseconds> other;
    CLI::Option* const option = add_time(app, "--timeout", time, "help", {10ms, 1h});
    add_time(app, "--every", other, "help", {100ms, 24h});
    EXPECT_EQ(option->get_default_str(), "5s");
    EXPECT_EQ(other, std::nullopt);

    app.parse("--timeout 0.3 --every 1h");

    EXPECT_EQ(time, 300ms);
    EXPECT_EQ(other, 1h);
    EXPECT_EQ(fault_of(app, "--timeout 2h"),
              "--timeout: \"2h\": write a time from 10ms to 1h, such as 500ms, 10s, 5m or 1h");
}

TEST(RateOption, TakesKAndM)
{
    CLI::App app;
    std::uint32_t rate = 9600;
    add_rate(app, "--baud", rate, "help", {50, 12'000'000});

    app.parse("--baud 1.5M");

    EXPECT_EQ(rate, 1'500'000u);
    EXPECT_EQ(fault_of(app, "--baud fast"),
              "--baud: \"fast\": write a rate from 50 to 12000000 bit/s, such as 9600, 187.5k or 1.5M");
}

TEST(NumberOption, IsDecimalUnless0xStandsBefore)
{
    CLI::App app;
    unsigned number = 0;
    double decimal = 0;
    add_number(app, "--slave", number, "help", {0, 126});
    add_decimal(app, "--errors", decimal, "help", {0, 1});

    app.parse("--slave 010 --errors 0.25");

    EXPECT_EQ(number, 10u);
    EXPECT_EQ(decimal, 0.25);
    EXPECT_EQ(fault_of(app, "--slave 0127"), "--slave: \"0127\": write a number from 0 to 126");
    EXPECT_EQ(fault_of(app, "--errors 2"), "--errors: \"2\": write a number from 0 to 1");
}

TEST(ChoiceOption, RefusesWithTheSet)
{
    CLI::App app;
    std::string form;
    add_choice(app, "--as", form, {"prm", "cfg", "diag"}, "help");

    app.parse("--as cfg");

    EXPECT_EQ(form, "cfg");
    EXPECT_EQ(fault_of(app, "--as zzz"), "--as: \"zzz\": write \"prm\", \"cfg\" or \"diag\"");
}

TEST(ListOption, HasCommasOrBlanksAndMayBeRepeated)
{
    CLI::App app;
    std::vector<std::string> items, names;
    std::string port;
    add_list(app, "--unit", items, "LIST", "help", Between::commas_and_blanks, choice_judge({"1", "2", "3"}));
    add_list(app, "--modules", names, "LIST", "help", Between::commas);
    add_text(app, "PORT", port, "", "help");

    app.parse(
        {"Input, 2 words", "--modules", "3", "--unit", "1,2", "--unit", "tty"}); // the last word is first

    EXPECT_THAT(items, ElementsAre("1", "2", "3"));
    EXPECT_THAT(names, ElementsAre("Input", "2 words"));
    EXPECT_EQ(port, "tty");
    EXPECT_EQ(fault_of(app, "--unit 4"), "--unit: \"4\": write \"1\", \"2\" or \"3\"");
    EXPECT_EQ(fault_of(app, "--unit 1,,2"), "--unit: \"1,,2\": an item of the list is empty");
}

} // namespace
} // namespace dpslave::arguments
