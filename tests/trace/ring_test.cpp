// SPDX-License-Identifier: Apache-2.0
#include "dpslave/trace/ring.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

using namespace dpslave;
using namespace dpslave::trace;
using testing::ElementsAre;

namespace {

using From = Ring::Reader::From;

Record record(std::initializer_list<std::uint8_t> octets, Kind kind = Kind::heard)
{
    Record one{.head = {.kind = kind}};
    one.octets.assign(Bytes{octets.begin(), octets.size()});
    return one;
}

void put_into(Ring& ring, const Record& one)
{
    ring.put(one.head, one.octets);
}

/// All octets of one value, which its length also follows from.
Record of_number(std::uint64_t number)
{
    Record one;
    one.head.at = Instant{std::chrono::nanoseconds{static_cast<std::int64_t>(number)}};
    for (std::uint64_t i = 0; i < number % 300; ++i) one.octets.push(static_cast<std::uint8_t>(number));
    return one;
}

/// Whether a record is one of of_number(), whole.
bool is_whole(const Record& one)
{
    const auto number = static_cast<std::uint64_t>(one.head.at.time_since_epoch().count());
    return one.number == number && one.octets == of_number(number).octets;
}

TEST(TraceRing, GivesRecordsAsTheyWerePut)
{
    Ring ring{Ring::kLeast};
    Record put = record({1, 2, 3, 4, 5, 6, 7, 8, 9}, Kind::unanswered);
    put.head.detail = 4;
    put.head.rate = 6;
    put.head.address = 126;
    put.head.more_follows = true;
    put.head.at = Instant{std::chrono::nanoseconds{-5}};
    put.head.begun = Instant{std::chrono::hours{1000}};
    put_into(ring, put);
    Ring::Reader reader{ring};
    Record got;

    ASSERT_TRUE(reader.next(got));

    EXPECT_EQ(got.head.kind, Kind::unanswered);
    EXPECT_EQ(got.head.detail, 4);
    EXPECT_EQ(got.head.rate, 6);
    EXPECT_EQ(got.head.address, 126);
    EXPECT_TRUE(got.head.more_follows);
    EXPECT_EQ(got.head.at, put.head.at);
    EXPECT_EQ(got.head.begun, put.head.begun);
    EXPECT_EQ(got.octets, put.octets);
    EXPECT_FALSE(reader.next(got));
}

TEST(TraceRing, KeepsTheNewestAndCountsWhatAReaderHasMissed)
{
    Ring ring{Ring::kLeast};
    Ring::Reader reader{ring};
    for (std::uint64_t i = 0; i < 1000; ++i) put_into(ring, of_number(i));
    Record got;
    std::uint64_t read = 0;

    for (; reader.next(got); ++read) EXPECT_TRUE(is_whole(got));

    EXPECT_EQ(got.number, 999U);
    EXPECT_GT(read, 5U);
    EXPECT_EQ(reader.lost(), 0U) << "it did not say from which record on it wants them";
}

TEST(TraceRing, AReaderFromTheOldestMissesNothingThatWasThereBefore)
{
    Ring ring{Ring::kLeast};
    Record got;
    put_into(ring, record({1}));
    Ring::Reader reader{ring};
    put_into(ring, record({2}));

    ASSERT_TRUE(reader.next(got));
    EXPECT_THAT(got.octets.bytes(), ElementsAre(1));
    ASSERT_TRUE(reader.next(got));
    EXPECT_THAT(got.octets.bytes(), ElementsAre(2));
    EXPECT_EQ(reader.lost(), 0U);
}

TEST(TraceRing, AReaderFromTheNewestGetsWhatIsPutFromNowOn)
{
    Ring ring{Ring::kLeast};
    Record got;
    put_into(ring, record({1}));
    Ring::Reader reader{ring, From::newest};
    EXPECT_FALSE(reader.next(got));
    put_into(ring, record({2}));

    ASSERT_TRUE(reader.next(got));

    EXPECT_THAT(got.octets.bytes(), ElementsAre(2));
    EXPECT_EQ(got.number, 1U);
}

TEST(TraceRing, AReaderThatIsTooSlowLearnsHowManyItMissed)
{
    Ring ring{Ring::kLeast};
    Ring::Reader reader{ring, From::newest};
    for (std::uint64_t i = 0; i < 1000; ++i) put_into(ring, of_number(i));
    Record got;
    std::uint64_t read = 0;

    while (reader.next(got)) ++read;

    EXPECT_EQ(read + reader.lost(), 1000U);
}

TEST(TraceRing, OfSizeZeroRecordsNothing)
{
    Ring ring{0};
    put_into(ring, record({1}));
    Ring::Reader reader{ring};
    Record got;

    EXPECT_FALSE(ring.is_on());
    EXPECT_EQ(ring.size(), 0U);
    EXPECT_FALSE(reader.next(got));
}

TEST(TraceRing, SizesAreRoundedUpToAPowerOfTwo)
{
    EXPECT_EQ(Ring{1}.size(), Ring::kLeast);
    EXPECT_EQ(Ring{4097}.size(), 8192U);
    EXPECT_EQ(Ring{1U << 20}.size(), 1U << 20);
}

TEST(TraceRing, MoreOctetsThanARecordHoldsAreCutOff)
{
    Ring ring{Ring::kLeast};
    const std::vector<std::uint8_t> octets(Record::kMostOctets + 1, 7);
    ring.put(Head{}, octets);
    Ring::Reader reader{ring};
    Record got;

    ASSERT_TRUE(reader.next(got));
    EXPECT_EQ(got.octets.size(), Record::kMostOctets);
}

TEST(TraceRing, ReadersGetWholeRecordsInOrderWhileAnotherThreadWrites)
{
    Ring ring{Ring::kLeast};
    constexpr std::uint64_t kRecords = 200'000;
    std::atomic<bool> done{false};
    std::array<std::uint64_t, 2> seen{};
    std::array<bool, 2> good{true, true};
    const auto read_all = [&](std::size_t which, From from) {
        Ring::Reader reader{ring, from};
        Record got;
        std::optional<std::uint64_t> before;
        for (bool last = false; !last;) {
            last = done.load();
            while (reader.next(got)) {
                good[which] = good[which] && is_whole(got) && (!before || got.number > *before);
                before = got.number;
                ++seen[which];
            }
        }
        if (from == From::newest && seen[which] != 0)
            good[which] = good[which] && seen[which] + reader.lost() <= kRecords;
    };
    {
        const std::jthread one{read_all, 0, From::oldest};
        const std::jthread other{read_all, 1, From::newest};
        for (std::uint64_t i = 0; i < kRecords; ++i) put_into(ring, of_number(i));
        done = true;
    }

    EXPECT_TRUE(good[0]);
    EXPECT_TRUE(good[1]);
    EXPECT_GT(seen[0], 0U);
}

} // namespace
