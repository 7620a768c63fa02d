// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"

namespace dpslave::dpctl {
namespace {

struct ShowOptions : StationOptions {};

/// What a reply says of the station of this name; null without.
Json of_station(const Json& reply, const std::string& name)
{
    for (const Json& one : list(reply, "stations"))
        if (text(one, "name") == name) return one;
    return {};
}

/// The boards had OPTION VERSION in the drive's menu; 0.00 there said that no board is fitted (HA389815 ch.
/// 5).
int run(const ShowOptions& options, Session& session)
{
    const auto version = session.ask("GetVersion");
    if (!version) {
        if (version.error() == kNoDaemon)
            session.terminal().err << "OPTION VERSION 0.00: without dpslaved there is no option board.\n";
        return version.error();
    }
    const auto info = session.ask_of_stations("GetInfo", options.station);
    if (!info) return info.error();
    const auto leds = session.ask("GetLeds", station_parameter(options.station));
    if (!leds) return leds.error();
    const auto all = session.ask("ListStations");
    if (!all) return all.error();
    const auto tec = session.ask("GetTec"); // one that has none is no error here
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
    session.print(document, [&] { return render_show(document, session.terminal().look()); });
    return kFine;
}

} // namespace

const Command kShow{"show", kLook,
                    "Shows everything about a station: state, drive, emulated device, lamps, TEC OPTION",
                    add<ShowOptions>, kOwnForm};

} // namespace dpslave::dpctl
