// SPDX-License-Identifier: Apache-2.0
/// Capture files: octets to packets and back. It is pure: the caller reads and writes the file. Written is
/// pcapng (IETF draft-ietf-opsawg-pcapng): one section, little endian, times in nanoseconds. Read is what any
/// program writes, also the older form pcap (draft-ietf-opsawg-pcap).
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::pcapng {

/// The kind of a packet. Source: tcpdump.org, list of link-layer header types.
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

/// The direction as seen by the program that wrote the file.
enum class Direction : std::uint8_t { unknown, inbound, outbound };

struct Packet {
    std::uint32_t interface = 0; ///< index into the interfaces
    std::int64_t unix_ns = 0;    ///< since 1970, UTC
    Direction direction = Direction::unknown;
    bool checksum_error = false;            ///< a wrong checksum, or no telegram at all
    bool character_error = false;           ///< parity, framing or break
    bool is_part = false;                   ///< the program that recorded it has kept only its first octets
    std::optional<std::uint64_t> dropped{}; ///< packets lost between the one before and this one
    std::vector<std::uint8_t> octets{};
    std::vector<std::string> comments{};
};

/// The counts of one interface at the end of a file.
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

/// A complete file, pcapng or pcap. The failure is a sentence without the name of the file: what is wrong, at
/// which octet, or what it is instead. A file that ends within a block or packet (its writer was killed)
/// gives all before it, and `cut` becomes true.
Result<Capture, std::string> read(Bytes file, bool* cut = nullptr);

/// Packets of this type are those of a bus: 257, or 147 for programs that do not know it.
bool is_profibus(std::uint16_t link_type);

/// The assumptions that were made, because packets of the bus do not say who sent them.
struct Assumed {
    std::size_t packets = 0;         ///< 0: each of them said it
    std::bitset<128> replies_from{}; ///< the addresses that replied
};
/// Gives the packets of the bus without a direction one. Bit 6 of the function code tells a request, which is
/// inbound, from a reply, which is outbound (wire reference 2.3). A short acknowledge is a reply. A token,
/// and what is no telegram, is inbound.
Assumed assume_directions(Capture& capture);
/// Returns the assumptions in sentences without the name of the file. Precondition: `packets` is not 0.
std::string in_words(const Assumed& assumed);

} // namespace dpslave::pcapng
