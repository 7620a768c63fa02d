// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/daemon.hpp"

#include "dpslave/app/bus_thread.hpp"
#include "dpslave/app/main_thread.hpp"
#include "dpslave/app/plant.hpp"
#include "dpslave/app/service.hpp"
#include "dpslave/app/version.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/port.hpp"
#include "dpslave/io/realtime.hpp"
#include "dpslave/io/signals.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <thread>

namespace dpslave::app {

namespace {

void say_warnings(const std::vector<std::string>& warnings)
{
    for (const std::string& warning : warnings) spdlog::warn("{}", warning);
}

/// Opens the port of the bus and makes `driver` switch it; nothing: it cannot, and the log says why.
std::optional<io::Port> open_bus(const Config& config, io::DriverEnable& driver)
{
    const auto refuse = [&config](const std::string& why) -> std::optional<io::Port> {
        spdlog::error("{}[bus]: {}", place(config, config.bus.port_line), why);
        return std::nullopt;
    };
    auto port = io::Port::open(config.bus.port, bus_tty_settings(config));
    if (!port) return refuse(port.error());
    if (const auto trouble = driver.attach(port->tty())) return refuse(*trouble);
    for (const std::string& warning : port->tty().warnings())
        spdlog::warn("{}: {}", config.bus.port, warning);
    spdlog::info("{}: {}", config.bus.port, driver.self_check());
    if (!config.bus.baud)
        if (const std::string missing = port->tty().bauds().why_not; !missing.empty())
            spdlog::warn("{}: {}", config.bus.port, missing);
    if (config.bus.baud)
        if (const auto doubt = driver.doubt(*config.bus.baud))
            spdlog::warn("{}: {}", config.bus.port, *doubt);
    return std::move(*port);
}

std::string rate_in_words(const BusConfig& bus)
{
    if (!bus.baud) return "a rate that is searched for";
    return fmt::format("{} bit/s", static_cast<std::uint32_t>(*bus.baud));
}

/// Tells a thread to end and waits for it.
void end(std::jthread& thread, io::EventFd& wake)
{
    thread.request_stop();
    wake.ring();
    if (thread.joinable()) thread.join();
}

} // namespace

ExitStatus run_daemon(const Config& config, const std::filesystem::path& profiles)
{
    io::Signals signals; // first: every later thread inherits the blocked signals
    for (const profile::Fault& warning : config.warnings) spdlog::warn("{}", to_string(warning));

    // Everything that can fail comes first, in this thread, before anybody on the bus hears of us.
    auto driver = io::DriverEnable::open(config.bus.driver_enable);
    if (!driver) {
        spdlog::error("{}[bus]: {}", place(config, config.bus.port_line), driver.error());
        return ExitStatus::device_not_opened;
    }
    auto port = open_bus(config, *driver);
    if (!port) return ExitStatus::device_not_opened;
    if (const auto trouble = keep({config.bus.driver_enable, config.bus.port}, runtime_folder()))
        spdlog::warn("{}", *trouble);
    BusLink link;
    Plant plant{link.failed};
    if (const auto trouble = plant.open(config)) {
        spdlog::error("{}", *trouble);
        return ExitStatus::device_not_opened;
    }
    MainThread main_thread(config, profiles, plant, link, *driver, signals);
    if (const auto trouble = main_thread.open_socket()) {
        spdlog::error("{}: [control] socket: {}; set it to a place where this user may write",
                      config.file.string(), *trouble);
        return ExitStatus::device_not_opened;
    }

    BusThread bus(config.bus, std::move(*port), *driver, plant.roster(), link);
    if (config.realtime.lock_memory) say_warnings(io::lock_memory());
    spdlog::info("dpslaved {}: {} station(s) on {} at {}", kVersion, config.stations.size(), config.bus.port,
                 rate_in_words(config.bus));

    plant.start();
    io::EventFd bus_wake;
    std::jthread bus_thread([&](const std::stop_token& stop) {
        guarded(link.failed, "bus", [&] {
            say_warnings(io::enter_realtime(config.realtime.priority, config.realtime.cpu));
            bus.run(stop, bus_wake);
        });
    });

    const bool by_signal = main_thread.run();

    // The bus first: its last word to the drive lines is what puts the outputs into their safe state.
    end(bus_thread, bus_wake);
    static_cast<void>(driver->set(false, io::monotonic_now())); // also after a bus thread that had to give up
    plant.end();
    spdlog::info("ended");
    return by_signal ? ExitStatus::ended_by_signal : ExitStatus::device_not_opened;
}

} // namespace dpslave::app
