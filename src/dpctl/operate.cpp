// SPDX-License-Identifier: Apache-2.0
#include "ask.hpp"
#include "render.hpp"
#include "subcommands.hpp"
#include "words.hpp"

namespace dpslave::dpctl {

int do_read(const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    parameters["tag"] = options.tag;
    return show(options, terminal, "ReadTag", parameters,
                [](const Json& reply) { return render_tag(reply, "is"); });
}

int do_write(const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    parameters["tag"] = options.tag;
    parameters["value"] = options.value;
    return show(options, terminal, "WriteTag", parameters,
                [](const Json& reply) { return render_tag(reply, "is now"); });
}

int do_tec(const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    if (options.set) {
        parameters["parameter"] = options.parameter;
        parameters["value"] = options.value;
    }
    return show(options, terminal, options.set ? "SetTec" : "GetTec", parameters,
                [&](const Json& reply) { return render_tec(reply, terminal.colour); });
}

/// Refused is not fine, though the daemon has answered.
int do_reload(const Options& options, Terminal& terminal)
{
    const auto reply = ask(options, terminal, "Reload", Json::object());
    if (!reply) return reply.error();
    const bool applied = reply->value("applied", false);
    if (options.json)
        terminal.out << json_text(*reply) << '\n' << std::flush;
    else
        (applied ? terminal.out : terminal.err) << render_reload(*reply) << std::flush;
    return applied ? kFine : kNo;
}

} // namespace dpslave::dpctl
