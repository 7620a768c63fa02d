// SPDX-License-Identifier: Apache-2.0
#include "gsd.hpp"

#include "gsd_commands.hpp"

#include <CLI/CLI.hpp>

#include <memory>

namespace dpslave::dpctl {
namespace {

constexpr const char* kExits =
    "Exit codes: 0 success, 1 faulty or refused, 2 wrong usage; no daemon is needed.";

constexpr const char* kExamples =
    "Examples:\n"
    "  dpctl gsd check EURO0533.GSD\n"
    "  dpctl gsd check UNWI0533.GSD --station unwinder\n"
    "  dpctl gsd make --profile 590 --output 590_0533.GSD\n"
    "  dpctl gsd make --profile 590 --in 55,57 --out 56 --demand --output UNWI0533.GSD\n"
    "  dpctl gsd make --mapping gain-scheduling.toml --ident 0x1234 --output GAIN1234.GSD\n"
    "  dpctl gsd show UNWI0533.GSD --profile 590\n"
    "  dpctl gsd make --profile 605 --ident 0x1649 --table mine.csv --in 1,2 --output MINE1649.GSD\n"
    "  dpctl gsd import UNWI0533.GSD --profile 590 --output unwinder.toml\n"
    "  dpctl gsd diff OLD.GSD NEW.GSD --profile 590\n"
    "  dpctl gsd configure\n"
    "  dpctl gsd types --output /media/disc\n";

void add_profiles(CLI::App& app, GsdOptions& options)
{
    app.add_option("--profiles", options.profiles, "Folder of the device profiles")
        ->type_name("DIR")
        ->capture_default_str();
}

void add_table(CLI::App& app, GsdOptions& options)
{
    app.add_option("--table", options.table, "Your own tag table (CSV); the GSD file gets its names")
        ->type_name("FILE");
}

void add_tags(CLI::App& app, const char* name, std::vector<std::string>& tags, const char* help)
{
    app.add_option(name, tags, help)->type_name("TAG,TAG,...")->delimiter(',');
}

void add_check(CLI::App& app, GsdOptions& options)
{
    app.add_option("FILE", options.file, "A GSD file")->required()->type_name("");
    app.add_flag("--strict", options.strict,
                 "Every deviation from the standard is an error, also those that many public files have and "
                 "masters accept");
    app.add_option(
           "--station", options.daemon.station,
           "Checks the file against this running station too, its name or address: before commissioning")
        ->type_name("NAME");
    app.add_option("--table", options.table,
                   "With --station: the station's tag table (CSV), if it is not here")
        ->type_name("FILE");
    add_profiles(app, options);
    app.add_option("--socket", options.daemon.socket, "With --station: the daemon's control socket")
        ->type_name("PATH")
        ->capture_default_str();
    app.footer(
        "Exit codes: 0 success, 1 faulty or refused, 2 wrong usage or no such station, 3 no daemon; without "
        "--station no daemon is needed.");
}

void add_show(CLI::App& app, GsdOptions& options)
{
    app.add_option("FILE", options.file, "A GSD file")->required()->type_name("");
    app.add_option("--profile", options.profile, "Show the tags with the names of this profile's tag table")
        ->type_name("NAME");
    add_profiles(app, options);
    add_table(app, options);
}

void add_make(CLI::App& app, GsdOptions& options)
{
    app.add_option("--profile", options.profile, "Profile of the device")->type_name("NAME");
    add_profiles(app, options);
    add_table(app, options);
    app.add_option(
           "--mapping", options.mapping,
           "A TOML file with profile, list, in, out, in_out, demand, ident, max_tsdr, description, model, "
           "[table]; the command line overrides it")
        ->type_name("FILE");
    add_tags(app, "--in", options.in, "Inputs: tags that the master reads, in the order of the telegram");
    add_tags(app, "--out", options.out, "Outputs: tags that the master writes");
    add_tags(app, "--in-out", options.in_out, "Both: tags that it reads and writes, after those");
    app.add_option("--list", options.list,
                   "Parameters of all directions in the order of the telegram, instead of --in, --out, "
                   "--in-out; none: no parameter, for Demand Data alone")
        ->type_name("in:TAG,out:TAG,in-out:TAG,...")
        ->delimiter(',');
    app.add_flag("--demand", options.demand, "Puts Demand Data before the parameters");
    app.add_option("--ident", options.ident,
                   "Ident_Number: 0x1649 or decimal; required if the profile has none")
        ->type_name("N");
    app.add_option("--max-tsdr", options.max_tsdr,
                   "MaxTsdr in bit times, as [bus] max_tsdr of the daemon: if this machine needs more than "
                   "the profile")
        ->type_name("N");
    app.add_option("--description", options.description,
                   "What the file is for, 56 characters at most (Info_Text)")
        ->type_name("TEXT");
    app.add_option("--model", options.model, "Name in the master's device list, 32 characters at most")
        ->type_name("TEXT");
    app.add_option("--output", options.output, "File to write; default: standard output")->type_name("FILE");
    app.add_flag("--force", options.force, "Replace an existing file");
}

void add_import(CLI::App& app, GsdOptions& options)
{
    app.add_option("FILE", options.file, "A GSD file")->required()->type_name("");
    app.add_option("--profile", options.profile,
                   "Profile of the device; default: found by Ident_Number and Model_Name together")
        ->type_name("NAME");
    add_profiles(app, options);
    app.add_option("--table", options.table,
                   "Your own tag table (CSV) with which the GSD file was made; the mapping keeps it")
        ->type_name("FILE");
    app.add_option("--output", options.output, "Mapping file to write; default: standard output")
        ->type_name("FILE");
    app.add_flag("--force", options.force, "Replace an existing file");
}

void add_diff(CLI::App& app, GsdOptions& options)
{
    app.add_option("FILE", options.file, "A GSD file")->required()->type_name("");
    app.add_option("OTHER", options.other, "Another GSD file")->required()->type_name("");
    app.add_option("--profile", options.profile, "Show the tags with the names of this profile's tag table")
        ->type_name("NAME");
    add_profiles(app, options);
    add_table(app, options);
}

void add_configure(CLI::App& app, GsdOptions& options)
{
    app.add_option("--page", options.page, "The configurator's page, if it is elsewhere")
        ->type_name("FILE")
        ->capture_default_str();
}

void add_types(CLI::App& app, GsdOptions& options)
{
    app.add_option("--output", options.output, "Folder to write the five files to")
        ->required()
        ->type_name("DIR");
    app.add_flag("--brief", options.brief,
                 "Type name in 17 characters, as in STEP 7 (V5); default: in 21, as the manual has "
                 "it (V4.0)");
    app.add_flag("--force", options.force, "Replace existing files");
}

} // namespace

void add_gsd(CLI::App& app, Action& chosen)
{
    const auto options = std::make_shared<GsdOptions>();
    CLI::App& gsd =
        *app.add_subcommand("gsd", "Checks, makes and shows GSD and type files for the master's tool");
    gsd.require_subcommand(1);
    gsd.footer(std::string{kExamples} + kExits);
    const struct {
        const char* name;
        const char* help;
        void (*arguments)(CLI::App&, GsdOptions&);
        int (*run)(const GsdOptions&, Terminal&);
    } kCommands[] = {
        {"check", "Checks whether a master's tool accepts this file; errors and warnings with their lines",
         add_check, gsd_check},
        {"show", "Shows where each value is in the telegrams (I/O map)", add_show, gsd_show},
        {"make", "Writes the GSD file of a device, as it is or with your own mapping", add_make, gsd_make},
        {"import", "Writes the mapping file that makes this GSD file; names what a mapping cannot hold",
         add_import, gsd_import},
        {"diff", "Compares two GSD files by their meaning and by their lines", add_diff, gsd_diff},
        {"configure", "Opens the configurator in a browser, or says how to open it on another PC",
         add_configure, gsd_configure},
        {"types", "Writes the type files for COM ET200 in five languages", add_types, gsd_types},
    };
    for (const auto& command : kCommands) {
        CLI::App& own = *gsd.add_subcommand(command.name, command.help);
        own.footer(kExits);
        command.arguments(own, *options);
        own.add_flag("--json", options->json, "Print JSON");
        own.callback([&chosen, options, run = command.run] {
            chosen = [options, run](const Options& common, Terminal& terminal) {
                options->json = options->json || common.json;
                options->daemon.timeout_s = common.timeout_s;
                if (options->daemon.socket == Options{}.socket) options->daemon.socket = common.socket;
                return run(*options, terminal);
            };
        });
    }
}

} // namespace dpslave::dpctl
