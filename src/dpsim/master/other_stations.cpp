// SPDX-License-Identifier: Apache-2.0
#include "other_stations.hpp"

namespace dpslave::sim {
namespace {

constexpr std::uint8_t kRequest = 0x5D, kRequestWithBit = 0x7D, kReply = 0x08; // SRD high, and its answer
constexpr std::size_t kOutputs = 8, kInputs = 32;

/// The number in its first four octets, high octet first.
Octets numbered(std::uint32_t number, std::size_t length)
{
    Octets data(length);
    for (std::size_t i = 0; i < 4; ++i) data[i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
    return data;
}

} // namespace

Octets OtherStations::exchanges(std::uint8_t master, unsigned count)
{
    Octets octets;
    for (unsigned i = 0; i < count; ++i, ++number_) {
        const auto slave = static_cast<std::uint8_t>(kFirstOther + i);
        const std::uint8_t fc = number_ % 2 == 0 ? kRequest : kRequestWithBit;
        for (const Frame& frame :
             {Frame{.da = slave, .sa = master, .fc = fc, .data = numbered(number_, kOutputs)},
              Frame{.da = master, .sa = slave, .fc = kReply, .data = numbered(number_, kInputs)}}) {
            const Octets telegram = encode(frame);
            octets.insert(octets.end(), telegram.begin(), telegram.end());
        }
    }
    return octets;
}

} // namespace dpslave::sim
