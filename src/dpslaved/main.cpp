// SPDX-License-Identifier: Apache-2.0
#include "log.hpp"

#include "dpslave/app/daemon.hpp"
#include "dpslave/app/service.hpp"
#include "dpslave/app/version.hpp"
#include "dpslave/arguments/command_line.hpp"
#include "dpslave/arguments/options.hpp"
#include "dpslave/arguments/standard_descriptors.hpp"
#include "dpslave/config/config.hpp"
#include "dpslave/io/port_users.hpp"

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <iostream>
#include <string>

namespace {

using dpslave::app::ExitStatus;

constexpr const char* kFooter =
    "Exit status:\n"
    "  0  ended by SIGTERM or SIGINT; with --check: the configuration is good; with --is-configured: there is something to start; always with --release\n"
    "  1  the configuration was refused: one line per fault on standard error; with --is-configured: it is still empty\n"
    "  2  wrong usage\n"
    "  3  the control socket could not be opened, or a thread failed or stalled";

int status(ExitStatus status)
{
    return static_cast<int>(status);
}

/// A file that is faulty counts as configured: the start itself says what is wrong with it.
int say_whether_configured(const std::string& file)
{
    if (!dpslave::app::is_unconfigured(file)) return 0;
    const auto log = dpslave::set_up_log();
    spdlog::warn(
        "{} configures neither bus nor line nor station, so there is nothing to start: delete the # before [bus], [[line]] and [[station]], set the keys below them, and start the service again",
        file);
    return 1;
}

/// What the daemon that has ended had in use, else what is configured. Whatever is wrong, the last step of a
/// service is no failure: the start reports a faulty configuration.
int release_drivers(const std::string& file, const std::string& profiles)
{
    namespace app = dpslave::app;
    const auto log = dpslave::set_up_log();
    auto drivers = app::kept_drivers(app::runtime_folder());
    if (!drivers) {
        const auto config = dpslave::config::load_config(file, profiles);
        if (!config) return 0;
        drivers = app::drivers_of(*config);
    }
    for (const app::DriverInUse& driver : *drivers)
        if (const auto trouble = app::release(driver)) spdlog::warn("not released: {}", *trouble);
    return 0;
}

/// Who else has the ports of the configuration, as far as this user may look. A daemon that serves them has
/// them too.
void warn_of_users(const dpslave::config::Config& config)
{
    const auto warn = [&](const std::string& port, unsigned line) {
        dpslave::io::PortUsers found = dpslave::io::users_of_port(port);
        std::erase_if(found.users, [](const auto& one) { return one.name == "dpslaved"; });
        if (!found.is_shared()) return;
        std::fprintf(stderr, "%s:%u: %s is used by others: %s; see dpctl tune %s (warning)\n",
                     config.file.c_str(), line, port.c_str(), found.in_words().c_str(), port.c_str());
    };
    warn(config.bus.port, config.bus.port_line);
    for (const auto& line : config.lines) warn(line.port, line.port_line);
}

} // namespace

int main(int argc, char** argv)
{
    dpslave::arguments::fill_standard_descriptors();
    CLI::App app{"PROFIBUS-DP slave that replaces a drive's option board.", "dpslaved"};
    app.footer(kFooter);
    std::string file = "/etc/dpslaved/dpslaved.toml";
    std::string profiles = DPSLAVE_DATA_FOLDER "/profiles"; // given by CMake
    bool check = false;
    bool is_configured = false;
    bool release = false;
    dpslave::arguments::add_text(app, "--config", file, "FILE", "Configuration file");
    dpslave::arguments::add_text(app, "--profiles", profiles, "DIR", "Folder of the device profiles");
    app.add_flag("--check", check, "Only check the configuration");
    app.add_flag("--is-configured", is_configured,
                 "Only show by the exit status whether a bus, a line or a station is configured")
        ->excludes("--check");
    app.add_flag("--release", release,
                 "Only switch the drivers of the RS-485 transceivers off, after the daemon has ended")
        ->excludes("--check", "--is-configured");
    if (const auto ended =
            dpslave::arguments::read_command_line(app, std::string{"dpslaved "} + dpslave::app::kVersion,
                                                  {argv + 1, argv + argc}, std::cout, std::cerr))
        return *ended;

    if (is_configured) return say_whether_configured(file);
    if (release) return release_drivers(file, profiles);
    const auto config = dpslave::config::load_config(file, profiles);
    if (!config) {
        for (const dpslave::input::Fault& fault : config.error())
            std::fprintf(stderr, "%s\n", to_string(fault).c_str());
        return status(ExitStatus::configuration_refused);
    }
    if (check) {
        for (const dpslave::input::Fault& warning : config->warnings)
            std::fprintf(stderr, "%s (warning)\n", to_string(warning).c_str());
        if (!dpslave::config::operator_group_of(config->control))
            std::fprintf(stderr, "%s (warning)\n", to_string(without_operator_group(*config)).c_str());
        warn_of_users(*config);
        return 0;
    }
    const auto log = dpslave::set_up_log();
    try {
        return status(dpslave::app::run_daemon(*config, profiles, *log));
    } catch (const std::exception& error) { // no descriptor, no thread or no memory left
        spdlog::critical("ended by a system error: {}", error.what());
        return status(ExitStatus::not_served);
    }
}
