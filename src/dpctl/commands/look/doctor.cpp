// SPDX-License-Identifier: Apache-2.0
#include "dpctl/doctor/doctor.hpp"

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/identify/identify_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::dpctl {
namespace {

struct DoctorOptions {
    std::string station;
    bool rules = false; ///< print every rule
    bool probe = false; ///< searches for the drive
    bool yes = false;   ///< with probe: even while a station of the line is in exchange
};

void set_up(CLI::App& app, DoctorOptions& options)
{
    add_station(app, options.station);
    auto* rules =
        app.add_flag("--rules", options.rules, "Print every rule: lamps and symptoms, causes, steps");
    app.add_flag("--probe", options.probe,
                 "Let the daemon search for the drive on its line: other rates, formats and units")
        ->excludes(rules);
    app.add_flag("--yes", options.yes,
                 "With --probe: search even while a station of this line is in exchange");
}

bool is_known(const std::vector<report::Station>& stations, const std::string& wanted)
{
    return std::any_of(stations.begin(), stations.end(),
                       [&](const report::Station& one) { return is_meant(one, wanted); });
}

std::string probe_text(const report::ProbeDriveReply& reply, Look look)
{
    std::string out = fmt::format("{}: asked {} on line {} ({})\n", reply.station,
                                  plural(reply.tried, "time"), reply.line, reply.port);
    for (const report::Answering& one : reply.answering)
        out += "a drive answers: " + render_answering(one, look);
    if (reply.answering.empty())
        return out +
               "no drive answers at any rate, format or unit: check the cable, the power, and that the drive's port is set to this protocol\n";
    return out +
           "Write these settings under [[line]] and [[station]], or set the drive to those that are there. Then: dpctl reload\n";
}

/// How long it takes at most, and then how far it is: on a terminal only, over the same line.
void print_progress(const report::ProbeDriveReply& reply, bool is_first, Terminal& terminal)
{
    if (is_first)
        terminal.err << fmt::format("searching for the drive of {} on {}: {} s at most; Ctrl-C ends it\n",
                                    reply.station, reply.port, reply.longest_s);
    else if (terminal.tty)
        terminal.err << fmt::format("\r{} of {} asked", reply.tried, reply.to_try);
    terminal.err << std::flush;
}

int search_for_drive(const DoctorOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    Json parameters = station_parameter(options.station);
    if (options.yes) parameters["yes"] = true;
    Json last;
    report::ProbeDriveReply now;
    const int code = session.follow("ProbeDrive", parameters, [&](const Json& reply) {
        const bool is_first = last.is_null();
        last = session.json() ? reply : printable_texts(reply);
        now = report::read<report::ProbeDriveReply>(last);
        if (!now.done) print_progress(now, is_first, terminal);
        return now.done;
    });
    if (code != kFine) return code;
    if (!now.done) {
        terminal.err << "\nended; the line continues its normal work\n";
        return kNo;
    }
    if (terminal.tty) terminal.err << "\r\033[K" << std::flush;
    session.print(last, [&] { return probe_text(now, terminal.look()); });
    return now.answering.empty() ? kNo : kFine;
}

/// Of each port once; the daemon may have them.
std::vector<io::PortUsers> port_users(const report::GetStatusReply& status)
{
    std::vector<io::PortUsers> all{io::users_of_port(status.bus.port, static_cast<int>(status.pid))};
    for (const report::Station& one : status.stations)
        if (std::ranges::find(all, one.drive.port, &io::PortUsers::port) == all.end())
            all.push_back(io::users_of_port(one.drive.port, static_cast<int>(status.pid)));
    return all;
}

int run(const DoctorOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    if (options.probe) return search_for_drive(options, session);
    if (options.rules) {
        session.print(rules_json(), [&] { return render_rules(terminal.look()); });
        return kFine;
    }
    Replies replies;
    std::optional<int> failed;
    const auto fetch = [&](std::string_view method, auto& reply) {
        if (failed) return;
        const auto answer = session.ask(method);
        if (!answer)
            failed = answer.error();
        else
            report::take(*answer, reply);
    };
    fetch("GetStatus", replies.status);
    fetch("GetInfo", replies.info);
    fetch("GetDiagnosis", replies.diagnosis);
    fetch("GetCounters", replies.counters);
    fetch("GetLeds", replies.leds);
    fetch("GetTec", replies.tec);
    fetch("GetIo", replies.io);
    if (failed) return *failed;
    const bool listens = replies.status.bus.listens;
    if (listens && !options.station.empty()) return session.print_only_listens();
    if (!listens && !is_known(replies.status.stations, options.station)) {
        terminal.err << (options.station.empty()
                             ? std::string{"dpctl: there is no station\n"}
                             : fmt::format("dpctl: there is no station '{}'\n", options.station));
        return options.station.empty() ? kNo : kUsage;
    }
    replies.ports = port_users(replies.status);
    const std::vector<Finding> findings = diagnose(replies, options.station);
    const std::vector<Earlier> earlier = earlier_troubles(replies, options.station);
    session.print(doctor_json(replies, findings, earlier), [&] {
        return render_doctor(replies, findings, earlier, options.station, terminal.look());
    });
    const bool well = std::all_of(findings.begin(), findings.end(),
                                  [](const Finding& f) { return f.rule->rank == Rank::note; });
    return well ? kFine : kNo;
}

} // namespace

const Command kDoctor{
    "doctor",
    kLook,
    "Names the likely cause of a fault and the next step",
    add<DoctorOptions>,
    kOwnForm,
    "dpctl doctor            every station\n"
    "dpctl doctor unwinder   this one\n"
    "dpctl doctor --probe    searches for a drive that never answered (root and the operator group)\n"
    "dpctl doctor --rules    all rules, for lamps and symptoms that you see",
    "0 all is well, 1 something was found"};

} // namespace dpslave::dpctl
