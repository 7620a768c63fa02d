// SPDX-License-Identifier: Apache-2.0
/// The TEC OPTION function block of one station: the inputs that were set, and the outputs that follow from
/// them and from the snapshots. Pure. Source: HA463561U002 (rows B-040 to B-055).
#pragma once

#include "app/links/links.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/tec/option_block.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::app {

class TecOption {
public:
    /// `config` outlives it. A failed self-test is permanent.
    TecOption(const config::TecConfig& config, bool self_test_passed);

    /// The same block with other keys, whose `config` outlives it. What was set by hand stands, unless the
    /// file says something else about it than before.
    void adopt(const config::TecConfig& config);

    /// `ext_diagnostic`: the word of the tag that EXT DIAGNOSTIC follows, if it follows one.
    void update(const BusSnapshot& bus, const dp::Snapshot& station, const drive::DriveSnapshot& drive,
                std::uint16_t ext_diagnostic);

    const tec::Settings& settings() const { return settings_; }
    OptionFault fault() const { return fault_; }
    /// The same, whether its drive feeds it or not: that the drive is gone is the bus thread's business
    /// (StationLink::departures).
    OptionFault fault_with_power() const;
    NetworkState network() const { return network_; }
    /// ADDRESS, while it is one.
    std::optional<std::uint8_t> address() const;
    std::array<tec::Row, 10> rows() const;

    /// "FAULT is ..., the station is silent on the bus", and what to do; empty: there is none.
    std::string fault_words() const;
    /// What may compromise safety, what to do next, and what the next start would change. `silent`: why the
    /// station is silent; empty: it is not.
    std::vector<std::string> notes(std::string silent) const;

    /// Sets an input. Nothing: done; else why not, with what it takes.
    std::optional<std::string> set(std::string_view parameter, std::string_view value);
    /// How often set() has changed RIDE THROUGH.
    std::uint32_t ride_through_changes() const { return ride_through_changes_; }
    /// The address and FAULT that a set() would bring; nothing: it could not be done, or changes no address.
    std::optional<std::uint8_t> address_after(std::string_view parameter, std::string_view value) const;
    std::optional<OptionFault> fault_after(std::string_view parameter, std::string_view value) const;

private:
    const config::TecConfig* config_;
    tec::Settings settings_;
    tec::Hardware hardware_;
    OptionFault fault_;
    NetworkState network_ = NetworkState::disabled;
    std::uint16_t int_diagnostic_ = 0;
    std::uint32_t ride_through_changes_ = 0;
};

/// What is said of a RIDE THROUGH that is not 0 (B-047).
extern const std::string_view kRideThroughWarning;

} // namespace dpslave::app
