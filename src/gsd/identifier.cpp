// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/identifier.hpp"

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
        return found;
    }
    const bool in = (head & 0x40) != 0;
    const bool out = (head & 0x80) != 0;
    const std::size_t own = (head & 0x0F) == 15 ? 0U : head & 0x0FU; // manufacturer's octets at the end
    found.length = 1U + (in ? 1U : 0U) + (out ? 1U : 0U) + own;
    if (octets.size() < found.length) return std::nullopt;
    std::size_t at = 1;
    if (out) found.out = octets_of(octets[at++]); // of two length octets the one of the outputs comes first
    if (in) found.in = octets_of(octets[at]);
    return found;
}

std::optional<Identifier> sum_of_identifiers(Bytes octets)
{
    Identifier sum{0, 0, 0};
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

} // namespace dpslave::gsd
