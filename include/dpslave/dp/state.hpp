// SPDX-License-Identifier: Apache-2.0
/// The states of a DP slave, and why one was left. Source: wire reference 6.1, 6.3.
#pragma once

#include <cstdint>
#include <string_view>

namespace dpslave::dp {

/// Wait_Prm, Wait_Cfg, Data_Exch; power_on = silent, before start() and after stop().
enum class State : std::uint8_t { power_on, wait_prm, wait_cfg, data_exch };
std::string_view text(State state) noexcept; ///< "Wait_Prm" ...

/// Why Data_Exch (or Wait_Cfg) was left.
enum class LeaveReason : std::uint8_t {
    none,
    prm_fault,      ///< the owner's Set_Prm was refused
    not_supported,  ///< ... because it asked for Sync or Freeze
    cfg_fault,      ///< the owner's Chk_Cfg was refused
    watchdog,       ///< no request of the owner for T_WD
    unlock,         ///< the owner released the slave
    output_length,  ///< Data_Exchange of another length than configured
    new_parameters, ///< the owner chose other tags while in Data_Exch (row P12)
    stop,           ///< the application
};
std::string_view text(LeaveReason reason) noexcept;

} // namespace dpslave::dp
