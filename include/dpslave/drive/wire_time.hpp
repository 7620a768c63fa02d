// SPDX-License-Identifier: Apache-2.0
/// The rule of time: no drive can begin to answer before the last octet of its question has left. Characters
/// take their time on a line, so that when a frame was read says when it can have begun at the latest. It is
/// pure.
#pragma once

#include "dpslave/base/units.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dpslave::drive {

/// [[line]] wire_time: whether characters take their time on the line.
enum class WireTime : std::uint8_t {
    automatic, ///< yes, but no on a pty
    yes,
    no,
};

/// Returns whether it applies to a port that is open now.
constexpr bool takes_wire_time(WireTime wire_time, bool is_pty)
{
    return wire_time == WireTime::yes || (wire_time == WireTime::automatic && !is_pty);
}

/// Returns from when on an answer can begin: not before the question has left, whose write began at `begun`
/// and may have waited in a queue. One character is allowed for the clocks of both ends, and for the stop bit
/// that a receiver does not wait for.
constexpr Instant answers_from(Instant begun, std::size_t characters, std::chrono::nanoseconds character)
{
    return begun + character * (static_cast<std::int64_t>(characters) - 1);
}

/// Returns when the last octet of a question has left. `written`: when its write returned, which waits for
/// the wire only where the port switches a driver.
constexpr Instant end_of_question(Instant begun, Instant written, std::chrono::nanoseconds duration)
{
    return std::max(begun + duration, written);
}

/// Returns the latest time at which octets can have begun that were read at `read_at`, maybe long after they
/// came.
constexpr Instant latest_begin(Instant read_at, std::size_t characters, std::chrono::nanoseconds character)
{
    return read_at - character * static_cast<std::int64_t>(characters);
}

/// Finds the latest time at which a frame can have begun, by each of its octets: one of them may have been
/// read in time.
class FrameBegin {
public:
    explicit FrameBegin(std::chrono::nanoseconds character) : character_(character) {}

    /// Its next octet was read at `read_at`, and with it `behind` more octets that follow it.
    void octet(Instant read_at, std::size_t behind)
    {
        begun_ = std::min(begun_, latest_begin(read_at, ++count_ + behind, character_));
    }
    Instant latest() const { return begun_; }

private:
    std::chrono::nanoseconds character_;
    std::size_t count_ = 0;
    Instant begun_ = kNever;
};

} // namespace dpslave::drive
