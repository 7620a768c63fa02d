// SPDX-License-Identifier: Apache-2.0
// Tests which incidents are kept, on a simulated clock.
#include "app/incident/book.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace dpslave::app {
namespace {

using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using testing::ElementsAre;
using Verdict = IncidentBook::Verdict;

/// A book and a clock; CLOCK_REALTIME is that of the bus here.
class IncidentBookTest : public testing::Test {
protected:
    Verdict happens(const std::string& reason, const std::string& station = "unwinder")
    {
        return book.happened({IncidentKind::left, station, reason}, station + " left: " + reason, now,
                             now.time_since_epoch().count());
    }
    /// One after the other, each as long after the one before that none is refused.
    void happen(int count, const std::string& reason)
    {
        for (int i = 0; i < count; ++i) {
            ASSERT_EQ(happens(reason + std::to_string(i)), Verdict::opened) << i;
            pass(minutes{2});
        }
    }
    void pass(std::chrono::nanoseconds time)
    {
        now += time;
        book.is_complete(now);
    }
    std::vector<std::uint64_t> numbers() const
    {
        std::vector<std::uint64_t> all;
        for (const Incident& one : book.kept()) all.push_back(one.number);
        return all;
    }

    IncidentBook book;
    Instant now{hours{24}};
};

TEST_F(IncidentBookTest, KeepsAnIncidentOfTwelveHoursAgoThroughADayOfCalmTraffic)
{
    ASSERT_EQ(happens("watchdog"), Verdict::opened);
    for (int second = 0; second < 24 * 3600; ++second) pass(seconds{1});

    ASSERT_EQ(book.kept().size(), 1U);
    EXPECT_EQ(book.kept()[0].key.reason, "watchdog");
    EXPECT_EQ(book.kept()[0].count, 1U);
}

TEST_F(IncidentBookTest, KeepsAnIncidentOfTwelveHoursAgoThroughAStormOfOthers)
{
    ASSERT_EQ(happens("watchdog"), Verdict::opened);
    pass(hours{12});
    for (int i = 0; i < 100'000; ++i) { // 28 hours, each another one
        happens("other " + std::to_string(i));
        pass(seconds{1});
    }

    ASSERT_EQ(book.kept().size(), IncidentBook::kFirst + IncidentBook::kLast);
    EXPECT_EQ(book.kept()[0].key.reason, "watchdog");
    EXPECT_GT(book.not_kept(), 0U);
}

/// What a book has that has been there for long: its first places are taken, and a day without incidents.
class IncidentOfTwelveHoursAgo : public IncidentBookTest {
protected:
    void SetUp() override
    {
        happen(8, "of last year ");
        pass(hours{24 * 300});
        ASSERT_EQ(happens("watchdog"), Verdict::opened);
        pass(hours{12});
    }
    /// One a second, each of them another one of `different`.
    void storm(seconds time, int different, const std::string& name)
    {
        for (int i = 0; i < time.count(); ++i) {
            happens(name + std::to_string(i % different));
            pass(seconds{1});
        }
    }
    bool is_kept(const std::string& reason) const
    {
        return std::any_of(book.kept().begin(), book.kept().end(),
                           [&](const Incident& one) { return one.key.reason == reason; });
    }
};

TEST_F(IncidentOfTwelveHoursAgo, IsKeptThroughADayOfCalmTraffic)
{
    for (int second = 0; second < 24 * 3600; ++second) pass(seconds{1});

    EXPECT_TRUE(is_kept("watchdog"));
}

TEST_F(IncidentOfTwelveHoursAgo, IsKeptThroughAStormOfDifferentOnesHoweverLong)
{
    storm(hours{28}, 1'000'000, "storm ");

    EXPECT_TRUE(is_kept("watchdog"));
    EXPECT_TRUE(is_kept("storm 0")) << "what it began with";
    EXPECT_TRUE(is_kept(book.kept().back().key.reason));
    EXPECT_EQ(book.kept().size(), IncidentBook::kFirst + IncidentBook::kLast);
}

TEST_F(IncidentOfTwelveHoursAgo, IsKeptThroughAStormOfHundredsOfAFewKinds)
{
    storm(hours{28}, 300, "storm ");

    EXPECT_TRUE(is_kept("watchdog"));
}

TEST_F(IncidentOfTwelveHoursAgo, IsKeptThroughStormAfterStorm)
{
    for (int one = 0; one < 20; ++one) {
        storm(minutes{40}, 1'000'000, "storm " + std::to_string(one) + " ");
        pass(hours{2});
    }

    EXPECT_TRUE(is_kept("watchdog"));
}

TEST_F(IncidentOfTwelveHoursAgo, IsKeptIfItWasInTheMiddleOfAStormAndAnotherOneComes)
{
    happen(6, "the same ");
    ASSERT_EQ(happens("in the middle"), Verdict::opened);
    pass(minutes{2});
    happen(4, "the same too ");
    pass(hours{12});
    storm(hours{28}, 1'000'000, "storm ");

    EXPECT_TRUE(is_kept("in the middle"));
    EXPECT_TRUE(is_kept("watchdog"));
}

TEST_F(IncidentOfTwelveHoursAgo, IsKeptThroughAStormThatGoesOnAfterARestart)
{
    storm(hours{3}, 1'000'000, "before ");
    const std::vector<Incident> of_the_folder = book.kept();
    book = IncidentBook{};
    book.restore(of_the_folder, 0);
    storm(hours{28}, 1'000'000, "behind ");

    EXPECT_TRUE(is_kept("watchdog"));
    EXPECT_TRUE(is_kept("before 0"));
    EXPECT_FALSE(is_kept("behind 0")) << "it is the same storm";
}

TEST_F(IncidentOfTwelveHoursAgo, IsKeptHoweverOtherOnesAreSpreadOverTheseHours)
{
    for (const auto distance : {seconds{61}, seconds{3599}, seconds{3600}, seconds{3601}}) {
        const std::string name = std::to_string(distance.count());
        ASSERT_EQ(happens("of " + name), Verdict::opened);
        for (auto time = distance; time <= hours{12}; time += distance) {
            pass(distance);
            happens(name + " other " + std::to_string(time.count()));
        }
        EXPECT_TRUE(is_kept("of " + name));
        pass(hours{12});
    }
}

TEST_F(IncidentOfTwelveHoursAgo, MakesRoomWhen24OthersHaveComeEachAfterAnHourOfCalm)
{
    for (int i = 0; i < 23; ++i, pass(hours{1}))
        ASSERT_EQ(happens("rare " + std::to_string(i)), Verdict::opened);
    EXPECT_TRUE(is_kept("watchdog"));
    ASSERT_EQ(happens("rare 23"), Verdict::opened);

    EXPECT_FALSE(is_kept("watchdog"));
    EXPECT_TRUE(is_kept("rare 0"));
}

TEST_F(IncidentBookTest, KeepsTheFirst8AndTheLast24AndSaysWhichFilesCanGo)
{
    happen(34, "reason ");

    ASSERT_EQ(book.kept().size(), 32U);
    EXPECT_EQ(book.kept()[7].number, 8U);
    EXPECT_EQ(book.kept()[8].number, 11U);
    EXPECT_EQ(book.kept()[31].number, 34U);
    EXPECT_THAT(book.take_dropped(), ElementsAre(9, 10));
    EXPECT_THAT(book.take_dropped(), ElementsAre());
}

TEST_F(IncidentBookTest, CountsEqualOnesOnTheOneThatIsKept)
{
    const auto first = now;
    ASSERT_EQ(happens("watchdog"), Verdict::opened);
    for (int i = 0; i < 1000; ++i) {
        pass(seconds{10});
        ASSERT_EQ(happens("watchdog"), Verdict::counted);
    }

    ASSERT_EQ(book.kept().size(), 1U);
    EXPECT_EQ(book.kept()[0].count, 1001U);
    EXPECT_EQ(book.kept()[0].first_unix_ns, first.time_since_epoch().count());
    EXPECT_EQ(book.kept()[0].last_unix_ns, now.time_since_epoch().count());
    EXPECT_TRUE(book.take_counts_changed());
    EXPECT_FALSE(book.take_counts_changed());
}

TEST_F(IncidentBookTest, TakesAnotherStationAnotherReasonOrAnotherKindForAnotherIncident)
{
    EXPECT_EQ(happens("watchdog"), Verdict::opened);
    pass(seconds{3});
    EXPECT_EQ(happens("watchdog", "rewinder"), Verdict::opened);
    pass(seconds{3});
    EXPECT_EQ(happens("unlock"), Verdict::opened);
    pass(seconds{3});
    EXPECT_EQ(book.happened({IncidentKind::refused, "unwinder", "watchdog"}, "", now, 0), Verdict::opened);
}

TEST_F(IncidentBookTest, TakesWhatHappensWithinTheTimeOfAnIncidentAsAPartOfIt)
{
    ASSERT_EQ(happens("watchdog"), Verdict::opened);
    for (int i = 0; i < 124; ++i) EXPECT_EQ(happens("watchdog", std::to_string(i)), Verdict::joined);

    ASSERT_EQ(book.kept().size(), 1U);
    EXPECT_EQ(book.kept()[0].also.size(), IncidentBook::kMostAlso);
    pass(hours{24}); // the next night
    EXPECT_EQ(happens("watchdog", "3"), Verdict::counted) << "it was a part of the one that is kept";
}

TEST_F(IncidentBookTest, IsCompleteOnceWhenTheTimeAfterItIsOver)
{
    ASSERT_EQ(happens("watchdog"), Verdict::opened);
    ASSERT_NE(book.opened(), nullptr);
    EXPECT_FALSE(book.is_complete(now + IncidentBook::kAfter));
    EXPECT_TRUE(book.is_complete(now + IncidentBook::kAfter + std::chrono::milliseconds{1}));
    EXPECT_FALSE(book.is_complete(now + seconds{10}));
    EXPECT_EQ(book.opened(), nullptr);
}

TEST_F(IncidentBookTest, Opens8InARowAndThenOneAMinute)
{
    int opened = 0;
    for (int i = 0; i < 3600; ++i, pass(seconds{3}))
        opened += happens("reason " + std::to_string(i)) == Verdict::opened ? 1 : 0;

    EXPECT_GE(opened, 8 + 179);
    EXPECT_LE(opened, 8 + 180);
    EXPECT_EQ(book.not_kept(), 3600U - static_cast<unsigned>(opened));
}

TEST_F(IncidentBookTest, GoesOnWithItsNumbersAfterARestart)
{
    book.restore({{.number = 9, .key = {IncidentKind::left, "unwinder", "unlock"}, .text = {}, .count = 5},
                  {.number = 2, .key = {IncidentKind::left, "unwinder", "watchdog"}, .text = {}}},
                 12);

    EXPECT_THAT(numbers(), ElementsAre(2, 9));
    EXPECT_EQ(happens("unlock"), Verdict::counted);
    EXPECT_EQ(book.find(9)->count, 6U);
    EXPECT_EQ(happens("stop"), Verdict::opened);
    EXPECT_THAT(numbers(), ElementsAre(2, 9, 12)) << "11 was there, and is not kept any more";
}

TEST_F(IncidentBookTest, OfAFolderWithTooManyDropsThoseInTheMiddle)
{
    std::vector<Incident> found(40);
    for (std::size_t i = 0; i < found.size(); ++i) found[i].number = 40 - i;
    book.restore(found, 1);

    EXPECT_EQ(book.kept().size(), 32U);
    EXPECT_THAT(book.take_dropped(), ElementsAre(9, 10, 11, 12, 13, 14, 15, 16));
    EXPECT_EQ(book.next_number(), 41U);
}

TEST_F(IncidentBookTest, TriesAnEqualOneAgainWhenTheFileCouldNotBeWritten)
{
    ASSERT_EQ(happens("watchdog"), Verdict::opened);
    book.forget(1);

    EXPECT_EQ(book.opened(), nullptr);
    EXPECT_EQ(happens("watchdog"), Verdict::opened);
    EXPECT_THAT(numbers(), ElementsAre(2));
}

TEST(IncidentKind, HasACodeThatIsReadBack)
{
    for (const auto kind : {IncidentKind::left, IncidentKind::refused, IncidentKind::flaws,
                            IncidentKind::drive, IncidentKind::answer})
        EXPECT_EQ(incident_kind(code(kind)), kind);
    EXPECT_EQ(incident_kind("other"), std::nullopt);
}

} // namespace
} // namespace dpslave::app
