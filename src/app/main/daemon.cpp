// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/daemon.hpp"

#include "app/bus/bus_port_opener.hpp"
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
#include "dpslave/io/log_thread.hpp"
#include "dpslave/io/notify.hpp"
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
    while (link.signs.bus.last() == Instant{} && io::monotonic_now() < limit)
        std::this_thread::sleep_for(std::chrono::microseconds{100});
}

/// The times of the end, from the signal on.
constexpr std::chrono::milliseconds kBusLeaves{500}; // more than the longest telegram at any rate
constexpr std::chrono::seconds kDrivesWrite{4};
constexpr std::chrono::milliseconds kAllEnds{4400}; // then the lamps

/// Waits until the bus thread has left the bus, or `limit`.
bool has_ended(const BusLink& link, Instant limit)
{
    while (!link.ended.load(std::memory_order_acquire)) {
        if (io::monotonic_now() > limit) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    return true;
}

std::chrono::milliseconds remaining(Instant until)
{
    return std::max(std::chrono::ceil<std::chrono::milliseconds>(until - io::monotonic_now()),
                    std::chrono::milliseconds{10});
}

/// On the bus thread, when the main thread has stalled for too long: the bus was left, and the drives have
/// their safe state.
void end_without_main_thread(io::LogThread& log)
{
    log.say_last("dpslaved: the main thread has stalled: the program ends\n", io::LogThread::kLastWait);
    std::_Exit(static_cast<int>(ExitStatus::not_served));
}

} // namespace

ExitStatus run_daemon(const config::Config& config, const std::filesystem::path& profiles, io::LogThread& log)
{
    io::Signals signals; // first: every later thread inherits the blocked signals
    if (config.realtime.lock_memory) io::keep_memory();
    for (const input::Fault& warning : config.warnings) spdlog::warn("{}", to_string(warning));

    // What can end the start comes first, before anything is sent on the bus.
    io::DriverEnable driver{config.bus.driver_enable};
    BusLink link{std::size_t{config.trace.bus_kib} * 1024};
    Plant plant{link, passes_self_test()};
    plant.open(config);
    DriverGuard guard{driver,
                      [&link] { return fdl::transmission_guard(link.baud.load(std::memory_order_relaxed)); }};
    MainThread main_thread(config, profiles, state_folder(), plant, link, guard, signals);
    if (const auto trouble = main_thread.open_socket()) {
        spdlog::error("{}: [control] socket: {}; set it to a place where this user may write",
                      config.file.string(), *trouble);
        return ExitStatus::not_served;
    }

    BusPortOpener opener{config, driver, link};
    link.memory_is_ready.store(false, std::memory_order_relaxed);
    opener.start();
    constexpr std::chrono::seconds kUsually{1}; // a port that opens later is served then
    opener.await_first_try(kUsually);
    if (!io::Notifier{}.watchdog_interval()) link.end_program = [&log] { end_without_main_thread(log); };
    BusThread bus(config.bus, opener, driver, plant.bus_stations(), link);
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
    opener.wake();
    plant.start();
    const bool by_signal = main_thread.run(begin_in_words(config));

    // The bus first: the end that it publishes makes the drive lines write the safe state. They write it also
    // without.
    const Instant begun = io::monotonic_now();
    bus_thread.request_stop();
    bus_wake.ring();
    const bool bus_has_left = has_ended(link, begun + kBusLeaves);
    plant.request_end(begun + kDrivesWrite);
    std::vector<std::string> hanging;
    for (const DriveLine* const line : plant.end(begun + kAllEnds))
        hanging.push_back(words_of_hanging(*line, main_thread.stations(), io::monotonic_now()));
    if (!bus_has_left && !has_ended(link, begun + kAllEnds))
        hanging.push_back("the bus thread hangs in a call of " + config.bus.port);
    else if (bus_thread.join(); !opener.end(remaining(begun + kAllEnds)))
        hanging.push_back("the port " + config.bus.port + " does not close");
    main_thread.tell_rest();
    const auto status = by_signal ? ExitStatus::ended_by_signal : ExitStatus::not_served;
    if (!main_thread.end(std::move(hanging), begun + kAllEnds)) {
        log.finish(io::LogThread::kLastWait);
        std::_Exit(static_cast<int>(status)); // what hangs uses objects that cannot be freed
    }
    spdlog::info("ended");
    return status;
}

} // namespace dpslave::app
