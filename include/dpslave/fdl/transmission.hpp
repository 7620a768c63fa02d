// SPDX-License-Identifier: Apache-2.0
/// A reply on its way out, at a rate of PROFIBUS. Source: wire reference 1.1, 1.3, 11.3; row A-027.
#pragma once

#include "dpslave/base/transmission.hpp"
#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstddef>

namespace dpslave::fdl {

/// The longest time that a driver may be kept active for a reply: twice the longest telegram.
std::chrono::nanoseconds transmission_guard(Baud baud) noexcept;

class Transmission : public dpslave::Transmission {
public:
    /// `octets` were handed to the UART at `at` (the moment after the write).
    void begin(std::size_t octets, Instant at, Baud baud) noexcept;
};

} // namespace dpslave::fdl
