// SPDX-License-Identifier: Apache-2.0
// dpctl metrics: the text, as a reader of the format of its own understands it, and as promtool judges it.
#include "control/fixtures.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/metrics/exposition.hpp"
#include "dpctl/metrics/metrics.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

namespace dpslave::test {
namespace {

using dpctl::Exposition;
using dpctl::Figures;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A sample as a reader takes it: prometheus.io/docs/instrumenting/exposition_formats, by hand.
struct Sample {
    std::string name;
    std::map<std::string, std::string> labels;
    std::string value;
};

/// `line` is a sample; what is none is a failure.
Sample sample_of(const std::string& line)
{
    Sample sample;
    std::size_t at = line.find_first_of("{ ");
    sample.name = line.substr(0, at);
    while (at < line.size() && line[at] != ' ' && line[at] != '}') {
        const std::size_t equals = line.find("=\"", ++at);
        std::string& value = sample.labels[line.substr(at, equals - at)];
        for (at = equals + 2; at < line.size() && line[at] != '"'; ++at) {
            const bool is_escaped = line[at] == '\\' && ++at < line.size();
            value += is_escaped && line[at] == 'n' ? '\n' : line[at];
        }
        ++at;
    }
    const std::size_t blank = line.find(' ', at);
    if (blank == std::string::npos) ADD_FAILURE() << line;
    sample.value = line.substr(blank + 1);
    EXPECT_EQ(sample.value.find(' '), std::string::npos) << "no timestamp: " << line;
    return sample;
}

/// All samples of `text`. Each family has one HELP and one TYPE, directly before its samples.
std::vector<Sample> samples_of(const std::string& text)
{
    std::vector<Sample> all;
    std::map<std::string, int> families;
    std::string family, line;
    for (std::istringstream lines{text}; std::getline(lines, line);) {
        if (line.starts_with("# HELP ")) {
            family = line.substr(7, line.find(' ', 7) - 7);
            EXPECT_EQ(++families[family], 1) << line;
        } else if (line.starts_with("# TYPE ")) {
            EXPECT_THAT(line, StartsWith("# TYPE " + family + " "));
        } else {
            all.push_back(sample_of(line));
            EXPECT_THAT(all.back().name, StartsWith(family)) << "a family is one group of lines";
        }
    }
    return all;
}

Figures figures()
{
    return {report::read<report::GetVersionReply>(fixture("GetVersion")),
            report::read<report::GetStatusReply>(fixture("GetStatus")),
            report::read<report::GetCountersReply>(fixture("GetCounters"))};
}

/// The only sample with this name and these labels among others.
std::string value(const std::string& text, const std::string& name,
                  const std::map<std::string, std::string>& labels)
{
    std::vector<std::string> found;
    for (const Sample& one : samples_of(text)) {
        bool is_meant = one.name == name;
        for (const auto& label : labels)
            is_meant =
                is_meant && one.labels.contains(label.first) && one.labels.at(label.first) == label.second;
        if (is_meant) found.push_back(one.value);
    }
    return found.size() == 1 ? found.front() : std::to_string(found.size()) + " samples";
}

// ---------------------------------------------------------------- the format

TEST(Exposition, EscapesQuotesBackslashAndLineEndInALabelAndNoQuotesInAHelp)
{
    EXPECT_EQ(dpctl::escaped_label("a\"b\\c\nd"), R"(a\"b\\c\nd)");
    EXPECT_EQ(dpctl::escaped_help("a\"b\\c\nd"), R"(a"b\\c\nd)");
    EXPECT_EQ(dpctl::escaped_label("\n"), R"(\n)");
    EXPECT_EQ(dpctl::escaped_label(""), "");
}

TEST(Exposition, WritesWhatATerminalWouldExecuteAsACode)
{
    EXPECT_EQ(dpctl::escaped_label("\x1B[2J"), R"(\\x1B[2J)");
}

TEST(Exposition, WritesAFamilyAsOneGroupAlsoWhenItsSamplesComeApart)
{
    Exposition out;
    out.gauge("a", "First.", {{"station", "x"}}, 1);
    out.counter("b_total", "Second.", {}, 9'007'199'254'740'993);
    out.gauge("a", "First.", {{"station", "y"}}, 0.5);

    EXPECT_EQ(out.text(), "# HELP a First.\n# TYPE a gauge\na{station=\"x\"} 1\na{station=\"y\"} 0.5\n"
                          "# HELP b_total Second.\n# TYPE b_total counter\nb_total 9007199254740993\n");
}

TEST(Exposition, WritesAHistogramWithItsLastBucketSumAndCount)
{
    Exposition out;
    out.histogram("t_seconds", "Times.", {{"bus", "x"}}, {{{0.001, 2}, {0.003, 5}}, 6, 0.25});

    EXPECT_EQ(out.text(), "# HELP t_seconds Times.\n# TYPE t_seconds histogram\n"
                          "t_seconds_bucket{bus=\"x\",le=\"0.001\"} 2\n"
                          "t_seconds_bucket{bus=\"x\",le=\"0.003\"} 5\n"
                          "t_seconds_bucket{bus=\"x\",le=\"+Inf\"} 6\n"
                          "t_seconds_sum{bus=\"x\"} 0.25\nt_seconds_count{bus=\"x\"} 6\n");
}

// ---------------------------------------------------------------- the figures

TEST(Metrics, HaveTheCountersOfBusStationDriveAndSocketUnderNamesOfTheirOwn)
{
    const std::string text = render_metrics(figures(), "/run/s");
    const std::map<std::string, std::string> station{{"bus", "/dev/ttyS1"}, {"station", "unwinder"}};

    EXPECT_EQ(value(text, "dpslaved_bus_telegrams_total", {{"bus", "/dev/ttyS1"}}), "123456");
    EXPECT_EQ(value(text, "dpslaved_bus_received_bytes_total", {{"bus", "/dev/ttyS1"}}), "900000");
    EXPECT_EQ(value(text, "dpslaved_bus_flaws_total", {{"flaw", "checksum"}}), "3");
    EXPECT_EQ(value(text, "dpslaved_station_data_exchange_total", station), "7");
    EXPECT_EQ(value(text, "dpslaved_drive_reads_total", {{"station", "unwinder"}, {"line", "p3"}}), "4000");
    EXPECT_EQ(value(text, "dpslaved_drive_delay_seconds", station), "0.42") << "in the base unit";
    EXPECT_EQ(value(text, "dpslaved_control_calls_total", {{"bus", "/dev/ttyS1"}}), "9");
}

TEST(Metrics, SayThatADriveIsGoneAndThatOneThatComesBackAnswers)
{
    Figures now = figures();
    now.status.stations[0].drive.link = "gone";
    now.status.stations[1].drive.link = "returning";
    const std::string text = render_metrics(now, "/run/s");
    EXPECT_EQ(value(text, "dpslaved_drive_gone", {{"station", "unwinder"}, {"line", "p3"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_drive_answers", {{"station", "unwinder"}, {"line", "p3"}}), "0");
    EXPECT_EQ(value(text, "dpslaved_drive_answers", {{"station", "rewinder"}, {"line", "p3"}}), "1");
}

TEST(Metrics, HaveTheStateOfEachStationAndDrive)
{
    const std::string text = render_metrics(figures(), "/run/s");

    EXPECT_EQ(value(text, "dpslaved_up", {{"socket", "/run/s"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_uptime_seconds", {}), "3720");
    EXPECT_EQ(value(text, "dpslaved_bus_last_telegram_age_seconds", {}), "0.0024");
    EXPECT_EQ(value(text, "dpslaved_build_info", {{"version", "9.8.7"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_station_state", {{"station", "unwinder"}, {"state", "Data_Exch"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_station_state", {{"station", "rewinder"}, {"state", "Data_Exch"}}), "0");
    EXPECT_EQ(value(text, "dpslaved_station_state", {{"station", "rewinder"}, {"state", "Wait_Prm"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_station_exchanging", {{"station", "unwinder"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_station_watchdog_seconds", {{"station", "unwinder"}}), "0.1");
    EXPECT_EQ(value(text, "dpslaved_station_watchdog_seconds", {{"station", "rewinder"}}), "0 samples");
    EXPECT_EQ(value(text, "dpslaved_station_info", {{"station", "rewinder"}, {"address", "16"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_drive_answers", {{"station", "unwinder"}, {"line", "p3"}}), "1");
    EXPECT_EQ(value(text, "dpslaved_drive_answers", {{"station", "rewinder"}, {"line", "p3"}}), "0");
    EXPECT_EQ(value(text, "dpslaved_drive_gone", {{"station", "rewinder"}, {"line", "p3"}}), "0");
    EXPECT_EQ(value(text, "dpslaved_line_port_open", {{"line", "p3"}}), "1") << "once for both drives";
}

/// The buckets of a histogram in their order.
std::vector<std::pair<double, std::int64_t>> buckets(const std::string& text, const std::string& name,
                                                     const std::string& station)
{
    std::vector<std::pair<double, std::int64_t>> found;
    for (const Sample& one : samples_of(text))
        if (one.name == name + "_bucket" && (station.empty() || one.labels.at("station") == station))
            found.emplace_back(one.labels.at("le") == "+Inf" ? HUGE_VAL : std::stod(one.labels.at("le")),
                               std::stoll(one.value));
    return found;
}

std::int64_t at_most(const std::vector<std::pair<double, std::int64_t>>& buckets, double upper)
{
    std::int64_t count = -1;
    for (const auto& [le, value] : buckets)
        if (le == upper) count = value;
    return count;
}

TEST(Metrics, HaveTheTurnaroundAsAHistogramInSeconds)
{
    const std::string text = render_metrics(figures(), "/run/s");
    const auto found = buckets(text, "dpslaved_reply_turnaround_seconds", "");

    EXPECT_EQ(at_most(found, 15e-6), 1600) << "the replies of 12 us";
    EXPECT_EQ(at_most(found, 63e-6), 1600);
    EXPECT_EQ(at_most(found, 79e-6), 1999);
    EXPECT_EQ(at_most(found, 14'335e-6), 1999);
    EXPECT_EQ(at_most(found, HUGE_VAL), 2000) << "the one that is longer than the last class";
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(value(text, "dpslaved_reply_turnaround_seconds_count", {}), "2000");
    EXPECT_EQ(value(text, "dpslaved_reply_turnaround_seconds_sum", {}), "0.066");
}

TEST(Metrics, HaveTheRefreshOfEachDriveAsAHistogramWithTheSameBucketsBeforeTheFirstRound)
{
    const std::string text = render_metrics(figures(), "/run/s");
    const auto first = buckets(text, "dpslaved_drive_refresh_seconds", "unwinder");
    const auto second = buckets(text, "dpslaved_drive_refresh_seconds", "rewinder");

    EXPECT_EQ(at_most(first, 0.015), 0);
    EXPECT_EQ(at_most(first, 0.031), 50);
    EXPECT_EQ(at_most(first, 0.063), 90);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].first, second[i].first);
        EXPECT_EQ(second[i].second, 0);
    }
    EXPECT_EQ(value(text, "dpslaved_drive_refresh_seconds_sum", {{"station", "unwinder"}}), "4.5");
}

TEST(Metrics, KeepANameWithQuotesBackslashesAndLineEndsWhole)
{
    Figures hostile = figures();
    const std::string name = "un\"win\\der}\n# TYPE x 1\n";
    hostile.status.stations[0].name = name;
    hostile.counters.groups[1].name = name;
    hostile.counters.groups[1].counters[0].meaning = "first\nsecond \\ \"third\"";

    const std::string text = render_metrics(hostile, "/run/\"s\"");

    EXPECT_EQ(value(text, "dpslaved_station_data_exchange_total", {{"station", name}}), "7");
    EXPECT_EQ(value(text, "dpslaved_up", {{"socket", "/run/\"s\""}}), "1");
    EXPECT_THAT(text, HasSubstr("data_exchange: first\\nsecond \\\\ \"third\"\n"));
}

TEST(Metrics, OfAStationCalledAsAnotherGroupAreThoseOfTheStation)
{
    for (const char* name : {"bus", "control socket"}) {
        Figures odd = figures();
        odd.status.stations[0].name = name;
        odd.counters.groups[1].name = name;

        const std::string text = render_metrics(odd, "/run/s");

        EXPECT_EQ(value(text, "dpslaved_station_data_exchange_total", {{"station", name}}), "7");
        EXPECT_EQ(value(text, "dpslaved_bus_telegrams_total", {}), "123456");
        EXPECT_EQ(value(text, "dpslaved_control_calls_total", {}), "9");
    }
}

TEST(Metrics, OfAReplyWithoutAnythingAreStillFamilies)
{
    EXPECT_EQ(value(dpctl::render_metrics({}, "/run/s"), "dpslaved_up", {}), "1");
    EXPECT_EQ(value(dpctl::render_metrics_of_none("/run/s"), "dpslaved_up", {{"socket", "/run/s"}}), "0");
}

// ---------------------------------------------------------------- the program

/// What `promtool check metrics` says about `text`, and its exit status. Package prometheus.
struct Judged {
    int status = -1;
    std::string said;
};
Judged promtool(const std::string& text)
{
    const TempFolder folder;
    const std::string file = folder.path() / "metrics";
    std::ofstream{file} << text;
    FILE* const pipe = ::popen(("promtool check metrics <" + file + " 2>&1").c_str(), "r");
    Judged judged;
    std::array<char, 4096> chunk;
    while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), pipe))
        judged.said.append(chunk.data(), n);
    const int status = ::pclose(pipe);
    judged.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return judged;
}
bool has_promtool()
{
    constexpr int kNotFound = 127;
    return promtool("").status != kNotFound;
}

TEST(DpctlMetrics, AreWhatPromtoolTakesWithoutARemark)
{
    if (!has_promtool()) GTEST_SKIP() << "promtool is not installed (package prometheus)";
    const FixtureDaemon daemon;
    const Ran ran = dpctl({"metrics", "--socket", daemon.socket()});
    ASSERT_EQ(ran.exit, 0) << ran.err;

    const Judged judged = promtool(ran.out);

    EXPECT_EQ(judged.status, 0) << ran.out;
    EXPECT_EQ(judged.said, "");
}

TEST(DpctlMetrics, OfHostileNamesAreWhatPromtoolTakes)
{
    if (!has_promtool()) GTEST_SKIP() << "promtool is not installed (package prometheus)";
    const std::string added = " \"Z\u00FCrich\"\\\x1B[2J\xFF\n# TYPE x y\n";
    Figures hostile = figures();
    hostile.version.version += added;
    hostile.status.bus.port += added;
    for (report::Station& station : hostile.status.stations) {
        station.name += added;
        station.state += added;
        station.drive.line += added;
    }
    hostile.counters.groups[1].name += added;
    for (report::CounterGroup& group : hostile.counters.groups)
        for (report::Counter& counter : group.counters) counter.meaning += added;

    const Judged judged = promtool(render_metrics(hostile, "/run/s" + added));

    EXPECT_EQ(judged.status, 0);
    EXPECT_EQ(judged.said, "");
}

TEST(DpctlMetrics, AreJudgedByAPromtoolThatFindsFaults)
{
    if (!has_promtool()) GTEST_SKIP() << "promtool is not installed (package prometheus)";
    const std::string good = render_metrics(figures(), "/run/s");

    EXPECT_NE(promtool(good + "dpslaved_up 1 2 3\n").status, 0) << "no sample";
    EXPECT_NE(promtool("# HELP calls Calls.\n# TYPE calls counter\ncalls 1\n").status, 0) << "no _total";
    EXPECT_NE(promtool("# HELP a_ms Times.\n# TYPE a_ms gauge\na_ms 1\n").status, 0) << "no base unit";
}

TEST(DpctlMetrics, AreTheThreeRepliesAsJson)
{
    const FixtureDaemon daemon;
    const Ran ran = dpctl({"metrics", "--json", "--socket", daemon.socket()});

    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(Json::parse(ran.out), Json::object({{"version", fixture("GetVersion")},
                                                  {"status", fixture("GetStatus")},
                                                  {"counters", fixture("GetCounters")}}));
}

std::string content_of(const std::filesystem::path& file)
{
    std::ostringstream all;
    all << std::ifstream{file}.rdbuf();
    return all.str();
}

TEST(DpctlMetrics, ReplaceTheFileThatWriteNamesAndLeaveNothingBeside)
{
    const FixtureDaemon daemon;
    const TempFolder folder;
    const auto file = folder.path() / "dpslaved.prom";
    std::ofstream{file} << "of before\n";

    const Ran ran = dpctl({"metrics", "--output", file, "--socket", daemon.socket()});

    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.out + ran.err, "");
    EXPECT_EQ(content_of(file), render_metrics(figures(), daemon.socket()));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder.path()}, {}), 1);
}

/// Its old content is seen until the whole new one is there: the file is another one from then on.
TEST(DpctlMetrics, AreNeverHalfWritten)
{
    const FixtureDaemon daemon;
    const TempFolder folder;
    const auto file = folder.path() / "dpslaved.prom";
    std::ofstream{file} << "of before\n";
    std::ifstream reader{file};

    ASSERT_EQ(dpctl({"metrics", "--output", file, "--socket", daemon.socket()}).exit, 0);

    std::ostringstream seen;
    seen << reader.rdbuf();
    EXPECT_EQ(seen.str(), "of before\n");
}

TEST(DpctlMetrics, SayInTheFileThatNoDaemonAnswers)
{
    const TempFolder folder;
    const auto file = folder.path() / "dpslaved.prom";
    std::ofstream{file} << "of before\n";

    const Ran ran = dpctl({"metrics", "--output", file, "--socket", "/nonexistent/s"});

    EXPECT_EQ(ran.exit, 3);
    EXPECT_THAT(ran.err, HasSubstr("nothing answers on /nonexistent/s"));
    EXPECT_EQ(content_of(file), dpctl::render_metrics_of_none("/nonexistent/s"));
}

TEST(DpctlMetrics, SayWhyTheFileCannotBeWritten)
{
    const FixtureDaemon daemon;

    const Ran ran = dpctl({"metrics", "--output", "/nonexistent/a.prom", "--socket", daemon.socket()});

    EXPECT_EQ(ran.exit, 1);
    EXPECT_EQ(ran.err, "dpctl: /nonexistent/a.prom: No such file or directory\n");
}

} // namespace
} // namespace dpslave::test
