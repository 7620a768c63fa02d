// SPDX-License-Identifier: Apache-2.0
/// Finds the differences in meaning between two GSD files, whatever their form.
#pragma once

#include "dpslave/gsd/io_map.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::configurator {

struct Difference {
    std::string what;                       ///< "Ident_Number", "Set_Prm", "input octets 0-1"
    std::optional<std::string> left, right; ///< as it is written, UTF-8; nullopt: not there
    unsigned line = 0;                      ///< of the left file; 0: not there
};

/// Keywords, blocks, modules, Set_Prm, Chk_Cfg.
/// `cfg`: of files whose modules are a choice, the Chk_Cfg that the master sends; empty: not known.
std::vector<Difference> differences(const gsd::Document& left, const gsd::Document& right,
                                    const std::vector<std::uint8_t>& cfg = {});
/// Compares the names of tags in the comments of files that were made here, "; 3 out tag 6 Ramp rate": it
/// returns those of the left file for which the right one has no name or another.
std::vector<Difference> name_differences(std::string_view left, std::string_view right);
/// The names that such comments of a file have for tags that have none yet.
void add_names(gsd::MapHints& hints, std::string_view file);
/// Values of the telegrams. None where a file leaves the map to the master's tool.
std::vector<Difference> map_differences(const gsd::IoMap& left, const gsd::IoMap& right);

} // namespace dpslave::configurator
