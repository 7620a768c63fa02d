// SPDX-License-Identifier: Apache-2.0
// Which incidents are kept, on a simulated clock.
#include "app/incident/book.hpp"

#include <gmock/gmock.h>

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
