// SPDX-License-Identifier: Apache-2.0
/// Capture files of the form pcapng (IETF draft-ietf-opsawg-pcapng): octets to packets and back. Pure: the
/// caller reads and writes the file. Written are one section, little endian, times in nanoseconds; read is
/// what any program writes.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::pcapng {

/// What a packet is. Source: tcpdump.org, list of link-layer header types.
enum class LinkType : std::uint16_t {
    user0 = 147,       ///< telegrams for programs that do not know 257
    user1 = 148,       ///< what is on a drive line with EI-ASCII
    user2 = 149,       ///< what is on a drive line with Modbus RTU
    profibus_dl = 257, ///< a telegram from start delimiter to end delimiter; or what was heard in its place
};

struct Interface {
    std::uint16_t link_type = 0; ///< of a file: any number
    std::string name;
    std::string description;
};

/// As seen by the program that wrote the file.
enum class Direction : std::uint8_t { unknown, inbound, outbound };

struct Packet {
    std::uint32_t interface = 0; ///< index into the interfaces
    std::int64_t unix_ns = 0;    ///< since 1970, UTC
    Direction direction = Direction::unknown;
    bool checksum_error = false;            ///< a wrong check sum, or no telegram at all
    bool character_error = false;           ///< parity, framing or break
    std::optional<std::uint64_t> dropped{}; ///< packets lost between the one before and this one
    std::vector<std::uint8_t> octets{};
    std::vector<std::string> comments{};
};

/// At the end of a file: what was counted for one interface.
struct Statistics {
    std::uint32_t interface = 0;
    std::int64_t unix_ns = 0;
    std::uint64_t received = 0;
    std::uint64_t dropped = 0;
};

using Octets = std::vector<std::uint8_t>;

/// The beginning of a file: section header, then one block for each interface.
Octets file_header(std::string_view program, std::string_view comment,
                   const std::vector<Interface>& interfaces);
/// One more interface; before its first packet.
Octets block(const Interface& interface);
Octets block(const Packet& packet);
Octets block(const Statistics& statistics);

struct Capture {
    std::string comment; ///< of the first section
    std::vector<Interface> interfaces;
    std::vector<Packet> packets;
    std::vector<Statistics> statistics;
};

/// A whole file. The failure is a sentence without the name of the file: what is wrong, at which octet. A
/// file that ends within a block (its writer was killed) gives all before it, and `cut` becomes true.
Result<Capture, std::string> read(Bytes file, bool* cut = nullptr);

} // namespace dpslave::pcapng
