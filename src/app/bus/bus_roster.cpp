// SPDX-License-Identifier: Apache-2.0
// Who is on the bus: the roster and the orders of the main thread, obeyed between two telegrams.
#include "bus_thread.hpp"

#include "dpslave/io/clock.hpp"

#include <algorithm>

namespace dpslave::app {

/// The next roster is taken as soon as those who are not in it have said their last word: what is given back
/// with the present one may be destroyed at once.
void BusThread::follow_roster()
{
    const Roster* const next = link_.roster.offered();
    if (next == nullptr || !part_with_leavers(*next)) return;
    link_.roster.take(roster_);
    seat_newcomers();
}

/// False: the ring of a station is full of orders, and one of its own is still waiting.
bool BusThread::part_with_leavers(const Roster& next)
{
    const auto stays = [&next](const BusStation* station) {
        return std::any_of(next.begin(), next.end(), [&](const auto& one) { return one.get() == station; });
    };
    bool all_gone = true;
    for (std::size_t i = 0; i < kPlaces; ++i) {
        Place& place = places_[i];
        if (place.station == nullptr || stays(place.station)) continue;
        place.leaving = true;
        if (place.address) take_off(i);
        if (!place.station->hand_on()) {
            all_gone = false;
            continue;
        }
        place.station->publish_snapshot();
        place = {};
        waiting_.reset(i);
        turns_.forget(i);
    }
    return all_gone;
}

/// Those who were there before keep their places.
void BusThread::seat_newcomers()
{
    for (const auto& one : *roster_) {
        const auto has = [&](const BusStation* station) {
            return std::find_if(places_.begin(), places_.end(),
                                [&](const Place& place) { return place.station == station; });
        };
        if (has(one.get()) != places_.end()) continue;
        const auto place = has(nullptr);
        if (place == places_.end()) return; // no bus has more than 127 addresses
        place->station = one.get();
        turns_.changed(static_cast<std::size_t>(place - places_.begin()));
    }
}

/// Puts stations on the bus, takes them off, and gives them another address, as the main thread wants it.
/// Between two telegrams and not inside one: layer 2 may be in the middle of a call to the station.
void BusThread::obey_orders()
{
    orders_due_ = false;
    for (std::size_t i = 0; i < kPlaces; ++i) {
        const Place& place = places_[i];
        if (place.station == nullptr) continue;
        if (place.station->take_orders())
            turns_.changed(i); // a new diagnosis is shown although nobody asks for it
        const BusOrders& wanted = place.station->orders();
        if (place.address && (!wanted.enabled || *place.address != wanted.address)) take_off(i);
    }
    for (std::size_t i = 0; i < kPlaces; ++i) { // an address that another one leaves is free by now
        const Place& place = places_[i];
        if (place.station != nullptr && !place.address && !place.leaving && place.station->orders().enabled)
            put_on(i);
    }
}

void BusThread::take_off(std::size_t place)
{
    BusStation& one = *places_[place].station;
    const std::uint8_t address = *places_[place].address;
    one.slave().stop(io::monotonic_now());
    waiting_.set(place, !one.hand_on());
    turns_.changed(place);
    layer2_.detach(address);
    at_[address].reset();
    places_[place].address.reset();
}

void BusThread::put_on(std::size_t place)
{
    BusStation& one = *places_[place].station;
    const std::uint8_t address = one.orders().address;
    if (at_[address]) return; // still somebody else's: with the next tick
    one.slave().set_address(address);
    if (!layer2_.attach(address, one, one.personality().max_tsdr)) return;
    one.slave().start(io::monotonic_now());
    at_[address] = static_cast<std::uint8_t>(place);
    places_[place].address = address;
    waiting_.set(place, !one.hand_on());
    turns_.changed(place);
}

} // namespace dpslave::app
