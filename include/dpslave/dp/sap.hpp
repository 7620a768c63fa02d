// SPDX-License-Identifier: Apache-2.0
/// The service access points of a DP slave. Source: wire reference 4.1.
#pragma once

#include <cstdint>

namespace dpslave::dp::sap {

inline constexpr std::uint8_t kSetSlaveAdd = 55;
inline constexpr std::uint8_t kRdInp = 56;
inline constexpr std::uint8_t kRdOutp = 57;
inline constexpr std::uint8_t kGlobalControl = 58;
inline constexpr std::uint8_t kGetCfg = 59;
inline constexpr std::uint8_t kSlaveDiag = 60;
inline constexpr std::uint8_t kSetPrm = 61;
inline constexpr std::uint8_t kChkCfg = 62;

/// The SAP that every request of a master comes from.
inline constexpr std::uint8_t kMaster = 62;

} // namespace dpslave::dp::sap
