// SPDX-License-Identifier: Apache-2.0
/// Looking for a drive that was never heard: which rates, formats and units are worth a question, in the
/// order in which they are asked. Pure.
#pragma once

#include "dpslave/config/config.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::app {

/// One way of asking: the settings of the port and the units that are asked with it.
struct ProbeTry {
    std::uint32_t baud = 9600;
    config::LineFormat format;
    std::vector<drive::UnitAddress> units;
};

/// The line's own rate and format with every usual unit first: a wrong unit is the most frequent fault; then
/// every other rate and format with this unit and the first one. Each pair of rate and format once.
std::vector<ProbeTry> probe_plan(const config::LineConfig& line, drive::UnitAddress unit);

/// How long one question may take: the line's time-out, within 100 and 300 ms.
std::chrono::milliseconds probe_timeout(const config::LineConfig& line);

/// How much a plan is: its questions, and the time that they take if nothing answers.
struct ProbeLength {
    std::uint32_t questions = 0;
    std::chrono::seconds longest{};
};
ProbeLength length_of(const std::vector<ProbeTry>& plan, const config::LineConfig& line);

/// "03" of EI-ASCII, "3" of Modbus: as the configuration has it.
std::string unit_text(const config::LineConfig& line, drive::UnitAddress unit);

/// What answered, drive -> main. The first few; the first few show that the line has several.
struct ProbeAnswer {
    std::uint32_t baud = 0;
    config::LineFormat format;
    drive::UnitAddress unit{};
};
struct ProbeReport {
    std::uint32_t number = 0; ///< of the order
    std::uint32_t tried = 0;  ///< questions asked
    std::array<ProbeAnswer, 16> answers{};
    std::size_t count = 0;
};

/// The order for it, main -> drive.
struct ProbeOrder {
    std::uint32_t number = 0;
    std::uint32_t station = 0; ///< DriveUnit::number
};

} // namespace dpslave::app
