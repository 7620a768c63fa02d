// SPDX-License-Identifier: Apache-2.0
/// Octets of a capture as numbers, in the byte order that the file has.
#pragma once

#include "dpslave/base/bytes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace dpslave::pcapng {

/// The places that are asked for lie within the octets.
struct View {
    Bytes octets;
    bool swapped = false; ///< big endian

    std::uint16_t u16(std::size_t at) const
    {
        const std::uint16_t low = octets[at], high = octets[at + 1];
        return static_cast<std::uint16_t>(swapped ? low << 8 | high : high << 8 | low);
    }
    std::uint32_t u32(std::size_t at) const
    {
        const std::uint32_t one = u16(at), other = u16(at + 2);
        return swapped ? one << 16 | other : other << 16 | one;
    }
    std::uint64_t u64(std::size_t at) const
    {
        const std::uint64_t one = u32(at), other = u32(at + 4);
        return swapped ? one << 32 | other : other << 32 | one;
    }
    View from(std::size_t at) const { return {octets.subspan(std::min(at, octets.size())), swapped}; }
    std::string text() const { return {octets.begin(), octets.end()}; }
};

} // namespace dpslave::pcapng
