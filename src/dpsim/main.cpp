// SPDX-License-Identifier: Apache-2.0
/// dpsim: a paced serial line, an EI-ASCII drive and a DP master, for users without hardware and for the
/// tests.
#include "dpsim/console.hpp"
#include "dpsim/drive_commands.hpp"
#include "dpsim/programs.hpp"
#include "dpsim/values.hpp"

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
    CLI::App& line = *app.add_subcommand("line", "joins two ptys as a paced serial line");
    line.add_option("--baud", o.baud, "bit/s")->required()->check(CLI::Range(50, 12'000'000));
    line.add_option("--bits", o.bits, "bit times of a character: 11 (PROFIBUS, 8E1) or 10 (7E1)")
        ->check(CLI::IsMember({10, 11}));
    line.add_option("--a", o.a, "path of one end (a link to a pty is made there)")->required();
    line.add_option("--b", o.b, "path of the other end")->required();
    line.add_option("--errors", o.errors, "chance of each bit to be inverted")->check(CLI::Range(0.0, 1.0));
    line.add_option("--delay", o.delay_us, "further delay in microseconds")->check(CLI::Range(0, 10'000'000));
    line.add_option("--seed", o.seed, "of the bit errors");
    line.footer("Prints 'ready PATH PATH' when both ends can be opened.\n"
                "Commands on standard input: cut | restore | errors P | delay US | stats | quit\n"
                "A bit error in a start or stop bit loses the character, wrong parity makes it 00 (as a tty "
                "with INPCK does).\n"
                "Example: dpsim line --baud 187500 --a /tmp/bus-slave --b /tmp/bus-master");
}

void add_drive(CLI::App& app, DriveOptions& o)
{
    CLI::App& drive = *app.add_subcommand("drive", "an EI-ASCII drive in memory");
    drive.add_option("--model", o.model, "590, 584s or 620")->required();
    drive.add_option("--port", o.port, "tty or end of a simulated line")->required();
    drive.add_option("--baud", o.baud, "bit/s (7E1)")->check(CLI::Range(50, 12'000'000));
    drive.add_option("--unit", o.units, "group and unit id; several drives: --unit 00 01")
        ->capture_default_str();
    drive.add_option("--tags", o.tags, "tag table, else the example that is shipped");
    drive.add_option("--turnaround", o.turnaround_ms, "milliseconds until a reply begins")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 10'000.0));
    drive.add_option("--fault", o.faults, "a fault from the start, as the command: --fault 'slow 50'");
    drive.add_flag("--log", o.log, "tell what is written, as 'log on'");
    drive.footer("Commands on standard input:\n" + lines(DriveCommands::help()) +
                 "Example: dpsim drive --model 590 --port /tmp/drive-end --log");
}

/// Options of the master that need a second look after CLI11 has read them.
struct MasterTexts {
    std::uint32_t baud = 187'500;
    std::string ident, prm, tags, cfg;
    std::uint32_t watchdog_ms = 1000, slot_ms = 20;
    unsigned address = 2, slave = 5, min_tsdr = 11, group = 1;
    double cycle_ms = 10;
    bool no_watchdog = false, no_sync_freeze = false, sd3 = false;
};

void add_master(CLI::App& app, MasterOptions& o, MasterTexts& t)
{
    CLI::App& master = *app.add_subcommand("master", "a DP master (class 1) for one slave");
    master.add_option("--port", o.port, "tty or end of a simulated line")->required();
    master.add_option("--baud", t.baud, "9600, 19200, 45450, 93750, 187500, 500000 or 1500000")->required();
    master.add_option("--master", t.address, "own address")->capture_default_str()->check(CLI::Range(0, 125));
    master.add_option("--slave", t.slave, "address of the slave")->required()->check(CLI::Range(0, 126));
    master.add_option("--ident", t.ident, "Ident_Number, 0x0533 if none is given");
    auto* const prm = master.add_option("--prm", t.prm, "User_Prm_Data in hexadecimal");
    master
        .add_option("--tags", t.tags,
                    "tags for User_Prm_Data of the option board (24 octets); 'w' = written: 55,56w,288")
        ->excludes(prm);
    master.add_option("--cfg", t.cfg, "Cfg_Data in hexadecimal; else 73 and 50 or 60 for each of --tags");
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
    master.add_option("--slot-ms", t.slot_ms, "waits so much longer for an answer than the slot time")
        ->capture_default_str()
        ->check(CLI::Range(0, 60'000));
    master.add_option("--retries", o.settings.retries, "repetitions of a request without answer")
        ->capture_default_str()
        ->check(CLI::Range(0, 15));
    master.add_flag("--sd3", t.sd3, "SD3 telegrams for data units of eight octets");
    master.add_option("--script", o.script,
                      "file of commands, - for standard input; ends at the first failure");
    master.footer(
        "Commands, one a line:\n" + lines(Console::help()) +
        "Exit status: 0 fine, 1 an expectation failed or the slave cannot be reached, 2 usage, 3 no port.\n"
        "Example: printf 'start\\nwait 2s for in 1 = 1250\\n' | dpsim master --port /tmp/bus-master --baud "
        "187500 \\\n"
        "           --slave 5 --tags 55,56w,288 --script -");
}

/// "55,56w,288" into User_Prm_Data and, if `cfg` is empty, Cfg_Data. Empty = good.
std::string use_tags(const std::string& list, Octets& prm, Octets& cfg)
{
    Octets ids{0x73};
    prm.clear();
    std::string text = list;
    for (char& c : text) c = c == ',' ? ' ' : c;
    for (std::string word : words_of(text)) {
        const bool written = word.ends_with('w');
        if (written) word.pop_back();
        const auto tag = number_of(word);
        if (!tag || *tag < 1 || *tag > 0xFFFF) return fmt::format("--tags: '{}' is no tag number", word);
        prm.push_back(high(static_cast<std::uint16_t>(*tag)));
        prm.push_back(low(static_cast<std::uint16_t>(*tag)));
        ids.push_back(written ? 0x60 : 0x50);
    }
    if (prm.size() > 24) return "--tags: 12 tags are the limit of the option board; --prm takes any octets";
    prm.resize(24, 0);
    if (cfg.empty()) cfg = ids;
    return {};
}

/// Puts the texts into the settings. Empty = good, else a sentence.
std::string complete(MasterSettings& s, const MasterTexts& t)
{
    const auto baud = baud_of(t.baud);
    if (!baud)
        return fmt::format("--baud {}: PROFIBUS has 9600, 19200, 45450, 93750, 187500, 500000 and 1500000",
                           t.baud);
    s.baud = *baud;
    s.address = static_cast<std::uint8_t>(t.address);
    s.slave = static_cast<std::uint8_t>(t.slave);
    if (s.address == s.slave) return "--master and --slave are the same address";
    if (!t.ident.empty()) {
        const auto ident = number_of(t.ident);
        if (!ident || *ident < 0 || *ident > 0xFFFF)
            return fmt::format("--ident {}: a number up to 0xFFFF", t.ident);
        s.ident = static_cast<std::uint16_t>(*ident);
    }
    const auto prm = octets_of(t.prm), cfg = octets_of(t.cfg);
    if (!prm) return "--prm: " + prm.error();
    if (!cfg) return "--cfg: " + cfg.error();
    if (!t.prm.empty()) s.user_prm = *prm;
    if (s.user_prm.size() > 237) return "--prm: 237 octets are the limit";
    Octets ids = *cfg;
    if (!t.tags.empty())
        if (std::string wrong = use_tags(t.tags, s.user_prm, ids); !wrong.empty()) return wrong;
    if (!ids.empty()) s.cfg = ids;
    if (const auto lengths = cfg_lengths(s.cfg); !lengths) return "--cfg: " + lengths.error();
    s.watchdog = std::chrono::milliseconds{t.no_watchdog ? 0 : t.watchdog_ms};
    s.min_tsdr = static_cast<std::uint8_t>(t.min_tsdr);
    s.group = static_cast<std::uint8_t>(t.group);
    s.sync_freeze = !t.no_sync_freeze;
    s.fixed = t.sd3 ? Fixed::when_eight : Fixed::never;
    s.cycle = std::chrono::nanoseconds{static_cast<std::int64_t>(t.cycle_ms * 1e6)};
    s.allowance = std::chrono::milliseconds{t.slot_ms};
    return {};
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app{
        "Simulators for dpslaved: a serial line, a drive and a PROFIBUS-DP master, all without hardware"};
    app.require_subcommand(1);
    app.footer("Example, a whole bus on one machine (three terminals and the daemon):\n"
               "  dpsim line --baud 187500 --a /tmp/bus-slave --b /tmp/bus-master\n"
               "  dpsim line --baud 9600 --bits 10 --a /tmp/drive-near --b /tmp/drive-end\n"
               "  dpsim drive --model 590 --port /tmp/drive-end\n"
               "  dpsim master --port /tmp/bus-master --baud 187500 --slave 5 --tags 55,56w,288");
    LineOptions line;
    DriveOptions drive;
    MasterOptions master;
    MasterTexts texts;
    add_line(app, line);
    add_drive(app, drive);
    add_master(app, master, texts);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kFine : kUsage;
    }
    if (app.got_subcommand("line")) return run_line(line);
    if (app.got_subcommand("drive")) return run_drive(drive);
    if (const std::string wrong = complete(master.settings, texts); !wrong.empty()) {
        fmt::print(stderr, "dpsim: {}\n", wrong);
        return kUsage;
    }
    return run_master(master);
}
