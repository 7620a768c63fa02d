// SPDX-License-Identifier: Apache-2.0
/// The options of `dpsim master` as texts, and the settings that they make.
#pragma once

#include "master.hpp"

namespace dpslave::sim {

/// The options as they are typed.
struct MasterTexts {
    std::uint32_t baud = 187'500;
    std::string ident, prm, tags, cfg, family = "option-board";
    std::string gsd, modules; ///< a file, and names of its modules; empty: without a file
    std::size_t prm_length = 0;
    std::chrono::nanoseconds watchdog = std::chrono::seconds{1}, slot = std::chrono::milliseconds{20},
                             cycle = std::chrono::milliseconds{10};
    unsigned address = 2, slave = 5, min_tsdr = 11, group = 1;
    bool no_watchdog = false, no_sync_freeze = false, no_demand = false, sd3 = false;
};

/// Puts the texts into the settings, and reads the GSD if they name one. Returns what to tell the user of it,
/// a sentence each; or what is wrong.
Result<std::vector<std::string>, std::string> complete(MasterSettings& settings, const MasterTexts& texts);

} // namespace dpslave::sim
