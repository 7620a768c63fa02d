// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/identifier.hpp"

#include <utility>

namespace dpslave::gsd {
namespace {

/// A length octet of the special format: bit 6 counts words, bits 5..0 are the count less one.
std::size_t octets_of(std::uint8_t length)
{
    return ((length & 0x3FU) + 1U) * ((length & 0x40) != 0 ? 2U : 1U);
}

} // namespace

std::optional<Identifier> first_identifier(Bytes octets)
{
    if (octets.empty()) return std::nullopt;
    const std::uint8_t head = octets[0];
    Identifier found;
    if ((head & 0x30) != 0) {
        const std::size_t length = ((head & 0x0FU) + 1U) * ((head & 0x40) != 0 ? 2U : 1U);
        if ((head & 0x10) != 0) found.in = length;
        if ((head & 0x20) != 0) found.out = length;
        found.in_words = (head & 0x40) != 0;
        return found;
    }
    const bool in = (head & 0x40) != 0;
    const bool out = (head & 0x80) != 0;
    found.manufacturer = (head & 0x0F) == 15 ? 0U : head & 0x0FU;
    found.length = 1U + (in ? 1U : 0U) + (out ? 1U : 0U) + found.manufacturer;
    if (octets.size() < found.length) return std::nullopt;
    found.in_words = in || out;
    std::size_t at = 1;
    for (const auto& [is_there, length] : {std::pair{out, &found.out}, std::pair{in, &found.in}}) {
        if (!is_there) continue; // of two length octets the one of the outputs comes first
        const std::uint8_t octet = octets[at++];
        *length = octets_of(octet);
        found.in_words = found.in_words && (octet & 0x40) != 0;
    }
    return found;
}

std::optional<Identifier> sum_of_identifiers(Bytes octets)
{
    Identifier sum{.length = 0};
    while (!octets.empty()) {
        const auto next = first_identifier(octets);
        if (!next) return std::nullopt;
        sum.length += next->length;
        sum.in += next->in;
        sum.out += next->out;
        octets = octets.subspan(next->length);
    }
    return sum;
}

std::size_t empty_slots(Bytes octets)
{
    std::size_t count = 0;
    while (const auto next = first_identifier(octets)) {
        if (octets[0] == kEmptySlot) ++count;
        octets = octets.subspan(next->length);
    }
    return count;
}

} // namespace dpslave::gsd
