// SPDX-License-Identifier: Apache-2.0
/// The line as the Modbus client uses it: sends and receives frames. It does not interpret them, and the
/// client has no descriptor.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/drive/frame_notes.hpp"

#include <cstdint>

namespace dpslave::modbus {

class ModbusPort {
public:
    enum class Heard : std::uint8_t {
        frame,   ///< with a right checksum and without a parity error: frame()
        silence, ///< until the time was over
        broken,  ///< octets that are no frame
        rest,    ///< octets after something broken, until the line was silent: they have no meaning
        gone,    ///< the port has vanished, or is not there yet
    };

    /// Sends a request with its checksum; need not wait until it has left. Returns false if the line does not
    /// accept it (unplugged).
    virtual bool send(std::uint8_t unit, Bytes pdu) = 0;

    /// Returns true if octets of a send() that failed may have left all the same: the unit may answer them.
    virtual bool may_have_left() const { return false; }

    /// Waits for the next frame, at most until `until`; a frame that has come already is given at once.
    virtual Heard receive(Instant until) = 0;

    /// Returns the last frame of receive(): unit first, without checksum. Valid until the next call. It has a
    /// unit and a function at least.
    virtual Bytes frame() const = 0;

    /// The octets for which the last receive() gave a frame, something broken or a rest, as they were on the
    /// wire.
    struct Piece {
        Bytes octets;            ///< with checksum, valid until the next call; a bad character is 00
        drive::Judgement flaw{}; ///< of something broken
        Instant read_at{};       ///< when the last of them was read
        Instant begun = kNever;  ///< of a frame: when it can have begun at the latest (drive::FrameBegin)
        Bytes noise{};           ///< of a frame: what came before it and is no part of it
    };
    /// The default is for a line that has only its frames to show.
    virtual Piece piece() const
    {
        return {.octets = frame(), .flaw = drive::Judgement::truncated, .read_at = now()};
    }

    /// Returns whether characters take their time on it at present, so that the rule of time applies
    /// (drive/wire_time.hpp).
    virtual bool takes_wire_time() const { return false; }

    /// The monotonic clock that receive() waits by.
    virtual Instant now() const = 0;

protected:
    ~ModbusPort() = default;
};

} // namespace dpslave::modbus
