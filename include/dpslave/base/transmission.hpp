// SPDX-License-Identifier: Apache-2.0
/// Tells when written octets have left the line, and when the driver of the transceiver must be made inactive
/// whatever the UART says. It is pure: moments go in, moments come out. Source: wire reference 1.3, 11.3; row
///
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace dpslave {

class Transmission {
public:
    /// The times of the line at its rate.
    struct Times {
        std::chrono::nanoseconds character{}; ///< from the start bit to the last stop bit
        std::chrono::nanoseconds guard{};     ///< the longest time that the driver may be kept active
    };

    /// Octets that take `on_line` on the line were handed to the UART at `at` (the moment after the write).
    /// If a transmission is still in progress they follow it; the guard goes on counting from the first.
    void begin(std::chrono::nanoseconds on_line, Instant at, const Times& times) noexcept;
    bool is_running() const noexcept { return ends_ != kNever; }
    /// Returns from when on `is_over` is worth asking: when the last stop bit should have gone, and a quarter
    /// of a character after each `is_over` that was false. kNever = idle.
    Instant ends_at() const noexcept { return ends_; }
    /// Returns when the transmission counts as over whatever the UART says. kNever = idle.
    Instant guard_at() const noexcept { return guard_; }
    /// `empty`: what the UART says of its shift register, nothing if it cannot say. Returns true if it is
    /// over, and idle now.
    bool is_over(Instant now, std::optional<bool> empty) noexcept;
    /// It has ended: the line was heard to be free, or the port has gone.
    void stop() noexcept { ends_ = guard_ = kNever; }
    /// Returns until when the present or last transmission was certainly in progress, by calculation or by
    /// the UART.
    Instant busy_until() const noexcept { return busy_until_; }
    /// Returns how many transmissions were ended by the guard.
    std::uint64_t guarded() const noexcept { return guarded_; }

private:
    Instant ends_ = kNever;
    Instant guard_ = kNever;
    Instant busy_until_{};
    std::chrono::nanoseconds ask_again_{};
    std::uint64_t guarded_ = 0;
};

} // namespace dpslave
