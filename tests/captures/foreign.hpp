// SPDX-License-Identifier: Apache-2.0
/// The captures of tests/captures/foreign: a master that is not ours, and the daemon with a drive behind it.
#pragma once

#include "dpslave/pcapng/pcapng.hpp"

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace captures {

/// One of the files; `name` is without its ending.
struct Foreign {
    std::string name;
    std::string family; ///< "590": the configuration is FAMILY.toml
    std::string profile;
    std::uint16_t ident;
    /// The scenario that was recorded before it with the same daemon: its Cfg_Fault still stands. Empty: a
    /// new daemon.
    std::string before;
};
inline void PrintTo(const Foreign& foreign, std::ostream* out)
{
    *out << foreign.name;
}

/// Address of the slave in all of them.
inline constexpr std::uint8_t kSlave = 8;

const std::vector<Foreign>& all_foreign();
std::string folder_of_foreign(); ///< with a slash at its end
/// Throws if it cannot be read.
dpslave::pcapng::Capture read_foreign(const std::string& name);

/// For the name of a test: letters and digits.
std::string test_name_of(const Foreign& foreign);

} // namespace captures
