// SPDX-License-Identifier: Apache-2.0
/// The orders of dpctl at a drive line, without its thread: the test is the main thread and the drive.
#include "app/line/line_orders.hpp"

#include <gmock/gmock.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using End = OrderStates::End;

constexpr std::uint16_t kFlow = 20;

/// One drive, whose station has the number 1.
class OrdersOfALine : public testing::Test {
protected:
    OrdersOfALine()
    {
        drive::Tag flow;
        flow.number = kFlow;
        tags = std::make_shared<const drive::TagTable>(std::vector{flow});
        units.emplace_back(unit(1));
        drive::DriveSettings settings;
        settings.tags = tags.get();
        poller.emplace(std::vector{settings}, drive::BlockRule{});
        orders.emplace(link, *poller, units);
    }
    DriveUnit unit(std::uint32_t number) const
    {
        config::StationConfig config;
        config.tags = tags;
        config.profile = std::make_shared<const profile::Profile>();
        return {.number = number,
                .config = std::make_shared<const config::StationConfig>(std::move(config)),
                .link = std::make_shared<StationLink>()};
    }
    /// The main thread orders a write.
    std::uint32_t writes(std::uint32_t station = 1)
    {
        const std::uint32_t number = ++last;
        EXPECT_TRUE(link.order_states.add(number));
        EXPECT_TRUE(link.orders.push(
            {.station = station,
             .order = {.number = number, .unit = 0, .is_write = true, .tag = kFlow, .word = 7}}));
        return number;
    }
    /// One round of the line. The number of the order that was sent; 0: none.
    std::uint32_t goes_round(bool is_sent = true)
    {
        orders->fetch();
        orders->drop_ended();
        now += 20ms;
        const auto transaction = poller->next(now);
        if (!transaction) return 0;
        drive::Outcome outcome{.error = AccessError::no_answer, .words = {}, .sent = false};
        const bool begins = transaction->order == 0 || orders->begin(transaction->order);
        if (begins && is_sent) outcome = {.error = AccessError::none, .words = word};
        if (transaction->order != 0) orders->done(transaction->order, outcome.sent);
        poller->heard(0, now);
        poller->done(outcome, now);
        orders->answer();
        return begins ? transaction->order : 0;
    }
    std::vector<std::uint32_t> answered()
    {
        std::vector<std::uint32_t> numbers;
        while (const auto answer = link.answers.pop()) numbers.push_back(answer->number);
        return numbers;
    }

    std::shared_ptr<const drive::TagTable> tags;
    std::vector<LineUnit> units;
    LineLink link;
    std::optional<drive::Poller> poller;
    std::optional<LineOrders> orders;
    std::vector<std::uint16_t> word{7};
    Instant now{1h};
    std::uint32_t last = 0;
};

TEST_F(OrdersOfALine, AreAnsweredAndThenTheirPlaceIsFree)
{
    const auto write = writes();
    for (int i = 0; i < 10; ++i) goes_round();
    EXPECT_THAT(answered(), ElementsAre(write));
    EXPECT_EQ(link.order_states.end(write), End::answered);
    EXPECT_TRUE(link.order_states.add(write));
}

TEST_F(OrdersOfALine, ThatEndInTheRingOrInThePollerAreNotSent)
{
    const auto in_poller = writes();
    orders->fetch();
    const auto in_ring = writes();
    EXPECT_EQ(link.order_states.end(in_poller), End::not_begun);
    EXPECT_EQ(link.order_states.end(in_ring), End::not_begun);

    for (int i = 0; i < 10; ++i) EXPECT_EQ(goes_round(), 0u);
    EXPECT_THAT(answered(), IsEmpty());
    EXPECT_TRUE(link.order_states.add(in_ring)) << "the place is free";
}

TEST_F(OrdersOfALine, ThatEndWhenTheirTurnHasJustComeAreNotSent)
{
    const auto write = writes();
    orders->fetch();
    orders->drop_ended();
    EXPECT_EQ(link.order_states.end(write), End::not_begun);
    EXPECT_FALSE(orders->begin(write)) << "although the poller has chosen it";
}

TEST_F(OrdersOfALine, AreBegunUntilTheReadThatProvesThem)
{
    const auto write = writes();
    ASSERT_EQ(goes_round(), write);
    EXPECT_THAT(answered(), IsEmpty());
    EXPECT_EQ(link.order_states.end(write), End::begun);

    for (int i = 0; i < 10; ++i) EXPECT_EQ(goes_round(), 0u) << "neither the proof nor the write again";
}

TEST_F(OrdersOfALine, OfWhichNothingWasSentAreNotBegun)
{
    const auto write = writes();
    ASSERT_EQ(goes_round(false), write);
    EXPECT_EQ(link.order_states.end(write), End::not_begun);
}

TEST_F(OrdersOfALine, ForADriveThatIsAboutToComeWaitForIt)
{
    const auto write = writes(2);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(goes_round(), 0u);
    EXPECT_THAT(answered(), IsEmpty());
    units.front() = LineUnit{unit(2)};
    orders->on_other_drives();
    EXPECT_EQ(goes_round(), write);
}

TEST_F(OrdersOfALine, AreAllDroppedWhenTheLineEnds)
{
    const auto in_poller = writes();
    orders->fetch();
    const auto early = writes(2);
    orders->fetch();
    const auto in_ring = writes();
    orders->drop_all();

    for (int i = 0; i < 10; ++i) EXPECT_EQ(goes_round(), 0u);
    EXPECT_THAT(answered(), testing::UnorderedElementsAre(in_poller, early, in_ring));
}

} // namespace
} // namespace dpslave::app
