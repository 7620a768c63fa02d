// SPDX-License-Identifier: Apache-2.0
#include "commands.hpp"

#include "arguments.hpp"
#include "json_forms.hpp"

#include <array>

namespace dpslave::dpctl {
namespace {

constexpr const char* kLook = "Look";
constexpr const char* kWatch = "Watch";
constexpr const char* kOperate = "Operate";

constexpr const char* kShows =
    "0 success, 1 refused or faulty, 2 wrong usage or no such station, 3 no daemon.";
constexpr const char* kWaits =
    "0 success, with --wait: in exchange; 1 refused or faulty, with --wait: not in exchange;\n"
    "2 wrong usage or no such station; 3 no daemon.";
constexpr const char* kJudges =
    "0 all is well, 1 something was found, 2 wrong usage or no such station, 3 no daemon.";
constexpr const char* kSurveys =
    "0 complete, 1 refused, faulty or not complete, 2 wrong usage or no such station, 3 no daemon.";
constexpr const char* kReads = "0 success, with --every: Ctrl-C; 1 refused or faulty; 2 wrong usage, no such "
                               "station or no such tag; 3 no daemon.";
constexpr const char* kPlots =
    "0 success; 1 refused or faulty, or there are no values of a tag; 2 wrong usage, "
    "no such station or no such tag; 3 no daemon.";
constexpr const char* kSetsLevel = "0 success, 1 refused or faulty, 2 wrong usage, 3 no daemon.";
constexpr const char* kWritesFigures =
    "0 success, 1 a faulty answer or the file cannot be written, 2 wrong usage, 3 no daemon.";
constexpr const char* kTops = "0 success, also q and Ctrl-C; 1 refused or faulty; 2 wrong usage or no such "
                              "station; 3 no daemon.";
constexpr const char* kReloads = "0 applied, or can be; 1 refused or faulty; 2 wrong usage; 3 no daemon.";
constexpr const char* kTunes =
    "0 success, 1 the rate of the bus cannot be held or something must be corrected,\n"
    "2 wrong usage, 3 no PORT and no daemon.";
constexpr const char* kNeedsNone = "0 success, 1 not found or faulty, 2 wrong usage; no daemon is needed.";
constexpr const char* kVersions = "0 success, also without a daemon; 1 a faulty answer; 2 wrong usage; 3 "
                                  "this user may not open the socket.";

constexpr std::array kCommands = std::to_array<Command>({
    {"status", kLook, "Shows the bus, and each station in one line",
     "GetStatus, with --follow those of Watch, one a line", kWaits,
     "dpctl status --follow                    each change, until Ctrl-C\n"
     "dpctl status unwinder --wait 30 --quiet  for scripts: 0 as soon as it is in exchange, 1 if not\n"
     "dpctl status --wait 0 --quiet --drive    are all in exchange now, and do their drives answer?",
     status_arguments, do_status},
    {"show", kLook, "Shows one station: state, drive, emulated device, lamps, TEC OPTION", kShowJson, kShows,
     "", station_argument, do_show},
    {"io", kLook, "Shows inputs and outputs by tag: raw, scaled, state and age",
     "GetIo, with --follow those of Watch, one a line", kShows, "", io_arguments, do_io},
    {"diag", kLook, "Decodes the diagnosis and explains the last refused telegram", "GetDiagnosis", kShows,
     "", station_argument, do_diag},
    {"counters", kLook, "Counts telegrams, line faults and calls, and shows how long the replies took",
     "GetCounters", kShows, "", no_arguments, do_counters},
    {"doctor", kLook, "Names the likely cause of a fault and the next step", kDoctorJson, kJudges,
     "dpctl doctor            every station\n"
     "dpctl doctor unwinder   this one\n"
     "dpctl doctor --probe    searches for a drive that never answered (root and the operator group)\n"
     "dpctl doctor --all      all rules, for lamps and symptoms that you see",
     doctor_arguments, do_doctor},
    {"trace", kWatch, "Shows the telegrams of the bus (root and the operator group)", kTraceJson, kShows,
     "dpctl trace --bad                      what was no telegram, and requests without a reply\n"
     "dpctl trace --follow --station 5       from now on, only from and to address 5\n"
     "dpctl trace --decode --service prm     what each Set_Prm says, octet by octet\n"
     "dpctl trace --follow --stop-on unanswered,to=5    until address 5 does not answer a request\n"
     "dpctl trace --drive p3                 what the drives of line p3 were asked and answered\n"
     "dpctl trace --write bus.pcapng         into a capture for Wireshark\n"
     "dpctl trace --incidents                what went wrong, and what is kept of it\n"
     "dpctl trace --incident 7               the seconds before and after it",
     trace_arguments, do_trace},
    {"bus", kWatch, "Shows who is on the bus: masters, slaves, cycles, retries, load", "GetBus", kShows,
     "dpctl bus            also addresses that a master asks and nobody answers", no_arguments, do_bus},
    {"top", kWatch, "Shows stations, values, rates and events on one screen that refreshes", kTopJson, kTops,
     "dpctl top                 q ends it, arrows select a station, / filters\n"
     "dpctl top unwinder        only this station\n"
     "dpctl top --every 10s | tee top.txt",
     top_arguments, do_top},
    {"events", kWatch, "Shows what happened, with the time, the newest last",
     "GetEvents, with --follow one reply a line", kShows, "dpctl events --follow unwinder", io_arguments,
     do_events},
    {"plot", kWatch, "Draws the values of a station over time, in the terminal or as SVG",
     "GetSamples, one a line", kPlots,
     "dpctl plot 55                                   the last ten minutes\n"
     "dpctl plot \"speed feedback\" 56 --last 2m       names as for dpctl read\n"
     "dpctl plot 55 --svg speed.svg --station unwinder\n"
     "dpctl plot 55 56 --csv > speed.csv",
     plot_arguments, do_plot},
    {"metrics", kWatch, "Prints the figures for Prometheus, in its text format", kMetricsJson, kWritesFigures,
     "dpctl metrics | promtool check metrics\n"
     "dpctl metrics --write /var/lib/prometheus/node-exporter/dpslaved.prom",
     metrics_arguments, do_metrics},
    {"read", kOperate, "Reads tags from the drive now, by number or by name",
     "ReadTag, with several tags or --every one a line; with --list that of FindTags", kReads,
     "dpctl read 55 --station unwinder\n"
     "dpctl read \"speed feedback\"         a name, or the part of one that fits no other tag\n"
     "dpctl read --every 1s 55 56          until Ctrl-C\n"
     "dpctl read --list speed              tags with this in their names",
     read_arguments, do_read},
    {"write", kOperate, "Writes a tag of the drive now (root and the operator group)", "WriteTag", kShows,
     "dpctl write 56 -12.5 --station unwinder", tag_and_value_arguments, do_write},
    {"tec", kOperate,
     "Sets an input of the function block TEC OPTION of a technology box: tec set (root and the operator "
     "group)",
     "SetTec", kShows,
     "dpctl tec set TYPE \"PROFIBUS DP\"\n"
     "dpctl tec set RIDE_THROUGH -1 --station unwinder\n"
     "dpctl show                                  shows the function block",
     tec_arguments, do_tec_set},
    {"survey", kOperate,
     "Reads every tag of a drive and writes a tag table, whose rows you confirm (root and the operator "
     "group)",
     kSurveyJson, kSurveys,
     "dpctl survey unwinder                          every tag once, into unwinder.csv\n"
     "dpctl survey unwinder --resume                 continues after Ctrl-C\n"
     "dpctl survey unwinder --tags 1-600 --for 10m   the extremes of ten minutes",
     survey_arguments, do_survey},
    {"log-level", kOperate,
     "Shows the level of the log, or sets it to debug for a while (root and the operator group)",
     "SetLogLevel", kSetsLevel,
     "dpctl log-level debug 10m   each call and each request to a drive is a line of the log\n"
     "dpctl log-level info        ends it now",
     log_level_arguments, do_log_level},
    {"reload", kOperate,
     "Reads the configuration file again and applies it, or says why not (root and the operator group)",
     "Reload", kReloads,
     "dpctl reload --dry-run   what it would change, and which stations would leave the bus and why",
     reload_arguments, do_reload},
    {"tune", kOperate, "Says which rates this machine can hold, and what would improve it", kTuneJson, kTunes,
     "dpctl tune               the port of the running daemon, with what was measured\n"
     "dpctl tune /dev/ttyS1    this port, if no daemon runs yet",
     port_argument, do_tune},
    {"tag", kOffline, "Looks up a parameter of a drive in the tag tables, by number or by words", kTagJson,
     kNeedsNone,
     "dpctl tag                            the tables that are shipped\n"
     "dpctl tag 270\n"
     "dpctl tag autotune\n"
     "dpctl tag program 1 segment 4 type   the address of a word of a program\n"
     "dpctl tag speed --profile 590plus",
     query_arguments, do_tag},
    {"hex", kOffline, "Shows 16-bit numbers in decimal and hexadecimal, with the octets for User_Prm_Data",
     kHexJson, kNeedsNone,
     "dpctl hex 288 0x120\n"
     "dpctl hex -300.00       with two decimals, as it goes over the bus: 8AD0\n"
     "dpctl hex 0-559         the table of the manuals",
     number_arguments, do_hex},
    {"decode", kOffline, "Explains a PROFIBUS telegram or a diagnosis in words", kDecodeJson, kNeedsNone,
     "dpctl decode 68 05 05 68 85 82 6D 3C 3E EE 16\n"
     "dpctl decode --as prm 88 01 0A 0B 05 33 00    octets as dpctl diag prints them\n"
     "dpctl decode 00 0C 00 01 16 49 04 01 6A B5 --profile 605",
     octet_arguments, do_decode},
    {"version", "Version", "Shows the versions of dpctl and of the daemon", "GetVersion", kVersions, "",
     no_arguments, do_version},
});

} // namespace

std::span<const Command> commands()
{
    return kCommands;
}

const char* const kFooter =
    "STATION is a name or an address. Values are in the drive's displayed units: dpctl write 56 -12.5\n"
    "--json prints the unchanged parameters of the daemon's reply (an error with its name and "
    "parameters).\n"
    "The Varlink interface org.dpslaved.Control describes them: see\n" DPSLAVE_DATA_FOLDER
    "/org.dpslaved.Control.varlink, or ask the daemon:\n"
    "varlinkctl introspect /run/dpslaved/control.sock org.dpslaved.Control\n"
    "show, doctor, survey, tune, top, metrics, tag, hex and decode have their own form: see their --help.\n"
    "Exit codes; the --help of each command has the details:\n"
    "  0  success\n"
    "  1  refused by the daemon or the drive, a faulty answer or input, not found, or the answer is no "
    "(status --wait, "
    "doctor, survey, tune)\n"
    "  2  wrong usage, or no such station\n"
    "  3  no daemon";

std::string footer_of(const Command& command)
{
    std::string footer;
    if (*command.examples != '\0') {
        footer = std::string{"Examples:\n"} + command.examples;
        for (std::size_t at = 0; (at = footer.find('\n', at)) != std::string::npos; at += 3)
            footer.insert(at + 1, "  ");
        footer += '\n';
    }
    const std::string json = command.json;
    footer += "--json prints " +
              (json.front() == '{' ? json : "the reply of " + json + " (org.dpslaved.Control.varlink)");
    return footer + ".\nExit codes: " + command.exits;
}

} // namespace dpslave::dpctl
