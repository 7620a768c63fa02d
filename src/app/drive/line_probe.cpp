// SPDX-License-Identifier: Apache-2.0
#include "line_probe.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {

namespace {

/// EI-ASCII: rates and the one format of the drives' manuals, and what converters are set to; Modbus: those
/// of the instruments.
constexpr std::array<std::uint32_t, 8> kRates{9600, 19200, 4800, 38400, 2400, 57600, 1200, 115200};
constexpr std::array kEiFormats{config::LineFormat{7, 'E', 1}, config::LineFormat{8, 'N', 1},
                                config::LineFormat{8, 'E', 1}};
constexpr std::array kModbusFormats{config::LineFormat{8, 'N', 1}, config::LineFormat{8, 'E', 1},
                                    config::LineFormat{8, 'O', 1}};
constexpr std::uint8_t kEiGroups = 8, kEiUnits = 16; ///< groups above 7 are rare
constexpr std::uint8_t kModbusUnits = 32;

void add(std::vector<drive::UnitAddress>& units, drive::UnitAddress unit)
{
    if (std::find(units.begin(), units.end(), unit) == units.end()) units.push_back(unit);
}

std::vector<drive::UnitAddress> usual_units(bool is_modbus, drive::UnitAddress first)
{
    std::vector<drive::UnitAddress> units{first};
    if (is_modbus) {
        for (std::uint8_t unit = 1; unit <= kModbusUnits; ++unit) add(units, {.group = 0, .unit = unit});
        return units;
    }
    for (std::uint8_t group = 0; group < kEiGroups; ++group)
        for (std::uint8_t unit = 0; unit < kEiUnits; ++unit) add(units, {.group = group, .unit = unit});
    return units;
}

} // namespace

std::vector<ProbeTry> probe_plan(const config::LineConfig& line, drive::UnitAddress unit)
{
    const bool is_modbus = line.protocol == config::kModbusRtu;
    std::vector<ProbeTry> plan{{line.baud, line.format, usual_units(is_modbus, unit)}};
    std::vector<drive::UnitAddress> few{unit};
    add(few, {.group = 0, .unit = static_cast<std::uint8_t>(is_modbus ? 1 : 0)});
    const auto& formats = is_modbus ? kModbusFormats : kEiFormats;
    for (const config::LineFormat& format : formats)
        for (const std::uint32_t baud : kRates)
            if (baud != line.baud || !(format == line.format)) plan.push_back({baud, format, few});
    return plan;
}

std::chrono::milliseconds probe_timeout(const config::LineConfig& line)
{
    return std::clamp(line.timeout, std::chrono::milliseconds{100}, std::chrono::milliseconds{300});
}

ProbeLength length_of(const std::vector<ProbeTry>& plan, const config::LineConfig& line)
{
    constexpr double kCharacters = 40; // of a question, and of what the port waits for before the next one
    constexpr std::chrono::duration<double> kOpening{0.02};
    ProbeLength length;
    std::chrono::duration<double> time{};
    for (const ProbeTry& one : plan) {
        const auto count = static_cast<std::uint32_t>(one.units.size());
        length.questions += count;
        time += count *
                (probe_timeout(line) + kOpening + std::chrono::duration<double>{kCharacters * 11 / one.baud});
    }
    length.longest = std::chrono::ceil<std::chrono::seconds>(time);
    return length;
}

std::string unit_text(const config::LineConfig& line, drive::UnitAddress unit)
{
    if (line.protocol == config::kModbusRtu) return std::to_string(unit.unit);
    return fmt::format("{:X}{:X}", unit.group, unit.unit);
}

} // namespace dpslave::app
