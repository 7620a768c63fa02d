// SPDX-License-Identifier: Apache-2.0
/// FDL telegrams (EN 50170-2; wire reference, section 2), written a second time. It shares nothing with the
/// daemon, on purpose: an error there is not repeated here.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::sim {

using Octets = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kBroadcast = 127; ///< only as DA, never answered

/// Service access points of a DP slave (wire reference 4.1); a master calls them from SAP 62.
inline constexpr std::uint8_t kSapMaster = 62;
inline constexpr std::uint8_t kSapGlobalControl = 58;
inline constexpr std::uint8_t kSapGetCfg = 59;
inline constexpr std::uint8_t kSapSlaveDiag = 60;
inline constexpr std::uint8_t kSapSetPrm = 61;
inline constexpr std::uint8_t kSapChkCfg = 62;
std::string_view sap_name(std::uint8_t sap); ///< of the service: "Slave_Diag"; empty = none

/// SC, SD4, SD1, SD2, SD3.
enum class FrameKind : std::uint8_t { short_ack, token, no_data, variable, fixed };

/// One telegram in parts. `data` is the data unit without the SAP octets.
struct Frame {
    FrameKind kind = FrameKind::no_data;
    std::uint8_t da = 0; ///< without the EXT bit
    std::uint8_t sa = 0;
    std::uint8_t fc = 0;
    std::optional<std::uint8_t> dsap{};
    std::optional<std::uint8_t> ssap{};
    Octets data{};
};

enum class Fixed : bool { never, when_eight }; ///< SD3 for a data unit of exactly eight octets?

/// The octets on the wire. `kind` is not looked at: an empty data unit makes SD1, eight octets SD3 if wanted,
/// others SD2. Precondition: data unit with SAP octets at most 246 octets.
Octets encode(const Frame& frame, Fixed fixed = Fixed::never);

/// Returns how long the telegram that begins with `head` is; 0 = too few octets to say; else why it cannot be
/// one.
Result<std::size_t, std::string> frame_length(Bytes head);

/// Takes a complete telegram apart, or says in words what is wrong with it.
/// Precondition: octets.size() == *frame_length(octets), not 0.
Result<Frame, std::string> decode(Bytes octets);

/// "Slave_Diag request 2 to 5" and the like.
std::string describe(const Frame& frame);

} // namespace dpslave::sim
