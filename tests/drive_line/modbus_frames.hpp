// SPDX-License-Identifier: Apache-2.0
/// Modbus drives on a simulated line, frame by frame, by a hand of its own (MODBUS Application Protocol
/// V1.1b3; EI-ASCII and Modbus reference, section 5). Frames begin with the unit and have no checksum here:
/// one that would not pass it is broken.
#pragma once

#include "simulated_line.hpp"

#include "dpslave/modbus/frame_line.hpp"

namespace dpslave::drive_line {

class ModbusFrames final : public SimulatedLine, public modbus::FrameLine {
public:
    using SimulatedLine::SimulatedLine;

    bool send(std::uint8_t unit, Bytes pdu) override;
    Heard receive(Instant until) override;
    Bytes frame() const override { return frame_; }
    Instant now() const override { return time; }

private:
    struct Arrived {
        Octets octets;
        Instant at{}; ///< of its last octet
        bool is_broken = false;
    };

    std::optional<Octets> carry_out(std::size_t drive, const SimulatedDrive::Question& question) override;
    void heard(const Speech& speech, Instant begins) override;
    Octets spoilt(Octets answer) override { return answer; }
    Octets noise() override { return Octets(1 + chance().below(8), 0xFF); }

    Octets read(std::size_t drive, std::uint8_t function, unsigned first, unsigned count);
    Octets write_one(std::size_t drive, unsigned reg, std::uint16_t word, Instant at);
    Octets write_many(std::size_t drive, const Octets& pdu, Instant at);

    std::deque<Arrived> arrived_; ///< what the port has, and when a program can read it
    Octets frame_;
};

} // namespace dpslave::drive_line
