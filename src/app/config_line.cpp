// SPDX-License-Identifier: Apache-2.0
// [bus] and [[line]]: the two kinds of serial line.
#include "config_parts.hpp"

#include <algorithm>

namespace dpslave::app {
namespace {

using profile::Document;
using profile::Table;

void read_baud(Table& bus, BusConfig& config)
{
    const std::string rates =
        "set baud to the rate of the bus, 9600, 19200, 45450, 93750, 187500, 500000 or 1500000.";
    const std::string no_search = "the search for the rate is not part of this release: " + rates;
    if (!bus.has("baud")) {
        if (bus.exists()) bus.refuse("baud", "'baud' is not set and then means \"auto\", but " + no_search);
    } else if (bus.is_text("baud")) {
        const bool automatic = bus.text("baud") == "auto";
        bus.refuse("baud", automatic ? "'baud' is \"auto\", but " + no_search
                                     : "'baud' must be a rate as a number, without quotes: " + rates);
    } else if (const auto rate = bus.integer("baud", 9600, 12'000'000)) {
        if (const auto baud = baud_of(static_cast<std::uint32_t>(*rate)))
            config.baud = *baud;
        else
            bus.refuse("baud", "'baud' " + std::to_string(*rate) + " is no rate that is served: " + rates);
    }
}

/// Only a transceiver that switches by itself is served yet; the keys of the other ways are judged all the
/// same.
void read_transceiver(Table& bus)
{
    enum class Direction : std::uint8_t { gpio, kernel, rts, none };
    const std::string remedy =
        "switching the transceiver is not part of this release: set direction = \"none\" and use "
        "a transceiver that switches by itself.";
    const auto direction = bus.choice<Direction>("direction", {{"gpio", Direction::gpio},
                                                               {"kernel", Direction::kernel},
                                                               {"rts", Direction::rts},
                                                               {"none", Direction::none}});
    if (bus.exists() && !bus.has("direction"))
        bus.refuse("direction", "'direction' is not set and then means \"gpio\", but " + remedy);
    else if (direction && *direction != Direction::none)
        bus.refuse("direction", "this 'direction' is not served: " + remedy);
    bus.text("gpio_chip");
    bus.integer("gpio_line", 0, 65535);
    bus.boolean("gpio_active_low");

    enum class Echo : std::uint8_t { off, on, automatic };
    const auto echo =
        bus.choice<Echo>("echo", {{"off", Echo::off}, {"on", Echo::on}, {"auto", Echo::automatic}});
    if (echo && *echo != Echo::off)
        bus.refuse(
            "echo",
            "removing the echo is not part of this release: set echo = \"off\" and use a transceiver that "
            "does not hear itself.");
}

std::optional<LineFormat> format_of(std::string_view text)
{
    if (text.size() != 3) return std::nullopt;
    const bool legal = (text[0] == '7' || text[0] == '8') &&
                       (text[1] == 'N' || text[1] == 'E' || text[1] == 'O') &&
                       (text[2] == '1' || text[2] == '2');
    if (!legal) return std::nullopt;
    return LineFormat{text[0] - '0', text[1], text[2] - '0'};
}

void read_protocol(Table& table, LineConfig& line)
{
    table.require("protocol", R"(protocol = "ei-ascii")");
    if (const auto protocol = table.choice<std::string>(
            "protocol", {{"ei-ascii", std::string{kEiAscii}}, {"modbus-rtu", std::string{kModbusRtu}}}))
        line.protocol = *protocol;
    if (line.protocol != kModbusRtu) return;
    line.format = {.data_bits = 8, .parity = 'N', .stop_bits = 1};
    line.timeout = kModbusTimeout;
}

void read_format(Table& table, LineConfig& line)
{
    const auto text = table.text("format");
    if (!text) return;
    const auto format = format_of(*text);
    if (!format)
        table.refuse("format", "format \"" + *text +
                                   "\": write data bits 7 or 8, parity N, E or O, stop bits 1 or 2, "
                                   "as in \"7E1\".");
    else if (line.protocol == kModbusRtu && format->data_bits != 8)
        table.refuse("format", "format \"" + *text +
                                   "\": Modbus RTU has 8 data bits; write \"8N1\", \"8E1\" or \"8O1\", as "
                                   "the instrument is set.");
    else
        line.format = *format;
}

ReadLine read_line(Table& table)
{
    ReadLine read;
    LineConfig& line = read.line;
    table.require("name", R"(name = "p3", which stations then give as their line)");
    line.name = table.text("name").value_or("");
    read.name_at = table.place_of("name");
    table.require("port", R"(port = "/dev/ttyS2")");
    line.port = table.text("port").value_or("");
    line.port_line = table.place_of("port").line;
    read_protocol(table, line);
    if (const auto baud = table.integer("baud", 300, 921'600)) line.baud = static_cast<std::uint32_t>(*baud);
    read_format(table, line);
    if (const auto timeout = table.integer("timeout_ms", 10, 10'000))
        line.timeout = std::chrono::milliseconds{*timeout};
    if (const auto retries = table.integer("retries", 0, 10)) line.retries = static_cast<int>(*retries);
    return read;
}

} // namespace

BusConfig read_bus(Document& document, profile::Faults& warnings)
{
    BusConfig config;
    Table root = document.root();
    root.require("bus", R"(the table [bus] with port = "/dev/ttyS1", baud = 187500 and direction = "none")");
    Table bus = root.table("bus");
    bus.require("port", R"(port = "/dev/ttyS1")");
    config.port = bus.text("port").value_or("");
    config.port_line = bus.place_of("port").line;
    read_baud(bus, config);
    read_transceiver(bus);
    if (const auto tbit = bus.integer("max_tsdr", 0, 65535)) {
        config.max_tsdr = static_cast<std::uint32_t>(*tbit);
        const profile::Place at = bus.place_of("max_tsdr");
        if (config.max_tsdr > 0 && config.max_tsdr < 11)
            bus.refuse("max_tsdr",
                       "'max_tsdr' is below 11 bit times, before which no station may answer: set 0 for the "
                       "profile's value, or 11 and more.");
        if (config.max_tsdr > 1000)
            warnings.push_back(
                {document.name(), at.line, at.column,
                 "'max_tsdr' is above 1000 bit times: many masters do not wait that long; see that the "
                 "master's GSD says the same."});
    }
    return config;
}

std::vector<ReadLine> read_lines(Document& document, const BusConfig& bus)
{
    std::vector<ReadLine> lines;
    Unlike names;
    Unlike ports;
    Table root = document.root();
    for (Table& table : root.tables("line")) {
        ReadLine read = read_line(table);
        if (!read.line.name.empty())
            names.check(table, "name", read.line.name, "line name \"" + read.line.name + '"',
                        "give each line a name of its own");
        if (!read.line.port.empty()) {
            const std::string port = canonical(read.line.port);
            if (!bus.port.empty() && port == canonical(bus.port))
                table.refuse("port", "port \"" + read.line.port + "\" is that of the bus on line " +
                                         std::to_string(bus.port_line) +
                                         ": a drive line needs a tty of its own.");
            else
                ports.check(table, "port", port, "port \"" + read.line.port + '"',
                            "give each line a tty of its own; several drives on one tty are several stations "
                            "with one line");
        }
        lines.push_back(std::move(read));
    }
    return lines;
}

} // namespace dpslave::app
