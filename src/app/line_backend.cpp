// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/line_backend.hpp"

#include "dpslave/modbus/modbus_rtu.hpp"

namespace dpslave::app {

namespace {

modbus::RtuSettings rtu_settings(const LineConfig& line)
{
    modbus::RtuSettings settings;
    settings.port = line.port;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    settings.timeout = line.timeout;
    return settings;
}

} // namespace

LineWork::~LineWork() = default;

drive::BlockRule LineBackend::block_rule(const LineConfig& line)
{
    return line.protocol == kModbusRtu ? modbus::ModbusRtu::block_rule(rtu_settings(line))
                                       : drive::BlockRule{};
}

Result<std::unique_ptr<LineBackend>, std::string> LineBackend::open(const LineConfig& line,
                                                                    std::atomic<bool>& is_open)
{
    auto made = std::make_unique<LineBackend>();
    if (line.protocol == kModbusRtu) {
        auto opened = modbus::ModbusRtu::open(rtu_settings(line), is_open);
        if (!opened) return Failure{opened.error()};
        made->backend_ = std::move(*opened);
        return made;
    }
    io::TtySettings settings;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    auto port = io::Port::open(line.port, settings);
    if (!port) return Failure{port.error()};
    made->tty_ = std::make_unique<TtyLine>(*std::move(port), is_open);
    auto client = std::make_unique<drive::EiAsciiClient>(
        *made->tty_, drive::EiTiming{.baud = line.baud, .timeout = line.timeout},
        std::vector<drive::EiUnit>{});
    made->ei_ascii_ = client.get();
    made->backend_ = std::move(client);
    return made;
}

void LineBackend::set_units(const std::vector<DriveUnit>& units)
{
    if (ei_ascii_ == nullptr) return;
    std::vector<drive::EiUnit> drives;
    for (const DriveUnit& unit : units)
        drives.push_back({.address = unit.config->unit, .mnemonics = unit.config->profile->mnemonics});
    ei_ascii_->set_units(std::move(drives));
}

} // namespace dpslave::app
