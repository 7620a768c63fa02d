// SPDX-License-Identifier: Apache-2.0
// Reads the keys about the switching of a transceiver that [bus] and [[line]] have in common.
#include "parts.hpp"

#include "dpslave/io/led_sink.hpp"

namespace dpslave::config {
namespace {

using input::Document;
using input::Table;
using io::Direction;

/// A key that only another direction uses: here it has no effect.
void warn_unused(const Document& document, const Table& table, std::string_view key, Direction direction,
                 input::Faults& warnings)
{
    if (!table.has(key)) return;
    const input::Place at = table.place_of(key);
    warnings.push_back({document.name(), at.line, at.column,
                        "'" + std::string{key} + "' means nothing with direction = \"" +
                            std::string{text(direction)} +
                            "\": remove it, or choose the direction that it belongs to."});
}

void require_gpio(Table& table)
{
    constexpr const char* kHow =
        ", as `gpioinfo` shows it for the pin that enables the transceiver; or direction = \"none\" for a transceiver that switches by itself";
    table.require("gpio_chip", std::string{R"(gpio_chip = "/dev/gpiochip0")"} + kHow);
    table.require("gpio_line", std::string{"gpio_line = 17"} + kHow);
}

} // namespace

io::DriverEnableSettings read_driver_enable(Document& document, Table& table, Direction otherwise,
                                            input::Faults& warnings)
{
    const auto named = table.choice<Direction>("direction", {{"gpio", Direction::gpio},
                                                             {"kernel", Direction::kernel},
                                                             {"rts", Direction::rts},
                                                             {"none", Direction::none}});
    const bool is_wrong = table.has("direction") && !named; // then nothing is said of what belongs to it
    io::DriverEnableSettings driver;
    driver.direction = named.value_or(otherwise);
    const bool by_gpio = driver.direction == Direction::gpio;
    if (by_gpio && !is_wrong) require_gpio(table);
    driver.gpio_chip = table.text("gpio_chip").value_or("");
    driver.gpio_line = static_cast<unsigned>(table.integer("gpio_line", 0, 65535).value_or(0));
    driver.active_low = table.boolean("gpio_active_low").value_or(false);
    if (by_gpio || is_wrong) return driver;
    warn_unused(document, table, "gpio_chip", driver.direction, warnings);
    warn_unused(document, table, "gpio_line", driver.direction, warnings);
    if (driver.direction == Direction::none)
        warn_unused(document, table, "gpio_active_low", driver.direction, warnings);
    driver.gpio_chip.clear();
    driver.gpio_line = 0;
    return driver;
}

std::string gpio_target(const io::DriverEnableSettings& driver, const std::filesystem::path& sysfs)
{
    return io::led_sink_target("line:" + driver.gpio_chip + ':' + std::to_string(driver.gpio_line), sysfs);
}

} // namespace dpslave::config
