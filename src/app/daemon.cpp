// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/daemon.hpp"

#include "dpslave/app/bus_thread.hpp"
#include "dpslave/app/drive_thread.hpp"
#include "dpslave/app/lamps.hpp"
#include "dpslave/app/main_thread.hpp"
#include "dpslave/app/tty_line.hpp"
#include "dpslave/app/version.hpp"
#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/io/realtime.hpp"
#include "dpslave/io/signals.hpp"
#include "dpslave/modbus/modbus_rtu.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <thread>

namespace dpslave::app {

namespace {

/// One drive line: its port and its thread, in the order in which they may go.
struct Line {
    std::unique_ptr<TtyLine> tty; ///< of EI-ASCII; a Modbus back-end has its port itself
    std::unique_ptr<DriveThread> work;
    io::EventFd wake;
    std::jthread thread;
};

io::TtySettings settings_of(const LineConfig& line)
{
    io::TtySettings settings;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    return settings;
}

using MadeBackend = Result<std::unique_ptr<drive::Backend>, std::string>;

MadeBackend open_ei_ascii(const Config& config, std::size_t index, LineLink& link,
                          std::unique_ptr<TtyLine>& tty)
{
    const LineConfig& line = config.lines[index];
    auto port = io::Tty::open(line.port, settings_of(line));
    if (!port) return Failure{port.error()};
    tty = std::make_unique<TtyLine>(line.port, settings_of(line), std::move(*port), link.port_open);
    std::vector<drive::EiUnit> units;
    for (const StationConfig& station : config.stations)
        if (station.line == index)
            units.push_back({.address = station.unit, .mnemonics = station.profile->mnemonics});
    return std::unique_ptr<drive::Backend>(std::make_unique<drive::EiAsciiClient>(
        *tty, drive::EiTiming{.baud = line.baud, .timeout = line.timeout}, std::move(units)));
}

MadeBackend open_modbus(const LineConfig& line, LineLink& link)
{
    modbus::RtuSettings settings;
    settings.port = line.port;
    settings.baud = line.baud;
    settings.data_bits = line.format.data_bits;
    settings.parity = line.format.parity;
    settings.stop_bits = line.format.stop_bits;
    settings.timeout = line.timeout;
    auto opened = modbus::ModbusRtu::open(settings, link.port_open);
    if (!opened) return Failure{opened.error()};
    return std::unique_ptr<drive::Backend>(std::move(*opened));
}

/// Tells a thread to end and waits for it.
void end(std::jthread& thread, io::EventFd& wake)
{
    thread.request_stop();
    wake.ring();
    if (thread.joinable()) thread.join();
}

/// "FILE:LINE: ", where the key stands that named a device.
std::string place(const Config& config, unsigned line)
{
    return fmt::format("{}:{}: ", config.file.string(), line);
}

/// Opens the drive lines and makes their work; false: one could not be opened, and the log says why.
bool open_lines(const Config& config, Links& links, std::vector<Line>& lines)
{
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const LineConfig& line = config.lines[i];
        LineLink& link = *links.lines[i];
        auto backend = line.protocol == kModbusRtu ? open_modbus(line, link)
                                                   : open_ei_ascii(config, i, link, lines[i].tty);
        if (!backend) {
            spdlog::error("{}[[line]] \"{}\": {}", place(config, line.port_line), line.name, backend.error());
            return false;
        }
        lines[i].work = std::make_unique<DriveThread>(config, i, std::move(*backend), links.stations, link);
    }
    return true;
}

/// What a thread does. A failure of the system ends the program in order, not in the middle.
void guarded(Links& links, const char* name, const std::function<void()>& work)
{
    try {
        io::name_thread(name);
        work();
    } catch (const std::exception& error) {
        spdlog::critical("the {} thread had to give up: {}", name, error.what());
        links.bus.failed.store(true, std::memory_order_relaxed);
    }
}

void say_warnings(const std::vector<std::string>& warnings)
{
    for (const std::string& warning : warnings) spdlog::warn("{}", warning);
}

} // namespace

ExitStatus run_daemon(const Config& config, const std::filesystem::path& profiles)
{
    io::Signals signals; // first: every later thread inherits the blocked signals
    for (const profile::Fault& warning : config.warnings) spdlog::warn("{}", to_string(warning));

    // Everything that can fail comes first, in this thread, before anybody on the bus hears of us.
    Links links;
    for (std::size_t i = 0; i < config.stations.size(); ++i)
        links.stations.push_back(std::make_unique<StationLink>());
    for (std::size_t i = 0; i < config.lines.size(); ++i) links.lines.push_back(std::make_unique<LineLink>());

    auto bus_tty = io::Tty::open(config.bus.port, bus_tty_settings(config));
    if (!bus_tty) {
        spdlog::error("{}[bus]: {}", place(config, config.bus.port_line), bus_tty.error());
        return ExitStatus::device_not_opened;
    }
    std::vector<Line> lines(config.lines.size());
    if (!open_lines(config, links, lines)) return ExitStatus::device_not_opened;
    std::vector<std::string> warnings;
    Lamps lamps(config, warnings);
    say_warnings(warnings);

    MainThread main_thread(config, profiles, links, lamps, signals);
    if (const auto trouble = main_thread.open_socket()) {
        spdlog::error("{}: [control] socket: {}; set it to a place where this user may write",
                      config.file.string(), *trouble);
        return ExitStatus::device_not_opened;
    }

    BusThread bus(config, std::move(*bus_tty), links.stations, links.bus);
    if (config.realtime.lock_memory) say_warnings(io::lock_memory());
    spdlog::info("dpslaved {}: {} station(s) on {} at {} bit/s", kVersion, config.stations.size(),
                 config.bus.port, static_cast<std::uint32_t>(config.bus.baud));

    for (Line& line : lines)
        line.thread = std::jthread([&links, &line](const std::stop_token& stop) {
            guarded(links, "drive", [&] { line.work->run(stop, line.wake); });
        });
    io::EventFd bus_wake;
    std::jthread bus_thread([&](const std::stop_token& stop) {
        guarded(links, "bus", [&] {
            say_warnings(io::enter_realtime(config.realtime.priority, config.realtime.cpu));
            bus.run(stop, bus_wake);
        });
    });

    const bool by_signal = main_thread.run();

    // The bus first: its last word to the drive lines is what puts the outputs into their safe state.
    end(bus_thread, bus_wake);
    for (Line& line : lines) line.thread.request_stop();
    for (Line& line : lines) end(line.thread, line.wake);
    spdlog::info("ended");
    return by_signal ? ExitStatus::ended_by_signal : ExitStatus::device_not_opened;
}

} // namespace dpslave::app
