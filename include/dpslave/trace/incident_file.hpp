// SPDX-License-Identifier: Apache-2.0
/// The file of an incident: a line that says what it is, a line of JSON (report/incident.hpp), records in
/// their wire form, and a checksum of all that in 4 octets, little endian. docs/internals/trace.md describes
/// it.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::trace {

inline constexpr std::string_view kIncidentMark = "dpslaved incident 1\n";
inline constexpr std::size_t kChecksumOctets = 4;
/// The longest second line, with its line break.
inline constexpr std::size_t kLongestHead = 48 * 1024;

/// CRC-32 as zlib and Ethernet have it, octet by octet.
class Crc32 {
public:
    void add(Bytes octets);
    std::uint32_t value() const { return ~crc_; }

private:
    std::uint32_t crc_ = 0xFFFF'FFFF;
};

/// Returns the checksum as the file has it.
std::array<std::uint8_t, kChecksumOctets> checksum_octets(const Crc32& crc);

/// A file begins like this. `head` is the JSON, without a line break.
std::string incident_begin(std::string_view head);
/// Returns the JSON of a file of which `begin` has at least kIncidentMark and kLongestHead octets, or all.
/// The failure is a clause.
Result<std::string_view, std::string> incident_head(Bytes begin);

/// Both lie in the octets that were read.
struct IncidentFile {
    std::string_view head; ///< JSON
    Bytes records;         ///< for take_record(), nothing else
};
/// A complete file. The failure is a clause: "it is cut off or damaged".
Result<IncidentFile, std::string> read_incident(Bytes file);

} // namespace dpslave::trace
