// SPDX-License-Identifier: Apache-2.0
#include "line_backend.hpp"

#include "dpslave/io/clock.hpp"

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
    settings.wire_time = line.wire_time;
    settings.rules = {.settle = line.settle, .hold_back = {}, .echo = line.echo, .frames = nullptr};
    return settings;
}

} // namespace

drive::BlockRule LineBackend::block_rule(const config::LineConfig& line)
{
    return line.protocol == config::kModbusRtu ? modbus::ModbusRtu::block_rule(rtu_settings(line))
                                               : drive::BlockRule{};
}

Result<std::unique_ptr<LineBackend>, std::string> LineBackend::open(const config::LineConfig& line,
                                                                    const Listeners& listeners)
{
    auto made = std::make_unique<LineBackend>(listeners);
    const io::TransceiverSettings transceiver{
        .driver = line.driver_enable, .priority = line.sending_priority, .counts = &listeners.transceiver};
    if (line.protocol == config::kModbusRtu) {
        modbus::RtuSettings settings = rtu_settings(line);
        settings.rules.frames = &listeners.frames;
        settings.transceiver = transceiver;
        auto opened = modbus::ModbusRtu::open(settings, listeners.is_open);
        if (!opened) return Failure{opened.error()};
        made->modbus_ = opened->get();
        made->backend_ = std::move(*opened);
        made->start_guard(line, listeners.transceiver);
        return made;
    }
    io::TtySettings settings;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    settings.prompt = true;
    auto port = io::SwitchedPort::open(line.port, settings, transceiver);
    if (!port) return Failure{port.error()};
    const drive::LineTiming rules{.settle = line.settle,
                                  .hold_back = port->tty().hold_back(),
                                  .echo = line.echo,
                                  .frames = &listeners.frames};
    made->tty_ =
        std::make_unique<TtyLine>(*std::move(port), line.wire_time, listeners.is_open, listeners.happenings);
    auto client = std::make_unique<drive::EiAsciiClient>(
        *made->tty_, drive::EiTiming{.baud = line.baud, .timeout = line.timeout, .rules = rules},
        std::vector<drive::EiDrive>{});
    made->ei_ascii_ = client.get();
    made->backend_ = std::move(client);
    made->start_guard(line, listeners.transceiver);
    return made;
}

std::optional<io::ChangedSettings> LineBackend::changed_settings() const
{
    return port().is_open() ? port().tty().changed_settings() : std::nullopt;
}

std::error_code LineBackend::set_again(const io::ChangedSettings& changed)
{
    return port().tty().set_again(changed);
}

void LineBackend::reopen()
{
    tty_ ? tty_->reopen() : modbus_->reopen();
}

io::SwitchedPort& LineBackend::port() const
{
    return tty_ ? tty_->port() : modbus_->port();
}

/// A request may take seconds on a slow line: the guard knows how long the longest takes. At the end of the
/// program a thread that hangs while it sends keeps no line active.
void LineBackend::start_guard(const config::LineConfig& line, io::TransceiverCounts& counts)
{
    const auto limit = [longest = port().guard(), &ends_by = listeners_.ends_by] {
        return io::monotonic_now() < ends_by.load(std::memory_order_relaxed) ? longest
                                                                             : std::chrono::nanoseconds{};
    };
    guard_.emplace(port().driver(), limit, &counts);
    guard_->start(line.sending_priority);
}

std::string LineBackend::driver_in_words() const
{
    const io::DriverEnable& driver = port().driver();
    return driver.direction() == io::Direction::none ? std::string{} : driver.in_words();
}

int LineBackend::fd() const
{
    return tty_ ? tty_->fd() : modbus_->fd();
}

/// Of EI-ASCII the port itself has told it.
void LineBackend::tell_port_messages()
{
    if (modbus_ == nullptr) return;
    const bool is_open = listeners_.is_open.load(std::memory_order_relaxed);
    for (const modbus::PortMessage& one : modbus_->take_port_messages()) {
        const bool is_gone = one.is_trouble && !is_open && !std::exchange(is_gone_told_, true);
        listeners_.happenings.tell(one.is_trouble ? Severity::error : Severity::info, 0, one.text,
                                   is_gone ? LineHappenings::Kind::port_missing
                                           : LineHappenings::Kind::other);
    }
}

void LineBackend::set_units(const std::vector<DriveUnit>& units)
{
    std::vector<drive::EiDrive> ei_units;
    std::vector<modbus::ModbusDrive> modbus_units;
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
