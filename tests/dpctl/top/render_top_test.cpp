// SPDX-License-Identifier: Apache-2.0
// The screen of dpctl top as lines: pictures, sizes, text of others.
#include "dpctl/cli/columns.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/top/render_top.hpp"
#include "sightings.hpp"

#include "dpslave/base/printable.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>
#include <limits>

namespace dpslave::test {
namespace {

using dpctl::Json;
using dpctl::Key;
using dpctl::render_top;
using dpctl::render_top_whole;
using dpctl::ScreenSize;
using dpctl::TopLook;
using dpctl::TopState;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using Kind = Key::Kind;

class RenderTop : public testing::Test {
protected:
    void SetUp() override
    {
        ::setenv("TZ", "UTC0", 1);
        ::tzset();
    }
    void TearDown() override
    {
        ::unsetenv("TZ");
        ::tzset();
    }
};

std::string joined(const std::vector<std::string>& lines)
{
    std::string out;
    for (const std::string& line : lines) out += line + '\n';
    return out;
}

TEST_F(RenderTop, IsOneScreenWithMarksAtWhatHasChangedAndTheSelectedStation)
{
    EXPECT_EQ('\n' + joined(render_top(two_looks(), {80, 24}, {})), R"(
/dev/ttyS1, 187.5 kbit/s (DP_Control), last telegram 2 ms ago           04:15:12
telegrams 210.0/s, octets 4500.0/s, flaw: checksum 2.5/s
turnaround [#          .] 3 to 14 T_bit, p50 3, p99 14, last minute

    STATION   STATE      EXCH/s  DRIVE    READS/s  ADDR  MASTER  LINE
>   unwinder  Data_Exch   100.0  answers      8.0     5       2  p3
 *  rewinder  Data_Exch       -  silent         -    16       -  p3

unwinder: data_exchange 100.0/s, drive_reads 8.0/s
    DIR  TAG  NAME            VALUE   STATE        AGE    RAW
 *  in     7  SPEED FEEDBACK  51.00   good       12 ms  13ECh
    out   56                  -12.50  read only      -  FB1Eh

04:15:01.000 dpslaved 9.8.7 started
04:15:05.000 unwinder: Data_Exch with master 2
04:15:08.500 rewinder: Chk_Cfg of master 2 was refused (40 times)







q quit   up/down station 1/2   PgUp/PgDn values   / filter
)");
}

TEST_F(RenderTop, HasNoRatesBeforeTheSecondLook)
{
    const std::string screen = joined(render_top(one_look(), {80, 24}, {}));

    EXPECT_THAT(screen, HasSubstr("\nrates: with the next refresh\n"));
    EXPECT_THAT(screen, HasSubstr(", since the start\n"));
    EXPECT_THAT(screen, Not(HasSubstr("/s,")));
    EXPECT_THAT(screen, Not(HasSubstr("*")));
}

TEST_F(RenderTop, IntoAPipeHasTheValuesOfEachStationAndNoKeys)
{
    EXPECT_EQ('\n' + render_top_whole(two_looks(), {}), R"(
/dev/ttyS1, 187.5 kbit/s (DP_Control), last telegram 2 ms ago           04:15:12
telegrams 210.0/s, octets 4500.0/s, flaw: checksum 2.5/s
turnaround [#          .] 3 to 14 T_bit, p50 3, p99 14, last minute

    STATION   STATE      EXCH/s  DRIVE    READS/s  ADDR  MASTER  LINE
    unwinder  Data_Exch   100.0  answers      8.0     5       2  p3
 *  rewinder  Data_Exch       -  silent         -    16       -  p3

unwinder: data_exchange 100.0/s, drive_reads 8.0/s
    DIR  TAG  NAME            VALUE   STATE        AGE    RAW
 *  in     7  SPEED FEEDBACK  51.00   good       12 ms  13ECh
    out   56                  -12.50  read only      -  FB1Eh

04:15:01.000 dpslaved 9.8.7 started
04:15:05.000 unwinder: Data_Exch with master 2
04:15:08.500 rewinder: Chk_Cfg of master 2 was refused (40 times)
)");
}

TEST_F(RenderTop, NeverHasMoreLinesOrColumnsThanTheTerminal)
{
    const std::vector<TopState> states{one_look(), two_looks(), many_stations(126, 24), many_stations(0, 0),
                                       many_stations(1, 0)};
    for (const TopState& state : states)
        for (const std::size_t columns : {0U, 1U, 5U, 20U, 39U, 80U, 200U})
            for (std::size_t rows = 0; rows < 60; ++rows) {
                const auto lines = render_top(state, {columns, rows}, {});
                ASSERT_LE(lines.size(), rows) << columns;
                for (const std::string& line : lines)
                    ASSERT_LE(dpctl::columns_of(line), columns) << rows << " rows: " << line;
            }
}

TEST_F(RenderTop, ShowsTheSelectedStationAmongManyAndItsValues)
{
    TopState state = many_stations(126, 24);
    for (int i = 0; i < 70; ++i) state.on_key({Kind::down, {}});

    for (const std::size_t rows : {8U, 12U, 24U, 50U}) {
        const auto lines = render_top(state, {80, rows}, {});
        EXPECT_THAT(lines, Contains(HasSubstr(">   station 70 "))) << rows;
        EXPECT_THAT(lines, Contains(HasSubstr("station 71/126"))) << rows;
    }
    EXPECT_THAT(render_top(state, {80, 24}, {}), Contains("station 70"));
}

TEST_F(RenderTop, ShowsTheStationsFirstWhereThereIsLittleRoom)
{
    const auto lines = render_top(two_looks(), {80, 3}, {});
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_THAT(lines[1], HasSubstr("unwinder"));
    EXPECT_THAT(lines[2], HasSubstr("rewinder"));
}

TEST_F(RenderTop, ScrollsTheValuesToTheLastAndNoFurther)
{
    TopState state = many_stations(1, 24);
    EXPECT_THAT(render_top(state, {80, 24}, {}), Contains(HasSubstr("tag 0 ")));
    for (int i = 0; i < 9; ++i) state.on_key({Kind::page_down, {}});

    const auto lines = render_top(state, {80, 24}, {});

    EXPECT_THAT(lines, Contains(HasSubstr("tag 23 ")));
    EXPECT_THAT(lines, Contains(HasSubstr("tag 20 "))) << "the page stays full";
    EXPECT_THAT(lines, Not(Contains(HasSubstr("tag 0 "))));
}

TEST_F(RenderTop, ShowsTheFilterWhileItIsTypedAndAfterwards)
{
    TopState state = one_look();
    state.on_key({Kind::character, "/"});
    state.on_key({Kind::character, "y"});
    EXPECT_THAT(render_top(state, {80, 24}, {}).back(), HasSubstr("filter: y_"));
    EXPECT_THAT(render_top(state, {80, 24}, {}),
                Contains("  no station has this in its name or in those of its tags"));

    state.on_key({Kind::enter, {}});

    EXPECT_THAT(render_top(state, {80, 24}, {}).back(), HasSubstr("/ filter (y)"));
}

TEST_F(RenderTop, WritesNothingThatMovesTheCursorWhateverTheDaemonSays)
{
    const std::string evil = "\x1B[2J\u009B31m\u202E\r\n\t\u4E2D\xFF";
    const auto marked = [&](auto self, Json value) -> Json {
        if (value.is_string()) return dpctl::printable_texts(value.get<std::string>() + evil);
        if (value.is_structured())
            for (Json& item : value) item = self(self, std::move(item));
        return value;
    };
    const auto of = [&](const char* method) { return marked(marked, fixture(method)); };
    dpctl::Sighting one{std::chrono::seconds{1}, 1'795'580'110,
                        report::read<report::GetStatusReply>(of("GetStatus")),
                        report::read<report::GetCountersReply>(of("GetCounters")),
                        report::read<report::GetIoReply>(of("GetIo"))};
    TopState state;
    state.add(one, report::read<report::GetEventsReply>(of("GetEvents")));

    for (const std::size_t columns : {10U, 33U, 80U, 200U}) {
        for (const std::string& line : render_top(state, {columns, 40}, {}))
            EXPECT_EQ(line, printable(line)) << columns << " columns";
        for (const std::string& line : render_top(state, {columns, 40}, {}))
            EXPECT_LE(dpctl::columns_of(line), columns) << line;
    }
}

TEST_F(RenderTop, HasColoursOnlyWhereTheyAreWanted)
{
    const std::string with = joined(render_top(two_looks(), {80, 24}, {{true, 80}, true}));
    EXPECT_THAT(with, HasSubstr("\033[32mData_Exch\033[0m"));
    EXPECT_THAT(with, HasSubstr("\033[31mread only\033[0m"));
    EXPECT_THAT(with, HasSubstr("[█"));
    EXPECT_THAT(joined(render_top(two_looks(), {80, 24}, {})), Not(HasSubstr("\033")));
}

TEST_F(RenderTop, TakesNumbersThatCannotBe)
{
    dpctl::Sighting one = sighting(0);
    one.unix_seconds = -1e300;
    one.status.bus.last_telegram_age_ms = 1e300;
    one.io.stations[0].words[0].raw = -1;
    TopState state;
    state.add(one, past_events());
    one.at += std::chrono::nanoseconds{1};
    counter(one, 0, "telegrams").value = std::numeric_limits<std::int64_t>::max();
    state.add(one, {});

    EXPECT_EQ(render_top(state, {80, 24}, {}).size(), 24u);
}

} // namespace
} // namespace dpslave::test
