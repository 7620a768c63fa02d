// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/line_setting.hpp"

#include "drive/digits.hpp"

#include "dpslave/base/number.hpp"

namespace dpslave::drive {

namespace {

constexpr std::int64_t kLowestModbusUnit = 1, kHighestModbusUnit = 247; // beyond them Modbus reserves

} // namespace

std::optional<LineFormat> format_of(std::string_view text)
{
    if (text.size() != 3) return std::nullopt;
    const bool legal = (text[0] == '7' || text[0] == '8') &&
                       (text[1] == 'N' || text[1] == 'E' || text[1] == 'O') &&
                       (text[2] == '1' || text[2] == '2');
    if (!legal) return std::nullopt;
    return LineFormat{text[0] - '0', text[1], text[2] - '0'};
}

std::string text(const LineFormat& format)
{
    return std::to_string(format.data_bits) + format.parity + std::to_string(format.stop_bits);
}

std::string_view name(LineProtocol protocol) noexcept
{
    return protocol == LineProtocol::modbus_rtu ? "modbus-rtu" : "ei-ascii";
}

std::optional<UnitAddress> unit_of(LineProtocol protocol, std::string_view text)
{
    if (protocol == LineProtocol::ei_ascii) {
        if (text.size() != 2) return std::nullopt;
        const int group = hex_digit(text[0]), unit = hex_digit(text[1]);
        if (group < 0 || unit < 0) return std::nullopt;
        return UnitAddress{static_cast<std::uint8_t>(group), static_cast<std::uint8_t>(unit)};
    }
    if (text.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    const auto address = read_number(text, kLowestModbusUnit, kHighestModbusUnit);
    if (!address) return std::nullopt;
    return UnitAddress{.group = 0, .unit = static_cast<std::uint8_t>(*address)};
}

std::string unit_text(LineProtocol protocol, UnitAddress unit)
{
    if (protocol == LineProtocol::modbus_rtu) return std::to_string(unit.unit);
    return hex_text(static_cast<unsigned>(unit.group << 4 | unit.unit), 2).substr(1);
}

} // namespace dpslave::drive
