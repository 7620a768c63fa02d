// SPDX-License-Identifier: Apache-2.0
#include "dpsim/drive_commands.hpp"
#include "dpsim/edge.hpp"
#include "dpsim/programs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace dpslave::sim {
namespace {

/// The example table: of $DPSLAVED_DATA, else of the source tree that this program was built in, else the
/// installed one.
std::string example_table()
{
    namespace fs = std::filesystem;
    std::vector<fs::path> places;
    if (const char* const data = std::getenv("DPSLAVED_DATA"))
        places.emplace_back(fs::path{data} / "tags/example.csv");
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    if (!error) places.emplace_back(self.parent_path() / "../../../config/tags/example.csv");
    places.emplace_back("/usr/share/dpslaved/tags/example.csv");
    for (const fs::path& place : places)
        if (fs::is_regular_file(place, error)) return place.lexically_normal().string();
    return places.back().string();
}

int serve(DriveLine& drive, DriveCommands& commands, int port, const Signals& signals)
{
    LineReader input{STDIN_FILENO};
    const bool typed = ::isatty(STDIN_FILENO) == 1;
    while (!readable(signals.fd())) {
        wait_readable({signals.fd(), port, input.fd()}, drive.next_deadline());
        const auto octets = read_some(port);
        if (!octets) {
            print_error("the line is gone");
            return kNoPort;
        }
        if (!octets->empty()) drive.on_bytes(*octets, monotonic_now());
        if (const auto reply = drive.take_reply(monotonic_now()))
            write_all(port, *reply, std::chrono::milliseconds{100});
        if (readable(input.fd())) input.read();
        while (const auto line = input.take())
            for (const std::string& said : commands.command(*line, monotonic_now())) print_line(said);
        for (const std::string& line : drive.take_log()) print_line(line);
        if (commands.quit() || (input.closed() && typed)) break;
    }
    return kFine;
}

} // namespace

int run_drive(const DriveOptions& options)
{
    const auto model = model_of(options.model);
    if (!model) {
        print_error(fmt::format("there is no model '{}': 590, 584s or 620", options.model));
        return kUsage;
    }
    const auto tags = load_tags(options.tags.empty() ? example_table() : options.tags);
    if (!tags) {
        print_error(tags.error());
        return kUsage;
    }
    DriveLine drive{*model, std::chrono::nanoseconds{static_cast<std::int64_t>(options.turnaround_ms * 1e6)}};
    for (const std::string& unit : options.units)
        if (!drive.add_unit(unit, *tags)) {
            print_error(fmt::format(
                "--unit {}: a group 0-7 and a unit id 0-9 or A-F, each address once, for example 00", unit));
            return kUsage;
        }
    drive.set_logging(options.log);
    DriveCommands commands{drive};
    for (const std::string& fault : options.faults)
        for (const std::string& wrong : commands.command(fault, monotonic_now())) {
            print_error(fmt::format("--fault {}: {}", fault, wrong));
            return kUsage;
        }
    const Signals signals;
    auto port = open_tty(options.port, options.baud, Format::bits7_even);
    if (!port) {
        print_error(port.error());
        return kNoPort;
    }
    be_prompt();
    print_line(fmt::format("ready {}, model {}, {} parameters", options.port, options.model, tags->size()));
    return serve(drive, commands, port->get(), signals);
}

} // namespace dpslave::sim
