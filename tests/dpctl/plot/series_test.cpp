// SPDX-License-Identifier: Apache-2.0
// Samples as a series: what stands when, what is missing, and the axes.
#include "dpctl/plot/axis.hpp"
#include "dpctl/plot/series.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>

namespace dpslave::dpctl {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kNow = 1'700'000'100'000; ///< 2023-11-14 22:15:00 UTC

class PlotSeries : public testing::Test {
protected:
    PlotSeries()
    {
        ::setenv("TZ", "UTC0", 1);
        ::tzset();
    }
    static report::GetSamplesReply reply(std::vector<report::Sample> samples)
    {
        report::GetSamplesReply one;
        one.tag = 7;
        one.name = "SPEED";
        one.direction = "in";
        one.samples = std::move(samples);
        one.oldest_unix_ms = kNow - 1'000'000;
        one.now_unix_ms = kNow;
        return one;
    }
    static report::Sample sample(std::int64_t ms_ago, const char* state, double scaled)
    {
        return {.unix_ms = kNow - ms_ago, .state = state, .scaled = scaled, .value = "v"};
    }
    /// "from-to mark value", with the times in ms before now.
    static std::vector<std::string> standing(const Series& series, std::int64_t last_ms)
    {
        std::vector<std::string> all;
        for_each_standing(series, {kNow - last_ms, kNow}, [&](const Point& point, Span span) {
            const char* const marks[] = {"none", "good", "held", "failed"};
            all.push_back(std::to_string(kNow - span.from_ms) + "-" + std::to_string(kNow - span.to_ms) +
                          " " + marks[static_cast<int>(point.mark)] + " " +
                          std::to_string(static_cast<int>(point.scaled)));
        });
        return all;
    }
};

TEST_F(PlotSeries, HasEachValueUntilTheNextOne)
{
    const Series series = series_of({reply({sample(9000, "good", 1), sample(5000, "good", 2)})});

    EXPECT_THAT(standing(series, 10'000),
                ElementsAre("10000-9000 none 0", "9000-5000 good 1", "5000-0 good 2"));
    EXPECT_THAT(standing(series, 6000), ElementsAre("6000-5000 good 1", "5000-0 good 2"))
        << "the one before stands when the time begins";
}

TEST_F(PlotSeries, MarksWhatIsHeldAndWhatIsRefused)
{
    const Series series = series_of(
        {reply({sample(9000, "stale", 1), sample(8000, "out_of_range", 2), sample(7000, "untried", 0),
                sample(6000, "unscaled", 0), sample(5000, "none", 0)})});

    EXPECT_THAT(standing(series, 9000),
                ElementsAre("9000-8000 held 1", "8000-7000 failed 2", "7000-6000 none 0",
                            "6000-5000 failed 0", "5000-0 none 0"));
}

TEST_F(PlotSeries, HasAGapWhereALaterReplyHasLostSamples)
{
    report::GetSamplesReply second = reply({sample(2000, "good", 2)});
    second.lost = 40;
    const Series series = series_of({reply({sample(9000, "good", 0), sample(8000, "good", 1)}), second});

    EXPECT_THAT(standing(series, 9000), ElementsAre("9000-8000 good 0", "8000-2000 none 0", "2000-0 good 2"));
}

TEST_F(PlotSeries, TakesTimesAndValuesThatCannotBe)
{
    const Series series =
        series_of({reply({sample(-5000, "good", 1e300), sample(9000, "good", -1e300), sample(0, "", 0)})});

    ASSERT_EQ(series.points.size(), 3U);
    for (const Point& point : series.points) EXPECT_EQ(point.unix_ms, kNow) << "no time runs backwards";
    EXPECT_THAT(standing(series, 1000), ElementsAre("1000-0 none 0"));
    EXPECT_THAT(standing(series_of({reply({})}), 1000), ElementsAre("1000-0 none 0"));
}

TEST_F(PlotSeries, SaysWhatDidNotFitAndWhereThereIsNothing)
{
    report::GetSamplesReply first =
        reply({sample(9000, "good", 0), sample(8000, "none", 0), sample(6000, "good", 0)});
    first.lost = 5;
    first.oldest_unix_ms = kNow - 9000;
    Plot plot{"unwinder", {kNow - 60'000, kNow}, {series_of({first})}, {}};

    EXPECT_THAT(notes_of(plot, {first}),
                ElementsAre("Older samples did not fit: they reach back to 22:14:51 (samples_kib in [trace] "
                            "sets the size)",
                            "Tag 7 has no values 22:14:00 to 22:14:51, 22:14:52 to 22:14:54"));
    report::GetSamplesReply second = first;
    second.tag = 8;
    plot.series.push_back(series_of({second}));
    EXPECT_THAT(notes_of(plot, {first, second}).back(),
                "Tags 7, 8 have no values 22:14:00 to 22:14:51, 22:14:52 to 22:14:54")
        << "once for those of one layout";
    plot.time.from_ms = kNow - 5000;
    EXPECT_THAT(notes_of(plot, {first}), IsEmpty()) << "all that was asked for is there";
}

TEST_F(PlotSeries, HasRoundNumbersOnItsAxes)
{
    const auto labels = [](double lowest, double highest, std::size_t most) {
        const ValueAxis axis = value_axis(lowest, highest, most);
        std::vector<std::string> all;
        for (const double tick : axis.ticks()) all.push_back(axis.label(tick));
        return all;
    };
    EXPECT_THAT(labels(0, 10, 6), ElementsAre("0", "2", "4", "6", "8", "10"));
    EXPECT_THAT(labels(-0.3, 0.25, 4), ElementsAre("-0.4", "-0.2", "0.0", "0.2", "0.4"));
    EXPECT_THAT(labels(12.5, 12.5, 3), ElementsAre("10", "12", "14")) << "a value that stands still";
    EXPECT_THAT(labels(0, 65'535, 3), ElementsAre("0", "50000", "100000"));
    EXPECT_THAT(time_ticks(kNow - 600'000, kNow, 6),
                ElementsAre(kNow - 540'000, kNow - 420'000, kNow - 300'000, kNow - 180'000, kNow - 60'000))
        << "22:06, 22:08 ... 22:14";
    EXPECT_LE(time_ticks(0, std::int64_t{3600} * 24 * 30 * 1000, 9).size(), 10U);
    EXPECT_EQ(utc_time(kNow + 7), "2023-11-14T22:15:00.007Z");
}

} // namespace
} // namespace dpslave::dpctl
