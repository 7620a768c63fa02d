// SPDX-License-Identifier: Apache-2.0
#include "cli.hpp"

#include "subcommands.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cctype>

namespace dpslave::dpctl {
namespace {

/// What stands behind the name of a subcommand.
enum class Takes { nothing, station, tag, tag_and_value };

struct Subcommand {
    const char* name;
    const char* help;
    const char* method; ///< of org.dpslaved.Control, whose reply --json prints
    Takes takes;
    int (*run)(const Options&, Terminal&);
};

constexpr std::array kSubcommands = std::to_array<Subcommand>({
    {"status", "The bus and each station in one line", "GetStatus", Takes::nothing, do_status},
    {"stations", "All about each station's state and its drive link", "ListStations", Takes::nothing,
     do_stations},
    {"info", "What is emulated: device, order code, ident, limits, address", "GetInfo", Takes::station,
     do_info},
    {"io", "Inputs and outputs by tag: raw, scaled, state and age", "GetIo", Takes::station, do_io},
    {"diag", "The diagnosis decoded, and the last refused telegram explained", "GetDiagnosis", Takes::station,
     do_diag},
    {"counters", "What happened how often", "GetCounters", Takes::nothing, do_counters},
    {"read", "Reads a tag from the drive now", "ReadTag", Takes::tag, do_read},
    {"write", "Writes a tag of the drive now (root and the operator group)", "WriteTag", Takes::tag_and_value,
     do_write},
    {"leds", "What the lamps show, and what that means", "GetLeds", Takes::station, do_leds},
    {"watch", "Shows changes until Ctrl-C", "Watch", Takes::station, do_watch},
    {"version", "Versions of dpctl and of the daemon", "GetVersion", Takes::nothing, do_version},
    {"is-exchanging", "For scripts: 0 when all stations, or this one, are in Data_Exch, 1 when not",
     "ListStations", Takes::station, do_is_exchanging},
});

constexpr const char* kFooter =
    "STATION is a name or an address. Values are in the drive's displayed units: dpctl write 56 -12.5\n"
    "--json prints the parameters of the daemon's reply as they come (an error with its name and "
    "parameters).\n"
    "Their description is the Varlink interface org.dpslaved.Control: see org.dpslaved.Control.varlink in\n"
    "/usr/share/dpslaved, or ask the daemon: varlinkctl introspect /run/dpslaved/control.sock "
    "org.dpslaved.Control\n"
    "Exit codes:\n"
    "  0  fine\n"
    "  1  refused by the daemon or the drive, a faulty answer, or not so (is-exchanging)\n"
    "  2  usage\n"
    "  3  no daemon";

void add_common(CLI::App& app, Options& options)
{
    app.add_flag("--json", options.json, "Print the parameters of the reply as JSON");
    app.add_option("--socket", options.socket, "The daemon's control socket")
        ->type_name("PATH")
        ->capture_default_str();
    app.add_option("--timeout", options.timeout_s, "How long to wait for an answer")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.01, 3600.0).description(""))
        ->capture_default_str();
}

void add_arguments(CLI::App& app, Takes takes, Options& options)
{
    constexpr const char* kStation = "Name or address; without it: all";
    if (takes == Takes::station) app.add_option("STATION", options.station, kStation)->type_name("");
    if (takes != Takes::tag && takes != Takes::tag_and_value) return;
    app.add_option("TAG", options.tag, "Tag of the drive, decimal, 0 to 65535")
        ->required()
        ->type_name("")
        ->check(CLI::Range(0, 65535).description(""));
    if (takes == Takes::tag_and_value)
        app.add_option("VALUE", options.value,
                       "As the drive shows it: -12.5, 0x00FF for a WORD, a name of an ENUM")
            ->required()
            ->type_name("");
    app.add_option("--station", options.station, "Name or address; needed when there are several")
        ->type_name("STATION");
}

/// CLI11 takes -12.5 as a number, but -.5 as an option.
std::string with_leading_zero(std::string argument)
{
    const bool bare = argument.size() > 2 && argument[0] == '-' && argument[1] == '.' &&
                      std::isdigit(static_cast<unsigned char>(argument[2])) != 0;
    return bare ? argument.insert(1, "0") : argument;
}

} // namespace

int run(const std::vector<std::string>& arguments, Terminal& terminal)
{
    Options options;
    CLI::App app{"Shows and operates a running dpslaved, the PROFIBUS-DP slave.", "dpctl"};
    app.footer(kFooter);
    app.require_subcommand(1);
    add_common(app, options);
    const Subcommand* chosen = nullptr;
    for (const Subcommand& subcommand : kSubcommands) {
        CLI::App& own = *app.add_subcommand(subcommand.name, subcommand.help);
        own.footer(std::string{"--json prints the reply of "} + subcommand.method +
                   " (org.dpslaved.Control.varlink). Exit codes: 0 fine, 1 refused, faulty or not so, 2 "
                   "usage, 3 no daemon.");
        add_common(own, options);
        add_arguments(own, subcommand.takes, options);
        own.callback([&chosen, &subcommand] { chosen = &subcommand; });
    }
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // the order CLI11 wants
        std::transform(reversed.begin(), reversed.end(), reversed.begin(), with_leading_zero);
        app.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
        return app.exit(error, terminal.out, terminal.err) == 0 ? kFine : kUsage;
    }
    return chosen->run(options, terminal);
}

} // namespace dpslave::dpctl
