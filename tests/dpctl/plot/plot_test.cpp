// SPDX-License-Identifier: Apache-2.0
// dpctl plot: the picture, the chart for a terminal and the table, whole; and what it says where there is
// nothing. The values are those of the fixture: 0 for 50 s, 10 for 10 s, held for 20 s, none for 10 s,
// refused for 10 s.
#include "control/fixtures.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/plot/render_plot.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kWholePicture = R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="960" height="325" viewBox="0 0 960 325">
<title>unwinder, 2023-11-14 22:13:20 to 2023-11-14 22:15:00</title>
<style>
text{font:12px sans-serif;fill:#222}
.head{font-size:15px}.y{text-anchor:end}.x{text-anchor:middle}
.grid{stroke:#ccc;stroke-width:1}.gap{fill:#ddd}
path{fill:none;stroke-width:1.5}
.good{stroke:#1f5fa8}.held{stroke:#b45f06;stroke-dasharray:7 3}.failed{stroke:#b00020;stroke-dasharray:2 3}
</style>
<rect width="960" height="325" fill="#fff"/>
<text class="head" x="90" y="24">unwinder, 2023-11-14 22:13:20 to 2023-11-14 22:15:00</text>
<text x="90" y="58">tag 7 SPEED FEEDBACK, in</text>
<path class="grid" d="M90 216.0H920"/>
<text class="y" x="82" y="220.0">0</text>
<path class="grid" d="M90 186.0H920"/>
<text class="y" x="82" y="190.0">2</text>
<path class="grid" d="M90 156.0H920"/>
<text class="y" x="82" y="160.0">4</text>
<path class="grid" d="M90 126.0H920"/>
<text class="y" x="82" y="130.0">6</text>
<path class="grid" d="M90 96.0H920"/>
<text class="y" x="82" y="100.0">8</text>
<path class="grid" d="M90 66.0H920"/>
<text class="y" x="82" y="70.0">10</text>
<rect class="gap" x="754.0" y="66" width="83.0" height="150"/>
<path class="good" d="M90.0 216.0H505.0V66.0H588.0"/>
<path class="held" d="M588.0 66.0H754.0"/>
<path class="failed" d="M837.0 216.0H920.0"/>
<path class="grid" d="M173.0 66V227"/>
<text class="x" x="173.0" y="241">22:13:30</text>
<path class="grid" d="M297.5 66V227"/>
<text class="x" x="297.5" y="241">22:13:45</text>
<path class="grid" d="M422.0 66V227"/>
<text class="x" x="422.0" y="241">22:14:00</text>
<path class="grid" d="M546.5 66V227"/>
<text class="x" x="546.5" y="241">22:14:15</text>
<path class="grid" d="M671.0 66V227"/>
<text class="x" x="671.0" y="241">22:14:30</text>
<path class="grid" d="M795.5 66V227"/>
<text class="x" x="795.5" y="241">22:14:45</text>
<path class="grid" d="M920.0 66V227"/>
<text class="x" x="920.0" y="241">22:15:00</text>
<path class="held" d="M90 267H120"/>
<text x="130" y="271">held: the drive did not answer, the last value stands</text>
<path class="failed" d="M90 285H120"/>
<text x="130" y="289">failed: the drive or the tag table refuses it</text>
<rect class="gap" x="90" y="298" width="30" height="10"/>
<text x="130" y="307">no values</text>
</svg>
)";

constexpr const char* kWholeChart = R"(unwinder, 2023-11-14 22:13:20 to 22:15:00
tag 7 SPEED FEEDBACK, in: 0.00 (failed)
        10 |                                  ******ooooooooooooooo
           |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
         5 |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
           |                                  *
         0 |***********************************                          xxxxxxx
           +------+--------------------+-------------------+-------------------+
              22:13:30             22:14:00            22:14:30         22:15:00
o held: the drive did not answer  x failed: refused
Tag 7 has no values 22:14:40 to 22:14:50
)";

class DpctlPlot : public testing::Test {
protected:
    DpctlPlot()
    {
        ::setenv("TZ", "UTC0", 1);
        ::tzset();
        ::setenv("LC_ALL", "C", 1);
    }
    ~DpctlPlot() override { ::unsetenv("LC_ALL"); }
    Ran run(std::vector<std::string> arguments, const FixtureDaemon& of)
    {
        arguments.insert(arguments.begin(), "plot");
        arguments.insert(arguments.end(), {"--station", "unwinder", "--socket", of.socket()});
        return dpctl(std::move(arguments));
    }
    Ran run(std::vector<std::string> arguments) { return run(std::move(arguments), daemon); }
    FixtureDaemon daemon;
};

/// Some of them are in the names of tags.
constexpr const char* kHostile = "<script>\"x\"&'\n,\x1B[2J\xEF\xBF\xBE";

dpctl::Plot plot_of(const std::string& name)
{
    report::GetSamplesReply reply = report::read<report::GetSamplesReply>(fixture("GetSamples"));
    reply.name = name;
    return {.station = "unwinder",
            .time = {reply.now_unix_ms - 100'000, reply.now_unix_ms},
            .series = {dpctl::series_of({reply})},
            .notes = {}};
}

TEST_F(DpctlPlot, WritesAPictureWithHeldFailedAndMissingValuesApart)
{
    EXPECT_EQ(dpctl::render_svg(plot_of("SPEED FEEDBACK")), kWholePicture);
}

TEST_F(DpctlPlot, PutsThePictureIntoAFileAndSaysWhatIsMissing)
{
    const std::string file = testing::TempDir() + "dpctl_plot_test.svg";
    const Ran ran = run({"feedback", "--last", "100s", "--output", file});

    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "dpctl: Tag 7 has no values 22:14:40 to 22:14:50\n");
    std::stringstream written;
    written << std::ifstream{file}.rdbuf();
    EXPECT_THAT(written.str(), StartsWith("<?xml"));
    EXPECT_THAT(written.str(), HasSubstr("<path class=\"good\" d=\"M90.0 216.0H505.0V66.0H588.0\"/>"));
    EXPECT_EQ(run({"7", "--last", "100s", "--output", "-"}).out, written.str());
    EXPECT_EQ(run({"7", "--output", "/none/x.svg"}).exit, 1);
}

TEST_F(DpctlPlot, PrintsATableWithARowForEachSample)
{
    EXPECT_EQ(run({"7", "--csv", "--last", "100s"}).out,
              "time,tag,name,direction,value,scaled,raw,state\n"
              "2023-11-14T22:13:20.000Z,7,SPEED FEEDBACK,in,0.00,0,0,good\n"
              "2023-11-14T22:14:10.000Z,7,SPEED FEEDBACK,in,10.00,10,1000,good\n"
              "2023-11-14T22:14:20.000Z,7,SPEED FEEDBACK,in,10.00,10,1000,stale\n"
              "2023-11-14T22:14:40.000Z,7,SPEED FEEDBACK,in,,,,none\n"
              "2023-11-14T22:14:50.000Z,7,SPEED FEEDBACK,in,0.00,0,0,unscaled\n");
}

TEST_F(DpctlPlot, DrawsWithAsciiWhereTheLocaleHasNoMore)
{
    const Ran ran = run({"7", "--last", "100s"});

    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(ran.out, kWholeChart);
}

TEST_F(DpctlPlot, DrawsWithDotsWhereTheLocaleHasThem)
{
    ::setenv("LC_ALL", "C.UTF-8", 1);
    const Ran ran = run({"7", "--last", "100s"});

    EXPECT_THAT(ran.out, HasSubstr("⣀⣀⣀⣀"));
    EXPECT_THAT(ran.out, HasSubstr("oooo")) << "held";
    EXPECT_THAT(ran.out, HasSubstr("xxxx")) << "refused";
    EXPECT_THAT(ran.out, Not(HasSubstr("*")));
}

TEST_F(DpctlPlot, OfSeveralTagsFitsAScreen)
{
    for (const std::vector<std::string>& tags :
         {std::vector<std::string>{"7"}, {"7", "8"}, {"7", "8", "9"}, {"7", "8", "9", "10"}}) {
        const std::string out = run(tags).out;
        EXPECT_LE(std::count(out.begin(), out.end(), '\n'), 23) << out;
        std::istringstream lines(out);
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
    }
}

TEST_F(DpctlPlot, PrintsTheRepliesAsJson)
{
    const Ran ran = run({"7", "8", "--json"});

    std::istringstream lines(ran.out);
    int count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        EXPECT_EQ(Json::parse(line), fixture("GetSamples"));
    EXPECT_EQ(count, 2);
}

TEST_F(DpctlPlot, EscapesNamesOfTagsInEachForm)
{
    const std::string svg = dpctl::render_svg(plot_of(kHostile));
    EXPECT_THAT(svg, HasSubstr("<text x=\"90\" y=\"58\">tag 7 &lt;script&gt;&quot;x&quot;&amp;&apos;\\x0A,"
                               "\\x1B[2J\\uFFFE, in</text>\n"));
    const std::string csv = dpctl::render_csv(plot_of(kHostile));
    EXPECT_THAT(csv, HasSubstr("Z,7,\"<script>\"\"x\"\"&'\\x0A,\\x1B[2J\xEF\xBF\xBE\",in,0.00,"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
    const std::string chart = dpctl::render_chart(plot_of(kHostile), 80, false);
    EXPECT_THAT(chart, HasSubstr("\ntag 7 <script>\"x\"&'\\x0A,\\x1B[2J"));

    const FixtureDaemon hostile{kHostile};
    EXPECT_THAT(run({"7", "--csv"}, hostile).out, Not(HasSubstr("\x1B")));
    EXPECT_THAT(run({"7"}, hostile).out, Not(HasSubstr("\x1B")));
    const Ran json = run({"7", "--json"}, hostile);
    EXPECT_EQ(Json::parse(json.out).at("name"), std::string{"SPEED FEEDBACK"} + kHostile);
    EXPECT_EQ(std::count(json.out.begin(), json.out.end(), '\n'), 1);
}

TEST_F(DpctlPlot, NamesTheTagThatIsNearest)
{
    const Ran ran = run({"sped feedbak"});

    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.err, "dpctl: no tag of unwinder has 'sped feedbak' in its name; did you mean 'SPEED "
                       "FEEDBACK'? dpctl read --names prints the names\n");
    EXPECT_THAT(run({"torqe"}).err, HasSubstr("did you mean 'TORQUE'?"));
}

TEST_F(DpctlPlot, SaysWhatToDoWithoutATagOrAStation)
{
    EXPECT_EQ(run({}).exit, 2);
    EXPECT_THAT(run({}).err, HasSubstr("name a tag"));
    const Ran unknown = dpctl({"plot", "7", "--station", "other", "--socket", daemon.socket()});
    EXPECT_EQ(unknown.exit, 2);
    EXPECT_THAT(unknown.err, HasSubstr("there is no station 'other'"));
    EXPECT_EQ(run({"7", "--last", "soon"}).exit, 2);
}

} // namespace
} // namespace dpslave::test
