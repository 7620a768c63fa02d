// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"
#include "status.hpp"

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
