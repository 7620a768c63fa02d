// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/line_search.hpp"

#include <algorithm>

namespace dpslave::drive {

namespace {

/// EI-ASCII: rates and the one format of the drives' manuals, and what converters are set to; Modbus: those
/// of the instruments.
constexpr std::array<std::uint32_t, 8> kRates{9600, 19200, 4800, 38400, 2400, 57600, 1200, 115200};
constexpr std::array kEiFormats{LineFormat{7, 'E', 1}, LineFormat{8, 'N', 1}, LineFormat{8, 'E', 1}};
constexpr std::array kModbusFormats{LineFormat{8, 'N', 1}, LineFormat{8, 'E', 1}, LineFormat{8, 'O', 1}};
constexpr std::uint8_t kEiGroups = 8, kEiUnits = 16; ///< groups above 7 are rare
constexpr std::uint8_t kModbusUnits = 32;

using Units = std::vector<UnitAddress>;

void add(Units& units, UnitAddress unit)
{
    if (std::find(units.begin(), units.end(), unit) == units.end()) units.push_back(unit);
}

Units without(Units units, const Units& others)
{
    std::erase_if(units, [&](UnitAddress unit) {
        return std::find(others.begin(), others.end(), unit) != others.end();
    });
    return units;
}

/// Returns the units that a drive has from the factory, and their neighbours.
Units first_units(LineProtocol protocol)
{
    if (protocol == LineProtocol::modbus_rtu) return {{.group = 0, .unit = 1}};
    return {{.group = 0, .unit = 0}, {.group = 0, .unit = 1}};
}

Units usual_units(LineProtocol protocol, Units units)
{
    if (protocol == LineProtocol::modbus_rtu) {
        for (std::uint8_t unit = 1; unit <= kModbusUnits; ++unit) add(units, {.group = 0, .unit = unit});
        return units;
    }
    for (std::uint8_t group = 0; group < kEiGroups; ++group)
        for (std::uint8_t unit = 0; unit < kEiUnits; ++unit) add(units, {.group = group, .unit = unit});
    return units;
}

std::vector<LineFormat> usual_formats(LineProtocol protocol)
{
    const auto& usual = protocol == LineProtocol::modbus_rtu ? kModbusFormats : kEiFormats;
    return {usual.begin(), usual.end()};
}

/// Modbus RTU has 8 data bits.
std::vector<LineFormat> formats_of(LineProtocol protocol, const SearchScope& scope)
{
    std::vector<LineFormat> formats = scope.formats.empty() ? usual_formats(protocol) : scope.formats;
    if (protocol == LineProtocol::modbus_rtu)
        std::erase_if(formats, [](const LineFormat& format) { return format.data_bits != 8; });
    return formats;
}

/// The likely ones first: the format of the manuals at all rates, for each protocol.
std::vector<LineSetting> settings_of(const SearchScope& scope)
{
    std::vector<LineProtocol> protocols = scope.protocols;
    if (protocols.empty()) protocols = {LineProtocol::ei_ascii, LineProtocol::modbus_rtu};
    std::vector<std::uint32_t> bauds = scope.bauds;
    if (bauds.empty()) bauds.assign(kRates.begin(), kRates.end());
    std::vector<LineSetting> settings;
    std::size_t most = 0;
    for (const LineProtocol protocol : protocols) most = std::max(most, formats_of(protocol, scope).size());
    for (std::size_t i = 0; i < most; ++i)
        for (const std::uint32_t baud : bauds)
            for (const LineProtocol protocol : protocols)
                if (const auto formats = formats_of(protocol, scope); i < formats.size())
                    settings.push_back({protocol, baud, formats[i]});
    return settings;
}

} // namespace

std::vector<SearchTry> search_plan(const SearchScope& scope)
{
    std::vector<SearchTry> plan, second;
    for (const LineSetting& setting : settings_of(scope)) {
        const LineProtocol protocol = setting.protocol;
        if (const auto named = scope.units.find(protocol); named != scope.units.end()) {
            plan.push_back({setting, named->second, {}});
            continue;
        }
        const Units first = first_units(protocol);
        const Units rest = without(usual_units(protocol, first), first);
        plan.push_back({setting, first, rest});
        const bool is_printed = protocol == LineProtocol::modbus_rtu || setting.format == kEiFormats[0];
        if (is_printed || !scope.formats.empty()) second.push_back({setting, rest, {}});
    }
    plan.insert(plan.end(), second.begin(), second.end());
    return plan;
}

std::vector<SearchTry> search_near(const LineSetting& own, UnitAddress unit, const Units& others)
{
    std::vector<SearchTry> plan{{own, without(usual_units(own.protocol, {unit}), others), {}}};
    Units few{unit};
    add(few, first_units(own.protocol).front());
    for (const LineFormat& format : usual_formats(own.protocol))
        for (const std::uint32_t baud : kRates)
            if (const LineSetting setting{own.protocol, baud, format}; !(setting == own))
                plan.push_back({setting, without(few, others), {}});
    return plan;
}

} // namespace dpslave::drive
