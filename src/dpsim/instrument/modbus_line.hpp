// SPDX-License-Identifier: Apache-2.0
/// One or more instruments as Modbus RTU slaves on one serial line (EI-ASCII and Modbus reference, section
/// 5).
#pragma once

#include "instrument.hpp"

namespace dpslave::sim {

class ModbusLine final : public DeviceLine {
public:
    explicit ModbusLine(std::chrono::nanoseconds turnaround) : DeviceLine(turnaround, 0xFF) {}

    /// False if the address is not 1 to 254, or taken.
    bool add(Instrument instrument);

    void on_bytes(Bytes octets, Instant now) override;
    std::vector<Device*> devices() override;

    std::vector<Instrument>& instruments() { return instruments_; }
    std::uint64_t bad_crc() const { return bad_crc_; }         ///< requests with a wrong CRC
    std::uint64_t unsupported() const { return unsupported_; } ///< functions that get no answer

private:
    void request(Bytes frame, Instant now);
    void carry_out(Instrument& instrument, Bytes frame, Instant now);
    Exception read(Instrument& instrument, Bytes frame, Octets& answer, Instant now);
    Exception write(Instrument& instrument, Bytes frame, Octets& answer, Instant now);

    std::vector<Instrument> instruments_;
    Octets rx_;
    bool ignores_ = false; ///< until the line is idle: where the next request begins is not known
    Instant heard_{};
    std::uint64_t bad_crc_ = 0, unsupported_ = 0;
};

} // namespace dpslave::sim
