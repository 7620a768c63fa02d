// SPDX-License-Identifier: Apache-2.0
/// What a new configuration means for a program that runs: who goes on, who comes, who leaves, what has to
/// wait for a restart, and why it cannot be done at all. Pure. Source: A-033.
#pragma once

#include "dpslave/app/config.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

struct Plan {
    struct Line {
        std::optional<std::size_t> before; ///< index of the one with this name until now
        bool is_changed = false;           ///< its port is another one, or set in another way
        friend bool operator==(const Line&, const Line&) = default;
    };
    struct Station {
        /// Index of the one that goes on without a break; nothing: a new one, also where one of this name
        /// leaves.
        std::optional<std::size_t> stays;
        friend bool operator==(const Station&, const Station&) = default;
    };

    /// The new one, with the addresses that will be in force.
    Config config;
    std::vector<Line> lines;           ///< in the order of config.lines
    std::vector<Station> stations;     ///< in the order of config.stations
    std::vector<std::string> changes;  ///< what will be different, each a sentence; empty: nothing
    std::vector<std::string> pending;  ///< what waits for a restart of the service, each a sentence
    std::vector<std::string> refusals; ///< why none of it can be done, each a sentence; empty: it can
};

/// From `present`, as the last Plan had it or the file at the start, to `wanted`. `in_force`: the addresses
/// of the stations of `present` now; with a TEC OPTION block they may be others than those of the file. A
/// station is known by its name, a line as well.
Plan plan_reload(const Config& present, const std::vector<std::uint8_t>& in_force, Config wanted);

/// Nothing about the two is different, profile and tag table included; the lamps are not looked at, and lines
/// not but for their index.
bool is_same(const StationConfig& a, const StationConfig& b);

} // namespace dpslave::app
