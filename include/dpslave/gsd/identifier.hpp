// SPDX-License-Identifier: Apache-2.0
/// Identifier octets of Chk_Cfg as the standard defines them, whatever a device makes of them.
/// Source: wire reference 4.5.
#pragma once

#include "dpslave/base/bytes.hpp"

#include <cstddef>
#include <optional>

namespace dpslave::gsd {

inline constexpr std::uint8_t kEmptySlot = 0x00; ///< special format without a length or an octet after it

struct Identifier {
    std::size_t length = 1; ///< octets that it takes in Chk_Cfg: 1..17
    std::size_t in = 0;     ///< octets from the slave to the master
    std::size_t out = 0;
    bool in_words = false;        ///< all that it has is counted in words; false: some of it in octets
    std::size_t manufacturer = 0; ///< octets of its own at the end of the special format
};

/// Returns the identifier that `octets` begin with; nullopt if there is none, or it is cut short.
std::optional<Identifier> first_identifier(Bytes octets);

/// Returns the sum of all identifiers; nullopt if one of them is cut short.
std::optional<Identifier> sum_of_identifiers(Bytes octets);

/// Returns how many of them are an empty slot. It stops at an identifier that is cut short.
std::size_t empty_slots(Bytes octets);

} // namespace dpslave::gsd
