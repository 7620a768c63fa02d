// SPDX-License-Identifier: Apache-2.0
/// Why a Set_Prm or Chk_Cfg was refused: enough detail to correct the master's configuration.
#pragma once

#include "dpslave/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dpslave::dp {

/// The reason of a refusal. The comment of each says what `octet`, `expected` and `got` of RefusalDetail mean
/// for it.
enum class Refusal : std::uint8_t {
    none,
    prm_ident,         ///< another Ident_Number: octet 5, our ident, the master's
    prm_watchdog,      ///< WD_On with a factor 0: octet 2 or 3, at least 1, 0
    prm_not_supported, ///< Sync_Req or Freeze_Req that the device does not have: octet 1, what would do, what
                       ///< came
    prm_length,        ///< User_Prm_Data of an illegal length: octet 0, nearest legal length, length
    prm_dpv1, ///< DPV1_Status asks for what the device does not have: octet 8..10, what would do, what came
    prm_tag_too_large, ///< also what a master that takes the board for a DP-V1 device sends: its octet,
                       ///< highest tag, tag
    prm_zero_tag,      ///< a zero between tags: octet of the zero, at least 1, 0
    cfg_empty,         ///< no identifier at all: octet 0, at least 1, 0
    cfg_too_long,      ///< octet of the first identifier beyond the limit, identifiers allowed, identifiers
    cfg_identifier,    ///< no legal identifier, or Demand Data elsewhere than first: its octet, a legal one,
                       ///< what came
    cfg_too_few,       ///< fewer identifiers than tags: octet 0, tags, identifiers of parameters
    cfg_too_many,      ///< more identifiers than tags: octet of the first too many, tags, identifiers of
                       ///< parameters
    cfg_changed, ///< other octets than the accepted ones while in Data_Exch: first other octet, accepted,
                 ///< came
};
std::string_view text(Refusal why) noexcept;

/// The telegram that is refused.
enum class Service : std::uint8_t { none, set_prm, chk_cfg };
Service service_of(Refusal why) noexcept;

/// A refused telegram explained: which octet, what was expected, what came.
struct RefusalDetail {
    Refusal why = Refusal::none;
    std::uint16_t octet = 0;    ///< of Set_Prm or Cfg_Data, counted from 1; 0 = the telegram as a whole
    std::uint16_t expected = 0; ///< a value, a length or a count, by `why`
    std::uint16_t got = 0;
    friend bool operator==(const RefusalDetail&, const RefusalDetail&) = default;
};

/// Precondition: the numbers are those of a telegram, below 65536.
constexpr Failure<RefusalDetail> refuse(Refusal why, std::size_t octet, std::size_t expected, std::size_t got)
{
    return {{why, static_cast<std::uint16_t>(octet), static_cast<std::uint16_t>(expected),
             static_cast<std::uint16_t>(got)}};
}

} // namespace dpslave::dp
