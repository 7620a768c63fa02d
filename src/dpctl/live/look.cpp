// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"
#include "status.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// What there is of the station that is meant, or of all.
int of_stations(const Options& options, Terminal& terminal, std::string_view method,
                std::string (*render)(const Json&, Look))
{
    const auto reply = ask_of_stations(options, terminal, method);
    if (!reply) return reply.error();
    terminal.out << (options.json ? json_text(*reply) + '\n' : render(*reply, terminal.look())) << std::flush;
    return kFine;
}

} // namespace

int do_status(const Options& options, Terminal& terminal)
{
    if (options.follow) return follow_status(options, terminal);
    if (options.wait_s) return wait_for_exchange(options, terminal);
    const auto reply = ask_status(options, terminal);
    if (!reply) return reply.error();
    print_status(*reply, options, terminal);
    return kFine;
}
int do_io(const Options& options, Terminal& terminal)
{
    if (options.follow) return follow_io(options, terminal);
    return of_stations(options, terminal, "GetIo", render_io);
}
int do_diag(const Options& options, Terminal& terminal)
{
    return of_stations(options, terminal, "GetDiagnosis", render_diagnosis);
}
int do_counters(const Options& options, Terminal& terminal)
{
    return show(options, terminal, "GetCounters", Json::object(),
                [&](const Json& reply) { return render_counters(reply, terminal.look()); });
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
    return show(options, terminal, "GetVersion", Json::object(), [](const Json& json) {
        const auto reply = report::read<report::GetVersionReply>(json);
        return fmt::format("{} {} ({})\n", reply.program, reply.version, reply.interface);
    });
}

} // namespace dpslave::dpctl
