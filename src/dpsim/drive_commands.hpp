// SPDX-License-Identifier: Apache-2.0
/// What can be typed at a simulated drive: faults, values, a list.
#pragma once

#include "dpsim/drive.hpp"

namespace dpslave::sim {

class DriveCommands {
public:
    explicit DriveCommands(DriveLine& line) : line_(line) {}

    /// Carries out one line and returns what is to be said about it.
    std::vector<std::string> command(std::string_view line, Instant now);
    bool quit() const { return quit_; }
    static std::vector<std::string> help();

private:
    using Words = std::vector<std::string>;
    std::vector<DriveUnit*> meant();
    std::string fault(const Words& words);
    std::string choose_unit(const Words& words);
    std::vector<std::string> get(const Words& words, Instant now);
    std::string set(const Words& words);
    std::string move(const Words& words, Instant now);
    std::vector<std::string> list(Instant now);
    std::vector<std::string> stats();

    DriveLine& line_;
    std::string unit_; ///< empty = all units
    bool quit_ = false;
};

} // namespace dpslave::sim
