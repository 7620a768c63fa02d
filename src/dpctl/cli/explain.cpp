// SPDX-License-Identifier: Apache-2.0
#include "explain.hpp"

#include "fields.hpp"

#include <fmt/format.h>

#include <array>

namespace dpslave::dpctl {
namespace {

std::string no_such_station(const Json& p)
{
    return fmt::format("there is no station '{}'; there are: {}", text(p, "station"),
                       joined(list(p, "known"), ", "));
}
std::string station_required(const Json& p)
{
    return fmt::format("there are several stations, say which one: {}", joined(list(p, "known"), ", "));
}
std::string not_permitted(const Json& p)
{
    const std::string group = text(p, "group", "");
    if (group.empty()) return "only root may do this; try: sudo dpctl ...";
    return fmt::format(
        "only root and members of the group '{0}' may do this; try: sudo dpctl ..., or let root add you: "
        "adduser YOUR_NAME {0}",
        group);
}
std::string drive_refused(const Json& p)
{
    const auto code = integer(p, "code");
    const std::string as_demand_data = code ? fmt::format(" (Demand Data: error code {})", *code) : "";
    return fmt::format("tag {}: {}{}", number(p, "tag"), text(p, "reason"), as_demand_data);
}
std::string bad_value(const Json& p)
{
    return fmt::format("tag {}: the value '{}' does not fit: {}", number(p, "tag"), text(p, "value"),
                       text(p, "reason"));
}
std::string no_tec_option(const Json& p)
{
    return fmt::format(
        "the device of station '{}' has no TEC OPTION function block; technology boxes have one",
        text(p, "station"));
}
std::string bad_tec_value(const Json& p)
{
    return fmt::format("{} cannot be set to '{}': {}", text(p, "parameter"), text(p, "value"),
                       text(p, "reason"));
}
std::string would_silence(const Json& p)
{
    return fmt::format(
        "{} = {} would take station '{}' off the bus while a master exchanges data with it ({}); "
        "if that is wanted: --yes",
        text(p, "parameter"), text(p, "value"), text(p, "station"), text(p, "reason"));
}
std::string line_in_use(const Json& p)
{
    return fmt::format(
        "line {} works for {}, which a master exchanges data with: its drives would wait for up to a "
        "minute; if that is wanted: --yes",
        text(p, "line"), joined(list(p, "stations"), ", "));
}
std::string busy(const Json&)
{
    return "the daemon has too many callers or orders at once; try again";
}
std::string invalid_parameter(const Json& p)
{
    return fmt::format(
        "the daemon does not take the parameter '{}': dpctl and dpslaved are of different versions",
        text(p, "parameter"));
}
std::string method_not_found(const Json& p)
{
    return fmt::format("the daemon does not know {}: dpctl and dpslaved are of different versions",
                       text(p, "method"));
}
std::string interface_not_found(const Json& p)
{
    return fmt::format("what answers on this socket does not know {}: it is no dpslaved",
                       text(p, "interface"));
}

struct Row {
    std::string_view error;
    std::string (*sentence)(const Json& parameters);
};
constexpr std::array kSentences = std::to_array<Row>({
    {"org.dpslaved.Control.NoSuchStation", no_such_station},
    {"org.dpslaved.Control.StationRequired", station_required},
    {"org.dpslaved.Control.NotPermitted", not_permitted},
    {"org.dpslaved.Control.DriveRefused", drive_refused},
    {"org.dpslaved.Control.BadValue", bad_value},
    {"org.dpslaved.Control.NoTecOption", no_tec_option},
    {"org.dpslaved.Control.BadTecValue", bad_tec_value},
    {"org.dpslaved.Control.WouldSilence", would_silence},
    {"org.dpslaved.Control.LineInUse", line_in_use},
    {"org.dpslaved.Control.Busy", busy},
    {"org.varlink.service.InvalidParameter", invalid_parameter},
    {"org.varlink.service.MethodNotFound", method_not_found},
    {"org.varlink.service.InterfaceNotFound", interface_not_found},
});

} // namespace

std::string explain(const control::ReplyMessage& error)
{
    for (const Row& row : kSentences)
        if (row.error == error.error) return row.sentence(error.parameters);
    return fmt::format("{} {}", error.error,
                       error.parameters.dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace dpslave::dpctl
