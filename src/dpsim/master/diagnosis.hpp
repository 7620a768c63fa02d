// SPDX-License-Identifier: Apache-2.0
/// Slave_Diag as the master reads it (wire reference 5.1 and 5.3), and in words.
#pragma once

#include "dpsim/common/telegram.hpp"

#include <string_view>

namespace dpslave::sim {

struct DiagnosisBit {
    std::size_t octet; ///< from 1
    std::uint8_t mask;
};
inline constexpr DiagnosisBit kNotReady{1, 0x02}, kCfgFault{1, 0x04}, kNotSupported{1, 0x10},
    kPrmFault{1, 0x40}, kPrmRequired{2, 0x01}, kStatDiag{2, 0x02};

/// The six standard octets and what follows them.
struct Diagnosis {
    Octets octets;              ///< all of them, at least six
    std::uint8_t master = 0xFF; ///< Master_Add; FF = none
    std::uint16_t ident = 0;

    bool has(DiagnosisBit bit) const { return (octets[bit.octet - 1] & bit.mask) != 0; }
};

/// Reads the data unit of a Slave_Diag reply; says what is implausible about it.
Result<Diagnosis, std::string> parse_diagnosis(Bytes data);

/// One line a finding, the standard octets first, then each block of the extended part.
std::vector<std::string> explain(const Diagnosis& diagnosis);

/// Returns whether the finding of this name ("prm-fault", "cfg-fault", "not-ready", "prm-required",
/// "ext-diag", "stat-diag", "not-supported", "watchdog", "freeze", "sync", "overflow") is set; nullopt if
/// there is no such name.
std::optional<bool> finding(const Diagnosis& diagnosis, std::string_view name);

} // namespace dpslave::sim
