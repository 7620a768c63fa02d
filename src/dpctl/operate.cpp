// SPDX-License-Identifier: Apache-2.0
#include "ask.hpp"
#include "render.hpp"
#include "subcommands.hpp"

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

} // namespace dpslave::dpctl
