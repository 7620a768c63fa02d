// SPDX-License-Identifier: Apache-2.0
/// Reads what a master takes from a GSD for one slave: ident, Set_Prm, Chk_Cfg and lengths (wire reference,
/// 4.4, 4.5 and 9.2). It is pure.
#pragma once

#include "dpsim/common/gsd_file.hpp"
#include "master_settings.hpp"

namespace dpslave::sim {

struct GsdStation {
    std::string vendor{}, model{}; ///< UTF-8
    std::uint16_t ident = 0;
    bool sync = false, freeze = false;  ///< the device supports it
    std::vector<std::string> modules{}; ///< the names of those that are plugged, in the order of their slots
    Octets user_prm{};                  ///< of the device, then of each module
    Octets cfg{};
    CfgLengths lengths{};
};

/// `modules`: names in any case, or #3 for the third of the file, in the order of the slots. None: those that
/// are preset, or the one of a compact station. A failure is a sentence; where a module is missing or is none
/// of the file, the list of its modules follows, a line each.
Result<GsdStation, std::string> station_of(const GsdFile& file, const std::vector<std::string>& modules);

/// Ident, User_Prm_Data and Cfg_Data of the station. Sync and Freeze stay only where it supports them.
void apply(const GsdStation& station, MasterSettings& settings);

/// Data units without the SAP octets.
struct GsdTelegrams {
    Octets set_prm; ///< seven octets, then User_Prm_Data
    Octets chk_cfg;
};

/// A complete file and what it makes a master send. `others` says what no GSD says: watchdog, min T_SDR,
/// group, and whether Sync and Freeze are wanted.
Result<GsdTelegrams, std::string>
gsd_telegrams(std::string_view text, const std::vector<std::string>& modules, MasterSettings others = {});

} // namespace dpslave::sim
