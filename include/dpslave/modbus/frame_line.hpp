// SPDX-License-Identifier: Apache-2.0
/// The line as the Modbus client uses it: sends and receives frames. It does not interpret them, and the
/// client has no descriptor.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <cstdint>

namespace dpslave::modbus {

class FrameLine {
public:
    enum class Heard : std::uint8_t {
        frame,   ///< with a right check sum and without a parity fault: frame()
        silence, ///< until the time was over
        broken,  ///< octets that are no frame
        gone,    ///< the port has vanished, or is not there yet
    };

    /// Sends a request, the check sum behind it; need not wait until it has left. False: the line does not
    /// take it (unplugged).
    virtual bool send(std::uint8_t unit, Bytes pdu) = 0;

    /// Waits for the next frame, at most until `until`; what has come already is given at once.
    virtual Heard receive(Instant until) = 0;

    /// The last frame of receive(): unit first, without check sum. Valid until the next call.
    virtual Bytes frame() const = 0;

    /// The monotonic clock that receive() waits by.
    virtual Instant now() const = 0;

protected:
    ~FrameLine() = default;
};

} // namespace dpslave::modbus
