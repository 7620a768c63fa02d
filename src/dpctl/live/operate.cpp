// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"

namespace dpslave::dpctl {

int do_write(const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    parameters["tag"] = options.tag;
    parameters["value"] = options.value;
    return show(options, terminal, "WriteTag", parameters,
                [](const Json& reply) { return render_tag(reply, "is now"); });
}

int do_tec_set(const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    parameters["parameter"] = options.parameter;
    parameters["value"] = options.value;
    if (options.yes) parameters["yes"] = true;
    return show(options, terminal, "SetTec", parameters, [&](const Json& reply) {
        std::string out;
        for (const report::Tec& tec : report::read<report::SetTecReply>(reply).stations)
            out += (out.empty() ? "" : "\n") + render_tec(tec, terminal.look());
        return out;
    });
}

/// Says first what it is going to do. Refused is not fine, though the daemon has answered.
int do_reload(const Options& options, Terminal& terminal)
{
    std::string said;
    std::vector<std::string> warned; ///< nothing with --json, which prints one reply
    if (options.dry_run || !options.json) {
        const auto plan = ask(options, terminal, "Reload", Json::object({{"dry_run", true}}));
        if (!plan) return plan.error();
        const auto planned = report::read<report::ReloadReply>(*plan);
        const bool faulty = !planned.faults.empty();
        said = options.json ? json_text(*plan) + '\n' : render_reload(planned, options.dry_run);
        (faulty && !options.json ? terminal.err : terminal.out) << said << std::flush;
        if (options.dry_run) return faulty ? kNo : kFine;
        warned = planned.warnings;
    }
    const auto reply = ask(options, terminal, "Reload", Json::object());
    if (!reply) return reply.error();
    auto done = report::read<report::ReloadReply>(*reply);
    if (!options.json && render_reload(done, false) == said) return done.applied ? kFine : kNo;
    if (!done.applied && done.warnings == warned) done.warnings.clear(); // just said
    (done.applied || options.json ? terminal.out : terminal.err)
        << (options.json ? json_text(*reply) + '\n' : render_reload(done, false)) << std::flush;
    return done.applied ? kFine : kNo;
}

} // namespace dpslave::dpctl
