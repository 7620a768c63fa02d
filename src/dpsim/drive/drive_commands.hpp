// SPDX-License-Identifier: Apache-2.0
/// The commands that can be typed at a simulated EI-ASCII drive: its faults, beside what every device has.
#pragma once

#include "dpsim/common/device_commands.hpp"
#include "drive.hpp"

namespace dpslave::sim {

class DriveCommands final : public DeviceCommands {
public:
    explicit DriveCommands(DriveLine& line) : DeviceCommands(line) {}
    static std::vector<std::string> all_help();

private:
    std::vector<std::string> help() const override { return all_help(); }
    std::vector<std::string> stats() override;
    std::vector<std::string> special(const Words& words, Instant now) override;
    std::string text(const Words& words);
};

} // namespace dpslave::sim
