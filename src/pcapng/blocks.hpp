// SPDX-License-Identifier: Apache-2.0
/// Numbers of the format: draft-ietf-opsawg-pcapng, sections 3 and 4. And the reader of the older format.
#pragma once

#include "dpslave/pcapng/pcapng.hpp"

#include <cstdint>
#include <string>

namespace dpslave::pcapng {

inline constexpr std::uint32_t kSectionBlock = 0x0A0D0D0A, kInterfaceBlock = 1, kSimplePacketBlock = 3,
                               kStatisticsBlock = 5, kEnhancedPacketBlock = 6;
inline constexpr std::uint32_t kByteOrder = 0x1A2B3C4D, kByteOrderSwapped = 0x4D3C2B1A;

enum Option : std::uint16_t {
    kEnd = 0,
    kComment = 1,
    kName = 2,           // of an interface
    kDescription = 3,    // of an interface
    kFlags = 2,          // of a packet
    kDropCount = 4,      // of a packet
    kProgram = 4,        // of a section
    kTimeResolution = 9, // of an interface
    kTimeOffset = 14,    // of an interface, s
    kStatisticsReceived = 4,
    kStatisticsDropped = 5,
};

/// epb_flags: direction in bits 0 and 1, errors of the link layer from bit 16 on.
inline constexpr std::uint32_t kDirectionMask = 3, kInbound = 1, kOutbound = 2;
inline constexpr std::uint32_t kChecksumError = 1U << 24, kSymbolError = 1U << 31;

inline constexpr std::uint8_t kNanoseconds = 9; // if_tsresol: 10^-9 s

/// It begins as a classic pcap file does.
bool is_pcap(Bytes file);
/// Reads a capture of the older format like read(). Precondition: is_pcap(file).
Result<Capture, std::string> read_pcap(Bytes file, bool* cut);

} // namespace dpslave::pcapng
