// SPDX-License-Identifier: Apache-2.0
/// Chk_Cfg: identifiers and tags joined to a layout. Source: wire reference 4.5; HA389815 ch. 6.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/dp/refusal.hpp"

#include <cstdint>
#include <span>

namespace dpslave::dp {

/// The configuration of an accepted Chk_Cfg. The layout has no generation yet.
struct Configuration {
    bool demand = false;
    bool reads = false;         ///< at least one parameter is an input
    std::size_t in_length = 0;  ///< octets of a Data_Exchange reply, <= 244
    std::size_t out_length = 0; ///< octets of a Data_Exchange request, <= 244
    Layout layout{};
};

/// Returns what `cfg` (Cfg_Data) configures, or why it is refused. `tags` are those of the Set_Prm before.
Result<Configuration, RefusalDetail> check_chk_cfg(const Personality& personality,
                                                   std::span<const std::uint16_t> tags, Bytes cfg);

/// The first octet that differs, when a master in Data_Exch checks other octets than the accepted ones.
RefusalDetail cfg_difference(Bytes accepted, Bytes cfg);

} // namespace dpslave::dp
