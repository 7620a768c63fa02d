// SPDX-License-Identifier: Apache-2.0
/// Tests what the bus thread puts into the ring of the trace.
#include "app/bus_bench.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace dpslave::test {
namespace {

using testing::EndsWith;
using trace::Kind;
using trace::Record;

class TraceOfTheBus : public OnABus {
protected:
    /// All that was heard by then, one behind the other.
    static std::string heard_before(const std::vector<Record>& all, std::uint64_t number)
    {
        std::string heard;
        for (const Record& one : all)
            if (one.head.kind == Kind::heard && one.number < number)
                heard.append(one.octets.bytes().begin(), one.octets.bytes().end());
        return heard;
    }
};

TEST_F(TraceOfTheBus, HasARequestAndItsReplyInTheirOrderWithTheirTimes)
{
    start({}, {station(kStation)});
    const Octets request = fdl_status(kStation);
    const Instant before = io::monotonic_now();
    const auto reply = master.ask(request);
    ASSERT_TRUE(reply);
    stop();

    const auto all = records();
    const auto sent =
        std::find_if(all.rbegin(), all.rend(), [](const Record& one) { return one.head.kind == Kind::sent; });
    ASSERT_NE(sent, all.rend());
    EXPECT_EQ(Octets(sent->octets.bytes().begin(), sent->octets.bytes().end()), *reply);
    EXPECT_THAT(heard_before(all, sent->number), EndsWith(std::string(request.begin(), request.end())));
    EXPECT_LE(before, all.front().head.at);
    EXPECT_LE(all.front().head.at, sent->head.begun);
    EXPECT_LE(sent->head.begun, sent->head.at);
    EXPECT_EQ(kBauds.at(sent->head.rate), Baud::k500);
}

TEST_F(TraceOfTheBus, SaysThatAReplyWasNotTakenByThePort)
{
    start({}, {station(kStation)});
    uart::refuse_edges(true);
    ASSERT_TRUE(asked_until(fdl_status(kStation), [this] { return snapshot().unsent != 0; }));
    stop();

    const auto all = records();
    EXPECT_TRUE(
        std::none_of(all.begin(), all.end(), [](const Record& one) { return one.head.kind == Kind::sent; }));
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Record& one) {
        return one.head.kind == Kind::unanswered && one.head.address == kStation &&
               static_cast<fdl::Unanswered::Why>(one.head.detail) == fdl::Unanswered::Why::unsent;
    }));
}

TEST_F(TraceOfTheBus, SaysWhenWhatWasUnfinishedWasGivenUp)
{
    start({}, {station(kStation)});
    ASSERT_TRUE(master.ask(fdl_status(kStation)));
    EXPECT_EQ(master.ask({0x68, 0x0B, 0x0B}, 1), std::nullopt);
    ASSERT_TRUE(eventually(
        [this] { return snapshot().counters.flaws[static_cast<std::size_t>(fdl::Flaw::unfinished)] != 0; }));
    stop();

    const auto all = records();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back().head.kind, Kind::silence);
    EXPECT_THAT(heard_before(all, all.back().number), EndsWith("h\x0B\x0B"));
}

TEST_F(TraceOfTheBus, NamesTheRateThatASearchGoesOnAt)
{
    start({.baud = std::nullopt}, {station(kStation)});
    ASSERT_TRUE(eventually([this] { return snapshot().baud == Baud::k500; }));
    stop();

    const auto all = records();
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Record& one) {
        return one.head.kind == Kind::rate && kBauds.at(one.head.rate) == Baud::k500;
    }));
}

} // namespace
} // namespace dpslave::test
