// SPDX-License-Identifier: Apache-2.0
// Tests what the commands that watch ask the daemon: events, names of tags, the level of the log.
#include "app/calls/event_streams.hpp"
#include "app/calls/tag_names.hpp"
#include "app/log/log_level.hpp"
#include "app/state/recent_events.hpp"
#include "control/interface.hpp"

#include <gmock/gmock.h>

#include <set>

namespace dpslave::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;

constexpr Instant kStart{seconds{1000}};

// ---------------------------------------------------------------- events

std::vector<std::string> texts(const RecentEvents& history)
{
    std::vector<std::string> all;
    for (const auto& one : history.events()) all.push_back(one.text);
    return all;
}

TEST(RecentEvents, HasTheNewestLastWithNumbersFrom1)
{
    RecentEvents history;
    history.add(Happened::state, "unwinder", "first", kStart);
    history.add(Happened::port, {}, "second", kStart + seconds{1});

    EXPECT_THAT(texts(history), ElementsAre("first", "second"));
    EXPECT_EQ(history.events().front().number, 1u);
    EXPECT_EQ(history.events().back().number, 2u);
    EXPECT_EQ(history.newest(), 2u);
}

TEST(RecentEvents, KeepsTheLastThousand)
{
    RecentEvents history;
    for (int i = 1; i <= 1003; ++i) history.add(Happened::write, {}, std::to_string(i), kStart);

    EXPECT_EQ(history.events().size(), 1000u);
    EXPECT_EQ(history.events().front().text, "4");
    EXPECT_EQ(history.events().back().text, "1003");
}

TEST(RecentEvents, CountsEqualOnesWithinTenSecondsOfTheFirst)
{
    RecentEvents history;
    for (int i = 0; i < 11; ++i) {
        history.add(Happened::refused, "unwinder", "got " + std::to_string(i), "cause", kStart + seconds{i});
        history.add(Happened::refused, "rewinder", "other station", "cause", kStart + seconds{i});
    }

    ASSERT_EQ(history.events().size(), 4u);
    EXPECT_EQ(history.events()[0].count, 10u);
    EXPECT_EQ(history.events()[0].text, "got 9") << "the newest text stands";
    EXPECT_EQ(history.events()[0].at, kStart) << "at the time of the first";
    EXPECT_EQ(history.events()[2].count, 1u) << "ten seconds later it is another one";
}

TEST(RecentEvents, HasWhatGoesAndComesBackInItsOrder)
{
    RecentEvents history;
    for (const char* text : {"answers", "silent", "answers", "answers"})
        history.add(Happened::drive, "unwinder", text, kStart);
    history.add(Happened::state, "unwinder", "other kind", kStart);
    history.add(Happened::drive, "unwinder", "answers", kStart);

    EXPECT_THAT(texts(history), ElementsAre("answers", "silent", "answers", "other kind"));
    EXPECT_EQ(history.events()[2].count, 3u);
}

TEST(RecentEvents, OfWhatGoesBackAndForthWithoutEndHasAFewInTenSeconds)
{
    RecentEvents history;
    for (int i = 0; i < 1000; ++i)
        history.add(Happened::state, "unwinder", i % 2 == 0 ? "Sync" : "Unsync", kStart + milliseconds{i});

    ASSERT_EQ(history.events().size(), 8u);
    EXPECT_EQ(history.events()[6].count + history.events()[7].count, 994u);
}

TEST(RecentEvents, CutsATextAndShowsNoControlCharacter)
{
    RecentEvents history;
    std::string longer;
    for (int i = 0; i < 300; ++i) longer += "\u00FC";
    history.add(Happened::device, {}, longer, kStart);
    history.add(Happened::device, {}, "a\nb", kStart);

    EXPECT_EQ(history.events()[0].text, longer.substr(0, 400) + " ...") << "in whole characters";
    EXPECT_EQ(history.events()[1].text, "a\\x0Ab");
}

TEST(RecentEvents, HasAWordOfItsOwnForEachKind)
{
    std::set<std::string_view> codes;
    for (const Happened kind :
         {Happened::state, Happened::refused, Happened::drive, Happened::device, Happened::port,
          Happened::write, Happened::setting, Happened::reload, Happened::daemon})
        codes.insert(code(kind));

    EXPECT_EQ(codes, (std::set<std::string_view>{"state", "refused", "drive", "device", "port", "write",
                                                 "setting", "reload", "daemon"}));
}

TEST(EventsReport, HasThoseBehindANumberAndOfOneStation)
{
    RecentEvents history;
    history.add(Happened::state, "unwinder", "one", kStart);
    history.add(Happened::state, "rewinder", "two", kStart);
    history.add(Happened::reload, {}, "three", kStart + seconds{2});

    const auto all = events_report(history, 1, {}, kStart + seconds{3});
    EXPECT_EQ(control::reply_mismatch("GetEvents", report::json_of(all)), std::nullopt);
    ASSERT_EQ(all.events.size(), 2u);
    EXPECT_EQ(all.events[0].text, "two");
    EXPECT_EQ(all.events[0].station, "rewinder");
    EXPECT_EQ(all.events[0].age_ms, 3000);
    EXPECT_EQ(all.events[1].station, std::nullopt);
    EXPECT_EQ(all.events[1].kind, "reload");
    EXPECT_EQ(all.newest, 3);
    EXPECT_EQ(all.lost, 0);

    const auto own = events_report(history, 0, "unwinder", kStart);
    ASSERT_EQ(own.events.size(), 1u);
    EXPECT_EQ(own.events[0].text, "one");
}

TEST(EventsReport, SaysHowManyTheListHasNoLonger)
{
    RecentEvents history;
    for (int i = 1; i <= 1010; ++i) history.add(Happened::write, {}, std::to_string(i), kStart);

    EXPECT_EQ(events_report(history, 0, {}, kStart).lost, 10);
    EXPECT_EQ(events_report(history, 4, {}, kStart).lost, 6);
    EXPECT_EQ(events_report(history, 10, {}, kStart).lost, 0);
    EXPECT_EQ(events_report(history, 2000, {}, kStart).lost, 0);
    EXPECT_EQ(events_report(RecentEvents{}, 0, {}, kStart).lost, 0);
}

// ---------------------------------------------------------------- names of tags

drive::Tag tag(std::uint16_t number, std::string name, std::vector<std::string> aliases = {})
{
    drive::Tag row;
    row.number = number;
    row.name = std::move(name);
    row.aliases = std::move(aliases);
    return row;
}

std::vector<int> called(std::string_view name)
{
    static const drive::TagTable table{{tag(1, "Speed feedback"), tag(2, "Speed"),
                                        tag(3, "SPEED DEMAND", {"Ref"}), tag(4, ""), tag(5, "Torque")}};
    std::vector<int> numbers;
    for (const drive::Tag* one : tags_called(table, name)) numbers.push_back(one->number);
    return numbers;
}

TEST(TagsCalled, AreThoseThatHaveThePartInAnyCase)
{
    EXPECT_THAT(called("FEED"), ElementsAre(1));
    EXPECT_THAT(called("speed "), ElementsAre(1, 3));
    EXPECT_THAT(called("colour"), ElementsAre());
}

TEST(TagsCalled, AreOnlyThoseWhoseWholeNameItIsWhereThereAreAny)
{
    EXPECT_THAT(called("speed"), ElementsAre(2));
    EXPECT_THAT(called("speed demand"), ElementsAre(3));
    EXPECT_THAT(called("ref"), ElementsAre(3)) << "another name of it";
}

TEST(TagsCalled, MayHaveUnderscoresOrHyphensForBlanks)
{
    EXPECT_THAT(called("speed_demand"), ElementsAre(3));
    EXPECT_THAT(called("Speed-Feedback"), ElementsAre(1));
}

TEST(TagsCalled, AreAllThatHaveANameWithoutOne)
{
    EXPECT_THAT(called(""), ElementsAre(1, 2, 3, 5));
}

// ---------------------------------------------------------------- the level of the log

TEST(LogLevel, FallsBackByItselfOnce)
{
    LogLevel level;
    EXPECT_FALSE(level.is_debug());
    EXPECT_FALSE(level.falls_back(kStart));

    level.set_debug(kStart + seconds{10});
    EXPECT_TRUE(level.is_debug());
    EXPECT_FALSE(level.falls_back(kStart + milliseconds{9999}));
    EXPECT_TRUE(level.falls_back(kStart + seconds{10}));
    EXPECT_FALSE(level.is_debug());
    EXPECT_FALSE(level.falls_back(kStart + seconds{11}));
}

TEST(LogLevel, AskedTwiceEndsAsTheSecondCallSaysAndIsInfoThen)
{
    LogLevel level;
    level.set_debug(kStart + seconds{10});
    level.set_debug(kStart + seconds{60});

    EXPECT_FALSE(level.falls_back(kStart + seconds{10}));
    EXPECT_EQ(level.ends(), kStart + seconds{60});
    EXPECT_TRUE(level.falls_back(kStart + seconds{60}));
    EXPECT_EQ(level.ends(), std::nullopt);
}

TEST(LogLevel, SetToInfoHasNothingLeftToEnd)
{
    LogLevel level;
    level.set_debug(kStart + seconds{10});
    level.set_info();

    EXPECT_FALSE(level.falls_back(kStart + seconds{10}));
}

} // namespace
} // namespace dpslave::app
