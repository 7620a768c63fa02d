// SPDX-License-Identifier: Apache-2.0
/// What two GSD files say differently, however they are written.
#pragma once

#include "dpslave/gsd/io_map.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::configurator {

struct Difference {
    std::string what;                       ///< "Ident_Number", "Set_Prm", "input octets 0-1"
    std::optional<std::string> left, right; ///< as it is written, UTF-8; nothing: not there
    unsigned line = 0;                      ///< of the left file; 0: not there
};

/// Keywords, blocks, modules, Set_Prm, Chk_Cfg.
std::vector<Difference> differences(const gsd::Document& left, const gsd::Document& right);
/// What the tags are called in the comments of files that were made here, "; 3 out tag 6 Ramp rate": those of
/// the left file for which the right one has no name or another.
std::vector<Difference> name_differences(std::string_view left, std::string_view right);
/// Values of the telegrams. None where a file leaves the map to the master's tool.
std::vector<Difference> map_differences(const gsd::IoMap& left, const gsd::IoMap& right);

} // namespace dpslave::configurator
