// SPDX-License-Identifier: Apache-2.0
/// The check before commissioning: a GSD file against the station that runs. dpctl asks the daemon, this
/// judges.
#pragma once

#include "dpslave/configurator/configurator.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::configurator {

/// The state of a station as the daemon reports it.
struct RunningStation {
    std::string name, profile;
    std::string protocol;                                         ///< of its drive: "ei-ascii"
    profile::StationKeys keys{};                                  ///< with its ident
    std::uint32_t baud = 0;                                       ///< of the bus now; 0 = none is found yet
    std::vector<std::pair<std::uint32_t, std::uint32_t>> rates{}; ///< bit/s, MaxTsdr in T_bit
    /// Bit times that 99.9 of 100 replies took, and the slowest; nullopt: none was sent.
    std::optional<std::uint32_t> usual_reply{}, slowest_reply{};
    std::string last_prm{}, last_cfg{};    ///< octets in hexadecimal; empty: no master sent them
    std::vector<std::uint16_t> unscaled{}; ///< tags that answer with a number whose scale is not known
};

/// `path` is the file's, for the lines. `table`: the tag table of the station; empty = that of its profile.
Outcome check_with_station(const Files& files, std::string_view file, const std::string& path, bool strict,
                           const RunningStation& station, const std::string& table);

} // namespace dpslave::configurator
