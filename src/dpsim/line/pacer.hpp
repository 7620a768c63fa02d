// SPDX-License-Identifier: Apache-2.0
/// Decides when each octet that was handed to a serial line arrives at its other end, and how it is changed
/// on the way. It is pure.
#pragma once

#include "dpsim/common/telegram.hpp"

#include "dpslave/base/units.hpp"

#include <deque>
#include <random>

namespace dpslave::sim {

/// One direction of a line. A character takes `bits` bit times; octets that come while the line is busy queue
/// up.
class Pacer {
public:
    /// `bits`: 10 or 11 per character. `baud` > 0.
    Pacer(std::uint32_t baud, unsigned bits, std::uint64_t seed) : baud_(baud), bits_(bits), random_(seed) {}

    /// Octet i of `octets`, read at `now`, is due at max(line free, now) + (i + 1) characters (+ delay).
    void take(Bytes octets, Instant now);
    /// Every octet that is due by `now`, oldest first: a late call takes what is overdue, so that the average
    /// rate stays exact.
    Octets due_by(Instant now);
    Instant next_due() const { return queue_.empty() ? kNever : queue_.front().due; }
    bool empty() const { return queue_.empty(); }
    std::size_t in_flight() const { return queue_.size(); }

    /// Chance of each bit to be inverted. A hit start or stop bit loses the character; wrong parity makes it
    /// 00, as a tty with INPCK delivers it (a pty has no parity of its own); an even number of hits passes
    /// unseen, as on a wire.
    void set_errors(double probability) { errors_ = probability; }
    void set_delay(std::chrono::nanoseconds delay) { delay_ = delay; }
    /// Sets the rate of the octets that are taken from now on. `baud` > 0.
    void set_baud(std::uint32_t baud);
    std::uint32_t baud() const { return baud_; }
    unsigned bits() const { return bits_; }
    /// Octets in flight are lost too.
    void set_cut(bool cut);

    std::uint64_t passed() const { return passed_; }
    std::uint64_t spoilt() const { return spoilt_; } ///< altered or lost by bit errors
    std::uint64_t lost() const { return lost_; }     ///< lost while the line was cut

private:
    struct Flight {
        std::uint8_t octet;
        Instant due;
    };
    Instant after(std::uint64_t characters) const;
    std::optional<std::uint8_t> through_noise(std::uint8_t octet);

    std::uint32_t baud_;
    unsigned bits_;
    std::mt19937_64 random_;
    double errors_ = 0;
    std::chrono::nanoseconds delay_{0};
    bool cut_ = false;
    Instant burst_began_{}; ///< characters are counted from here, so that rounding does not add up
    std::uint64_t burst_length_ = 0;
    Instant last_due_{};
    std::deque<Flight> queue_;
    std::uint64_t passed_ = 0, spoilt_ = 0, lost_ = 0;
};

} // namespace dpslave::sim
