// SPDX-License-Identifier: Apache-2.0
/// The options of `dpsim master` as texts, and the settings that they make.
#pragma once

#include "master.hpp"

namespace dpslave::sim {

/// As they are typed.
struct MasterTexts {
    std::uint32_t baud = 187'500;
    std::string ident, prm, tags, cfg, family = "option-board";
    std::size_t prm_length = 0;
    std::uint32_t watchdog_ms = 1000, slot_ms = 20;
    unsigned address = 2, slave = 5, min_tsdr = 11, group = 1;
    double cycle_ms = 10;
    bool no_watchdog = false, no_sync_freeze = false, no_demand = false, sd3 = false;
};

/// Puts the texts into the settings. Empty = good, else a sentence.
std::string complete(MasterSettings& settings, const MasterTexts& texts);

} // namespace dpslave::sim
