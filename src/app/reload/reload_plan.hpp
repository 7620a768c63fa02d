// SPDX-License-Identifier: Apache-2.0
/// What a new configuration means for a program that runs: which stations and lines stay, come and leave,
/// what has to wait for a restart, and why it cannot be done at all. Pure. Source: A-033.
#pragma once

#include "real_paths.hpp"

#include "dpslave/config/config.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

/// A tag that the master of a station uses: one of its layout, or the one that Demand Data asks for.
struct TagInUse {
    std::uint16_t tag = 0;
    /// What stands on the bus, or in the drive, for it. Nothing: no value of it was ever there, for instance
    /// because its scale is not known.
    std::optional<std::uint16_t> word;
};

/// How a station is while the plan is made.
struct InForce {
    std::uint8_t address = 0;     ///< with a TEC OPTION block it may be another one than that of the file
    std::vector<TagInUse> tags{}; ///< none while no master exchanges data with it
};

struct Plan {
    struct Line {
        std::optional<std::size_t> before; ///< index of the one that it continues
        bool is_changed = false;           ///< a key of it
        bool is_opened_anew = false;       ///< its port is another one, or set in another way
        friend bool operator==(const Line&, const Line&) = default;
    };
    struct Station {
        /// Index of the one that goes on without a break; nothing: a new one, also where one of this name
        /// leaves.
        std::optional<std::size_t> stays;
        bool is_changed = false; ///< with `stays`: a key of it, a row of its table, its name
        friend bool operator==(const Station&, const Station&) = default;
    };

    /// One that leaves the bus, and why: "unit", "removed".
    struct Leaving {
        std::string station; ///< its name until now
        std::string reason;
        friend bool operator==(const Leaving&, const Leaving&) = default;
    };

    /// The new one, with the addresses that will be in force.
    config::Config config;
    std::vector<Line> lines;           ///< in the order of config.lines
    std::vector<Station> stations;     ///< in the order of config.stations
    std::vector<std::string> changes;  ///< what will be different, each a sentence; empty: nothing
    std::vector<Leaving> leaving;      ///< those of the present stations that leave the bus
    std::vector<std::string> pending;  ///< what waits for a restart of the service, each a sentence
    std::vector<std::string> refusals; ///< why none of it can be done, each a sentence; empty: it can
    RealPaths real_paths{};            ///< of the present lines and of config.lines
};

/// From `present`, as the last Plan had it or the file at the start, to `wanted`. `in_force`: the stations of
/// `present` now. A line is known by its name, else by its port; a station by its name, else by its device:
/// profile, line, unit and address.
Plan plan_reload(const config::Config& present, const std::vector<InForce>& in_force, config::Config wanted);

} // namespace dpslave::app
