// SPDX-License-Identifier: Apache-2.0
#include "arguments.hpp"

#include "dpctl/live/tag_names.hpp"

#include "dpslave/profile/survey.hpp"
#include "dpslave/toml/wording.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>

namespace dpslave::dpctl {
namespace {

void follow_flag(CLI::App& app, Options& options)
{
    app.add_flag("--follow", options.follow, "Continue until Ctrl-C and show each change");
}

void station_option(CLI::App& app, Options& options)
{
    app.add_option("--station", options.station, "Name or address; required if there are several")
        ->type_name("STATION");
}

void profiles_option(CLI::App& app, Options& options)
{
    app.add_option("--profiles", options.profiles,
                   "Folder of the device profiles; the tag tables are in ../tags")
        ->type_name("DIR")
        ->capture_default_str();
}

void profile_options(CLI::App& app, Options& options, const char* what_profile_does)
{
    app.add_option("--profile", options.profile, what_profile_does)->type_name("NAME");
    profiles_option(app, options);
}

/// Empty: `text` is a time as parse_duration() reads it.
std::string duration_fault(const std::string& text)
{
    return profile::parse_duration(text)
               ? std::string{}
               : toml::in_quotes(text) + ": write a time up to 30 days, such as 90s, 10m or 2h";
}

/// Empty: `text` is a time as parse_interval() reads it.
std::string interval_fault(const std::string& text)
{
    return parse_interval(text)
               ? std::string{}
               : toml::in_quotes(text) + ": write a time from 100ms, such as 500ms, 1s or 10m";
}

/// Empty: `text` is the number of a tag, or may be a name.
std::string tag_fault(const std::string& text)
{
    const bool is_number = text.find_first_not_of("0123456789") == std::string::npos;
    const bool is_name = !is_number && !text.starts_with('-');
    if (is_name || (is_number && !text.empty() && text.size() <= 5 && std::stoi(text) <= 65535)) return {};
    return toml::in_quotes(text) + ": write a tag from 0 to 65535, or a name";
}

} // namespace

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

void status_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    follow_flag(app, options);
    auto* wait = app.add_option("--wait", options.wait_s,
                                "Wait at most this long until all stations, or this one, are in exchange")
                     ->type_name("SECONDS")
                     ->check(CLI::Range(0.0, 86400.0).description(""))
                     ->excludes("--follow");
    app.add_flag("--drive", options.with_drive,
                 "With --wait: the drive must also answer, and the master must not be in Clear")
        ->needs(wait);
    app.add_flag("--quiet", options.quiet, "With --wait: print nothing, only set the exit code")->needs(wait);
}

void io_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    follow_flag(app, options);
}

void read_arguments(CLI::App& app, Options& options)
{
    app.add_option("TAG", options.words, "Tags of the drive: numbers (0 to 65535), or names or parts of them")
        ->type_name("")
        ->check(tag_fault);
    auto* every =
        app.add_option("--every", options.every, "Read again and again, until Ctrl-C: 500ms, 1s, 10m")
            ->type_name("TIME")
            ->check(interval_fault);
    app.add_flag("--list", options.list, "Print the tags and their names; with TAG only those that fit")
        ->excludes(every);
    station_option(app, options);
}

void log_level_arguments(CLI::App& app, Options& options)
{
    auto* level = app.add_option("LEVEL", options.level, "debug or info; without it: which one it is")
                      ->type_name("")
                      ->check(CLI::IsMember({"debug", "info"}).description(""));
    app.add_option("TIME", options.duration, "With debug: until it is info again: 90s, 10m, 2h. Default: 10m")
        ->type_name("")
        ->needs(level)
        ->check(duration_fault);
}

void tag_and_value_arguments(CLI::App& app, Options& options)
{
    app.add_option("TAG", options.tag, "Tag of the drive, decimal, 0 to 65535")
        ->required()
        ->type_name("")
        ->check(CLI::Range(0, 65535).description(""));
    station_option(app, options);
    app.add_option("VALUE", options.value,
                   "As the drive shows it: -12.5, 0x00FF for a WORD, a name of an ENUM")
        ->required()
        ->type_name("");
}

void tec_arguments(CLI::App& app, Options& options)
{
    app.require_subcommand(1);
    CLI::App& set = *app.add_subcommand("set", "Sets an input until the next start");
    set.add_option("NAME", options.parameter, "Name of the input: TYPE, ADDRESS, RIDE_THROUGH ...")
        ->required()
        ->type_name("");
    set.add_option("VALUE", options.value, "A number (12, -1, 0x6AB5); for TYPE also a name")
        ->required()
        ->type_name("");
    station_option(set, options);
    set.add_flag("--yes", options.yes, "Set it even if this silences a station that is in exchange");
    add_common(set, options);
}

void doctor_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    auto* all = app.add_flag("--all", options.all, "Print every rule: lamps and symptoms, causes, steps");
    app.add_flag("--probe", options.probe,
                 "Let the daemon search for the drive on its line: other rates, formats and units")
        ->excludes(all);
    app.add_flag("--yes", options.yes,
                 "With --probe: search even while a station of this line is in exchange");
}

void port_argument(CLI::App& app, Options& options)
{
    app.add_option("PORT", options.port, "A tty, which is not opened; default: that of the running daemon")
        ->type_name("");
}

void query_arguments(CLI::App& app, Options& options)
{
    app.add_option("WHAT", options.words,
                   "A tag number (270, 0x10E), or words of its name; a number belongs to the word before it")
        ->type_name("");
    app.add_flag("--all", options.all, "Also find names that contain more than WHAT");
    auto* table = app.add_option("--table", options.table, "Search only this CSV file")->type_name("FILE");
    profile_options(app, options, "Search only the table of this profile");
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
    app.add_flag("--dry-run", options.dry_run,
                 "Only say what a reload would do; change nothing and open no port");
}

void octet_arguments(CLI::App& app, Options& options)
{
    app.add_option("HEX", options.words, "Octets: 10 05 02 49 50 16, with or without blanks")
        ->required()
        ->type_name("");
    app.add_option("--as", options.form, "The octets are those of a Set_Prm, a Chk_Cfg or a Slave_Diag")
        ->type_name("prm|cfg|diag")
        ->check(CLI::IsMember({"prm", "cfg", "diag"}).description(""));
    profile_options(app, options, "Explain tags, modules and the extended diagnosis as those of this device");
}

void top_arguments(CLI::App& app, Options& options)
{
    station_argument(app, options);
    app.add_option("--every", options.every,
                   "Time from one refresh to the next: 500ms, 1s, 10s; into a pipe: print again and again. "
                   "Default: 1s")
        ->type_name("TIME")
        ->check(interval_fault);
}

void plot_arguments(CLI::App& app, Options& options)
{
    app.add_option("TAG", options.words, "Tags of the drive: numbers (0 to 65535), or names or parts of them")
        ->type_name("")
        ->check(tag_fault);
    app.add_option("--last", options.duration, "How far back: 90s, 10m, 2h. Default: 10m")
        ->type_name("TIME")
        ->check(duration_fault);
    auto* const svg =
        app.add_option("--svg", options.output, "Write a picture (SVG) instead; - is standard output")
            ->type_name("FILE");
    app.add_flag("--csv", options.csv, "Print a table, one row for each sample")->excludes(svg);
    station_option(app, options);
}

void metrics_arguments(CLI::App& app, Options& options)
{
    app.add_option("--write", options.output,
                   "Write FILE instead, whole at every moment; without a daemon it says so (dpslaved_up 0)")
        ->type_name("FILE");
}

void survey_arguments(CLI::App& app, Options& options)
{
    app.add_option("STATION", options.station, "Name or address; required if there are several")
        ->type_name("");
    app.add_option("--tags", options.tags, "Ask only for these tags: 1-600,1000-1127")
        ->type_name("LIST")
        ->check([](const std::string& text) {
            const auto spans = profile::parse_tag_spans(text);
            return spans ? std::string{} : spans.error();
        });
    app.add_option("--table", options.table,
                   "The tag table to write; an existing one is continued. Default: STATION.csv")
        ->type_name("FILE");
    auto* duration =
        app.add_option("--for", options.duration, "Repeat the passes for this time: 90s, 10m, 2h")
            ->type_name("TIME")
            ->check(duration_fault);
    app.add_option("--passes", options.passes, "Number of times to ask for each tag")
        ->type_name("N")
        ->check(CLI::Range(1, 1'000'000).description(""))
        ->capture_default_str()
        ->excludes(duration);
    app.add_flag("--resume", options.resume, "Continue where the last survey ended");
}

void trace_arguments(CLI::App& app, Options& options)
{
    auto* const follow =
        app.add_flag("--follow", options.follow, "Show what comes from now on, until Ctrl-C");
    auto* const list =
        app.add_flag("--incidents", options.incidents, "List what the daemon has kept of incidents")
            ->excludes(follow);
    app.add_option("--incident", options.incident, "The telegrams around this incident")
        ->type_name("NUMBER")
        ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max()).description(""))
        ->excludes(follow)
        ->excludes(list);
    auto* const station =
        app.add_option("--station", options.station, "Only telegrams from or to this name or address")
            ->type_name("STATION");
    app.add_option("--service", options.service, "Only services whose name has this part, as in \"diag\"")
        ->type_name("NAME");
    app.add_flag("--bad", options.bad,
                 "Only what is no telegram or was not taken, and requests without a reply");
    auto* const stop_on =
        app.add_option("--stop-on", options.stop_on,
                       "End behind the first telegram for which this holds: bad, unanswered, service=NAME, "
                       "station=STATION, from=ADDRESS, to=ADDRESS; several with commas")
            ->type_name("CONDITION");
    auto* const file =
        app.add_option("--write", options.file, "Write a capture (pcapng) in place of the text")
            ->type_name("FILE");
    app.add_option("--linktype", options.link_type,
                   "Of the capture: profibus (257, default), or user0 (147) for programs that do not know it")
        ->type_name("TYPE")
        ->check(CLI::IsMember({"profibus", "user0"}).description(""))
        ->needs(file);
    auto* const decode =
        app.add_flag("--decode", options.decode,
                     "Below each telegram what it says: parameters, tags by name, values, diagnosis")
            ->excludes(file);
    app.add_option("--drive", options.drive,
                   "The frames of this drive line in place of the bus, with the judgement of each answer")
        ->type_name("LINE")
        ->excludes(station)
        ->excludes(list)
        ->excludes(stop_on)
        ->excludes(decode);
    app.add_option("--gsd", options.gsd_folder,
                   "Folder of GSD files: texts of the diagnosis of other devices")
        ->type_name("DIR")
        ->needs(decode);
    profiles_option(app, options);
}

} // namespace dpslave::dpctl
