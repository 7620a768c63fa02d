// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include "dpsim/drive/drive_commands.hpp"
#include "dpsim/instrument/instrument_commands.hpp"
#include "dpsim/master/console.hpp"

#include "dpslave/arguments/options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <limits>

namespace dpslave::sim {
namespace {

using arguments::add_choice, arguments::add_decimal, arguments::add_list, arguments::add_number,
    arguments::add_rate, arguments::add_text, arguments::add_time, arguments::Between;
using namespace std::chrono_literals;

constexpr const char* kBusRates = "9600, 19200, 45450, 93750, 187500, 500000 or 1500000 bit/s";
constexpr arguments::NumberLimits kRetries{0, 15};
constexpr arguments::TimeLimits kSlots{0s, 1min};

std::string lines(const std::vector<std::string>& all)
{
    std::string text;
    for (const std::string& line : all) text += line + '\n';
    return text;
}

void add_line(CLI::App& app, LineOptions& o)
{
    CLI::App& line =
        *app.add_subcommand("line", "Joins two ptys as a serial line with the timing of its rate");
    add_rate(line, "--baud", o.baud, "Rate of the line in bit/s", kRatesOfALine)->required();
    add_number(line, "--bits", o.bits, "Bit times of a character: 11 (PROFIBUS, 8E1) or 10 (7E1)", {10, 11});
    add_text(line, "--a", o.a, "PATH", "One end (a link to a pty is made there)")->required();
    add_text(line, "--b", o.b, "PATH", "The other end")->required();
    add_decimal(line, "--errors", o.errors, "Probability that a bit is inverted", {0, 1});
    add_time(line, "--delay", o.delay, "Additional delay", kDelaysOfALine);
    add_number(line, "--seed", o.seed, "Seed of the random bit errors",
               {0, std::numeric_limits<std::int64_t>::max()});
    line.add_flag("--any-rate", o.any_rate, "The ends may be set to any rate");
    add_text(line, "--log-a", o.log_a, "FILE",
             "Write each octet that arrives at end a to FILE; it is complete after 'stats' and at the end");
    add_text(line, "--log-b", o.log_b, "FILE", "The same of end b");
    line.footer(
        "Prints 'ready PATH PATH' when both ends can be opened.\n"
        "Commands on standard input: " +
        std::string{kLineCommands} +
        "\n"
        "Octets whose rate differs by more than 2 % from that of the line are garbage, as on a real line.\n"
        "A bit error in a start or stop bit loses the character, wrong parity makes it 00 (as a tty with INPCK does).\n"
        "Example:\n"
        "  dpsim line --baud 187.5k --a /tmp/bus-slave --b /tmp/bus-master");
}

void add_drive(CLI::App& app, DriveOptions& o)
{
    CLI::App& drive =
        *app.add_subcommand("drive", "Simulates a drive (EI-ASCII) or an instrument (Modbus RTU)");
    add_text(
        drive, "--profile", o.profile, "NAME",
        "Name of the device, as in config/profiles. EI-ASCII: 590, 584s, 620, 590plus, 584sv, 605 or 690plus; Modbus RTU: 2408f or 2404f")
        ->required();
    add_text(drive, "--port", o.port, "TTY", "A tty, or an end of a simulated line")->required();
    add_rate(drive, "--baud", o.baud, "Rate in bit/s (7E1; Modbus RTU 8N1)", kRatesOfALine);
    add_list(drive, "--unit", o.units, "LIST",
             "EI-ASCII: group and unit id, default 00; Modbus RTU: address, default 1; several: 00,01",
             Between::commas_and_blanks);
    add_text(
        drive, "--table", o.table, "FILE",
        "Tag table (columns as in dpslaved.toml); default: the shipped example.csv, for instruments 2400.csv");
    add_text(
        drive, "--mnemonics", o.mnemonics, "RULE|FILE",
        "EI-ASCII: how the drive names its tags, whatever table and profile say: 590plus, ac, pno (the PNO in hexadecimal), or a file with the columns tag and mnemonic");
    add_time(drive, "--turnaround", o.turnaround,
             "Time until a reply begins; Modbus RTU: at least 3.5 characters", {0s, 10s});
    add_choice(drive, "--programs", o.programs, {"0", "1", "4"},
               "Number of programs that an instrument stores");
    drive.add_flag("--parity", o.parity, "Modbus RTU with even parity (8E1)");
    drive
        .add_option("--fault", o.faults,
                    "Set a fault from the start, in the words of the command: --fault 'slow 50ms'")
        ->type_name("TEXT");
    drive.add_flag("--log", o.log, "Print each value that is written, as 'log on' does");
    drive.footer(
        "Commands on standard input, of a drive:\n" + lines(DriveCommands::all_help()) +
        "Commands on standard input, of an instrument:\n" + lines(InstrumentCommands::all_help()) +
        "TIME: 50ms, 2s, 5m; a number alone is seconds.\n"
        "An instrument answers functions 3, 4, 6, 7, 8 (sub code 0) and 16; register = tag, from 8000h on IEEE singles at 8000h + 2 x tag.\n"
        "Examples:\n"
        "  dpsim drive --profile 590 --port /tmp/drive-end --log\n"
        "  dpsim drive --profile 2408f --port /tmp/drive-end --unit 1 --programs 4");
}

/// The options that say what User_Prm_Data and Cfg_Data contain.
void add_telegrams(CLI::App& master, MasterTexts& t)
{
    auto* const gsd = add_text(
        master, "--gsd", t.gsd, "FILE",
        "A GSD file: ident, User_Prm_Data, Cfg_Data, and whether to ask for Sync and Freeze, as the master's tool takes them from it");
    add_text(
        master, "--modules", t.modules, "NAME,...",
        "With --gsd: the modules in the order of their slots, by name, or '#3' for the third of the file; default: those that are preset, or the one of a compact station")
        ->needs(gsd);
    add_choice(
        master, "--family", t.family, {"option-board", "technology-box", "controller"},
        "Kind of slave: option-board (584S, 590, 620), technology-box (6053/6055) or controller (2408f/2404f, without Sync and Freeze)");
    add_text(master, "--ident", t.ident, "N",
             "Ident_Number, as 0x1649; default 0x0533 for the option board, required for the others")
        ->excludes(gsd);
    auto* const prm = add_text(master, "--prm", t.prm, "HEX", "User_Prm_Data in hexadecimal, or none");
    prm->excludes(gsd);
    auto* const tags = add_text(
        master, "--tags", t.tags, "LIST",
        "Tags for User_Prm_Data in the form of the family (24 octets; three of DPV1, then the tags; the tags alone); 'w' = written, 'rw' = both: 55,56w,288-290. With --gsd: the numbers alone, put over the octets of the file");
    tags->excludes(prm);
    add_number(master, "--prm-length", t.prm_length, "Fill --tags up with zeros to this number of octets",
               {1, 237})
        ->needs(tags)
        ->excludes(gsd);
    auto* const cfg = add_text(master, "--cfg", t.cfg, "HEX",
                               "Cfg_Data in hexadecimal; default: 73, then 50, 60 or 70 for each of --tags");
    cfg->excludes(gsd);
    master.add_flag("--no-demand", t.no_demand, "With --tags: Cfg_Data without the 73 of Demand Data")
        ->needs(tags)
        ->excludes(cfg)
        ->excludes(gsd);
}

/// The further contents of Set_Prm, and the pace of the master.
void add_settings(CLI::App& master, MasterSettings& settings, MasterTexts& t)
{
    auto* const wd = add_time(master, "--watchdog", t.watchdog, "Watchdog time of the slave",
                              {10ms, std::chrono::milliseconds{650'250}});
    master.add_flag("--no-watchdog", t.no_watchdog, "Set_Prm without WD_On")->excludes(wd);
    add_number(master, "--min-tsdr", t.min_tsdr, "Bit times", {0, 255})->default_str("11");
    add_number(master, "--group", t.group, "Group_Ident, a bit per group", {0, 255})->default_str("1");
    master.add_flag("--no-sync-freeze", t.no_sync_freeze, "Do not ask for Sync and Freeze");
    add_time(master, "--cycle", t.cycle, "Time from one Data_Exchange to the next", {0s, 1min});
    add_time(master, "--slot", t.slot, "How long to wait for an answer after the slot time", kSlots);
    add_number(master, "--retries", settings.retries, "Repetitions of a request without answer", kRetries)
        ->default_str(std::to_string(settings.retries));
    add_number(master, "--others", settings.others,
               "Exchanges of other stations before each request, from address 90 on: the bus is busy",
               {0, 32})
        ->default_str("0");
    master.add_flag("--sd3", t.sd3, "Send data units of eight octets as SD3 telegrams");
}

void add_master(CLI::App& app, MasterOptions& o, MasterTexts& t)
{
    CLI::App& master = *app.add_subcommand("master", "Simulates a DP master (class 1) for one slave");
    add_text(master, "--port", o.port, "TTY", "A tty, or an end of a simulated line")->required();
    add_rate(master, "--baud", t.baud, kBusRates, {1, 12'000'000})->required();
    add_number(master, "--master", t.address, "Address of the master", {0, 125})->default_str("2");
    add_number(master, "--slave", t.slave, "Address of the slave", {0, 126})->required();
    add_telegrams(master, t);
    add_settings(master, o.settings, t);
    add_text(master, "--script", o.script, "FILE",
             "File of commands, - for standard input; ends at the first failure");
    master.footer(
        "Commands, one on each line:\n" + lines(Console::help()) + "Examples:\n" +
        "  printf 'start\\nwait 2s for in 1 = 1250\\n' > script\n"
        "  dpsim master --port /tmp/bus-master --baud 187.5k --slave 5 --tags 55,56w,288 --script script\n"
        "A rehearsal with the GSD of the plant:\n"
        "  dpsim master --port /tmp/bus-master --baud 187.5k --slave 5 --gsd EURO0533.GSD --modules Demand-Data,Process-Data-Input --tags 55\n"
        "Autotune of a 2408f (worked example 1 of its handbook) as a script:\n"
        "  start\n  demand raw 0\n  wait 5s for demand reg 1 = 0\n  demand raw 8462 0 0 1\n"
        "  wait 5s for demand reg 1 = 4366\n  demand raw 4172\n  wait 5s for demand reg 1 = 4172\n"
        "  wait 60s for demand reg 4 & 0x1000 = 0");
}

void add_replay(CLI::App& app, ReplayOptions& o)
{
    CLI::App& replay =
        *app.add_subcommand("replay", "Sends the master's side of a capture again, and compares the answers");
    add_text(replay, "FILE", o.file, "", "Capture (pcapng or pcap), as dpctl trace --output makes it")
        ->required();
    add_text(replay, "--port", o.port, "TTY", "A tty, or an end of a simulated line")->required();
    add_rate(replay, "--baud", o.baud, kBusRates, {1, 12'000'000})->required();
    auto* const drive =
        add_text(replay, "--drive-port", o.drive_port, "TTY",
                 "End of the gateway's drive line: the drive frames of the capture answer there");
    add_text(replay, "--line", o.line, "LINE",
             "The drive line whose frames answer, where the capture has several")
        ->needs(drive);
    add_rate(replay, "--drive-baud", o.drive_baud, "Rate of that line in bit/s", kRatesOfALine)->needs(drive);
    replay.add_flag("--fast", o.fast, "Leave out the pauses of the capture");
    add_number(replay, "--retries", o.retries, "Repetitions of a request that is not answered", kRetries)
        ->default_str(std::to_string(o.retries));
    add_time(replay, "--slot", o.slot, "How long to wait for an answer after the slot time", kSlots);
    replay.footer(
        "What the capture has as received is sent, with its pauses. What it has as sent is the answer that the gateway has to give. The gateway needs the configuration of the capture: address, profile, ident, tags.\n"
        "A capture that does not say who sent its packets: bit 6 of the function code tells requests from answers of the gateway.\n"
        "Without --drive-port what comes from the drive is not compared: inputs, Stat_Diag, the extended diagnosis. With it an input word must be one that the capture has in this place. When a drive answers is never the same: Stat_Diag, and whether a diagnosis waits (DH), are not compared.\n"
        "Example:\n"
        "  dpsim replay bus.pcapng --port /tmp/bus-master --baud 187.5k");
}

} // namespace

void add_commands(CLI::App& app, CommandLine& into)
{
    add_line(app, into.line);
    add_drive(app, into.drive);
    add_master(app, into.master, into.texts);
    add_replay(app, into.replay);
}

} // namespace dpslave::sim
