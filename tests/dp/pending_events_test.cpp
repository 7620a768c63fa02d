// SPDX-License-Identifier: Apache-2.0
/// The event log by itself.
#include "dpslave/dp/pending_events.hpp"

#include <gtest/gtest.h>

namespace test {
namespace {

using dpslave::dp::Event;
using dpslave::dp::PendingEvents;
using dpslave::dp::State;

constexpr Event kSync{.kind = Event::Kind::sync, .state = State::data_exch, .master = 2};
constexpr Event kFreeze{.kind = Event::Kind::freeze, .state = State::data_exch, .master = 2};

TEST(PendingEvents, GivesEachEventOnceAndInOrder)
{
    PendingEvents log;
    log.add(kSync);
    log.add(kFreeze);

    EXPECT_EQ(log.take(State::wait_prm, 9), kSync);
    EXPECT_EQ(log.take(State::wait_prm, 9), kFreeze);
    EXPECT_FALSE(log.take(State::wait_prm, 9));
}

TEST(PendingEvents, DropsARepetitionAlsoWhenTheFirstOneWasFetched)
{
    PendingEvents log;
    log.add_once(kSync);
    EXPECT_EQ(log.take(State::wait_prm, 9), kSync);

    log.add_once(kSync);
    EXPECT_FALSE(log.take(State::wait_prm, 9));

    log.add_once(kFreeze);
    log.add_once(kSync);
    EXPECT_EQ(log.take(State::wait_prm, 9), kFreeze);
    EXPECT_EQ(log.take(State::wait_prm, 9), kSync);
}

TEST(PendingEvents, ReportsALossInItsPlace)
{
    PendingEvents log;
    for (int i = 0; i < 17; ++i) log.add(kSync);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(log.take(State::wait_prm, 9), kSync);
    log.add(kFreeze); // behind the loss, which has not been reported yet

    EXPECT_EQ(log.take(State::wait_cfg, 3),
              (Event{.kind = Event::Kind::overflow, .state = State::wait_cfg, .master = 3}));
    EXPECT_FALSE(log.take(State::wait_cfg, 3));
    log.add(kFreeze);
    EXPECT_EQ(log.take(State::wait_cfg, 3), kFreeze);
}

} // namespace
} // namespace test
