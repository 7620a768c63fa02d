// SPDX-License-Identifier: Apache-2.0
// [bus] and [[line]]: the two kinds of serial line.
#include "parts.hpp"

#include <algorithm>

namespace dpslave::config {
namespace {

using input::Document;
using input::Table;

constexpr std::ptrdiff_t kMostLines = 126; ///< one for each station at most

/// "auto", a rate that is searched, or the one that is only ever fixed.
void read_baud(Table& bus, BusConfig& config)
{
    const std::string remedy =
        "write \"auto\", or a rate in bit/s without quotes: 9600, 19200, 45450, 93750, 187500, 500000 or 1500000.";
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
void warn_of_answers(Document& document, const Table& bus, input::Faults& warnings)
{
    for (const std::string_view key : {"max_tsdr", "echo"}) {
        if (!bus.has(key)) continue;
        const input::Place at = bus.place_of(key);
        warnings.push_back({document.name(), at.line, at.column,
                            "'" + std::string{key} +
                                "' means nothing with listen = true, because nothing is sent: remove it."});
    }
}

/// A bus that is only listened to names the driver enable if there is one to be kept inactive.
void read_transceiver(Document& document, Table& bus, BusConfig& config, input::Faults& warnings)
{
    using io::Direction;
    const bool names_gpio = bus.has("gpio_chip") || bus.has("gpio_line");
    const Direction otherwise = config.listen && !names_gpio ? Direction::none : Direction::gpio;
    config.driver_enable = read_driver_enable(document, bus, otherwise, warnings);
    config.echo =
        bus.choice<EchoMode>("echo",
                             {{"off", EchoMode::off}, {"on", EchoMode::on}, {"auto", EchoMode::automatic}})
            .value_or(EchoMode::off);
    config.driver_enable.receive_own =
        config.driver_enable.direction == Direction::kernel && config.echo == EchoMode::on;
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
    const auto format = drive::format_of(*text);
    if (!format)
        table.refuse("format",
                     "format \"" + *text +
                         "\": write data bits 7 or 8, parity N, E or O, stop bits 1 or 2, as in \"7E1\".");
    else if (line.protocol == kModbusRtu && format->data_bits != 8)
        table.refuse(
            "format",
            "format \"" + *text +
                "\": Modbus RTU has 8 data bits; write \"8N1\", \"8E1\" or \"8O1\", as the instrument is set.");
    else
        line.format = *format;
}

void read_settle(Table& table, LineConfig& line)
{
    const auto settle = table.integer("settle_ms", 0, 600'000);
    if (!settle) return;
    line.settle = std::chrono::milliseconds{*settle};
    if (line.settle != std::chrono::milliseconds{0} && line.settle < line.timeout)
        table.refuse(
            "settle_ms",
            "'settle_ms' is shorter than timeout_ms (" + std::to_string(line.timeout.count()) +
                "): an answer may come later than that. Write at least as much, or 0 for ten timeouts.");
}

/// The transceiver switches by itself unless the file says otherwise.
void read_transceiver(Document& document, Table& table, LineConfig& line, input::Faults& warnings)
{
    line.driver_enable = read_driver_enable(document, table, io::Direction::none, warnings);
    line.echo = table
                    .choice<EchoMode>(
                        "echo", {{"off", EchoMode::off}, {"on", EchoMode::on}, {"auto", EchoMode::automatic}})
                    .value_or(EchoMode::off);
    line.driver_enable.receive_own =
        line.driver_enable.direction == io::Direction::kernel && line.echo == EchoMode::on;
}

ReadLine read_line(Document& document, Table& table, input::Faults& warnings)
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
    using drive::WireTime;
    line.wire_time =
        table
            .choice<WireTime>("wire_time",
                              {{"auto", WireTime::automatic}, {"yes", WireTime::yes}, {"no", WireTime::no}})
            .value_or(WireTime::automatic);
    read_transceiver(document, table, line, warnings);
    return read;
}

} // namespace

BusConfig read_bus(Document& document, input::Faults& warnings)
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
        const input::Place at = bus.place_of("max_tsdr");
        if (config.max_tsdr > 0 && config.max_tsdr < 11)
            bus.refuse(
                "max_tsdr",
                "'max_tsdr' is below 11 bit times, before which no station may answer: set 0 for the profile's value, or 11 and more.");
        if (config.max_tsdr > 1000 && !config.listen)
            warnings.push_back(
                {document.name(), at.line, at.column,
                 "'max_tsdr' is above 1000 bit times: many masters do not wait that long; check that the master's GSD states the same."});
    }
    if (config.listen) {
        warn_of_answers(document, bus, warnings);
        config.max_tsdr = 0;
        config.echo = EchoMode::off;
        config.driver_enable.receive_own = false;
    }
    return config;
}

void refuse_beside_listen(Document& document, const std::vector<Table>& tables, std::string_view what)
{
    if (tables.empty()) return;
    const unsigned line = document.root().table("bus").place_of("listen").line;
    document.fault(
        tables.front().place(),
        "[[" + std::string{what} + "]] is not allowed with listen = true on line " + std::to_string(line) +
            ": who only listens has no station and no drive line. Remove each [[line]] and [[station]], or remove 'listen'.");
}

/// The GPIO lines that switch transceivers, that of the bus first. `sysfs`: where it lies.
class TransceiverLines {
public:
    explicit TransceiverLines(const std::filesystem::path& sysfs) : sysfs_(sysfs) {}
    void check(Table& table, const io::DriverEnableSettings& driver)
    {
        if (driver.direction != io::Direction::gpio || driver.gpio_chip.empty() || !table.has("gpio_line"))
            return;
        lines_.check(table, "gpio_line", gpio_target(driver, sysfs_),
                     "line " + std::to_string(driver.gpio_line) + " of GPIO chip \"" + driver.gpio_chip + '"',
                     "it switches another transceiver; give each transceiver a GPIO line of its own");
    }

private:
    const std::filesystem::path& sysfs_;
    Unlike lines_;
};

std::vector<ReadLine> read_lines(Document& document, const BusConfig& bus, const std::filesystem::path& sysfs,
                                 input::Faults& warnings)
{
    std::vector<ReadLine> lines;
    Unlike names;
    Unlike ports;
    TransceiverLines transceivers{sysfs};
    Table root = document.root();
    Table bus_table = root.table("bus");
    transceivers.check(bus_table, bus.driver_enable);
    std::vector<Table> tables = root.tables("line");
    if (bus.listen) refuse_beside_listen(document, tables, "line");
    if (std::ssize(tables) > kMostLines) {
        document.fault(tables[static_cast<std::size_t>(kMostLines)].place(),
                       "there are more lines than there can be stations (126): remove some of them.");
        tables.erase(tables.begin() + kMostLines, tables.end());
    }
    for (Table& table : tables) {
        ReadLine read = read_line(document, table, warnings);
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
                ports.check(
                    table, "port", port, "port \"" + read.line.port + '"',
                    "give each line a tty of its own; several drives on one tty are several stations with one line");
        }
        transceivers.check(table, read.line.driver_enable);
        lines.push_back(std::move(read));
    }
    return lines;
}

} // namespace dpslave::config
