// SPDX-License-Identifier: Apache-2.0
/// A moment as a word of 64 bits: ns on the clock of the bus.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>

namespace dpslave::trace {

inline std::uint64_t word_of(Instant at)
{
    return static_cast<std::uint64_t>(at.time_since_epoch().count());
}

inline Instant instant_of(std::uint64_t word)
{
    return Instant{std::chrono::nanoseconds{static_cast<std::int64_t>(word)}};
}

} // namespace dpslave::trace
