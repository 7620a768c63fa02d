// SPDX-License-Identifier: Apache-2.0
/// Layer 2 and slave on a clock that has run for weeks.
#include "dp/bench.hpp"
#include "support/long_times.hpp"

namespace test {
namespace {

using dpslave::Instant;
using dpslave::dp::State;
using namespace std::chrono_literals;

/// The watchdog of kPrm.
constexpr auto kWatchdog = 200ms;

class SlaveAcrossLongTimes : public ExampleSlave, public testing::WithParamInterface<LongTime> {
protected:
    /// Exchanges data from `before` that moment on.
    void lives_until_shortly_before(std::chrono::nanoseconds before)
    {
        time_is(GetParam().instant() - before);
        exchanges();
    }
};

TEST_P(SlaveAcrossLongTimes, TheExchangeGoesOn)
{
    lives_until_shortly_before(1s);

    inputs_are({0x1234});
    for (int i = 0; i < 200; ++i) {
        time_is(bus.now() + 10ms);
        ASSERT_EQ(master.data_exchange("00 01"), "DL 12 34") << i;
    }
    EXPECT_GT(bus.now(), GetParam().instant());
    EXPECT_EQ(seen().counters.left_data_exchange, 0U);
}

TEST_P(SlaveAcrossLongTimes, TheWatchdogExpiresAtItsTime)
{
    lives_until_shortly_before(kWatchdog / 2);
    master.data_exchange("00 01");

    time_is(bus.asked_at() + kWatchdog - 1ns);
    EXPECT_EQ(state(), State::data_exch);
    time_is(bus.asked_at() + kWatchdog);
    EXPECT_EQ(state(), State::wait_prm);
    EXPECT_GT(bus.now(), GetParam().instant());
}

INSTANTIATE_TEST_SUITE_P(, SlaveAcrossLongTimes, testing::ValuesIn(kLongTimes),
                         [](const auto& row) { return std::string{row.param.name}; });

using SlaveForSixtyDays = ExampleSlave;

TEST_F(SlaveForSixtyDays, AnswersEachRequestOfAMinuteAndNeverLeavesTheExchange)
{
    exchanges("88 FF FF 0B 47 11 01"); // a watchdog of 650 s
    inputs_are({0x1234});
    const Instant begin = bus.now();

    std::uint64_t asked = 0;
    for (; bus.now() < begin + kSixtyDays; time_is(bus.now() + 1min), ++asked)
        ASSERT_EQ(master.data_exchange("00 01"), "DL 12 34") << asked;

    EXPECT_GE(asked, 86'000U);
    EXPECT_GE(seen().counters.data_exchange, asked);
    EXPECT_EQ(seen().counters.left_data_exchange, 0U);
    EXPECT_EQ(station.counters().late + station.counters().overtaken, 0U);
    time_is(bus.asked_at() + 650'250ms - 1ns);
    EXPECT_EQ(state(), State::data_exch);
    time_is(bus.asked_at() + 650'250ms);
    EXPECT_EQ(state(), State::wait_prm);
}

} // namespace
} // namespace test
