// SPDX-License-Identifier: Apache-2.0
#include "cli.hpp"

#include "dpctl/gsd/gsd.hpp"
#include "json_forms.hpp"
#include "subcommands.hpp"

#include "dpslave/profile/survey.hpp"
#include "dpslave/toml/wording.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace dpslave::dpctl {
namespace {

/// What a subcommand needs, and so which options and exit codes it has.
enum class Needs { daemon, daemon_to_judge, machine, files };

constexpr const char* exits_of(Needs needs)
{
    switch (needs) {
        case Needs::daemon:
            return "0 fine, 1 refused, faulty or not so, 2 usage or no such station, 3 no daemon.";
        case Needs::daemon_to_judge:
            return "0 all is well, 1 something was found, 2 usage or no such station, 3 no daemon.";
        case Needs::machine:
            return "0 fine, 1 the rate of the bus cannot be held or something must be mended,\n"
                   "2 usage, 3 no PORT and no daemon.";
        case Needs::files: break;
    }
    return "0 fine, 1 not found or faulty, 2 usage; no daemon is needed.";
}

struct Subcommand {
    const char* name;
    const char* help;
    const char* json; ///< what --json prints: the method whose reply it is, or the form of the object
    Needs needs;
    const char* examples; ///< a line each; may be empty
    void (*arguments)(CLI::App&, Options&);
    int (*run)(const Options&, Terminal&);
};

void no_arguments(CLI::App&, Options&);
void station_argument(CLI::App&, Options&);
void tag_argument(CLI::App&, Options&);
void tag_and_value_arguments(CLI::App&, Options&);
void tec_arguments(CLI::App&, Options&);
void exchanging_arguments(CLI::App&, Options&);
void doctor_arguments(CLI::App&, Options&);
void query_arguments(CLI::App&, Options&);
void port_argument(CLI::App&, Options&);
void number_arguments(CLI::App&, Options&);
void octet_arguments(CLI::App&, Options&);
void reload_arguments(CLI::App&, Options&);
void survey_arguments(CLI::App&, Options&);

constexpr std::array kSubcommands = std::to_array<Subcommand>({
    {"status", "The bus and each station in one line", "GetStatus", Needs::daemon, "", no_arguments,
     do_status},
    {"stations", "All about each station's state and its drive link", "ListStations", Needs::daemon, "",
     no_arguments, do_stations},
    {"info", "What is emulated: device, order code, ident, limits, address", "GetInfo", Needs::daemon, "",
     station_argument, do_info},
    {"io", "Inputs and outputs by tag: raw, scaled, state and age", "GetIo", Needs::daemon, "",
     station_argument, do_io},
    {"diag", "The diagnosis decoded, and the last refused telegram explained", "GetDiagnosis", Needs::daemon,
     "", station_argument, do_diag},
    {"doctor", "Names the likely cause of a fault and the next step", kDoctorJson, Needs::daemon_to_judge,
     "dpctl doctor            every station\n"
     "dpctl doctor unwinder   this one\n"
     "dpctl doctor --probe    looks for a drive that was never heard (root and the operator group)\n"
     "dpctl doctor --all      all rules, for lamps and symptoms that you see",
     doctor_arguments, do_doctor},
    {"tune", "What this machine can promise at each rate, and what would make it better", kTuneJson,
     Needs::machine,
     "dpctl tune               the port of the running daemon, with what was measured\n"
     "dpctl tune /dev/ttyS1    this port, before there is a daemon",
     port_argument, do_tune},
    {"counters", "How often what happened", "GetCounters", Needs::daemon, "", no_arguments, do_counters},
    {"read", "Reads a tag from the drive now", "ReadTag", Needs::daemon, "", tag_argument, do_read},
    {"write", "Writes a tag of the drive now (root and the operator group)", "WriteTag", Needs::daemon,
     "dpctl write 56 -12.5 --station unwinder", tag_and_value_arguments, do_write},
    {"survey",
     "Reads every tag of a drive and writes a tag table, whose rows you confirm (root and the operator "
     "group)",
     kSurveyJson, Needs::daemon_to_judge,
     "dpctl survey unwinder                          every tag once, into unwinder.csv\n"
     "dpctl survey unwinder --resume                 goes on after Ctrl-C\n"
     "dpctl survey unwinder --only 1-600 --for 10m   the extremes of ten minutes",
     survey_arguments, do_survey},
    {"tec", "The TEC OPTION function block of a technology box: shows it, sets its inputs",
     "GetTec or SetTec", Needs::daemon,
     "dpctl tec                            the function block of every technology box\n"
     "dpctl tec set TYPE \"PROFIBUS DP\"     sets an input until the next start (root and the operator "
     "group)\n"
     "dpctl tec set RIDE_THROUGH -1 --station unwinder",
     tec_arguments, do_tec},
    {"reload",
     "Reads the configuration file again and applies it, or says why not (root and the operator group)",
     "Reload", Needs::daemon,
     "dpctl reload --dry-run   what it would change, and which stations would leave the bus and why",
     reload_arguments, do_reload},
    {"leds", "What the lamps show, and what that means", "GetLeds", Needs::daemon, "", station_argument,
     do_leds},
    {"watch", "Shows changes until Ctrl-C", "Watch", Needs::daemon, "", station_argument, do_watch},
    {"version", "Versions of dpctl and of the daemon", "GetVersion", Needs::daemon, "", no_arguments,
     do_version},
    {"is-exchanging", "For scripts: 0 when all stations, or this one, are in Data_Exch, 1 when not",
     "ListStations", Needs::daemon,
     "dpctl is-exchanging --healthy   and their drives answer, and no master is in Clear",
     exchanging_arguments, do_is_exchanging},
    {"tag", "Looks a parameter of a drive up in the tag tables, by number or by words", kTagJson,
     Needs::files,
     "dpctl tag                            the tables that are shipped\n"
     "dpctl tag 270\n"
     "dpctl tag autotune\n"
     "dpctl tag program 1 segment 4 type   the address of a word of a program\n"
     "dpctl tag speed --profile 590plus",
     query_arguments, do_tag},
    {"hex", "Numbers of 16 bits in decimal and hexadecimal, with the octets for User_Prm_Data", kHexJson,
     Needs::files,
     "dpctl hex 288 0x120\n"
     "dpctl hex -300.00       with two decimals, as it goes over the bus: 8AD0\n"
     "dpctl hex 0-559         the table of the manuals",
     number_arguments, do_hex},
    {"decode", "A PROFIBUS telegram or a diagnosis in words", kDecodeJson, Needs::files,
     "dpctl decode 68 05 05 68 85 82 6D 3C 3E EE 16\n"
     "dpctl decode --as prm 88 01 0A 0B 05 33 00    octets as dpctl diag prints them\n"
     "dpctl decode 00 0C 00 01 16 49 04 01 6A B5 --profile 605",
     octet_arguments, do_decode},
});

constexpr const char* kFooter =
    "STATION is a name or an address. Values are in the drive's displayed units: dpctl write 56 -12.5\n"
    "--json prints the parameters of the daemon's reply as they come (an error with its name and "
    "parameters).\n"
    "Their description is the Varlink interface org.dpslaved.Control: see\n" DPSLAVE_DATA_FOLDER
    "/org.dpslaved.Control.varlink, or ask the daemon:\n"
    "varlinkctl introspect /run/dpslaved/control.sock org.dpslaved.Control\n"
    "What needs no daemon (tag, hex, decode) or judges its replies (doctor, survey, tune) says the form of "
    "its "
    "--json in "
    "its\n"
    "own --help.\n"
    "Exit codes:\n"
    "  0  fine\n"
    "  1  refused by the daemon or the drive, a faulty answer or input, not found, or not so (is-exchanging, "
    "doctor, survey, tune)\n"
    "  2  usage, or there is no such station\n"
    "  3  no daemon";

/// "--json prints ...", the examples, the exit codes.
std::string footer_of(const Subcommand& subcommand)
{
    std::string footer;
    if (*subcommand.examples != '\0') {
        footer = std::string{"Examples:\n"} + subcommand.examples;
        for (std::size_t at = 0; (at = footer.find('\n', at)) != std::string::npos; at += 3)
            footer.insert(at + 1, "  ");
        footer += '\n';
    }
    const std::string json = subcommand.json;
    footer += "--json prints " +
              (json.front() == '{' ? json : "the reply of " + json + " (org.dpslaved.Control.varlink)");
    return footer + ". Exit codes: " + exits_of(subcommand.needs);
}

void add_json(CLI::App& app, Options& options)
{
    app.add_flag("--json", options.json, "Print JSON");
}

void add_common(CLI::App& app, Options& options)
{
    add_json(app, options);
    app.add_option("--socket", options.socket, "The daemon's control socket")
        ->type_name("PATH")
        ->capture_default_str();
    app.add_option("--timeout", options.timeout_s, "How long to wait for an answer")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.01, 3600.0).description(""))
        ->capture_default_str();
}

void no_arguments(CLI::App&, Options&) {}

void station_argument(CLI::App& app, Options& options)
{
    app.add_option("STATION", options.station, "Name or address; without it: all")->type_name("");
}

void station_option(CLI::App& app, Options& options)
{
    app.add_option("--station", options.station, "Name or address; needed when there are several")
        ->type_name("STATION");
}

void tag_argument(CLI::App& app, Options& options)
{
    app.add_option("TAG", options.tag, "Tag of the drive, decimal, 0 to 65535")
        ->required()
        ->type_name("")
        ->check(CLI::Range(0, 65535).description(""));
    station_option(app, options);
}

void tag_and_value_arguments(CLI::App& app, Options& options)
{
    tag_argument(app, options);
    app.add_option("VALUE", options.value,
                   "As the drive shows it: -12.5, 0x00FF for a WORD, a name of an ENUM")
        ->required()
        ->type_name("");
}

void tec_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    CLI::App& set = *app.add_subcommand("set", "Sets an input until the next start");
    set.add_option("NAME", options.parameter, "Name of the input: TYPE, ADDRESS, RIDE_THROUGH ...")
        ->required()
        ->type_name("");
    set.add_option("VALUE", options.value, "A number (12, -1, 0x6AB5), of TYPE also a name")
        ->required()
        ->type_name("");
    station_option(set, options);
    set.add_flag("--yes", options.yes, "Also if it silences a station that is in exchange");
    add_common(set, options);
    set.callback([&options] { options.set = true; });
}

void doctor_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    auto* all = app.add_flag("--all", options.all, "Print every rule: lamps and symptoms, causes, steps");
    app.add_flag("--probe", options.probe,
                 "Let the daemon look for the drive on its line: other rates, formats and units")
        ->excludes(all);
    app.add_flag("--yes", options.yes, "With --probe: also while a station of this line is in exchange");
}

void exchanging_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    app.add_flag("--healthy", options.healthy,
                 "Count a station only if its drive answers and its master is not in Clear");
}

void port_argument(CLI::App& app, Options& options)
{
    app.add_option("PORT", options.port, "A tty; without it: that of the running daemon. It is not opened")
        ->type_name("");
}

void profile_options(CLI::App& app, Options& options, const char* what_profile_does)
{
    app.add_option("--profile", options.profile, what_profile_does)->type_name("NAME");
    app.add_option("--profiles", options.profiles,
                   "Folder of the device profiles; the tag tables lie in ../tags")
        ->type_name("DIR")
        ->capture_default_str();
}

void query_arguments(CLI::App& app, Options& options)
{
    app.add_option("WHAT", options.words,
                   "A tag number (270, 0x10E), or words of its name; a number belongs to the word before it")
        ->type_name("");
    app.add_flag("--all", options.all, "Also names that say more than WHAT");
    auto* table = app.add_option("--table", options.table, "Look into this CSV file only")->type_name("FILE");
    profile_options(app, options, "Look into the table of this profile only");
    table->excludes("--profile");
}

void number_arguments(CLI::App& app, Options& options)
{
    app.add_option("NUMBER", options.words,
                   "Decimal (288, -300.00), hexadecimal (0x120, >120, 120h) or a range (0-559)")
        ->required()
        ->type_name("");
}

void reload_arguments(CLI::App& app, Options& options)
{
    app.add_flag("--dry-run", options.dry_run, "Only tells what a reload would do; no port is opened for it");
}

void octet_arguments(CLI::App& app, Options& options)
{
    app.add_option("HEX", options.words, "Octets: 10 05 02 49 50 16, with or without blanks")
        ->required()
        ->type_name("");
    app.add_option("--as", options.form, "The octets are those of a Set_Prm, a Chk_Cfg or a Slave_Diag")
        ->type_name("prm|cfg|diag")
        ->check(CLI::IsMember({"prm", "cfg", "diag"}).description(""));
    profile_options(app, options, "Take tags, modules and the extended diagnosis for those of this device");
}

void survey_arguments(CLI::App& app, Options& options)
{
    app.add_option("STATION", options.station, "Name or address; needed when there are several")
        ->type_name("");
    app.add_option("--only", options.only, "Ask these tags only: 1-600,1000-1127")
        ->type_name("TAGS")
        ->check([](const std::string& text) {
            const auto spans = profile::parse_tag_spans(text);
            return spans ? std::string{} : spans.error();
        });
    app.add_option("--table", options.table,
                   "The tag table to write; one that is there is joined. Without it: STATION.csv")
        ->type_name("FILE");
    auto* duration = app.add_option("--for", options.duration, "Go on for so long: 90s, 10m, 2h")
                         ->type_name("TIME")
                         ->check([](const std::string& text) {
                             return profile::parse_duration(text)
                                        ? std::string{}
                                        : toml::in_quotes(text) + ": write a time up to 30 days, as "
                                                                  "90s, 10m or 2h";
                         });
    app.add_option("--passes", options.passes, "Ask each tag so often")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000).description(""))
        ->capture_default_str()
        ->excludes(duration);
    app.add_flag("--resume", options.resume, "Go on where the survey before this one ended");
}

/// Behind every subcommand, too; in the help of the program only.
void add_version(CLI::App& app)
{
    for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
        command->set_version_flag("--version", "dpctl " DPSLAVE_VERSION)->group("");
        add_version(*command);
    }
}

/// The command that `word` is near to, or the first one that begins with it; nothing: none.
std::string_view meant_by(const std::string& word, const std::vector<std::string>& names)
{
    constexpr std::size_t kShort = 4; // every short word is near to another one
    const std::string_view near =
        word.size() < kShort ? toml::nearest(word, names, 1) : toml::nearest(word, names);
    if (!near.empty()) return near;
    const auto begins = std::find_if(names.begin(), names.end(),
                                     [&word](const std::string& name) { return name.starts_with(word); });
    return begins == names.end() ? std::string_view{} : std::string_view{*begins};
}

/// Says which command was perhaps meant, where the word in its place is none.
void suggest(const CLI::App& app, const std::vector<std::string>& arguments, Terminal& terminal)
{
    const CLI::App* level = &app;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word == "--socket" || word == "--timeout") ++i; // their values
        if (word.empty() || word.front() == '-') continue;
        std::vector<std::string> names;
        const CLI::App* found = nullptr;
        for (const CLI::App* command : level->get_subcommands([](const CLI::App*) { return true; })) {
            names.push_back(command->get_name());
            if (names.back() == word) found = command;
        }
        if (found == nullptr) {
            const std::string_view meant = meant_by(word, names);
            if (!meant.empty())
                terminal.err << "dpctl: there is no command '" << word << "'; did you mean '" << meant
                             << "'?\n";
            return;
        }
        level = found;
    }
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
    app.set_version_flag("--version", "dpctl " DPSLAVE_VERSION);
    add_common(app, options);
    Action chosen;
    for (const Subcommand& subcommand : kSubcommands) {
        CLI::App& own = *app.add_subcommand(subcommand.name, subcommand.help);
        own.footer(footer_of(subcommand));
        subcommand.needs == Needs::files ? add_json(own, options) : add_common(own, options);
        subcommand.arguments(own, options);
        own.callback([&chosen, &subcommand, &options, &own] {
            chosen = subcommand.run;
            const CLI::App& level = options.set ? *own.get_subcommand("set") : own;
            options.station_is_option = level.get_option_no_throw("--station") != nullptr;
        });
    }
    add_gsd(app, chosen);
    add_version(app);
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // the order CLI11 wants
        std::transform(reversed.begin(), reversed.end(), reversed.begin(), with_leading_zero);
        app.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) suggest(app, arguments, terminal);
        return app.exit(error, terminal.out, terminal.err) == 0 ? kFine : kUsage;
    }
    if (options.json && app.got_subcommand("gsd")) {
        terminal.err << "dpctl gsd prints text only: leave --json out\n";
        return kUsage;
    }
    return chosen(options, terminal);
}

} // namespace dpslave::dpctl
