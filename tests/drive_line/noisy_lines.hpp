// SPDX-License-Identifier: Apache-2.0
/// Lines with bit errors in both directions between a client and simulated drives.
#pragma once

#include "ei_line.hpp"
#include "modbus/frame_receiver.hpp"
#include "modbus_frames.hpp"
#include "support/bit_line.hpp"

#include <deque>

namespace dpslave::drive_line {

/// 7E1. A drive says nothing to a question with a bad character; here an octet with wrong parity comes as 00
/// (SerialLine).
class EiLineWithBitErrors final : public drive::SerialLine {
public:
    EiLineWithBitErrors(EiLine& line, double errors);

    bool write(Bytes octets) override;
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override;
    Instant now() const override { return line_.now(); }
    void discard() override;

    void heal();
    std::uint64_t hits() const { return there_.hits() + back_.hits(); }

private:
    EiLine& line_;
    ::test::BitLine there_, back_;
    std::deque<std::uint8_t> waiting_;
};

/// Frames octet by octet with their checksum, 8N1 or 8E1. The program's receiver makes frames of what
/// arrives; a checksum of this line's own says what a drive takes, and what was sent says whether the
/// receiver was right.
class ModbusLineWithBitErrors final : public modbus::ModbusPort {
public:
    ModbusLineWithBitErrors(ModbusFrames& line, double errors, ::test::Parity parity);

    bool send(std::uint8_t unit, Bytes pdu) override;
    Heard receive(Instant until) override;
    Bytes frame() const override { return receiver_.frame(); }
    Piece piece() const override
    {
        return {.octets = receiver_.piece(), .flaw = receiver_.flaw(), .read_at = now()};
    }
    Instant now() const override { return line_.now(); }

    void heal();
    std::uint64_t hits() const { return there_.hits() + back_.hits(); }
    std::uint64_t refused() const { return refused_; } ///< answers that the receiver has called broken
    /// Frames other than the drive has sent that the receiver gave, and questions other than the client has
    /// sent whose checksum is right.
    std::uint64_t taken_for_good() const { return taken_for_good_; }

private:
    Heard of_what_has_come();

    ModbusFrames& line_;
    ::test::BitLine there_, back_;
    modbus::FrameReceiver receiver_;
    std::deque<::test::Character> waiting_;
    Octets answered_; ///< by the drive, last
    std::uint64_t refused_ = 0, taken_for_good_ = 0;
};

} // namespace dpslave::drive_line
