// SPDX-License-Identifier: Apache-2.0
/// Captures of the tests, packet by packet.
#pragma once

#include "dpsim/octets.hpp"
#include "dpsim/replay/replay_script.hpp"

namespace dpslave::sim {

using pcapng::Direction;

inline constexpr std::uint16_t kBusLink = 257;

/// Interface 0 is the bus, 1 a drive line.
inline pcapng::Capture capture_of(std::vector<pcapng::Packet> packets, std::uint16_t drive_link = 148)
{
    pcapng::Capture capture;
    capture.interfaces = {{.link_type = kBusLink, .name = "bus", .description = {}},
                          {.link_type = drive_link, .name = "drive", .description = {}}};
    capture.packets = std::move(packets);
    return capture;
}

/// A packet of the bus at this time: heard by the gateway, or said by it.
inline pcapng::Packet bus_in(std::int64_t ms, const std::string& octets)
{
    return {
        .interface = 0, .unix_ns = ms * 1'000'000, .direction = Direction::inbound, .octets = wire(octets)};
}
inline pcapng::Packet bus_out(std::int64_t ms, const std::string& octets)
{
    return {
        .interface = 0, .unix_ns = ms * 1'000'000, .direction = Direction::outbound, .octets = wire(octets)};
}

/// Frames of the drive line.
inline pcapng::Packet drive_out(std::int64_t ms, const std::string& octets)
{
    return {
        .interface = 1, .unix_ns = ms * 1'000'000, .direction = Direction::outbound, .octets = wire(octets)};
}
inline pcapng::Packet drive_in(std::int64_t ms, const std::string& octets)
{
    return {
        .interface = 1, .unix_ns = ms * 1'000'000, .direction = Direction::inbound, .octets = wire(octets)};
}

/// The script of packets that make one.
inline ReplayScript script(std::vector<pcapng::Packet> packets, std::uint16_t drive_link = 148)
{
    const auto made = script_of(capture_of(std::move(packets), drive_link));
    return made ? *made : ReplayScript{};
}

// Telegrams of the wire reference, section 4.2: master 2, slave 5.
inline const std::string kFdlStatus = "10 05 02 49 50 16", kFdlStatusOk = "10 02 05 00 07 16";
inline const std::string kDiagRequest = "68 05 05 68 85 82 6D 3C 3E EE 16";
inline const std::string kDiagNotReady = "68 0B 0B 68 82 85 08 3E 3C 00 0E 00 02 47 11 F1 16";
inline const std::string kDiagReady = "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 47 11 EF 16";
inline const std::string kChkCfg = "68 07 07 68 85 82 7D 3E 3E 11 21 32 16";
inline const std::string kExchange = "68 05 05 68 05 02 5D 00 00 64 16";
inline const std::string kInputs1234 = "68 05 05 68 02 05 08 12 34 55 16";
inline const std::string kInputs1234Dh = "68 05 05 68 02 05 0A 12 34 57 16";
inline const std::string kOperate = "68 07 07 68 FF 82 46 3A 3E 00 00 3F 16";

} // namespace dpslave::sim
