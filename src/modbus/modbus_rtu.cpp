// SPDX-License-Identifier: Apache-2.0
#include "dpslave/modbus/modbus_rtu.hpp"

#include "rtu_line.hpp"

namespace dpslave::modbus {

Result<std::unique_ptr<ModbusRtu>, std::string> ModbusRtu::open(const RtuSettings& settings,
                                                                std::atomic<bool>& is_open)
{
    auto line = RtuLine::open(settings, is_open);
    if (!line) return Failure{line.error()};
    return std::unique_ptr<ModbusRtu>{new ModbusRtu{settings, *std::move(line)}};
}

ModbusRtu::ModbusRtu(const RtuSettings& settings, std::unique_ptr<RtuLine> line) : line_(std::move(line))
{
    ClientSettings client;
    client.baud = settings.baud;
    client.bits_of_a_character = bits_of_a_character(settings);
    client.timeout = settings.timeout;
    client.rules = settings.rules;
    client.rules.hold_back += line_->hold_back();
    client_ = std::make_unique<ModbusClient>(*line_, std::move(client));
}

ModbusRtu::~ModbusRtu() = default;

std::string ModbusRtu::last_trouble() const
{
    return line_->is_open() ? client_->last_trouble() : line_->path() + " is missing";
}

std::vector<PortMessage> ModbusRtu::take_port_messages()
{
    return line_->take_messages();
}

int ModbusRtu::fd() const
{
    return line_->fd();
}

void ModbusRtu::reopen()
{
    line_->reopen();
}

io::SwitchedPort& ModbusRtu::port()
{
    return line_->port();
}

drive::BlockRule ModbusRtu::block_rule(const RtuSettings& settings)
{
    return ModbusClient::block_rule(settings.baud, bits_of_a_character(settings));
}

} // namespace dpslave::modbus
