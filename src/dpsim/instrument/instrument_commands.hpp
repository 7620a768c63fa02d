// SPDX-License-Identifier: Apache-2.0
/// The commands that can be typed at a simulated instrument: its faults, its front panel, its status bits.
#pragma once

#include "dpsim/common/device_commands.hpp"
#include "modbus_line.hpp"

namespace dpslave::sim {

class InstrumentCommands final : public DeviceCommands {
public:
    explicit InstrumentCommands(ModbusLine& line) : DeviceCommands(line), line_(line) {}
    static std::vector<std::string> all_help();

private:
    std::vector<std::string> help() const override { return all_help(); }
    std::vector<std::string> stats() override;
    std::vector<std::string> special(const Words& words, Instant now) override;

    std::string panel(const Words& words, Instant now);
    std::string bit(const Words& words, Instant now);
    std::string tune(const Words& words);
    std::string fault(const Words& words);

    ModbusLine& line_;
};

} // namespace dpslave::sim
