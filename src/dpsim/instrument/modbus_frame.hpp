// SPDX-License-Identifier: Apache-2.0
/// Modbus RTU (EI-ASCII and Modbus reference, section 5), written a second time: it shares nothing with the
/// library that the daemon uses.
#pragma once

#include "dpsim/common/telegram.hpp"

namespace dpslave::sim {

/// CRC-16 of Modbus: polynomial A001h, begun with FFFFh; goes over the line low octet first.
std::uint16_t crc16(Bytes octets);

/// Returns the octets followed by their CRC.
Octets with_crc(Octets octets);

/// Returns the number of octets of the request that begins with `head`, CRC included. The result 0 means that
/// too few are known to say. It is nullopt if the length of the function is not known, so that only silence
/// can end it.
std::optional<std::size_t> request_length(Bytes head);

/// The instruments of the 2000 series know these two and no others.
enum class Exception : std::uint8_t { none = 0, illegal_address = 2, illegal_value = 3 };

inline constexpr std::uint8_t kReadHolding = 3, kReadInput = 4, kWriteOne = 6, kReadFastStatus = 7,
                              kLoopback = 8, kWriteBlock = 16;

} // namespace dpslave::sim
