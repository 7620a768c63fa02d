// SPDX-License-Identifier: Apache-2.0
/// Times of a master on the bus (wire reference 1.3).
#pragma once

#include "dpslave/base/units.hpp"

#include <cstddef>

namespace dpslave::sim {

inline constexpr Tbit kTsyn{33}; ///< silence before a request
inline constexpr Tbit kTid1{37}; ///< pause after an answer: T_SYN and the safety margin 4

/// Default slot time.
constexpr Tbit slot_time(Baud baud)
{
    if (baud == Baud::k1500) return Tbit{300};
    return baud == Baud::k500 ? Tbit{200} : Tbit{100};
}

/// Pause after a request that is not answered: the largest T_SDR of the class.
constexpr Tbit pause_after_sdn(Baud baud)
{
    if (baud == Baud::k1500) return Tbit{150};
    return baud == Baud::k500 ? Tbit{100} : Tbit{60};
}

/// Returns how long `count` characters are on the line.
constexpr Tbit characters(std::size_t count)
{
    return Tbit{static_cast<std::uint32_t>(count) * kCharacter.count};
}

} // namespace dpslave::sim
