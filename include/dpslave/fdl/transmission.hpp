// SPDX-License-Identifier: Apache-2.0
/// When a reply that was written has left the line, and when the driver has to be made inactive whatever the
/// UART says. Pure: moments in, moments out. Source: wire reference 1.1, 1.3, 11.3; row A-027.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace dpslave::fdl {

/// The longest time that a driver may be kept active for a reply: twice the longest telegram.
std::chrono::nanoseconds transmission_guard(Baud baud) noexcept;

class Transmission {
public:
    /// `octets` were handed to the UART at `at` (the moment after the write). A reply that begins while
    /// another one is still going out comes behind it; the guard goes on counting from the first one.
    void begin(std::size_t octets, Instant at, Baud baud) noexcept;
    bool is_running() const noexcept { return ends_ != kNever; }
    /// From when on `is_over` is worth asking: when the last stop bit has gone by T_bit arithmetic, and after
    /// an `is_over` that was false a quarter of a character later. kNever = idle.
    Instant ends_at() const noexcept { return ends_; }
    /// When it counts as over whatever the UART says. kNever = idle.
    Instant guard_at() const noexcept { return guard_; }
    /// `empty`: what the UART says of its shift register, nothing if it cannot say. True: over, and idle now.
    bool is_over(Instant now, std::optional<bool> empty) noexcept;
    /// It has ended: the line was heard to be free, or the port has gone.
    void stop() noexcept { ends_ = guard_ = kNever; }
    /// Of those that were over: how often the guard had to say so.
    std::uint64_t guarded() const noexcept { return guarded_; }

private:
    Instant ends_ = kNever;
    Instant guard_ = kNever;
    std::chrono::nanoseconds ask_again_{};
    std::uint64_t guarded_ = 0;
};

} // namespace dpslave::fdl
