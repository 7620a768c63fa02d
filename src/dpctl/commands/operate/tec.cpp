// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct TecSetOptions {
    std::string station, parameter, value;
    bool yes = false; ///< also what silences a station in exchange
};

void set_up(CLI::App& app, TecSetOptions& options)
{
    app.add_option("NAME", options.parameter, "Name of the input: TYPE, ADDRESS, RIDE_THROUGH ...")
        ->required()
        ->type_name("");
    app.add_option("VALUE", options.value, "A number (12, -1, 0x6AB5); for TYPE also a name")
        ->required()
        ->type_name("");
    add_station_option(app, options.station);
    app.add_flag("--yes", options.yes, "Set it even if this silences a station that is in exchange");
}

int run(const TecSetOptions& options, Session& session)
{
    Json parameters = station_parameter(options.station);
    parameters["parameter"] = options.parameter;
    parameters["value"] = options.value;
    if (options.yes) parameters["yes"] = true;
    return session.show("SetTec", parameters, [&](const Json& reply) {
        std::string out;
        for (const report::Tec& tec : report::read<report::SetTecReply>(reply).stations)
            out += (out.empty() ? "" : "\n") + render_tec(tec, session.terminal().look());
        return out;
    });
}

} // namespace

const Command kTec{
    "tec",
    kOperate,
    "Sets an input of the function block TEC OPTION of a technology box: tec set (root and the operator group)",
    nullptr,
    "SetTec",
    "dpctl tec set TYPE \"PROFIBUS DP\"\n"
    "dpctl tec set RIDE_THROUGH -1 --station unwinder\n"
    "dpctl show                                  shows the function block"};

const Command kTecSet{"tec set", kOperate, "Sets an input until the next start", add<TecSetOptions>,
                      "SetTec"};

} // namespace dpslave::dpctl
