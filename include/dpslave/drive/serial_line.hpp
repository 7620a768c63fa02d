// SPDX-License-Identifier: Apache-2.0
/// The serial line to drives, as a client uses it. It is independent of protocols and descriptors.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dpslave::drive {

class SerialLine {
public:
    /// Hands `octets` to the line; it need not wait until they have left. Returns false if the line does not
    /// accept them (unplugged).
    virtual bool write(Bytes octets) = 0;

    /// Returns true if octets of a write() that failed may have left all the same: a drive may answer them.
    virtual bool may_have_left() const { return false; }

    /// Waits at most `timeout` for the first octet, then gives what is there, at least one and at most
    /// `into.size()`. The result is 0 if nothing came in this time, or the line is gone. Parity is removed;
    /// an octet with wrong parity comes as 00.
    virtual std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) = 0;

    /// The monotonic clock that read() waits by.
    virtual Instant now() const = 0;

    /// Returns whether characters take their time on it at present, so that the rule of time applies
    /// (wire_time.hpp).
    virtual bool takes_wire_time() const { return false; }

    /// Drops all that was received and not yet read.
    virtual void discard() = 0;

protected:
    ~SerialLine() = default;
};

} // namespace dpslave::drive
