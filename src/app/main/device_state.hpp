// SPDX-License-Identifier: Apache-2.0
/// What a device says and lets set beyond plain DP: its TEC OPTION function block, its extended diagnosis and
/// the lamps that mirror the drive. One per station, the main thread's own. Pure: snapshots in; orders for
/// the bus and the drive line, conditions of the lamps and sentences for the log out. Source: HA463561U002
/// (rows B-040 to B-055, B-080 to B-084), handbook ch. 4 (C-015 to C-017, X-15).
#pragma once

#include "app/links.hpp"
#include "report.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/led/pattern.hpp"
#include "dpslave/tec/option_block.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::app {

/// A line for the log.
struct Sentence {
    bool is_warning = false;
    std::string text;
};

class DeviceState {
public:
    /// `config` outlives it. Until the first look() the drive and the ports count as sound. A failed
    /// self-test is one for good: the station stays silent.
    explicit DeviceState(const config::StationConfig& config, bool self_test_passed = true);

    /// The same device with other keys, whose `config` outlives it. What was set by hand stands, unless the
    /// file says something else about it than before.
    void adopt(const config::StationConfig& config);

    /// What is the case now: the snapshots of `station` and of the bus.
    void look(const Station& station, const BusSnapshot& bus);

    /// The address in force: the one that is set, while it is one.
    std::uint8_t address() const { return address_; }
    BusOrders bus_orders() const;
    /// RIDE THROUGH, as StationLink::zero_after_ms has it; without a function block what the file says.
    std::int64_t zero_after_ms() const;
    const led::Condition& condition() const { return condition_; }

    bool has_tec() const { return config_->tec.has_value(); }
    const tec::Settings& settings() const { return settings_; }
    std::array<tec::Row, 10> rows() const;
    /// "0: NO TRIP", "5: EXTERNAL TRIP", "unknown: ..."; while it cannot be read the last one, and why it may
    /// be old; "not known: ..." where no tag has it. Nothing: the device has no function block.
    std::optional<std::string> trip() const;
    /// The tag that the trip is read from; nothing: none is configured.
    std::optional<std::int64_t> trip_tag() const;
    /// Nothing: not known, or no tag has it.
    std::optional<bool> tripped() const;
    /// Why the station is kept silent on the bus, and what to do; empty: it is not.
    std::string silent_because() const;
    /// What may compromise safety, what to do next, and what the next start would change.
    std::vector<std::string> notes() const;
    /// Sets an input of the function block. Nothing: done; else why not, with what it takes.
    std::optional<std::string> set(std::string_view parameter, std::string_view value);
    /// What the address would be after a set(), if it is one; to be compared with those of other stations.
    std::optional<std::uint8_t> address_after(std::string_view parameter, std::string_view value) const;

    /// What FAULT would be after a set(), if that can be done: other than none it silences the station.
    std::optional<OptionFault> fault_after(std::string_view parameter, std::string_view value) const;

    /// What has changed since the last call: FAULT, NETWORK STATE, trip, faults of a status word; and each
    /// RIDE THROUGH that was set and could compromise safety (B-047).
    std::vector<Sentence> take_news();

private:
    /// How a watched tag of the drive is: the last word that was read stands while the drive is lost.
    struct Seen {
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool was_read = false;
        bool is_current = false;
    };

    const Seen* seen(std::uint16_t tag) const;
    std::uint16_t word_of(std::uint16_t tag) const;
    bool mirrored(const profile::MirroredLamp& lamp) const;
    void look_at_drive(const drive::UnitSnapshot& drive);
    const Seen* seen_trip() const;
    std::uint16_t trip_word() const;
    std::uint8_t trip_octet() const;
    bool reports_a_fault() const;
    void say(bool is_warning, std::string text);
    void say_ride_through();
    void say_fault();
    void say_trip();
    void say_status();
    void say_scales(const Station& station);

    const config::StationConfig* config_;
    tec::Settings settings_;
    tec::Hardware hardware_;
    OptionFault fault_ = OptionFault::none;
    NetworkState network_ = NetworkState::disabled;
    std::uint16_t int_diagnostic_ = 0;
    std::uint8_t address_;
    std::vector<Seen> seen_; ///< in the order of StationConfig::watched
    led::Condition condition_;

    OptionFault fault_said_ = OptionFault::none;
    std::optional<NetworkState> network_said_;
    std::uint8_t trip_said_ = 0;
    std::uint16_t status_said_ = 0;
    std::string scales_said_;
    std::vector<Sentence> news_;
};

} // namespace dpslave::app
