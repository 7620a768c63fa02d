// SPDX-License-Identifier: Apache-2.0
/// The set bits of addresses and slots, without a look at the others one by one.
#pragma once

#include <bit>
#include <bitset>
#include <cstddef>
#include <cstdint>

namespace dpslave::app {

/// Calls `visit(n)` for every bit n that is set, upwards.
template <class Visit>
void for_each(const std::bitset<128>& bits_set, Visit visit)
{
    constexpr std::bitset<128> kLow{~0ULL};
    for (std::size_t half = 0; half < 2; ++half) {
        std::uint64_t bits = ((bits_set >> (half * 64)) & kLow).to_ullong();
        while (bits != 0) {
            visit(half * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
            bits &= bits - 1;
        }
    }
}

} // namespace dpslave::app
