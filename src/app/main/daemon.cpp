// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/daemon.hpp"

#include "app/bus/bus_thread.hpp"
#include "app/bus/driver_guard.hpp"
#include "app/reload/plant.hpp"
#include "main_thread.hpp"
#include "self_test.hpp"

#include "dpslave/app/service.hpp"
#include "dpslave/app/version.hpp"
#include "dpslave/fdl/transmission.hpp"
#include "dpslave/io/clock.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/port.hpp"
#include "dpslave/io/realtime.hpp"
#include "dpslave/io/signals.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace dpslave::app {

namespace {

void say_warnings(const std::vector<std::string>& warnings)
{
    for (const std::string& warning : warnings) spdlog::warn("{}", warning);
}

/// Opens the port of the bus and makes `driver` switch it; nothing: it cannot, and the log says why.
std::optional<io::Port> open_bus(const config::Config& config, io::DriverEnable& driver)
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
    if (const auto trouble = driver.self_check()) {
        driver.detach();
        return refuse(*trouble);
    }
    spdlog::info("{}: {}", config.bus.port, driver.in_words());
    Baud highest = Baud::k9_6; // that the bus may have
    if (config.bus.baud) {
        highest = *config.bus.baud;
    } else {
        const io::TtyBauds bauds = port->tty().bauds();
        if (!bauds.why_not.empty()) spdlog::warn("{}: {}", config.bus.port, bauds.why_not);
        for (const Baud baud : kBauds)
            if (bauds.can.test(index_of(baud))) highest = std::max(highest, baud);
    }
    if (const auto doubt = driver.doubt(highest)) spdlog::warn("{}: {}", config.bus.port, *doubt);
    return std::move(*port);
}

std::string rate_in_words(const config::BusConfig& bus)
{
    if (!bus.baud) return "a rate that is searched for";
    return fmt::format("{} bit/s", static_cast<std::uint32_t>(*bus.baud));
}

std::string begin_in_words(const config::Config& config)
{
    const std::string at = fmt::format("on {} at {}", config.bus.port, rate_in_words(config.bus));
    if (config.bus.listen)
        return fmt::format("dpslaved {} started: it only listens {}, it has no station and sends nothing",
                           kVersion, at);
    return fmt::format("dpslaved {} started: {} station(s) {}", kVersion, config.stations.size(), at);
}

/// Runs the self-test and logs what has failed.
bool passes_self_test()
{
    constexpr int kReadings = 1'000'000; // of a clock that may be a coarse one
    const Instant earlier = io::monotonic_now();
    Instant later = earlier;
    for (int i = 0; i < kReadings && later <= earlier; ++i) later = io::monotonic_now();
    const auto failures = self_test(kKnownTelegram, earlier, later);
    for (const std::string& failure : failures) spdlog::error("self-test: {}", failure);
    if (!failures.empty()) spdlog::error("the self-test has failed: every station stays silent on the bus");
    return failures.empty();
}

/// Waits until the bus thread has been through its first round, with the telegram that lay there or with its
/// first tick. The lock of the memory would hold it up, for both need the table of the pages.
void await_first_round(const BusLink& link)
{
    constexpr std::chrono::milliseconds kLongest{50}; // some ticks: whatever holds it up, the start goes on
    const Instant limit = io::monotonic_now() + kLongest;
    while (link.heartbeat.load(std::memory_order_relaxed) == 0 && io::monotonic_now() < limit)
        std::this_thread::sleep_for(std::chrono::microseconds{100});
}

/// Stops the bus thread and waits for its end. False: it hangs in a call of the system.
bool end(std::jthread& thread, io::EventFd& wake, const BusLink& link)
{
    constexpr std::chrono::seconds kLongest{2}; // more than twice the longest telegram at any rate
    thread.request_stop();
    wake.ring();
    const Instant limit = io::monotonic_now() + kLongest;
    while (!link.ended.load(std::memory_order_acquire)) {
        if (io::monotonic_now() > limit) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    thread.join();
    return true;
}

} // namespace

ExitStatus run_daemon(const config::Config& config, const std::filesystem::path& profiles)
{
    io::Signals signals; // first: every later thread inherits the blocked signals
    for (const input::Fault& warning : config.warnings) spdlog::warn("{}", to_string(warning));

    // Everything that can fail comes first, in this thread, before anything is sent on the bus.
    auto driver = io::DriverEnable::open(config.bus.driver_enable);
    if (!driver) {
        spdlog::error("{}[bus]: {}", place(config, config.bus.port_line), driver.error());
        return ExitStatus::device_not_opened;
    }
    auto port = open_bus(config, *driver);
    if (!port) return ExitStatus::device_not_opened;
    io::make_stacks_small(); // before the guards of the drive lines, the first threads
    if (config.realtime.lock_memory) io::keep_memory();
    BusLink link{std::size_t{config.trace.bus_kib} * 1024};
    Plant plant{link.failed, passes_self_test()};
    plant.open(config);
    DriverGuard guard{*driver,
                      [&link] { return fdl::transmission_guard(link.baud.load(std::memory_order_relaxed)); }};
    MainThread main_thread(config, profiles, state_folder(), plant, link, guard, signals);
    main_thread.tell_lines(); // of ports that are missing
    if (const auto trouble = main_thread.open_socket()) {
        spdlog::error("{}: [control] socket: {}; set it to a place where this user may write",
                      config.file.string(), *trouble);
        driver->detach(); // the port goes before it
        return ExitStatus::device_not_opened;
    }

    BusThread bus(config.bus, std::move(*port), *driver, plant.bus_stations(), link);
    link.memory_is_ready.store(false, std::memory_order_relaxed);
    guard.start(config.realtime.priority);
    io::EventFd bus_wake;
    std::jthread bus_thread([&](const std::stop_token& stop) {
        guarded(link.failed, "bus", [&] {
            say_warnings(io::enter_realtime(config.realtime.priority, config.realtime.cpu));
            bus.run(stop, bus_wake);
        });
        link.ended.store(true, std::memory_order_release);
    });

    await_first_round(link); // the bus is served: what takes milliseconds comes now
    if (config.realtime.lock_memory) say_warnings(io::lock_memory());
    link.memory_is_ready.store(true, std::memory_order_relaxed);
    plant.start();
    const bool by_signal = main_thread.run(begin_in_words(config));

    // The bus first: the end that it publishes makes the drive lines write the safe state.
    if (!end(bus_thread, bus_wake, link)) {
        spdlog::critical("the bus thread hangs in a system call for {}; the program ends without it",
                         config.bus.port);
        plant.end(); // meanwhile the guard has the driver enable
        main_thread.tell_rest();
        main_thread.release();
        std::_Exit(static_cast<int>(ExitStatus::device_not_opened)); // what it uses cannot be freed
    }
    static_cast<void>(driver->set(false, io::monotonic_now())); // also after a bus thread that has failed
    plant.end();
    main_thread.tell_rest();
    const auto status = by_signal ? ExitStatus::ended_by_signal : ExitStatus::device_not_opened;
    if (!main_thread.end_side_work()) std::_Exit(static_cast<int>(status)); // what hangs cannot be freed
    spdlog::info("ended");
    return status;
}

} // namespace dpslave::app
