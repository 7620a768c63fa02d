// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/service.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/toml/document.hpp"

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <system_error>

namespace dpslave::app {
namespace {

constexpr const char* kKept = "driver-enable.json";

std::filesystem::path folder_of_service(const char* variable)
{
    const char* const folders = std::getenv(variable); // this program never sets a variable
    if (folders == nullptr) return {};
    const std::string_view all = folders;
    return all.substr(0, all.find(':')); // the first of them
}

} // namespace

bool is_unconfigured(const std::filesystem::path& file)
{
    toml::Document document{io::read_regular_file, file.string()};
    if (!document.readable()) return false;
    const toml::Table root = document.root();
    return !root.has("bus") && !root.has("line") && !root.has("station");
}

std::filesystem::path runtime_folder()
{
    return folder_of_service("RUNTIME_DIRECTORY");
}

std::filesystem::path state_folder()
{
    return folder_of_service("STATE_DIRECTORY");
}

std::optional<std::string> keep(const DriverInUse& driver, const std::filesystem::path& runtime)
{
    if (runtime.empty()) return std::nullopt;
    const nlohmann::json kept{{"port", driver.port},
                              {"direction", io::text(driver.settings.direction)},
                              {"gpio_chip", driver.settings.gpio_chip},
                              {"gpio_line", driver.settings.gpio_line},
                              {"gpio_active_low", driver.settings.active_low}};
    std::ofstream out{runtime / kKept};
    out << kept.dump(2) << '\n' << std::flush;
    if (out) return std::nullopt;
    return (runtime / kKept).string() + " cannot be written (" + std::system_category().message(errno) +
           "): after a crash the driver enable of the configuration is released, whatever was in use";
}

std::optional<DriverInUse> kept_driver(const std::filesystem::path& runtime)
{
    if (runtime.empty()) return std::nullopt;
    std::ifstream in{runtime / kKept};
    DriverInUse driver;
    try {
        const auto kept = nlohmann::json::parse(in);
        driver.port = kept.value("port", "");
        driver.settings.gpio_chip = kept.value("gpio_chip", "");
        driver.settings.gpio_line = kept.value("gpio_line", 0U);
        driver.settings.active_low = kept.value("gpio_active_low", false);
        for (const io::Direction direction : {io::Direction::gpio, io::Direction::kernel, io::Direction::rts})
            if (kept.value("direction", "") == io::text(direction)) driver.settings.direction = direction;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt; // there is none
    }
    return driver;
}

std::optional<std::string> release(const DriverInUse& driver)
{
    return io::DriverEnable::release(driver.settings, driver.port);
}

} // namespace dpslave::app
