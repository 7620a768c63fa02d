// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"

namespace dpslave::dpctl {
namespace {

/// What a reply says of the station of this name; null without.
Json of_station(const Json& reply, const std::string& name)
{
    for (const Json& one : list(reply, "stations"))
        if (text(one, "name") == name) return one;
    return {};
}

} // namespace

/// The boards had OPTION VERSION in the drive's menu; 0.00 there said that no board is fitted (HA389815 ch.
/// 5).
int do_show(const Options& options, Terminal& terminal)
{
    const auto version = ask(options, terminal, "GetVersion", Json::object());
    if (!version) {
        if (version.error() == kNoDaemon)
            terminal.err << "OPTION VERSION 0.00: without dpslaved there is no option board.\n";
        return version.error();
    }
    const auto info = ask_of_stations(options, terminal, "GetInfo");
    if (!info) return info.error();
    const auto leds = ask(options, terminal, "GetLeds", station_parameter(options));
    if (!leds) return leds.error();
    const auto all = ask(options, terminal, "ListStations", Json::object());
    if (!all) return all.error();
    const auto tec = ask(options, terminal, "GetTec", Json::object()); // one that has none is no error here
    if (!tec) return tec.error();

    Json stations = Json::array();
    for (const Json& one : list(*info, "stations")) {
        const std::string name = text(one, "name");
        stations.push_back({{"station", of_station(*all, name)},
                            {"info", one},
                            {"leds", of_station(*leds, name)},
                            {"tec", of_station(*tec, name)}});
    }
    const Json document = {{"version", report::read<report::GetVersionReply>(*version).version},
                           {"stations", std::move(stations)}};
    terminal.out << (options.json ? json_text(document) + '\n' : render_show(document, terminal.look()))
                 << std::flush;
    return kFine;
}

} // namespace dpslave::dpctl
