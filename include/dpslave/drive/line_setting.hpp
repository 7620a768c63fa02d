// SPDX-License-Identifier: Apache-2.0
/// Describes the setting of a drive line: protocol, rate and format, and how the configuration spells them
/// and a drive on the line.
#pragma once

#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/frame_notes.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::drive {

/// Character format of a drive line.
struct LineFormat {
    int data_bits = 7;
    char parity = 'E'; ///< 'N', 'E', 'O'
    int stop_bits = 1;
    friend bool operator==(const LineFormat&, const LineFormat&) = default;
};
/// Reads "7E1"; returns nullopt if the text is no format.
std::optional<LineFormat> format_of(std::string_view text);
std::string text(const LineFormat& format);

struct LineSetting {
    LineProtocol protocol = LineProtocol::ei_ascii;
    std::uint32_t baud = 9600; ///< bit/s
    LineFormat format;
    friend bool operator==(const LineSetting&, const LineSetting&) = default;
};

/// "ei-ascii", "modbus-rtu"
std::string_view name(LineProtocol protocol) noexcept;

/// Reads "03" of EI-ASCII (group and unit id) or "3" of Modbus (1 to 247); returns nullopt if the text is no
/// such unit.
std::optional<UnitAddress> unit_of(LineProtocol protocol, std::string_view text);
std::string unit_text(LineProtocol protocol, UnitAddress unit);

} // namespace dpslave::drive
