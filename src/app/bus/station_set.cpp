// SPDX-License-Identifier: Apache-2.0
#include "station_set.hpp"

#include "set_bits.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::app {

StationSet::StationSet(std::unique_ptr<BusStations> stations, Handover<BusStations>& next,
                       fdl::Layer2& layer2, const SignOfLife& main_thread)
    : stations_(std::move(stations)), next_(next), layer2_(layer2), main_thread_(main_thread)
{
    add_stations();
}

void StationSet::update(Instant now)
{
    exchange(now);
    apply_orders(now);
}

/// What is given back with the present set may be destroyed at once: so those that are not in the next one
/// pass on what they have first.
void StationSet::exchange(Instant now)
{
    const BusStations* const next = next_.offered();
    if (next == nullptr || !remove_stations(*next, now)) return;
    next_.take(stations_);
    add_stations();
}

/// False: the ring of a station is full of orders, and one of its own is still waiting.
bool StationSet::remove_stations(const BusStations& next, Instant now)
{
    const auto stays = [&next](const BusStation* station) {
        return std::any_of(next.begin(), next.end(), [&](const auto& one) { return one.get() == station; });
    };
    bool all_gone = true;
    for (std::size_t i = 0; i < kSlots; ++i) {
        Slot& slot = slots_[i];
        if (slot.station == nullptr || stays(slot.station)) continue;
        slot.leaves = true;
        if (slot.address) detach(i, now);
        if (!slot.station->forward()) {
            all_gone = false;
            continue;
        }
        slot.station->publish_snapshot();
        slot = {};
        waiting_.reset(i);
        turns_.forget(i);
    }
    return all_gone;
}

void StationSet::add_stations()
{
    for (const auto& one : *stations_) {
        const auto slot_of = [&](const BusStation* station) {
            return std::find_if(slots_.begin(), slots_.end(),
                                [&](const Slot& slot) { return slot.station == station; });
        };
        if (slot_of(one.get()) != slots_.end()) continue;
        const auto slot = slot_of(nullptr);
        if (slot == slots_.end()) return; // no bus has more than 127 addresses
        slot->station = one.get();
        turns_.changed(static_cast<std::size_t>(slot - slots_.begin()));
    }
}

void StationSet::apply_orders(Instant now)
{
    main_silence_ = main_.look(main_thread_.last(), now);
    const auto is_wanted = [this](const Slot& slot) {
        return main_silence_ < kMainThreadMayStall && slot.station->is_wanted();
    };
    for (std::size_t i = 0; i < kSlots; ++i) {
        const Slot& slot = slots_[i];
        if (slot.station == nullptr) continue;
        if (slot.station->take_orders())
            turns_.changed(i); // a new diagnosis is published although no master asks for it
        if (slot.station->judge_line(now)) waiting_.set(i);
        const bool was_gone = slot.station->take_departure();
        const bool is_elsewhere = slot.address && *slot.address != slot.station->orders().address;
        if (slot.address && (was_gone || !is_wanted(slot) || is_elsewhere)) detach(i, now);
    }
    for (std::size_t i = 0; i < kSlots; ++i) { // an address that another one leaves is free by now
        const Slot& slot = slots_[i];
        if (slot.station != nullptr && !slot.address && !slot.leaves && is_wanted(slot)) attach(i, now);
    }
}

void StationSet::attach(std::size_t slot, Instant now)
{
    BusStation& one = *slots_[slot].station;
    const std::uint8_t address = one.orders().address;
    if (slot_at_[address]) return; // another station still has it: with the next tick
    one.slave().set_address(address);
    if (!layer2_.attach(address, one, one.personality().max_tsdr)) return;
    one.slave().start(now);
    slot_at_[address] = static_cast<std::uint8_t>(slot);
    slots_[slot].address = address;
    waiting_.set(slot, !one.forward());
    turns_.changed(slot);
}

void StationSet::detach(std::size_t slot, Instant now)
{
    BusStation& one = *slots_[slot].station;
    const std::uint8_t address = *slots_[slot].address;
    one.slave().stop(now);
    waiting_.set(slot, !one.forward());
    turns_.changed(slot);
    layer2_.detach(address);
    slot_at_[address].reset();
    slots_[slot].address.reset();
}

bool StationSet::has_heard()
{
    heard_ |= layer2_.take_touched();
    return heard_.any();
}

void StationSet::forward()
{
    if (!has_heard() && waiting_.none()) return;
    const auto addresses = std::exchange(heard_, {});
    for_each(addresses, [this](std::size_t address) {
        if (!slot_at_[address]) return; // it was detached after its request, and has passed on everything
        waiting_.set(*slot_at_[address]);
        turns_.changed(*slot_at_[address]);
    });
    for_each(waiting_, [this](std::size_t slot) { waiting_.set(slot, !slots_[slot].station->forward()); });
}

/// A layout that ends takes with it what was not passed on.
void StationSet::leave(Instant now)
{
    for (std::size_t i = 0; i < kSlots; ++i)
        if (slots_[i].address) detach(i, now);
    static_cast<void>(layer2_.take_touched());
    heard_ = {};
}

void StationSet::publish(Instant now)
{
    if (const auto slot = turns_.take(now)) slots_[*slot].station->publish_snapshot();
}

void StationSet::stop(Instant now)
{
    for (const Slot& slot : slots_) {
        if (slot.station == nullptr) continue;
        slot.station->slave().stop(now);
        slot.station->forward();
        slot.station->publish_snapshot();
    }
}

} // namespace dpslave::app
