// SPDX-License-Identifier: Apache-2.0
// Finds out who sent a packet, if the capture does not say it. Source: wire reference 2.1 to 2.4.
#include "dpslave/pcapng/pcapng.hpp"

#include <numeric>

namespace dpslave::pcapng {
namespace {

constexpr std::uint8_t kSD1 = 0x10, kSD2 = 0x68, kSD3 = 0xA2, kSC = 0xE5, kED = 0x16;
constexpr std::uint8_t kIsRequest = 0x40; // of the function code

/// Returns where DA is in a telegram that has a function code; 0 if it has none, or is no telegram.
std::size_t begin_of(Bytes octets)
{
    const std::size_t size = octets.size();
    if (size < 6 || octets[size - 1] != kED) return 0;
    std::size_t begin = 0;
    if ((octets[0] == kSD1 && size == 6) || (octets[0] == kSD3 && size == 14)) begin = 1;
    if (octets[0] == kSD2 && octets[3] == kSD2 && octets[1] == octets[2] && octets[1] + 6U == size &&
        octets[1] >= 4)
        begin = 4;
    if (begin == 0) return 0;
    const Bytes summed = octets.subspan(begin, size - begin - 2);
    const unsigned sum = std::accumulate(summed.begin(), summed.end(), 0U);
    return (sum & 0xFFU) == octets[size - 2] ? begin : 0;
}

Direction direction_of(Bytes octets, std::bitset<128>& replies_from)
{
    if (octets.size() == 1 && octets[0] == kSC) return Direction::outbound;
    const std::size_t begin = begin_of(octets);
    if (begin == 0 || (octets[begin + 2] & kIsRequest) != 0) return Direction::inbound;
    replies_from.set(octets[begin + 1] & 0x7FU);
    return Direction::outbound;
}

} // namespace

bool is_profibus(std::uint16_t link_type)
{
    return link_type == static_cast<std::uint16_t>(LinkType::profibus_dl) ||
           link_type == static_cast<std::uint16_t>(LinkType::user0);
}

Assumed assume_directions(Capture& capture)
{
    Assumed assumed;
    for (Packet& packet : capture.packets) {
        if (packet.direction != Direction::unknown || packet.octets.empty() ||
            !is_profibus(capture.interfaces.at(packet.interface).link_type))
            continue;
        packet.direction = direction_of(packet.octets, assumed.replies_from);
        ++assumed.packets;
    }
    return assumed;
}

std::string in_words(const Assumed& assumed)
{
    std::string text =
        "no direction is recorded with " + std::to_string(assumed.packets) +
        (assumed.packets == 1 ? " packet" : " packets") +
        " of the bus. Assumed: a function code with bit 6 is a request, one without it is a reply of this gateway, and so is SC";
    std::string stations;
    for (std::size_t address = 0; address < assumed.replies_from.size(); ++address)
        if (assumed.replies_from.test(address))
            stations += (stations.empty() ? "" : ", ") + std::to_string(address);
    return stations.empty() ? text : text + ". Its stations are then " + stations;
}

} // namespace dpslave::pcapng
