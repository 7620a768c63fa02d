// SPDX-License-Identifier: Apache-2.0
/// Modbus drives on a simulated line by a hand of its own (MODBUS Application Protocol V1.1b3; EI-ASCII and
/// Modbus reference, section 5). The program's receiver makes frames of the octets on the wire.
#pragma once

#include "modbus/frame_receiver.hpp"
#include "simulated_line.hpp"

#include "dpslave/modbus/modbus_port.hpp"

#include <cstdint>
#include <span>

namespace dpslave::drive_line {

/// MODBUS over Serial Line V1.02, 6.2.2, bit by bit: 0 over a whole frame.
std::uint16_t checksum(std::span<const std::uint8_t> octets);
/// Low octet first.
Octets with_checksum(Octets frame);

class ModbusFrames final : public SimulatedLine, public modbus::ModbusPort {
public:
    using SimulatedLine::SimulatedLine;

    bool send(std::uint8_t unit, Bytes pdu) override;
    Heard receive(Instant until) override;
    void lose_input() override
    {
        pass_until(time);
        while (!arrived_.empty() && arrived_.front().at <= time) arrived_.pop_front();
        receiver_ = {};
    }
    Bytes frame() const override { return receiver_.frame(); }
    Piece piece() const override
    {
        return {.octets = receiver_.piece(),
                .flaw = receiver_.flaw(),
                .read_at = time,
                .begun = receiver_.begun(rules().character),
                .noise = receiver_.noise()};
    }
    bool takes_wire_time() const override { return rules().wire_time; }
    Instant now() const override { return time; }

private:
    struct Arrived {
        std::uint8_t octet = 0;
        Instant at{};
    };

    std::optional<Octets> carry_out(std::size_t drive, const SimulatedDrive::Question& question) override;
    bool names_its_drive(const Speech& speech) const override { return speech.drive >= 0; }
    void heard(const Speech& speech, Instant begins) override;
    Octets spoilt(Octets answer) override;
    Octets noise() override;
    Octets false_frame();
    bool is_harmless(const Octets& noise) const;
    std::optional<Heard> take_arrived();

    Octets read(std::size_t drive, std::uint8_t function, unsigned first, unsigned count);
    Octets write_one(std::size_t drive, unsigned reg, std::uint16_t word, Instant at);
    Octets write_many(std::size_t drive, const Octets& pdu, Instant at);

    std::deque<Arrived> arrived_; ///< what the port has, and when a program can read it
    modbus::FrameReceiver receiver_;
    Octets question_; ///< the last one
};

} // namespace dpslave::drive_line
