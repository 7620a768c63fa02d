// SPDX-License-Identifier: Apache-2.0
#include "line_backend.hpp"

#include <utility>

namespace dpslave::app {

namespace {

modbus::RtuSettings rtu_settings(const config::LineConfig& line)
{
    modbus::RtuSettings settings;
    settings.port = line.port;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    settings.timeout = line.timeout;
    settings.rules = {.settle = line.settle, .hold_back = {}, .echo = line.echo, .frames = nullptr};
    return settings;
}

} // namespace

LineWork::~LineWork() = default;

drive::BlockRule LineBackend::block_rule(const config::LineConfig& line)
{
    return line.protocol == config::kModbusRtu ? modbus::ModbusRtu::block_rule(rtu_settings(line))
                                               : drive::BlockRule{};
}

Result<std::unique_ptr<LineBackend>, std::string>
LineBackend::open(const config::LineConfig& line, std::atomic<bool>& is_open, drive::FrameListener& frames)
{
    auto made = std::make_unique<LineBackend>();
    if (line.protocol == config::kModbusRtu) {
        modbus::RtuSettings settings = rtu_settings(line);
        settings.rules.frames = &frames;
        auto opened = modbus::ModbusRtu::open(settings, is_open);
        if (!opened) return Failure{opened.error()};
        made->modbus_ = opened->get();
        made->backend_ = std::move(*opened);
        return made;
    }
    io::TtySettings settings;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    settings.prompt = true;
    auto port = io::Port::open(line.port, settings);
    if (!port) return Failure{port.error()};
    const drive::LineRules rules{
        .settle = line.settle, .hold_back = port->tty().hold_back(), .echo = line.echo, .frames = &frames};
    made->tty_ = std::make_unique<TtyLine>(*std::move(port), is_open);
    auto client = std::make_unique<drive::EiAsciiClient>(
        *made->tty_, drive::EiTiming{.baud = line.baud, .timeout = line.timeout, .rules = rules},
        std::vector<drive::EiUnit>{});
    made->ei_ascii_ = client.get();
    made->backend_ = std::move(client);
    return made;
}

int LineBackend::fd() const
{
    return tty_ ? tty_->fd() : modbus_->fd();
}

/// Of EI-ASCII the port itself has logged it.
void LineBackend::log_port_messages(LimitedLog& log, Instant now)
{
    if (modbus_ == nullptr) return;
    for (modbus::PortMessage& one : modbus_->take_port_messages())
        log.say(one.is_trouble ? LimitedLog::Level::error : LimitedLog::Level::info, std::move(one.text),
                now);
}

void LineBackend::set_units(const std::vector<DriveUnit>& units)
{
    std::vector<drive::EiUnit> ei_units;
    std::vector<modbus::ModbusUnit> modbus_units;
    for (const DriveUnit& unit : units) {
        const profile::Profile& profile = *unit.config->profile;
        ei_units.push_back({.address = unit.config->unit, .mnemonics = profile.mnemonics});
        modbus_units.push_back({.unit = unit.config->unit.unit,
                                .reads_by_4 = profile.has_function_4,
                                .has_loopback = profile.has_function_8});
    }
    if (ei_ascii_ != nullptr) ei_ascii_->set_units(std::move(ei_units));
    if (modbus_ != nullptr) modbus_->set_units(std::move(modbus_units));
}

} // namespace dpslave::app
