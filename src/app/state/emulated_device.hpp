// SPDX-License-Identifier: Apache-2.0
/// The functions of a device beyond plain DP: its TEC OPTION function block, its extended diagnosis and the
/// lamps that mirror the drive. One per station, the main thread's own. Pure: snapshots in; orders for the
/// bus and the drive line and conditions of the lamps out. Source: HA463561U002 (rows B-080 to B-084),
/// handbook ch. 4 (C-015 to C-017, X-15).
#pragma once

#include "app/links/links.hpp"
#include "station.hpp"
#include "tec_option.hpp"
#include "watched_tags.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/led/pattern.hpp"
#include "dpslave/tec/option_block.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

class EmulatedDevice {
public:
    /// `config` outlives it. Until the first update() the drive and the ports count as sound. After a failed
    /// self-test the station stays silent.
    explicit EmulatedDevice(const config::StationConfig& config, bool self_test_passed = true);

    /// The same device with other keys, whose `config` outlives it.
    void adopt(const config::StationConfig& config);

    /// Takes the snapshots of `station` and of the bus.
    void update(const Station& station, const BusSnapshot& bus);

    /// The address in use: the one that was set by hand, if it is valid.
    std::uint8_t address() const { return address_; }
    BusOrders bus_orders() const;
    /// RIDE THROUGH, as StationLink::zero_after_ms has it; without a function block what the file says.
    std::int64_t zero_after_ms() const;
    const led::Condition& condition() const { return condition_; }

    /// Null: the device has no function block.
    const TecOption* tec() const { return tec_ ? &*tec_ : nullptr; }
    TecOption* tec() { return tec_ ? &*tec_ : nullptr; }
    const WatchedTags& watched() const { return watched_; }

    /// "0: NO TRIP", "5: EXTERNAL TRIP", "unknown: ..."; while it cannot be read the last one, and why it may
    /// be old; "not known: ..." where no tag has it. Nothing: the device has no function block.
    std::optional<std::string> trip() const;
    /// As the extended diagnosis has it. What is not known is no trip.
    std::uint8_t trip_octet() const;
    /// The tag that the trip is read from; nothing: none is configured.
    std::optional<std::int64_t> trip_tag() const;
    /// Nothing: not known, or no tag has it.
    std::optional<bool> tripped() const;
    /// Why the station is kept silent on the bus, and what to do; empty: it is not.
    std::string silent_because() const;
    /// As TecOption::notes().
    std::vector<std::string> notes() const;

private:
    bool mirrored(const profile::MirroredLamp& lamp) const;
    const WatchedTags::Seen* seen_trip() const;
    std::uint16_t trip_word() const;
    bool reports_a_fault() const;

    const config::StationConfig* config_;
    bool self_test_passed_;
    std::optional<TecOption> tec_;
    std::uint8_t address_;
    WatchedTags watched_;
    led::Condition condition_;
    bool is_away_ = false; ///< the station is off the bus for its drive
    std::string gone_;     ///< why; empty: the drive is here
};

} // namespace dpslave::app
