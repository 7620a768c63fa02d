// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct ReloadOptions {
    bool dry_run = false;
    bool careful = false; ///< takes no station in exchange off the bus without a consent
    bool yes = false;     ///< the consent
};

void set_up(CLI::App& app, ReloadOptions& options)
{
    app.add_flag("--dry-run", options.dry_run,
                 "Only say what a reload would do; change nothing and open no port");
    auto* const careful =
        app.add_flag("--careful", options.careful,
                     "Without a terminal: refuse if a station in exchange would leave the bus");
    app.add_flag("--yes", options.yes, "Do not ask on a terminal")->excludes(careful);
}

/// The stations that would leave the bus while a master exchanges data with them. The failure is an exit
/// status.
Result<std::vector<std::string>, int> leaving_in_exchange(const report::ReloadReply& plan, Session& session)
{
    std::vector<std::string> names;
    if (plan.leaving.empty()) return names;
    const auto status = session.ask("GetStatus");
    if (!status) return Failure{status.error()};
    for (const report::Station& station : report::read<report::GetStatusReply>(*status).stations)
        for (const report::LeavingStation& leaving : plan.leaving)
            if (leaving.station == station.name && station.state == "Data_Exch")
                names.push_back(station.name);
    return names;
}

/// On a terminal the user decides, else --careful. Nothing: go on.
std::optional<int> judge_leaving(const report::ReloadReply& plan, const ReloadOptions& options,
                                 Session& session)
{
    Terminal& terminal = session.terminal();
    const bool asks = terminal.user != nullptr && !options.yes;
    if (!asks && !options.careful) return std::nullopt;
    const auto leaving = leaving_in_exchange(plan, session);
    if (!leaving) return leaving.error();
    if (leaving->empty()) return std::nullopt;
    const std::string names = joined(*leaving, ", ");
    if (!asks) {
        terminal.err << "dpctl: not reloaded: a master exchanges data with " << names
                     << ", which would leave the bus; to do it anyway, leave out --careful\n";
        return kRefused;
    }
    if (session.agrees("A master exchanges data with " + names + ", which would leave the bus. Reload?"))
        return std::nullopt;
    terminal.err << "dpctl: nothing was changed\n";
    return kNo;
}

/// Says first what it is going to do. Refused is not fine, though the daemon has answered.
int run(const ReloadOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    std::string said;
    std::vector<std::string> warned; ///< nothing with --json, which prints one reply
    if (options.dry_run || options.careful || terminal.user != nullptr || !session.json()) {
        const auto plan = session.ask("Reload", Json::object({{"dry_run", true}}));
        if (!plan) return plan.error();
        const auto planned = report::read<report::ReloadReply>(*plan);
        const bool faulty = !planned.faults.empty();
        if (options.dry_run || !session.json()) {
            said = render_reload(planned, options.dry_run);
            if (faulty && !session.json())
                terminal.err << said << std::flush;
            else
                session.print(*plan, [&] { return said; });
        }
        if (options.dry_run) return faulty ? kNo : kFine;
        if (const auto ended = judge_leaving(planned, options, session)) return *ended;
        if (!session.json()) warned = planned.warnings;
    }
    const auto reply = session.ask("Reload");
    if (!reply) return reply.error();
    auto done = report::read<report::ReloadReply>(*reply);
    const int code = done.applied ? kFine : kNo;
    if (!session.json() && render_reload(done, false) == said) return code;
    if (!done.applied && done.warnings == warned) done.warnings.clear(); // just said
    if (!done.applied && !session.json())
        terminal.err << render_reload(done, false) << std::flush;
    else
        session.print(*reply, [&] { return render_reload(done, false); });
    return code;
}

} // namespace

const Command kReload{
    "reload",
    kOperate,
    "Reads the configuration file again and applies it, or says why not (root and the operator group)",
    add<ReloadOptions>,
    "Reload",
    "dpctl reload --dry-run   what it would change, and which stations would leave the bus and why\n"
    "dpctl reload --careful   in a script: refuses if a station in exchange would leave the bus",
    "0 applied, or can be; 1 the configuration is faulty, or you answered no"};

} // namespace dpslave::dpctl
