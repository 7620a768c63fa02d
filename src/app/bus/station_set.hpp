// SPDX-License-Identifier: Apache-2.0
/// The stations of the bus: which there are, which of them are on the bus, and at which address, as the main
/// thread wants it. The bus thread's own. Nothing here allocates or blocks.
#pragma once

#include "app/links/links.hpp"
#include "bus_station.hpp"
#include "snapshot_schedule.hpp"

#include "dpslave/base/handover.hpp"
#include "dpslave/fdl/layer2.hpp"

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <optional>

namespace dpslave::app {

class StationSet {
public:
    /// More and other stations come through `next`. While `main_thread` gives no sign for
    /// kMainThreadMayStall no station is on the bus. All references outlive the set.
    StationSet(std::unique_ptr<BusStations> stations, Handover<BusStations>& next, fdl::Layer2& layer2,
               const SignOfLife& main_thread);

    /// Takes the next set, if there is one and all that leave have passed on what they had; then puts
    /// stations on the bus, takes them off, and gives them another address. Between two telegrams and not
    /// inside one: layer 2 may be in the middle of a call to the station. At least every
    /// Silence::kLongestLook.
    void update(Instant now);
    /// For how long the main thread has given no sign.
    std::chrono::nanoseconds main_silence() const { return main_silence_; }
    /// A station had a request since the last forward().
    bool has_heard();
    /// Passes on outputs, orders and events of the stations that had a request.
    void forward();
    /// Every station leaves the bus until the next update(). What came since the last forward() is dropped.
    void leave(Instant now);
    /// When publish() has something to do; kNever = nothing has changed.
    Instant next_publication() const { return turns_.next(); }
    /// Publishes the snapshot of one station, if one is due.
    void publish(Instant now);
    /// Every station leaves the bus, and passes on what it has.
    void stop(Instant now);

private:
    static constexpr std::size_t kSlots = SnapshotSchedule::kSlots;

    /// Where a station is held: it keeps its slot while others come and go.
    struct Slot {
        BusStation* station = nullptr;
        std::optional<std::uint8_t> address; ///< nothing = not on the bus
        bool leaves = false; ///< not in the next set: it stays only until its last order was taken
    };

    void exchange(Instant now);
    bool remove_stations(const BusStations& next, Instant now);
    void add_stations();
    void apply_orders(Instant now);
    void attach(std::size_t slot, Instant now);
    void detach(std::size_t slot, Instant now);

    std::unique_ptr<BusStations> stations_;
    Handover<BusStations>& next_;
    fdl::Layer2& layer2_;
    const SignOfLife& main_thread_;
    Silence main_;
    std::chrono::nanoseconds main_silence_{};
    std::array<Slot, kSlots> slots_{};
    std::array<std::optional<std::uint8_t>, kSlots> slot_at_{}; ///< by address
    std::bitset<128> heard_;                                    ///< addresses that had a request
    std::bitset<kSlots> waiting_; ///< slots with an order that could not be passed on yet
    SnapshotSchedule turns_;
};

} // namespace dpslave::app
