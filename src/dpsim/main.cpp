// SPDX-License-Identifier: Apache-2.0
/// dpsim: a paced serial line, an EI-ASCII drive or a Modbus instrument, a DP master, and the replay of a
/// capture, for users without hardware and for the tests.
#include "dpsim/common/programs.hpp"
#include "dpsim/drive/drive_commands.hpp"
#include "dpsim/instrument/instrument_commands.hpp"
#include "dpsim/master/console.hpp"
#include "dpsim/master/master_options.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>

namespace {

using namespace dpslave;
using namespace dpslave::sim;

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
    line.add_option("--baud", o.baud, "bit/s")->required()->check(CLI::Range(50, 12'000'000));
    line.add_option("--bits", o.bits, "bit times of a character: 11 (PROFIBUS, 8E1) or 10 (7E1)")
        ->check(CLI::IsMember({10, 11}));
    line.add_option("--a", o.a, "path of one end (a link to a pty is made there)")->required();
    line.add_option("--b", o.b, "path of the other end")->required();
    line.add_option("--errors", o.errors, "probability that a bit is inverted")->check(CLI::Range(0.0, 1.0));
    line.add_option("--delay", o.delay_us, "additional delay in microseconds")
        ->check(CLI::Range(0, 10'000'000));
    line.add_option("--seed", o.seed, "seed of the random bit errors");
    line.add_flag("--any-rate", o.any_rate, "the ends may be set to any rate");
    line.add_option("--log-a", o.log_a,
                    "file for each octet that arrives at end a, as it is; whole after stats and at the end");
    line.add_option("--log-b", o.log_b, "the same of end b");
    line.footer(
        "Prints 'ready PATH PATH' when both ends can be opened.\n"
        "Commands on standard input: " +
        std::string{kLineCommands} +
        "\n"
        "Octets whose rate differs by more than 2 % from that of the line are garbage, as on a real line.\n"
        "A bit error in a start or stop bit loses the character, wrong parity makes it 00 (as a tty "
        "with INPCK does).\n"
        "Example: dpsim line --baud 187500 --a /tmp/bus-slave --b /tmp/bus-master");
}

void add_drive(CLI::App& app, DriveOptions& o)
{
    CLI::App& drive =
        *app.add_subcommand("drive", "Simulates a drive (EI-ASCII) or an instrument (Modbus RTU)");
    drive
        .add_option("--profile", o.profile,
                    "name of the device, as in config/profiles. EI-ASCII: 590, 584s, 620, 590plus, 584sv, "
                    "605 or 690plus; Modbus RTU: 2408f or 2404f")
        ->required();
    drive.add_option("--port", o.port, "tty or end of a simulated line")->required();
    drive.add_option("--baud", o.baud, "bit/s (7E1; Modbus RTU 8N1)")
        ->capture_default_str()
        ->check(CLI::Range(50, 12'000'000));
    drive.add_option(
        "--unit", o.units,
        "EI-ASCII: group and unit id, default 00; Modbus RTU: address, default 1; several: --unit 00 01");
    drive.add_option("--table", o.table,
                     "tag table (columns as in dpslaved.toml); default: the shipped example.csv, for "
                     "instruments 2400.csv");
    drive
        .add_option("--turnaround", o.turnaround_ms,
                    "milliseconds until a reply begins; Modbus RTU: at least 3.5 "
                    "characters")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 10'000.0));
    drive.add_option("--programs", o.programs, "number of programs that an instrument stores: 0, 1 or 4")
        ->capture_default_str()
        ->check(CLI::IsMember({0, 1, 4}));
    drive.add_flag("--parity", o.parity, "Modbus RTU with even parity (8E1)");
    drive.add_option("--fault", o.faults,
                     "sets a fault from the start, in the words of the command: --fault 'slow 50'");
    drive.add_flag("--log", o.log, "prints each value that is written, as 'log on' does");
    drive.footer(
        "Commands on standard input, of a drive:\n" + lines(DriveCommands::all_help()) +
        "Commands on standard input, of an instrument:\n" + lines(InstrumentCommands::all_help()) +
        "An instrument answers functions 3, 4, 6, 7, 8 (sub code 0) and 16; register = tag, from 8000h on "
        "IEEE singles at 8000h + 2 x tag.\n"
        "Example: dpsim drive --profile 590 --port /tmp/drive-end --log\n"
        "         dpsim drive --profile 2408f --port /tmp/drive-end --unit 1 --programs 4");
}

void add_master(CLI::App& app, MasterOptions& o, MasterTexts& t)
{
    CLI::App& master = *app.add_subcommand("master", "Simulates a DP master (class 1) for one slave");
    master.add_option("--port", o.port, "tty or end of a simulated line")->required();
    master.add_option("--baud", t.baud, "9600, 19200, 45450, 93750, 187500, 500000 or 1500000")->required();
    master.add_option("--master", t.address, "address of the master")
        ->capture_default_str()
        ->check(CLI::Range(0, 125));
    master.add_option("--slave", t.slave, "address of the slave")->required()->check(CLI::Range(0, 126));
    master
        .add_option("--family", t.family,
                    "kind of slave: option-board (584S, 590, 620), technology-box (6053/6055) or "
                    "controller (2408f/2404f, without Sync and Freeze)")
        ->capture_default_str()
        ->check(CLI::IsMember({"option-board", "technology-box", "controller"}));
    master.add_option("--ident", t.ident,
                      "Ident_Number; default 0x0533 for the option board, required for the others");
    auto* const prm = master.add_option("--prm", t.prm, "User_Prm_Data in hexadecimal, or none");
    auto* const tags = master.add_option(
        "--tags", t.tags,
        "tags for User_Prm_Data in the form of the family (24 octets; three of DPV1, then the tags; the tags "
        "alone); 'w' = written, 'rw' = both: 55,56w,288");
    tags->excludes(prm);
    master.add_option("--prm-length", t.prm_length, "fills --tags up with zeros to this number of octets")
        ->needs(tags)
        ->check(CLI::Range(1, 237));
    auto* const cfg = master.add_option(
        "--cfg", t.cfg, "Cfg_Data in hexadecimal; default: 73, then 50, 60 or 70 for each of --tags");
    master.add_flag("--no-demand", t.no_demand, "with --tags: Cfg_Data without the 73 of Demand Data")
        ->needs(tags)
        ->excludes(cfg);
    auto* const wd = master.add_option("--watchdog", t.watchdog_ms, "milliseconds")
                         ->capture_default_str()
                         ->check(CLI::Range(10, 650'250));
    master.add_flag("--no-watchdog", t.no_watchdog, "Set_Prm without WD_On")->excludes(wd);
    master.add_option("--min-tsdr", t.min_tsdr, "bit times")
        ->capture_default_str()
        ->check(CLI::Range(0, 255));
    master.add_option("--group", t.group, "Group_Ident, a bit per group")
        ->capture_default_str()
        ->check(CLI::Range(0, 255));
    master.add_flag("--no-sync-freeze", t.no_sync_freeze, "do not ask for Sync and Freeze");
    master.add_option("--cycle", t.cycle_ms, "milliseconds from one Data_Exchange to the next")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 60'000.0));
    master.add_option("--slot-ms", t.slot_ms, "how long to wait for an answer after the slot time")
        ->capture_default_str()
        ->check(CLI::Range(0, 60'000));
    master.add_option("--retries", o.settings.retries, "repetitions of a request without answer")
        ->capture_default_str()
        ->check(CLI::Range(0, 15));
    master
        .add_option("--others", o.settings.others,
                    "exchanges of other stations before each request, from address 90 on: the bus is busy")
        ->capture_default_str()
        ->check(CLI::Range(0, 32));
    master.add_flag("--sd3", t.sd3, "SD3 telegrams for data units of eight octets");
    master.add_option("--script", o.script,
                      "file of commands, - for standard input; ends at the first failure");
    master.footer(
        "Commands, one on each line:\n" + lines(Console::help()) +
        "Exit status: 0 success, 1 an expectation failed or the slave cannot be reached, 2 wrong usage, 3 a "
        "port cannot be opened.\n"
        "Example: printf 'start\\nwait 2s for in 1 = 1250\\n' | dpsim master --port /tmp/bus-master --baud "
        "187500 \\\n"
        "           --slave 5 --tags 55,56w,288 --script -\n"
        "Autotune of a 2408f (worked example 1 of its handbook) as a script:\n"
        "  start\n  demand raw 0\n  wait 5s for demand reg 1 = 0\n  demand raw 8462 0 0 1\n"
        "  wait 5s for demand reg 1 = 4366\n  demand raw 4172\n  wait 5s for demand reg 1 = 4172\n"
        "  wait 60s for demand reg 4 & 0x1000 = 0");
}

void add_replay(CLI::App& app, ReplayOptions& o)
{
    CLI::App& replay =
        *app.add_subcommand("replay", "Sends the master's side of a capture again, and compares the answers");
    replay.add_option("FILE", o.file, "capture (pcapng), as dpctl trace --write makes it")->required();
    replay.add_option("--port", o.port, "tty or end of a simulated line")->required();
    replay.add_option("--baud", o.baud, "9600, 19200, 45450, 93750, 187500, 500000 or 1500000")->required();
    auto* const drive = replay.add_option(
        "--drive", o.drive, "end of the gateway's drive line: the drive frames of the capture answer there");
    replay.add_option("--line", o.line, "the drive line whose frames answer, where the capture has several")
        ->type_name("NAME")
        ->needs(drive);
    replay.add_option("--drive-baud", o.drive_baud, "bit/s of that line")
        ->capture_default_str()
        ->needs(drive)
        ->check(CLI::Range(50, 12'000'000));
    replay.add_flag("--fast", o.fast, "without the pauses of the capture");
    replay.add_option("--retries", o.retries, "repetitions of a request that is not answered")
        ->capture_default_str()
        ->check(CLI::Range(0, 15));
    replay.add_option("--slot-ms", o.slot_ms, "how long to wait for an answer after the slot time")
        ->capture_default_str()
        ->check(CLI::Range(0, 60'000));
    replay.footer(
        "What the capture has as received is sent, with its pauses. What it has as sent is the answer\n"
        "that the gateway has to give. The gateway needs the configuration of the capture: address,\n"
        "profile, ident, tags.\n"
        "Without --drive what comes from the drive is not compared: inputs, Stat_Diag, the extended\n"
        "diagnosis. With it an input word must be one that the capture has in this place. When a drive\n"
        "answers is never the same: Stat_Diag, and whether a diagnosis waits (DH), are not compared.\n"
        "Exit status: 0 no difference, 1 there are differences, 2 wrong usage or no such capture,\n"
        "3 a port cannot be opened.\n"
        "Example: dpsim replay bus.pcapng --port /tmp/bus-master --baud 187500");
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{
        "Simulators for dpslaved: a serial line, a drive or instrument, a PROFIBUS-DP master and the "
        "replay of a capture, all without hardware"};
    app.require_subcommand(1);
    app.set_version_flag("--version", "dpsim " DPSLAVE_VERSION);
    app.footer(
        "Example, a whole bus on one machine (three terminals and the daemon):\n"
        "  dpsim line --baud 187500 --a /tmp/bus-slave --b /tmp/bus-master\n"
        "  dpsim line --baud 9600 --bits 10 --a /tmp/drive-near --b /tmp/drive-end\n"
        "  dpsim drive --profile 590 --port /tmp/drive-end\n"
        "  dpsim master --port /tmp/bus-master --baud 187500 --slave 5 --tags 55,56w,288\n"
        "With an instrument: dpsim drive --profile 2408f --port /tmp/drive-end, and\n"
        "  dpsim master --port /tmp/bus-master --baud 187500 --slave 5 --family controller --ident IDENT "
        "--tags 1,5,3,75,24w");
    LineOptions line;
    DriveOptions drive;
    MasterOptions master;
    MasterTexts texts;
    ReplayOptions replay;
    add_line(app, line);
    add_drive(app, drive);
    add_master(app, master, texts);
    add_replay(app, replay);
    for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
        command->set_version_flag("--version", "dpsim " DPSLAVE_VERSION)->group(""); // in the help once
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kFine : kUsage;
    }
    if (app.got_subcommand("line")) return run_line(line);
    if (app.got_subcommand("drive")) return run_drive(drive);
    if (app.got_subcommand("replay")) return run_replay(replay);
    if (const std::string wrong = complete(master.settings, texts); !wrong.empty()) {
        fmt::print(stderr, "dpsim: {}\n", wrong);
        return kUsage;
    }
    return run_master(master);
}
