// SPDX-License-Identifier: Apache-2.0
/// A capture as what is to be done again: the telegrams that the gateway heard, what it answered, and the
/// frames of its drive line. It is pure.
#pragma once

#include "dpsim/common/telegram.hpp"

#include "dpslave/pcapng/pcapng.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace dpslave::sim {

/// One packet that the gateway heard: a telegram, or what was heard in its place.
struct ReplayStep {
    Octets octets{};
    std::size_t packet = 0;           ///< its number in the file, from 1
    std::chrono::nanoseconds at{};    ///< since the first packet of the file
    std::chrono::nanoseconds pause{}; ///< since the packet of the bus before it
    std::optional<Octets> answer{};   ///< of the gateway
    std::size_t answer_packet = 0;    ///< 0: none
};

struct DriveFrame {
    Octets octets{};
    bool to_drive = false; ///< sent by the gateway
    std::chrono::nanoseconds at{};
};

struct ReplayScript {
    std::vector<ReplayStep> steps{};
    std::vector<DriveFrame> drive{};
    bool is_modbus = false; ///< the drive frames are Modbus RTU, else EI-ASCII
    /// Names of the interfaces that have such frames, in the order of their first one. If there are two of
    /// them `drive` has the frames of the first.
    std::vector<std::string> drive_lines{};
};

/// Link types of the drive line, as numbers.
inline constexpr auto kEiAsciiLink = static_cast<std::uint16_t>(pcapng::LinkType::user1);
inline constexpr auto kModbusLink = static_cast<std::uint16_t>(pcapng::LinkType::user2);

/// The directions of the packets say which of them the gateway sent. Octets before the first telegram may be
/// the end of one, and are left out, as is one that `dpctl trace` calls cut. `line`: whose drive frames, by
/// the name of the interface, also without "drive " before it; empty: the first. The failure is a sentence:
/// what the capture lacks. A pause is an hour at most, the sum a year, and a time that goes back is no pause.
Result<ReplayScript, std::string> script_of(const pcapng::Capture& capture, const std::string& line = {});

} // namespace dpslave::sim
