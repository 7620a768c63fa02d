// SPDX-License-Identifier: Apache-2.0
/// The captures of tests/captures: of a foreign master, of the examples of the manuals and the wire
/// reference, and of faults that were found. Each folder has a page with what they show.
#pragma once

#include "dpslave/pcapng/pcapng.hpp"

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace captures {

/// The station that answers: its configuration is stations/NAME.toml.
struct Station {
    std::string name;
    std::string profile;
    std::uint16_t ident;
    std::uint8_t address;
    std::string profiles; ///< folder of the profile
};

/// One of the files. The first part of its name is that of its station.
struct Scenario {
    std::string folder; ///< "foreign", "worked" or "found"
    std::string name;   ///< without its ending
    Station station;
    /// Path of the capture that was recorded before it with the same daemon: its Cfg_Fault still stands.
    /// Empty: a new daemon.
    std::string before;

    std::string path() const;
    /// Recorded, with values and times of a real drive. The others are written by make.py, octet for octet.
    bool is_recorded() const { return folder == "foreign"; }
};
inline void PrintTo(const Scenario& scenario, std::ostream* out)
{
    *out << scenario.folder << "/" << scenario.name;
}

/// All files that are in the folders, in the order of their names.
const std::vector<Scenario>& all_scenarios();
/// Throws if there is none of this name.
const Scenario& scenario(const std::string& name);
std::string folder_of_stations(); ///< with a slash at its end
/// Throws if it cannot be read.
dpslave::pcapng::Capture read_capture(const std::string& path);

/// For the name of a test: letters and digits.
std::string test_name_of(const Scenario& scenario);

} // namespace captures
