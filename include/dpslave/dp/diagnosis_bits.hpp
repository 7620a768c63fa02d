// SPDX-License-Identifier: Apache-2.0
/// The bits of the first three octets of Slave_Diag by name. Source: wire reference 5.1. Those that only a
/// master sets in its own copy are named as well: a diagnosis may come from a master's screen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace dpslave::dp {

struct DiagnosisBit {
    std::size_t offset; ///< of the octet, counted from 0
    std::uint8_t mask;
    std::string_view name;
    std::string_view meaning;
};
inline constexpr std::array kDiagnosisBits = std::to_array<DiagnosisBit>({
    {0, 0x01, "Station_Non_Existent", "set by the master: no answer from the slave"},
    {0, 0x02, "Station_Not_Ready", "not ready for data exchange"},
    {0, 0x04, "Cfg_Fault", "the last Chk_Cfg did not match"},
    {0, 0x08, "Ext_Diag", "the extended diagnosis reports a fault"},
    {0, 0x10, "Not_Supported", "Sync or Freeze was asked for and is not supported"},
    {0, 0x20, "Invalid_Slave_Response", "set by the master: implausible reply"},
    {0, 0x40, "Prm_Fault", "the last Set_Prm was wrong"},
    {0, 0x80, "Master_Lock", "set by the master: parameterised by another master"},
    {1, 0x01, "Prm_Req", "must be parameterised"},
    {1, 0x02, "Stat_Diag", "starting: inputs are not valid yet, the master goes on reading the diagnosis"},
    {1, 0x08, "WD_On", "watchdog on"},
    {1, 0x10, "Freeze_Mode", "inputs are frozen"},
    {1, 0x20, "Sync_Mode", "outputs are held"},
    {1, 0x80, "Deactivated", "set by the master: the slave is inactive"},
    {2, 0x80, "Ext_Diag_Overflow", "more diagnosis than fits"},
});

} // namespace dpslave::dp
