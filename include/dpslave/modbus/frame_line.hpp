// SPDX-License-Identifier: Apache-2.0
/// The line as the Modbus client uses it: sends and receives frames. It does not interpret them, and the
/// client has no descriptor.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/drive/line_frames.hpp"

#include <cstdint>

namespace dpslave::modbus {

class FrameLine {
public:
    enum class Heard : std::uint8_t {
        frame,   ///< with a right check sum and without a parity fault: frame()
        silence, ///< until the time was over
        broken,  ///< octets that are no frame
        rest,    ///< what came behind something broken, until the line was silent: it has no meaning
        gone,    ///< the port has vanished, or is not there yet
    };

    /// Sends a request, the check sum behind it; need not wait until it has left. False: the line does not
    /// take it (unplugged).
    virtual bool send(std::uint8_t unit, Bytes pdu) = 0;

    /// Waits for the next frame, at most until `until`; what has come already is given at once.
    virtual Heard receive(Instant until) = 0;

    /// The last frame of receive(): unit first, without check sum. Valid until the next call. It has a unit
    /// and a function at least.
    virtual Bytes frame() const = 0;

    /// What the last receive() gave a frame, something broken or a rest for, as it was on the wire.
    struct Piece {
        Bytes octets;            ///< with check sum, valid until the next call; a bad character is 00
        drive::Judgement flaw{}; ///< of something broken
        Instant read_at{};       ///< when the last of them was read
    };
    /// By default of a line that has no more to show than its frames.
    virtual Piece piece() const
    {
        return {.octets = frame(), .flaw = drive::Judgement::no_frame, .read_at = now()};
    }

    /// The monotonic clock that receive() waits by.
    virtual Instant now() const = 0;

protected:
    ~FrameLine() = default;
};

} // namespace dpslave::modbus
