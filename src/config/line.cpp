// SPDX-License-Identifier: Apache-2.0
// [bus] and [[line]]: the two kinds of serial line.
#include "parts.hpp"

#include <algorithm>

namespace dpslave::config {
namespace {

using toml::Document;
using toml::Table;

constexpr std::ptrdiff_t kMostLines = 126; ///< one for each station at most

/// "auto", a rate that is searched, or the one that is only ever fixed.
void read_baud(Table& bus, BusConfig& config)
{
    const std::string remedy =
        "write \"auto\", or a rate in bit/s without quotes: 9600, 19200, 45450, 93750, "
        "187500, 500000 or 1500000.";
    if (bus.is_text("baud")) {
        const auto text = bus.text("baud");
        if (text && *text != "auto") bus.refuse("baud", "'baud' \"" + *text + "\" is not a rate: " + remedy);
    } else if (const auto rate = bus.integer("baud", 9600, 12'000'000)) {
        config.baud = baud_of(static_cast<std::uint32_t>(*rate));
        if (!config.baud)
            bus.refuse("baud", "'baud' " + std::to_string(*rate) + " is not a supported rate: " + remedy);
    }
}

/// Keys that are about answers: here they have no effect.
void warn_of_answers(Document& document, const Table& bus, toml::Faults& warnings)
{
    for (const std::string_view key : {"max_tsdr", "echo"}) {
        if (!bus.has(key)) continue;
        const toml::Place at = bus.place_of(key);
        warnings.push_back({document.name(), at.line, at.column,
                            "'" + std::string{key} +
                                "' means nothing with listen = true, because nothing is "
                                "sent: remove it."});
    }
}

/// A key that only another direction uses: here it has no effect.
void warn_unused(Document& document, const Table& bus, std::string_view key, std::string_view direction,
                 toml::Faults& warnings)
{
    if (!bus.has(key)) return;
    const toml::Place at = bus.place_of(key);
    warnings.push_back({document.name(), at.line, at.column,
                        "'" + std::string{key} + "' means nothing with direction = \"" +
                            std::string{direction} +
                            "\": remove it, or choose the direction that it belongs to."});
}

void read_transceiver(Document& document, Table& bus, BusConfig& config, toml::Faults& warnings)
{
    using io::Direction;
    io::DriverEnableSettings& driver = config.driver_enable;
    const auto direction = bus.choice<Direction>("direction", {{"gpio", Direction::gpio},
                                                               {"kernel", Direction::kernel},
                                                               {"rts", Direction::rts},
                                                               {"none", Direction::none}});
    driver.direction = direction.value_or(Direction::gpio);
    // Who only listens names the driver enable if there is one to be kept inactive.
    const bool names_gpio = bus.has("gpio_chip") || bus.has("gpio_line");
    const bool is_given = bus.has("direction");
    if (!is_given && config.listen && !names_gpio) driver.direction = Direction::none;
    const bool by_gpio = is_given ? direction == Direction::gpio // not of a direction that is wrong
                                  : driver.direction == Direction::gpio;
    if (by_gpio) {
        constexpr const char* kHow = ", as `gpioinfo` shows it for the pin that enables the transceiver; or "
                                     "direction = \"none\" for a transceiver that switches by itself";
        bus.require("gpio_chip", std::string{R"(gpio_chip = "/dev/gpiochip0")"} + kHow);
        bus.require("gpio_line", std::string{"gpio_line = 17"} + kHow);
    }
    driver.gpio_chip = bus.text("gpio_chip").value_or("");
    driver.gpio_line = static_cast<unsigned>(bus.integer("gpio_line", 0, 65535).value_or(0));
    driver.active_low = bus.boolean("gpio_active_low").value_or(false);
    if (direction && !by_gpio) {
        warn_unused(document, bus, "gpio_chip", text(*direction), warnings);
        warn_unused(document, bus, "gpio_line", text(*direction), warnings);
        if (*direction == Direction::none)
            warn_unused(document, bus, "gpio_active_low", text(*direction), warnings);
        driver.gpio_chip.clear();
        driver.gpio_line = 0;
    }

    using fdl::EchoMode;
    config.echo =
        bus.choice<EchoMode>("echo",
                             {{"off", EchoMode::off}, {"on", EchoMode::on}, {"auto", EchoMode::automatic}})
            .value_or(EchoMode::off);
    driver.receive_own = direction == Direction::kernel && config.echo == EchoMode::on;
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

void read_settle(Table& table, LineConfig& line)
{
    const auto settle = table.integer("settle_ms", 0, 600'000);
    if (!settle) return;
    line.settle = std::chrono::milliseconds{*settle};
    if (line.settle != std::chrono::milliseconds{0} && line.settle < line.timeout)
        table.refuse("settle_ms",
                     "'settle_ms' is shorter than timeout_ms (" + std::to_string(line.timeout.count()) +
                         "): an answer may come later than that. Write at least as much, or 0 for "
                         "ten time-outs.");
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
    read_settle(table, line);
    using drive::EchoMode;
    line.echo = table
                    .choice<EchoMode>(
                        "echo", {{"off", EchoMode::off}, {"on", EchoMode::on}, {"auto", EchoMode::automatic}})
                    .value_or(EchoMode::off);
    return read;
}

} // namespace

BusConfig read_bus(Document& document, toml::Faults& warnings)
{
    BusConfig config;
    Table root = document.root();
    root.require("bus",
                 R"(the table [bus] with port = "/dev/ttyS1", and gpio_chip and gpio_line or a direction)");
    Table bus = root.table("bus");
    bus.require("port", R"(port = "/dev/ttyS1")");
    config.port = bus.text("port").value_or("");
    config.port_line = bus.place_of("port").line;
    read_baud(bus, config);
    config.listen = bus.boolean("listen").value_or(false);
    read_transceiver(document, bus, config, warnings);
    if (const auto tbit = bus.integer("max_tsdr", 0, 65535)) {
        config.max_tsdr = static_cast<std::uint32_t>(*tbit);
        const toml::Place at = bus.place_of("max_tsdr");
        if (config.max_tsdr > 0 && config.max_tsdr < 11)
            bus.refuse("max_tsdr",
                       "'max_tsdr' is below 11 bit times, before which no station may answer: set 0 for the "
                       "profile's value, or 11 and more.");
        if (config.max_tsdr > 1000 && !config.listen)
            warnings.push_back({document.name(), at.line, at.column,
                                "'max_tsdr' is above 1000 bit times: many masters do not wait that long; "
                                "check that the master's GSD states the same."});
    }
    if (config.listen) {
        warn_of_answers(document, bus, warnings);
        config.max_tsdr = 0;
        config.echo = fdl::EchoMode::off;
        config.driver_enable.receive_own = false;
    }
    return config;
}

void refuse_beside_listen(Document& document, const std::vector<Table>& tables, std::string_view what)
{
    if (tables.empty()) return;
    const unsigned line = document.root().table("bus").place_of("listen").line;
    document.fault(tables.front().place(),
                   "[[" + std::string{what} + "]] cannot stand beside listen = true on line " +
                       std::to_string(line) +
                       ": who only listens has no station and no drive line. Remove each [[line]] and "
                       "[[station]], or remove 'listen'.");
}

std::vector<ReadLine> read_lines(Document& document, const BusConfig& bus)
{
    std::vector<ReadLine> lines;
    Unlike names;
    Unlike ports;
    Table root = document.root();
    std::vector<Table> tables = root.tables("line");
    if (bus.listen) refuse_beside_listen(document, tables, "line");
    if (std::ssize(tables) > kMostLines) {
        document.fault(tables[static_cast<std::size_t>(kMostLines)].place(),
                       "there are more lines than there can be stations (126): remove some of them.");
        tables.erase(tables.begin() + kMostLines, tables.end());
    }
    for (Table& table : tables) {
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

} // namespace dpslave::config
