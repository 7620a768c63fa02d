// SPDX-License-Identifier: Apache-2.0
#include "dpsim/common/programs.hpp"
#include "dpsim/common/system.hpp"
#include "dpsim/common/values.hpp"
#include "dpsim/instrument/instrument_commands.hpp"
#include "drive_commands.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace dpslave::sim {
namespace {

/// A table that comes with dpslaved: of $DPSLAVED_DATA, else of the source tree that this program was built
/// in, else the installed one.
std::string shipped_table(const std::string& name)
{
    namespace fs = std::filesystem;
    std::vector<fs::path> places;
    if (const char* const data = std::getenv("DPSLAVED_DATA"))
        places.emplace_back(fs::path{data} / "tags" / name);
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    if (!error) places.emplace_back(self.parent_path() / "../../../config/tags" / name);
    places.emplace_back(fs::path{DPSLAVE_DATA_FOLDER "/tags"} / name); // given by CMake
    for (const fs::path& place : places)
        if (fs::is_regular_file(place, error)) return place.lexically_normal().string();
    return places.back().string();
}

int serve(DeviceLine& line, DeviceCommands& commands, int port, const Signals& signals)
{
    LineReader input{STDIN_FILENO};
    const bool typed = ::isatty(STDIN_FILENO) == 1;
    while (!readable(signals.fd())) {
        wait_readable({signals.fd(), port, input.fd()}, line.next_deadline());
        const auto octets = read_some(port);
        if (!octets) {
            print_error("the line is gone");
            return kNo;
        }
        if (!octets->empty()) {
            if (line.echoes()) write_all(port, *octets, std::chrono::milliseconds{100});
            line.on_bytes(*octets, monotonic_now());
        }
        if (const auto reply = line.take_reply(monotonic_now()))
            write_all(port, *reply, std::chrono::milliseconds{100});
        if (readable(input.fd())) input.read();
        while (const auto typed_line = input.take())
            for (const std::string& said : commands.command(*typed_line, monotonic_now())) print_line(said);
        for (const std::string& logged : line.take_log()) print_line(logged);
        if (commands.quit() || (input.closed() && typed)) break;
    }
    return kFine;
}

/// Sets the first faults, opens the port and serves it until the end.
int run(DeviceLine& line, DeviceCommands& commands, const DriveOptions& options, Format format,
        std::size_t tags)
{
    line.set_logging(options.log);
    for (const std::string& fault : options.faults)
        for (const std::string& wrong : commands.command(fault, monotonic_now())) {
            print_error(fmt::format("--fault {}: {}", fault, wrong));
            return kUsage;
        }
    const Signals signals;
    auto port = open_tty(options.port, options.baud, format);
    if (!port) {
        print_error(port.error());
        return kNo;
    }
    be_prompt();
    print_line(fmt::format("ready {}, profile {}, {} parameters", options.port, options.profile, tags));
    return serve(line, commands, port->get(), signals);
}

/// Modbus RTU begins a reply after 3.5 characters of silence, 1.75 ms at 19200 and above.
std::chrono::nanoseconds modbus_turnaround(const DriveOptions& options)
{
    const auto silence = options.baud > 19'200
                             ? std::chrono::nanoseconds{1'750'000}
                             : std::chrono::nanoseconds{std::int64_t{38'500'000'000} / options.baud};
    return std::max(options.turnaround, silence);
}

/// Returns the naming chosen by --mnemonics; the error is a sentence.
Result<Naming, std::string> naming_of(const DriveOptions& options, Model model)
{
    if (options.mnemonics.empty()) return Naming{model};
    if (const auto rule = rule_of(options.mnemonics)) return Naming{*rule};
    std::error_code error;
    if (!std::filesystem::is_regular_file(options.mnemonics, error))
        return Failure{fmt::format(
            "--mnemonics {}: neither a rule (590plus, ac, pno) nor a file with the columns tag and mnemonic",
            options.mnemonics)};
    auto rows = load_tags(options.mnemonics);
    if (!rows) return Failure{rows.error()};
    return Naming{*std::move(rows)};
}

int run_ei_ascii(const DriveOptions& options, Model model, const std::vector<SimTag>& tags)
{
    auto naming = naming_of(options, model);
    if (!naming) {
        print_error(naming.error());
        return kUsage;
    }
    DriveLine line{model, options.turnaround, *std::move(naming)};
    for (const std::string& unit : options.units)
        if (!line.add_unit(unit, tags)) {
            print_error(fmt::format(
                "--unit {}: a group 0-7 and a unit id 0-9 or A-F, each address once, for example 00", unit));
            return kUsage;
        }
    DriveCommands commands{line};
    return run(line, commands, options, Format::bits7_even, tags.size());
}

int run_modbus(const DriveOptions& options, std::uint16_t ident, const std::vector<SimTag>& tags)
{
    ModbusLine line{modbus_turnaround(options)};
    const auto programs = static_cast<unsigned>(read_number(options.programs).value_or(1));
    std::size_t registers = 0;
    for (const std::string& text : options.units) {
        const auto unit = read_number(text, 1, 254);
        if (!unit || !line.add({static_cast<std::uint8_t>(*unit), ident, tags, programs})) {
            print_error(fmt::format("--unit {}: an address from 1 to 254, each once", text));
            return kUsage;
        }
        registers = line.instruments().back().parameters().size();
    }
    InstrumentCommands commands{line};
    return run(line, commands, options, options.parity ? Format::bits8_even : Format::bits8, registers);
}

} // namespace

int run_drive(const DriveOptions& chosen)
{
    DriveOptions options = chosen;
    const auto model = model_of(options.profile);
    const auto ident = instrument_ident(options.profile);
    if (!model && !ident) {
        print_error(fmt::format(
            "there is no profile '{}': 590, 584s, 620, 590plus, 584sv, 605, 690plus, 2408f or 2404f",
            options.profile));
        return kUsage;
    }
    if (options.units.empty()) options.units = {model ? "00" : "1"};
    if (options.table.empty()) options.table = shipped_table(model ? "example.csv" : "2400.csv");
    if (!model && !options.mnemonics.empty()) {
        print_error("--mnemonics: an instrument with Modbus RTU has registers and no mnemonics");
        return kUsage;
    }
    const auto tags = load_tags(options.table);
    if (!tags) {
        print_error(tags.error());
        return kNo;
    }
    return model ? run_ei_ascii(options, *model, *tags) : run_modbus(options, *ident, *tags);
}

} // namespace dpslave::sim
