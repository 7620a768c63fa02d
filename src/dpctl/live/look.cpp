// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/doctor/doctor.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

int plain(const Options& options, Terminal& terminal, std::string_view method, const Json& parameters,
          std::string (*render)(const Json&, Look))
{
    return show(options, terminal, method, parameters,
                [&](const Json& reply) { return render(reply, terminal.look()); });
}

} // namespace

int do_status(const Options& options, Terminal& terminal)
{
    return plain(options, terminal, "GetStatus", Json::object(), render_status);
}
int do_stations(const Options& options, Terminal& terminal)
{
    return plain(options, terminal, "ListStations", Json::object(), render_stations);
}
int do_io(const Options& options, Terminal& terminal)
{
    return plain(options, terminal, "GetIo", station_parameter(options), render_io);
}
int do_diag(const Options& options, Terminal& terminal)
{
    return plain(options, terminal, "GetDiagnosis", station_parameter(options), render_diagnosis);
}
int do_counters(const Options& options, Terminal& terminal)
{
    return plain(options, terminal, "GetCounters", Json::object(), render_counters);
}
int do_leds(const Options& options, Terminal& terminal)
{
    return plain(options, terminal, "GetLeds", station_parameter(options), render_leds);
}

/// The boards had OPTION VERSION in the drive's menu; 0.00 there said that no board is fitted (HA389815 ch.
/// 5).
int do_info(const Options& options, Terminal& terminal)
{
    if (options.json) return show(options, terminal, "GetInfo", station_parameter(options), json_text);
    const auto version = ask(options, terminal, "GetVersion", Json::object());
    if (!version) {
        if (version.error() == kNoDaemon)
            terminal.err << "OPTION VERSION 0.00: without dpslaved there is no option board.\n";
        return version.error();
    }
    return show(options, terminal, "GetInfo", station_parameter(options), [&](const Json& reply) {
        return render_info(reply, text(*version, "version"), terminal.look());
    });
}

int do_version(const Options& options, Terminal& terminal)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    const bool no_daemon = !client && client.error().kind == control::ClientError::Kind::no_daemon;
    if (no_daemon && options.json) {
        terminal.out << json_text(Json::object({{"program", "dpctl"},
                                                {"version", DPSLAVE_VERSION},
                                                {"interface", "org.dpslaved.Control"}}))
                     << '\n';
        return kFine;
    }
    if (!options.json) terminal.out << "dpctl " << DPSLAVE_VERSION << std::endl;
    if (no_daemon) {
        terminal.out << "no daemon: " << client.error().text << '\n';
        return kFine;
    }
    return show(options, terminal, "GetVersion", Json::object(), [](const Json& reply) {
        return fmt::format("{} {} ({})\n", text(reply, "program"), text(reply, "version"),
                           text(reply, "interface"));
    });
}

int do_is_exchanging(const Options& options, Terminal& terminal)
{
    const auto reply = ask(options, terminal, "ListStations", Json::object());
    if (!reply) return reply.error();
    int meant = 0, exchanging = 0;
    std::string lines;
    for (const Json& station : list(*reply, "stations")) {
        if (!is_meant(station, options.station)) continue;
        ++meant;
        const bool is_healthy = text(part(station, "drive"), "link") == "answers" && !flag(station, "clear");
        const bool is_exchanging = text(station, "state") == "Data_Exch" && !flag(station, "held");
        if (is_exchanging && (is_healthy || !options.healthy)) ++exchanging;
        lines += fmt::format("{} (address {}): {}{}{}, drive {}\n", text(station, "name"),
                             number(station, "address"), text(station, "state"),
                             flag(station, "held") ? ", held for a tag without scale" : "",
                             flag(station, "clear") ? " in Clear" : "", text(part(station, "drive"), "link"));
    }
    if (options.json) lines = json_text(*reply) + '\n';
    terminal.out << lines << std::flush;
    if (meant == 0) {
        terminal.err << (options.station.empty()
                             ? std::string{"dpctl: there is no station\n"}
                             : fmt::format("dpctl: there is no station '{}'\n", options.station));
        return options.station.empty() ? kNo : kUsage;
    }
    return meant == exchanging ? kFine : kNo;
}

} // namespace dpslave::dpctl
