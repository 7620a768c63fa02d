// SPDX-License-Identifier: Apache-2.0
#include "status.hpp"

#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/end_signals.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/doctor/doctor.hpp"

#include <algorithm>
#include <chrono>

namespace dpslave::dpctl {
namespace {

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

} // namespace

Result<Json, int> ask_status(const Options& options, Terminal& terminal)
{
    auto reply = ask(options, terminal, "GetStatus", Json::object());
    if (!reply) return reply;
    const bool names_one = !options.station.empty();
    if ((names_one || options.wait_s) && report::read<report::GetStatusReply>(*reply).bus.listens)
        return Failure{print_only_listens(options, terminal)};
    if (!names_one) return reply;
    Json known = Json::array(), meant = Json::array();
    for (const Json& one : list(*reply, "stations")) {
        const auto station = report::read<report::Station>(one);
        known.push_back(station.name);
        if (is_meant(station, options.station)) meant.push_back(one);
    }
    if (meant.empty())
        return Failure{print_error({Json::object({{"station", options.station}, {"known", known}}),
                                    "org.dpslaved.Control.NoSuchStation", false},
                                   options, terminal)};
    (*reply)["stations"] = std::move(meant);
    return reply;
}

void print_status(const Json& reply, const Options& options, Terminal& terminal)
{
    terminal.out << (options.json ? json_text(reply) + '\n' : render_status(reply, terminal.look()))
                 << std::flush;
}

/// Asks ten times a second: a station may come, leave or be renamed meanwhile.
int wait_for_exchange(const Options& options, Terminal& terminal)
{
    using Clock = std::chrono::steady_clock;
    using std::chrono::milliseconds;
    constexpr milliseconds kPause{100};
    const EndSignals end;
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>{options.wait_s.value_or(0)});
    for (;;) {
        const auto reply = ask_status(options, terminal);
        if (!reply) return reply.error();
        const bool reached = all_exchange(*reply, options.with_drive);
        const auto left = std::chrono::ceil<milliseconds>(until - Clock::now());
        if (reached || left.count() <= 0 || end.within(static_cast<int>(std::min(left, kPause).count()))) {
            if (!options.quiet) print_status(*reply, options, terminal);
            return reached ? kFine : kNo;
        }
    }
}

} // namespace dpslave::dpctl
