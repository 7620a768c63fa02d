// SPDX-License-Identifier: Apache-2.0
/// Identifier octets of Chk_Cfg as the standard defines them, whatever a device makes of them.
/// Source: wire reference 4.5.
#pragma once

#include "dpslave/base/bytes.hpp"

#include <cstddef>
#include <optional>

namespace dpslave::gsd {

struct Identifier {
    std::size_t length = 1; ///< octets that it takes in Chk_Cfg: 1..17
    std::size_t in = 0;     ///< octets from the slave to the master
    std::size_t out = 0;
};

/// The identifier that `octets` begin with. Nothing: there is none, or it is cut short.
std::optional<Identifier> first_identifier(Bytes octets);

/// All identifiers together. Nothing: one of them is cut short.
std::optional<Identifier> sum_of_identifiers(Bytes octets);

} // namespace dpslave::gsd
