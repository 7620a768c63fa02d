// SPDX-License-Identifier: Apache-2.0
#include "dpsim/common/programs.hpp"
#include "dpsim/common/system.hpp"
#include "drive_answers.hpp"
#include "replay.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace dpslave::sim {
namespace {

/// The limit of a capture, which is read as a whole. A busy bus at 187.5 kbit/s fills this in an hour.
constexpr std::size_t kMostOfACapture = 256U << 20;

Result<ReplayScript, std::string> read_script(const std::string& path, const std::string& line)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return Failure{path + ": is no file"};
    std::ifstream file{path, std::ios::binary | std::ios::ate};
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0) return Failure{path + ": cannot be read"};
    if (static_cast<std::uint64_t>(size) > kMostOfACapture)
        return Failure{path + ": it has more than 256 MiB"};
    Octets octets(static_cast<std::size_t>(size));
    file.seekg(0);
    if (size > 0 &&
        !file.read(reinterpret_cast<char*>(octets.data()), size)) // NOLINT: the octets of a stream are char
        return Failure{path + ": cannot be read"};
    bool is_cut = false;
    auto capture = pcapng::read(octets, &is_cut);
    if (!capture) return Failure{path + ": " + capture.error()};
    const pcapng::Assumed assumed = pcapng::assume_directions(*capture);
    auto script = script_of(*capture, line);
    if (!script) return Failure{path + ": " + script.error()};
    if (is_cut) print_error(path + ": it is cut off: the complete packets before that are sent");
    if (assumed.packets != 0) print_error(path + ": " + pcapng::in_words(assumed));
    return script;
}

/// Returns a clause about what is wrong with --drive-port and --line for this capture; nullopt if all is
/// well.
std::optional<std::string> fault_of_drive(const ReplayScript& script, const ReplayOptions& options)
{
    const std::string lines = fmt::format("{}", fmt::join(script.drive_lines, ", "));
    if (options.drive_port.empty()) return std::nullopt;
    if (script.drive_lines.empty()) return "it has no frames of a drive line: leave out --drive-port";
    if (script.drive.empty()) return "it has no drive line " + options.line + "; it has: " + lines;
    if (script.drive_lines.size() > 1 && options.line.empty())
        return "it has several drive lines, name one with --line: " + lines;
    return std::nullopt;
}

class ReplaySession {
public:
    ReplaySession(const ReplayScript& script, const ReplayOptions& options, Baud baud, int bus, int drive)
        : bus_(bus),
          drive_(drive),
          answers_(script),
          replay_(
              script, drive >= 0 ? DriveSide::capture : DriveSide::unknown,
              {.baud = baud, .in_time = !options.fast, .retries = options.retries, .allowance = options.slot},
              monotonic_now())
    {}

    int run(const Signals& signals)
    {
        while (!replay_.done() && !readable(signals.fd())) {
            wait_readable({signals.fd(), bus_, drive_}, replay_.next_deadline());
            if (!turn_bus() || (drive_ >= 0 && !turn_drive())) {
                print_error("the line is gone");
                return kNo;
            }
            for (const std::string& line : replay_.take_lines()) print_line(line);
        }
        print_line(in_words(replay_.counters()));
        if (!replay_.done()) print_error("ended before the end of the capture");
        return replay_.done() && replay_.counters().differences == 0 ? kFine : kNo;
    }

private:
    bool turn_bus()
    {
        const auto octets = read_some(bus_);
        if (!octets) return false;
        replay_.on_bytes(*octets, monotonic_now());
        replay_.on_time(monotonic_now());
        if (const auto telegram = replay_.take_transmit(monotonic_now()))
            write_all(bus_, *telegram, std::chrono::milliseconds{100});
        return true;
    }

    bool turn_drive()
    {
        const auto octets = read_some(drive_);
        if (!octets) return false;
        if (octets->empty()) return true;
        // A request that did not become complete within a moment never does.
        if (monotonic_now() - drive_heard_ > std::chrono::milliseconds{50}) answers_.forget();
        drive_heard_ = monotonic_now();
        if (const auto answer = answers_.on_bytes(*octets, replay_.capture_time()))
            write_all(drive_, *answer, std::chrono::milliseconds{100});
        for (const Octets& request : answers_.take_unknown())
            print_line("the drive was asked what the capture has no answer to: " + hex(request));
        return true;
    }

    int bus_, drive_;
    Instant drive_heard_{};
    DriveAnswers answers_;
    Replay replay_;
};

} // namespace

int run_replay(const ReplayOptions& options)
{
    const auto baud = baud_of(options.baud);
    if (!baud) {
        print_error(fmt::format(
            "--baud {}: PROFIBUS has 9600, 19200, 45450, 93750, 187500, 500000 and 1500000", options.baud));
        return kUsage;
    }
    const auto script = read_script(options.file, options.line);
    if (!script) {
        print_error(script.error());
        return kNo;
    }
    if (const auto fault = fault_of_drive(*script, options)) {
        print_error(options.file + ": " + *fault);
        return kUsage;
    }
    const Signals signals;
    auto bus = open_tty(options.port, options.baud, Format::bits8_even);
    if (!bus) {
        print_error(bus.error());
        return kNo;
    }
    Fd drive;
    if (!options.drive_port.empty()) {
        auto opened = open_tty(options.drive_port, options.drive_baud,
                               script->is_modbus ? Format::bits8 : Format::bits7_even);
        if (!opened) {
            print_error(opened.error());
            return kNo;
        }
        drive = *std::move(opened);
    }
    be_prompt();
    return ReplaySession{*script, options, *baud, bus->get(), drive.get()}.run(signals);
}

} // namespace dpslave::sim
