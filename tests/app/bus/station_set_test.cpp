// SPDX-License-Identifier: Apache-2.0
/// Stations come and go while the bus is served, and the others notice nothing.
#include "app/bus_bench.hpp"

namespace dpslave::test {
namespace {

using namespace std::chrono_literals;

class StationsOfTheBus : public OnABus {
protected:
    /// Offers a new set and waits until it is in use; gives the old one back.
    std::unique_ptr<app::BusStations> change_to(app::BusStations stations)
    {
        auto next = std::make_unique<app::BusStations>(std::move(stations));
        EXPECT_TRUE(link.stations.offer(next));
        std::unique_ptr<app::BusStations> old;
        EXPECT_TRUE(eventually([&] { return (old = link.stations.collect()) != nullptr; }));
        return old;
    }
    bool answers(std::uint8_t address, int tries = 200)
    {
        return master.ask(fdl_status(address), tries).has_value();
    }
};

TEST_F(StationsOfTheBus, MayBeEmptyAtFirst)
{
    start({}, {});
    EXPECT_FALSE(answers(5, 1));

    change_to({station(5)});
    EXPECT_TRUE(eventually([this] { return answers(5, 1); }));
}

TEST_F(StationsOfTheBus, TakesAStationOnAndTheOneThatWasThereGoesOn)
{
    const auto five = station(5);
    start({}, {five});
    start_up(5);
    drive_reads(5, 1234);
    ASSERT_EQ(exchange(5), 1234);
    change_to({five, station(6)});

    EXPECT_EQ(exchange(5), 1234); // without a new start-up
    EXPECT_TRUE(eventually([this] { return answers(6, 1); }));
    EXPECT_EQ(links[5]->ended.load(), 0u); // its layout has not ended
}

TEST_F(StationsOfTheBus, ThatChangesAllTheTimeCostsTheOthersNotOneReply)
{
    const auto five = station(5);
    start({.direction = io::Direction::none}, {five, station(6)}); // the number of replies is not known
    start_up(5);
    std::uint16_t value = 0;
    for (std::uint8_t other = 7; other < 27; ++other) {
        auto next = std::make_unique<app::BusStations>(app::BusStations{five, station(other)});
        ASSERT_TRUE(link.stations.offer(next));
        while (!link.stations.taken()) {
            drive_reads(5, ++value);
            ASSERT_EQ(exchange(5), value);
        }
        ASSERT_TRUE(eventually([this] { return link.stations.collect() != nullptr; }));
    }
    EXPECT_TRUE(eventually([this] { return answers(26, 1); }));
    EXPECT_FALSE(answers(25, 1));
    EXPECT_EQ(allocations(), 0u); // all of it is built and thrown away elsewhere
}

TEST_F(StationsOfTheBus, TakesAStationOffWithAllThatLeavingMeans)
{
    const auto five = station(5), six = station(6);
    start({}, {five, six});
    start_up(6);
    ASSERT_TRUE(exchange(6));
    const auto generation = links[6]->outputs.latest().layout.generation;
    const auto old = change_to({five});

    EXPECT_FALSE(answers(6, 2));
    EXPECT_TRUE(answers(5));
    EXPECT_EQ(links[6]->ended.load(), generation); // its outputs go to the safe state
    EXPECT_EQ(links[6]->bus_snapshot.latest().state, dp::State::power_on);
    EXPECT_EQ(old->size(), 2u); // and what is given back is not used any more
    EXPECT_EQ(six.use_count(), 2);
}

TEST_F(StationsOfTheBus, GivesAnAddressToAnotherStation)
{
    start({}, {station(5)});
    start_up(5);
    const auto first = links[5];
    change_to({station(5)});

    EXPECT_TRUE(eventually([this] { return answers(5, 1); }));
    EXPECT_EQ(exchange(5), std::nullopt); // a new one: it waits for its parameters
    EXPECT_NE(first->ended.load(), 0u);
}

TEST_F(StationsOfTheBus, IsTakenOnlyWhenTheOrdersOfThoseThatLeaveWereTaken)
{
    const auto five = station(5);
    while (links[5]->demand_orders.push({})) { // as if the drive line took none
    }
    start({}, {five});
    start_up(5);
    ASSERT_TRUE(exchange(5));
    const Octets read_tag_7{0x10, 0x07, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00}; // Demand Data
    ASSERT_TRUE(master.ask(::test::sd2(5, 2, master.next_fc(), read_tag_7)));
    ASSERT_TRUE(eventually([this] { return links[5]->demand_orders.refused() > 1; })); // the ring is full
    auto next = std::make_unique<app::BusStations>(app::BusStations{station(6)});
    ASSERT_TRUE(link.stations.offer(next));
    ASSERT_TRUE(eventually([this] { return answers(5, 1) == false; })); // it is silent at once
    EXPECT_FALSE(link.stations.taken());

    EXPECT_TRUE(eventually([&] {
        static_cast<void>(links[5]->demand_orders.pop());
        return link.stations.taken();
    }));
    EXPECT_TRUE(eventually([this] { return answers(6, 1); }));
}

TEST_F(StationsOfTheBus, ShowsEachStationInItsTurn)
{
    app::BusStations all;
    for (std::uint8_t address = 3; address < 40; ++address) all.push_back(station(address));
    start({}, all);

    EXPECT_TRUE(eventually([this] {
        return std::all_of(links.begin(), links.end(), [](const auto& one) {
            return one.second->bus_snapshot.latest().state == dp::State::wait_prm;
        });
    }));
}

/// The test has the only clock: no thread runs.
class StationsWithoutAMainThread : public OnABus {
protected:
    StationsWithoutAMainThread()
    {
        one = station(kStation);
        auto all = std::make_unique<app::BusStations>();
        all->push_back(one);
        set.emplace(std::move(all), next, layer2, main_thread);
    }
    /// Until `end`, every 10 ms. `main`: it goes round.
    void until(Instant end, bool main)
    {
        for (; now < end; now += 10ms) {
            if (main) main_thread.give(now);
            set->update(now);
        }
    }
    bool is_on_the_bus() { return one->slave().state() != dp::State::power_on; }

    Instant now{1h};
    SignOfLife main_thread;
    Handover<app::BusStations> next;
    fdl::Layer2 layer2{fdl::Layer2Settings{}};
    std::shared_ptr<app::BusStation> one;
    std::optional<app::StationSet> set;
};

TEST_F(StationsWithoutAMainThread, AreOnTheBusUntilItHasGivenNoSignForTwoAndAHalfSeconds)
{
    until(now + 10s, true);
    until(now + 2490ms, false);
    EXPECT_TRUE(is_on_the_bus());
    until(now + 20ms, false);
    EXPECT_FALSE(is_on_the_bus());
}

TEST_F(StationsWithoutAMainThread, StartUpAgainWhenItGoesRoundAgain)
{
    until(now + 1s, true);
    until(now + 4s, false);
    ASSERT_FALSE(is_on_the_bus());
    until(now + 20ms, true);
    EXPECT_EQ(one->slave().state(), dp::State::wait_prm);
}

TEST_F(StationsWithoutAMainThread, StayWhereTheBusThreadItselfStalledAsLong)
{
    until(now + 1s, true);
    now += 1h;
    until(now + 2s, false);
    EXPECT_TRUE(is_on_the_bus());
}

TEST_F(StationsWithoutAMainThread, AreOnTheBusBeforeItBegins)
{
    until(now + 10s, false);
    EXPECT_TRUE(is_on_the_bus());
}

/// The signs of the line of its drive come from the test.
class StationOfAStalledLine : public OnABus {
protected:
    StationOfAStalledLine()
    {
        link = std::make_shared<app::StationLink>(sign);
        one = std::make_shared<app::BusStation>(station_config(kStation), link);
        sign->give(now);
    }
    void until(Instant end, bool line)
    {
        for (; now < end; now += 10ms) {
            if (line) sign->give(now);
            one->judge_line(now);
        }
    }
    std::shared_ptr<io::ThreadSign> sign = std::make_shared<io::ThreadSign>();
    std::shared_ptr<app::StationLink> link;
    std::shared_ptr<app::BusStation> one;
    Instant now{1h};
};

TEST_F(StationOfAStalledLine, LetsTheLineWriteNothingUntilItHasTakenNote)
{
    until(now + 2s, true);
    EXPECT_FALSE(sign->is_given_up());
    until(now + 2s + 10ms, false);
    EXPECT_TRUE(sign->is_given_up());
    EXPECT_EQ(link->stalls.load(), 1u);
    EXPECT_FALSE(one->is_wanted());
    until(now + 1s, true);
    EXPECT_FALSE(one->is_wanted()) << "it has not taken note yet";
    link->stalls_noted.store(1);
    until(now + 20ms, true);
    EXPECT_TRUE(one->is_wanted());
}

/// What the line has fetched before it stalled is overtaken, and only the bus knows it.
TEST_F(StationOfAStalledLine, TellsTheLineFromWhichOrderOnTheyStand)
{
    config::StationConfig config = station_config(kStation);
    config.loss = {.when = drive::WhenLost::hold, .after = 500ms};
    links[kStation] = link;
    start({}, {std::make_shared<app::BusStation>(config, link)});
    start_up(kStation);
    ASSERT_TRUE(eventually([&] { return link->stalls.load() > 0; }));
    EXPECT_EQ(link->stands_from.load(), 0u);
    const Octets write{0x20, 55, 0, 0, 0, 0, 0, 1}; // of tag 55
    EXPECT_TRUE(master.ask(::test::sd2(kStation, 2, master.next_fc(), write)));
    EXPECT_TRUE(eventually([&] { return link->stands_from.load() != 0; }));
    EXPECT_EQ(link->demand_orders.pop(), std::nullopt);
}

TEST_F(StationOfAStalledLine, KeepsOfDemandDataTheNewestOrderUntilTheLineGoesRoundAgain)
{
    config::StationConfig config = station_config(kStation);
    config.loss = {.when = drive::WhenLost::hold, .after = 500ms};
    links[kStation] = link;
    start({}, {std::make_shared<app::BusStation>(config, link)});
    start_up(kStation);
    const auto writes = [this](std::uint8_t value) {
        Octets outputs{0x20, 55, 0, 0, 0, 0, 0, value}; // write tag 55
        EXPECT_TRUE(master.ask(::test::sd2(kStation, 2, master.next_fc(), outputs)));
    };
    const auto goes_round = [this] {
        link->stalls_noted.store(link->stalls.load());
        sign->give(io::monotonic_now());
        return true;
    };
    std::optional<DemandOrder> order;
    ASSERT_TRUE(eventually([&] {
        goes_round();
        writes(1);
        return (order = link->demand_orders.pop()).has_value();
    }));
    ASSERT_EQ(order->value, 1);

    const std::uint32_t before = link->stalls.load();
    ASSERT_TRUE(eventually([&] { return link->stalls.load() > before; }));
    for (std::uint8_t value = 2; value <= 4; ++value) writes(value);
    EXPECT_EQ(link->demand_orders.pop(), std::nullopt);
    ASSERT_TRUE(eventually([&] { return goes_round() && (order = link->demand_orders.pop()).has_value(); }));
    EXPECT_EQ(order->value, 4);
    EXPECT_EQ(link->demand_orders.pop(), std::nullopt);
    EXPECT_EQ(link->orders_dropped.load(), 2u);
}

} // namespace
} // namespace dpslave::test
