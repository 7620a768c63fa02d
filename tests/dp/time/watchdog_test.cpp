// SPDX-License-Identifier: Apache-2.0
/// The watchdog (conformance tests C-13 and C-14 of wire reference 10; section 7.1).
#include "dp/bench.hpp"

#include <functional>

namespace test {
namespace {

using dpslave::dp::State;
using namespace std::chrono_literals;

struct Factors {
    std::uint8_t first;
    std::uint8_t second;
    bool fine; ///< base 1 ms
};

class WatchdogTimes : public DpBench, public testing::WithParamInterface<Factors> {
protected:
    WatchdogTimes() : DpBench(technology_box()) {}
};

TEST_P(WatchdogTimes, C13_ExpiresAtTheProductOfTheFactorsNeitherSoonerNorLater)
{
    const Factors& f = GetParam();
    const auto period = (f.fine ? 1ms : 10ms) * (f.first * f.second);
    Octets prm = octets("88 00 00 0B 16 49 01 00 00 00");
    prm[1] = f.first;
    prm[2] = f.second;
    prm[7] = f.fine ? 0x04 : 0x00;

    master.set_prm(show(prm));
    ASSERT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(seen().watchdog, period);

    time_is(bus.asked_at() + period - 1ns);
    EXPECT_EQ(state(), State::wait_cfg);
    time_is(bus.asked_at() + period);
    EXPECT_EQ(state(), State::wait_prm);
}

INSTANTIATE_TEST_SUITE_P(Base10ms, WatchdogTimes,
                         testing::Values(Factors{1, 1, false}, Factors{2, 1, false}, Factors{1, 2, false},
                                         Factors{0x0A, 1, false}, Factors{0x14, 1, false},
                                         Factors{0x0D, 0x0F, false}, Factors{255, 1, false},
                                         Factors{1, 255, false}, Factors{255, 255, false}));
INSTANTIATE_TEST_SUITE_P(Base1ms, WatchdogTimes,
                         testing::Values(Factors{2, 1, true}, Factors{10, 1, true}, Factors{255, 255, true}));

class WatchdogBench : public ExampleSlave {
protected:
    /// Up to the last moment before the owner's last request would be too long ago, then `sign` of life.
    template <class Sign>
    bool lives_on_after(Sign sign)
    {
        time_is(bus.asked_at() + 190ms);
        sign();
        time_is(bus.asked_at() + 199ms);
        const bool alive = state() == State::data_exch;
        time_is(bus.asked_at() + 200ms);
        return alive && state() == State::wait_prm;
    }
};

TEST_F(WatchdogBench, C13_EveryRequestOfTheOwnerIsASignOfLife)
{
    const std::vector<std::function<void()>> signs{[this] { master.data_exchange("00 00"); },
                                                   [this] { master.slave_diag(); },
                                                   [this] { master.get_cfg(); },
                                                   [this] { master.rd_inp(); },
                                                   [this] { master.rd_outp(); },
                                                   [this] { master.chk_cfg(kCfg); },
                                                   [this] { master.set_prm(kPrm); },
                                                   [this] { master.asks(55); },
                                                   [this] { master.fdl_status(); },
                                                   [this] { master.repeats(); },
                                                   [this] { master.set_prm("00 00 00 00 00 00 00"); }};
    for (std::size_t i = 0; i < signs.size(); ++i) {
        exchanges();
        EXPECT_TRUE(lives_on_after(signs[i])) << i;
    }
}

TEST_F(WatchdogBench, C13_ForeignRequestsAreNone)
{
    exchanges();
    const auto expiry = bus.asked_at() + 200ms;
    time_is(expiry - 20ms);
    foreign.slave_diag();
    foreign.fdl_status();
    foreign.rd_inp();
    foreign.set_prm(kPrm);
    foreign.data_exchange("00 00");
    ASSERT_LT(bus.now(), expiry);

    time_is(expiry);

    EXPECT_EQ(state(), State::wait_prm);
}

TEST_F(WatchdogBench, C13_GlobalControlIsNone)
{
    exchanges();
    const auto expiry = bus.asked_at() + 200ms;
    time_is(expiry - 20ms);
    master.control("00 00");

    time_is(expiry);

    EXPECT_EQ(state(), State::wait_prm);
}

/// What counts is when a request was received: one that came too late finds the slave in Wait_Prm, even if
/// the program had not yet been woken by the deadline itself.
class LateWakeUp : public ExampleSlave {
protected:
    dpslave::fdl::Answer request_at(std::chrono::milliseconds after_start)
    {
        const Octets data = octets("00 00");
        dpslave::fdl::ReplyData reply;
        return alone.srd({.sa = 2, .dsap = {}, .ssap = {}, .data = data, .at = start + after_start}, reply);
    }
    void SetUp() override
    {
        const Octets prm = octets(kPrm);
        const Octets cfg = octets(kCfg);
        dpslave::fdl::ReplyData reply;
        alone.start(start);
        alone.srd({.sa = 2, .dsap = 61, .ssap = 62, .data = prm, .at = start}, reply);
        alone.srd({.sa = 2, .dsap = 62, .ssap = 62, .data = cfg, .at = start}, reply);
        ASSERT_EQ(alone.state(), State::data_exch);
    }

    dpslave::Instant start{1000s};
    dpslave::dp::Slave alone{personality, kUs};
};

TEST_F(LateWakeUp, C13_ARequestReceivedAfterTheExpiryIsTooLate)
{
    EXPECT_EQ(request_at(200ms), dpslave::fdl::Answer::not_activated);
    EXPECT_EQ(alone.state(), State::wait_prm);
    EXPECT_TRUE(alone.take_left());
}

TEST_F(LateWakeUp, C13_ARequestReceivedBeforeTheExpiryIsInTimeHoweverLateItIsProcessed)
{
    EXPECT_EQ(request_at(199ms), dpslave::fdl::Answer::high);
    alone.on_time(start + 398ms);
    EXPECT_EQ(alone.state(), State::data_exch);
    alone.on_time(start + 399ms);
    EXPECT_EQ(alone.state(), State::wait_prm);
}

TEST_F(LateWakeUp, C13_ARetryReceivedAfterTheExpiryIsTooLateToo)
{
    alone.heard(2, start + 200ms);

    EXPECT_EQ(alone.state(), State::wait_prm);
}

TEST_F(LateWakeUp, C13_AGlobalControlReceivedAfterTheExpiryIsIgnored)
{
    const Octets clear = octets("02 00");
    alone.sdn({.sa = 2, .dsap = 58, .ssap = 62, .data = clear, .at = start + 200ms});

    EXPECT_EQ(alone.state(), State::wait_prm);
}

TEST_F(LateWakeUp, ReportsItsNextDeadline)
{
    EXPECT_EQ(alone.next_deadline(), start + 200ms);
    request_at(100ms);
    EXPECT_EQ(alone.next_deadline(), start + 300ms);
    alone.stop(start + 100ms);
    EXPECT_EQ(alone.next_deadline(), dpslave::kNever);
}

TEST_F(WatchdogBench, C13_ARetryBehindAnExpiryIsAnsweredFromMemoryAndTheSlaveStaysReleased)
{
    exchanges();
    ASSERT_EQ(master.data_exchange("A5 01"), "DL 12 34");
    bus.advance(201ms);
    ASSERT_EQ(state(), State::wait_prm);
    const auto before = seen().counters;

    EXPECT_EQ(master.repeats(), "DL 12 34");
    EXPECT_EQ(state(), State::wait_prm);
    EXPECT_EQ(seen().counters.data_exchange, before.data_exchange);
    EXPECT_EQ(seen().counters.not_activated, before.not_activated);
    EXPECT_EQ(station.counters().retries, 1u);
    EXPECT_EQ(master.data_exchange("A5 01"), "RS") << "the next one is new";
}

TEST_F(WatchdogBench, C13_AnExpiryIsCounted)
{
    exchanges();
    bus.advance(1s);

    EXPECT_EQ(seen().counters.watchdog_expired, 1u);
    EXPECT_EQ(seen().watchdog, 0ms);
    EXPECT_EQ(slave.supervision(), dpslave::fdl::Supervision::unowned);
}

} // namespace
} // namespace test
