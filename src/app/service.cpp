// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/service.hpp"

#include "dpslave/input/document.hpp"
#include "dpslave/io/file.hpp"

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
    input::Document document{io::read_regular_file, file.string()};
    if (!document.readable()) return false;
    const input::Table root = document.root();
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

std::vector<DriverInUse> drivers_of(const config::Config& config)
{
    std::vector<DriverInUse> drivers{{config.bus.driver_enable, config.bus.port}};
    for (const config::LineConfig& line : config.lines)
        if (line.driver_enable.direction != io::Direction::none)
            drivers.push_back({line.driver_enable, line.port});
    return drivers;
}

std::optional<std::string> keep(const std::vector<DriverInUse>& drivers, const std::filesystem::path& runtime)
{
    if (runtime.empty()) return std::nullopt;
    nlohmann::json kept = nlohmann::json::array();
    for (const DriverInUse& driver : drivers)
        kept.push_back({{"port", driver.port},
                        {"direction", io::text(driver.settings.direction)},
                        {"gpio_chip", driver.settings.gpio_chip},
                        {"gpio_line", driver.settings.gpio_line},
                        {"gpio_active_low", driver.settings.active_low}});
    std::ofstream out{runtime / kKept};
    out << kept.dump(2) << '\n' << std::flush;
    if (out) return std::nullopt;
    return (runtime / kKept).string() + " cannot be written (" + std::system_category().message(errno) +
           "): after a crash the driver enables of the configuration are released, whatever was in use";
}

std::optional<std::vector<DriverInUse>> kept_drivers(const std::filesystem::path& runtime)
{
    if (runtime.empty()) return std::nullopt;
    std::ifstream in{runtime / kKept};
    std::vector<DriverInUse> drivers;
    try {
        const auto all = nlohmann::json::parse(in);
        if (!all.is_array()) return std::nullopt; // of an older version
        for (const auto& kept : all) {
            DriverInUse& driver = drivers.emplace_back();
            driver.port = kept.value("port", "");
            driver.settings.gpio_chip = kept.value("gpio_chip", "");
            driver.settings.gpio_line = kept.value("gpio_line", 0U);
            driver.settings.active_low = kept.value("gpio_active_low", false);
            for (const io::Direction direction :
                 {io::Direction::gpio, io::Direction::kernel, io::Direction::rts})
                if (kept.value("direction", "") == io::text(direction)) driver.settings.direction = direction;
        }
    } catch (const nlohmann::json::exception&) {
        return std::nullopt; // there is none
    }
    return drivers;
}

std::optional<std::string> release(const DriverInUse& driver)
{
    return io::DriverEnable::release(driver.settings, driver.port);
}

} // namespace dpslave::app
