// SPDX-License-Identifier: Apache-2.0
#include "modbus_frame.hpp"

namespace dpslave::sim {

std::uint16_t crc16(Bytes octets)
{
    unsigned crc = 0xFFFF;
    for (const std::uint8_t octet : octets) {
        crc ^= octet;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xA001U : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

Octets with_crc(Octets octets)
{
    const std::uint16_t crc = crc16(octets);
    octets.push_back(low(crc));
    octets.push_back(high(crc));
    return octets;
}

std::optional<std::size_t> request_length(Bytes head)
{
    if (head.size() < 2) return std::size_t{0};
    switch (head[1]) {
        case kReadHolding:
        case kReadInput:
        case kWriteOne:
        case kLoopback: return std::size_t{8};
        case kReadFastStatus: return std::size_t{4};
        case kWriteBlock: return head.size() < 7 ? std::size_t{0} : std::size_t{9} + head[6];
        default: return std::nullopt;
    }
}

} // namespace dpslave::sim
