// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/doctor/doctor.hpp"
#include "dpctl/live/follow.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

namespace dpslave::dpctl {
namespace {

struct StatusOptions {
    std::string station;
    bool follow = false;
    std::optional<std::chrono::nanoseconds> wait; ///< wait at most so long for the exchange
    bool with_drive = false;                      ///< with wait: the drive must answer, too
    bool quiet = false;                           ///< with wait: the exit status says it
};

void set_up(CLI::App& app, StatusOptions& options)
{
    add_station(app, options.station);
    add_follow(app, options.follow);
    auto* wait = add_time(app, "--wait", options.wait,
                          "Wait at most this long until all stations, or this one, are in exchange",
                          {std::chrono::seconds{0}, std::chrono::hours{24}})
                     ->excludes("--follow");
    app.add_flag("--with-drive", options.with_drive,
                 "With --wait: the drive must also answer, and the master must not be in Clear")
        ->needs(wait);
    app.add_flag("-q,--quiet", options.quiet, "With --wait: print nothing, only set the exit status")
        ->needs(wait);
}

bool exchanges(const report::Station& station, bool with_drive)
{
    if (station.state != "Data_Exch" || station.held) return false;
    return !with_drive || (station.drive.link == "answers" && !station.clear);
}

bool all_exchange(const Json& status, bool with_drive)
{
    const auto stations = report::read<report::GetStatusReply>(status).stations;
    return !stations.empty() &&
           std::all_of(stations.begin(), stations.end(),
                       [&](const report::Station& station) { return exchanges(station, with_drive); });
}

/// Of the named station only, if there is a name. An unknown one is reported, and its exit code returned.
Result<Json, int> ask_status(const StatusOptions& options, Session& session)
{
    auto reply = session.ask("GetStatus");
    if (!reply) return reply;
    const bool names_one = !options.station.empty();
    if ((names_one || options.wait) && report::read<report::GetStatusReply>(*reply).bus.listens)
        return Failure{session.print_only_listens()};
    if (!names_one) return reply;
    Json known = Json::array(), meant = Json::array();
    for (const Json& one : list(*reply, "stations")) {
        const auto station = report::read<report::Station>(one);
        known.push_back(station.name);
        if (is_meant(station, options.station)) meant.push_back(one);
    }
    if (meant.empty())
        return Failure{session.print_error({Json::object({{"station", options.station}, {"known", known}}),
                                            "org.dpslaved.Control.NoSuchStation", false})};
    (*reply)["stations"] = std::move(meant);
    return reply;
}

void print_status(const Json& reply, Session& session)
{
    session.print(reply, [&] { return render_status(reply, session.terminal().look()); });
}

/// Asks ten times a second: a station may come, leave or be renamed meanwhile.
int wait_for_exchange(const StatusOptions& options, Session& session)
{
    session.catch_signals();
    const auto until = Pace::Clock::now() + options.wait.value_or(std::chrono::nanoseconds{0});
    for (Pace pace{std::chrono::milliseconds{100}};;) {
        const auto reply = ask_status(options, session);
        if (!reply) return reply.error();
        const bool reached = all_exchange(*reply, options.with_drive);
        if (reached || Pace::Clock::now() >= until || session.pause_until(std::min(until, pace.next()))) {
            if (!options.quiet) print_status(*reply, session);
            return reached ? kFine : kNo;
        }
    }
}

int run(const StatusOptions& options, Session& session)
{
    if (options.follow)
        return follow_pictures({render_followed_status, status_changes}, options.station, session);
    if (options.wait) return wait_for_exchange(options, session);
    const auto reply = ask_status(options, session);
    if (!reply) return reply.error();
    print_status(*reply, session);
    return kFine;
}

} // namespace

const Command kStatus{
    "status",
    kLook,
    "Shows the bus, and each station in one line",
    add<StatusOptions>,
    "GetStatus, with --follow those of Watch, one a line",
    "dpctl status --follow                    each change, until Ctrl-C\n"
    "dpctl status unwinder --wait 30s --quiet   for scripts: 0 as soon as it is in exchange, 1 if not\n"
    "dpctl status --wait 0 --quiet --with-drive   are all in exchange now, and do their drives answer?",
    "with --wait 0 in exchange, 1 not in exchange"};

} // namespace dpslave::dpctl
