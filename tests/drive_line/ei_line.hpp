// SPDX-License-Identifier: Apache-2.0
/// EI-ASCII drives on a simulated line, by a hand of its own (EI-ASCII reference, sections 1, 2 and 4).
#pragma once

#include "simulated_line.hpp"

#include "dpslave/drive/serial_line.hpp"

namespace dpslave::drive_line {

class EiLine final : public SimulatedLine, public drive::SerialLine {
public:
    using SimulatedLine::SimulatedLine;

    bool write(Bytes octets) override;
    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override;
    Instant now() const override { return time; }
    void discard() override;
    void lose_input() override { discard(); }
    bool takes_wire_time() const override { return rules().wire_time; }

private:
    struct Arrived {
        std::uint8_t octet = 0;
        Instant at{};
    };

    std::optional<Octets> carry_out(std::size_t drive, const SimulatedDrive::Question& question) override;
    bool names_its_drive(const Speech& speech) const override;
    void heard(const Speech& speech, Instant begins) override;
    Octets spoilt(Octets answer) override;
    Octets noise() override;

    Octets polled(std::size_t drive, const std::string& mnemonic);
    bool selected(std::size_t drive, const std::string& mnemonic, const std::string& text, Instant at);

    std::deque<Arrived> arrived_; ///< what the port has, and when a program can read it
};

} // namespace dpslave::drive_line
