// SPDX-License-Identifier: Apache-2.0
// dpctl plot of a real daemon: what the drive had, what was held, another layout, hostile names.
// Only here: samples of a drive thread in the chart of another process.
#include "gateway.hpp"

#include <gmock/gmock.h>

#include <set>
#include <sstream>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

/// What an XML parser that is not ours says of `svg`: "ok", the number of its paths with a class, and its
/// texts.
Outcome parsed(const Gateway& gateway, const std::string& svg)
{
    const auto file = gateway.folder("plot.svg");
    write_file(file, svg);
    return run({"/usr/bin/env", "python3", "-c",
                "import sys, xml.etree.ElementTree as tree\n"
                "root = tree.parse(sys.argv[1]).getroot()\n"
                "print(root.tag, *sorted({one.get('class') or '' for one in root.iter()}))\n"
                "print(*(one.text for one in root.iter() if one.text), sep='\\n')\n"
                "assert not [one for one in root.iter() if one.tag.endswith('script')]\n",
                file.string()});
}

std::set<std::string> states(const Gateway& gateway, const std::string& tag)
{
    std::set<std::string> all;
    std::istringstream rows(gateway.dpctl({"plot", tag, "--csv"}).out);
    for (std::string row; std::getline(rows, row);) all.insert(row.substr(row.rfind(',') + 1));
    return all;
}

TEST(DpctlPlot, HasTheValuesOfTheDriveAndWhatWasHeld)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    ASSERT_TRUE(master.does("wait 10s for in 1 = 1250"));
    gateway.drive().send_line("silence");
    EXPECT_TRUE(gateway.daemon().says("the drive does not answer"));
    gateway.drive().send_line("ok");
    EXPECT_TRUE(gateway.daemon().says("the drive answers"));
    gateway.drive().send_line("set 55 3.00");
    ASSERT_TRUE(master.does("wait 10s for in 1 = 300"));

    const std::string csv = gateway.dpctl({"plot", "speed_feedback", "--csv", "--last", "2m"}).out;
    EXPECT_THAT(csv, HasSubstr(",55,Example: speed feedback,in,12.50,12.5,1250,good\n"));
    EXPECT_THAT(csv, HasSubstr(",12.50,12.5,1250,stale\n")) << "held";
    EXPECT_THAT(csv, HasSubstr(",in,3.00,3,300,good\n"));
    EXPECT_LT(csv.find(",stale\n"), csv.find(",3.00,"));

    const Outcome svg = gateway.dpctl({"plot", "55", "56", "--output", "-"});
    EXPECT_EQ(svg.status, 0) << svg.err;
    const Outcome read = parsed(gateway, svg.out);
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_THAT(read.out, HasSubstr("{http://www.w3.org/2000/svg}svg"));
    EXPECT_THAT(read.out, HasSubstr("good"));
    EXPECT_THAT(read.out, HasSubstr("held: the drive did not answer"));
    EXPECT_THAT(gateway.dpctl({"plot", "55"}).out, HasSubstr("o held: the drive did not answer"));
}

TEST(DpctlPlot, EndsTheLineWhereTheMasterChoosesOtherTags)
{
    Gateway gateway;
    {
        Master master{gateway, {"--tags", "55,56w"}};
        ASSERT_TRUE(master.does("start 60s"));
        gateway.drive().send_line("set 55 12.50");
        ASSERT_TRUE(master.does("wait 10s for in 1 = 1250"));
    }
    Master master{gateway, {"--tags", "90"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 90 7");
    ASSERT_TRUE(master.does("wait 10s for in 1 = 7"));

    EXPECT_THAT(states(gateway, "55"), IsSupersetOf({"good", "none"}));
    EXPECT_THAT(gateway.dpctl({"plot", "55"}).out,
                HasSubstr("tag 55 Example: speed feedback, not in the present "
                          "layout: no value now\n"));
    const Outcome other = gateway.dpctl({"plot", "62"});
    EXPECT_EQ(other.status, 1);
    EXPECT_THAT(other.err, HasSubstr("is not refreshed: it is not among the inputs and outputs"));
    EXPECT_THAT(other.err, HasSubstr("dpctl read --every 1s 62\n"));
}

TEST(DpctlPlot, EscapesANameOfTheTagTable)
{
    Gateway gateway{
        {.table = "tag,name,type,decimals\n55,\"<script>\"\"a\"\"&'b</script>\",REAL,2\n56,x,REAL,2\n"}};
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    ASSERT_TRUE(master.does("wait 60s for in 1 = 1250")); // so there is a value to show

    const Outcome read = parsed(gateway, gateway.dpctl({"plot", "55", "--output", "-"}).out);
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_THAT(read.out, HasSubstr("\ntag 55 <script>\"a\"&'b</script>, in\n")) << "a text, no element";
    EXPECT_THAT(gateway.dpctl({"plot", "55", "--csv"}).out,
                HasSubstr(",\"<script>\"\"a\"\"&'b</script>\",in,"));
    EXPECT_EQ(gateway.json({"plot", "55"}).at("name"), "<script>\"a\"&'b</script>");
}

TEST(DpctlPlot, SaysThatNoValuesAreKept)
{
    Gateway gateway{{.started = false}};
    write_file(gateway.config(), gateway.config_text() + "\n[trace]\nsamples_kib = 0\n");
    gateway.start_daemon();

    const Outcome outcome = gateway.dpctl({"plot", "55"});
    EXPECT_EQ(outcome.status, 5);
    EXPECT_THAT(outcome.err, HasSubstr("samples_kib"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("org.dpslaved")));
}

} // namespace
} // namespace dpslave::test
