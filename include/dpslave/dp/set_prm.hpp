// SPDX-License-Identifier: Apache-2.0
/// Set_Prm: what it says, and whether this device can do it. Source: wire reference 4.4; HA389815 ch. 6.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/dp/refusal.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <span>

namespace dpslave::dp {

/// Octets before User_Prm_Data; a shorter Set_Prm is discarded.
inline constexpr std::size_t kPrmHeader = 7;
/// Octets of DPV1_Status in front of User_Prm_Data, where a device has it.
inline constexpr std::size_t kDpv1Status = 3;

/// min T_SDR after power-on, and the smallest that a Set_Prm can set. Source: wire reference 4.4.
inline constexpr Tbit kSmallestMinTsdr{11};

/// Lock_Req and Unlock_Req; Unlock has priority.
enum class Lock : std::uint8_t {
    neither, ///< only min T_SDR is meant
    lock,
    unlock,
};
/// Precondition: telegram.size() >= kPrmHeader.
Lock lock_of(Bytes telegram);

/// `old` changed by octet 4: 0 keeps it, 1..10 count as 11. Precondition: telegram.size() >= kPrmHeader.
Tbit min_tsdr_of(Bytes telegram, Tbit old);

/// T_WD by the two factors, if the watchdog is on. `dpv1_status`: the device has DPV1_Status, with WD_Base.
/// Precondition: telegram.size() >= kPrmHeader.
std::chrono::milliseconds watchdog_of(Bytes telegram, bool dpv1_status);

/// The parameters of an accepted Set_Prm.
struct SetPrm {
    bool watchdog_on = false;
    std::chrono::milliseconds watchdog{}; ///< T_WD
    bool sync_requested = false;
    bool freeze_requested = false;
    std::uint8_t groups = 0; ///< Group_Ident
    ByteBuffer<kMaxUserPrm> user;
    std::uint8_t tag_count = 0;
    std::array<std::uint16_t, kMaxParameters> tag_list{};

    std::span<const std::uint16_t> tags() const { return std::span{tag_list}.first(tag_count); }
};

/// The parameters of the telegram, or why it is refused. Checks 5 to 8 of wire reference 4.4, in that order:
/// ident, Sync/Freeze, watchdog factors, User_Prm_Data. Precondition: telegram.size() >= kPrmHeader.
Result<SetPrm, RefusalDetail> check_set_prm(const Personality& personality, Bytes telegram);

} // namespace dpslave::dp
