// SPDX-License-Identifier: Apache-2.0
#include "explain.hpp"

#include "fields.hpp"

#include "dpslave/report/replies.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>

#include <array>

namespace dpslave::dpctl {
namespace {

// Of org.varlink.service.
struct InvalidParameter {
    std::string parameter{};
    DPSLAVE_FIELDS(parameter)
};
struct MethodNotFound {
    std::string method{};
    DPSLAVE_FIELDS(method)
};
struct InterfaceNotFound {
    std::string interface {};
    DPSLAVE_FIELDS(interface)
};

constexpr std::int64_t kNoTag = -1;

std::string tag_text(std::int64_t tag)
{
    return tag == kNoTag ? "-" : std::to_string(tag);
}

template <class T, std::string (*Sentence)(const T&)>
std::string said(const Json& json)
{
    T parameters{};
    if constexpr (requires { parameters.tag; }) parameters.tag = kNoTag;
    report::take(json, parameters);
    return Sentence(parameters);
}

std::string no_such_station(const report::NoSuchStation& p)
{
    return fmt::format("there is no station '{}'; there are: {}", p.station, joined(p.known, ", "));
}
std::string no_such_line(const report::NoSuchLine& p)
{
    return fmt::format("there is no drive line '{}'; there are: {}", p.line, joined(p.known, ", "));
}
std::string station_required(const report::StationRequired& p)
{
    return fmt::format("there are several stations, name one: {}", joined(p.known, ", "));
}
std::string only_listens(const Json&)
{
    return "the daemon only listens, so it has no station: 'listen' is set in [bus] of its configuration. See who is on the bus: dpctl bus";
}
std::string not_permitted(const report::NotPermitted& p)
{
    if (p.group.empty()) return "only root may do this; try: sudo dpctl ...";
    return fmt::format(
        "only root and members of the group '{0}' may do this; try: sudo dpctl ..., or let root add you: adduser YOUR_NAME {0}",
        p.group);
}
std::string drive_refused(const report::DriveRefused& p)
{
    const std::string as_demand_data = p.code ? fmt::format(" (Demand Data: error code {})", *p.code) : "";
    return fmt::format("tag {}: {}{}", tag_text(p.tag), p.reason, as_demand_data);
}
std::string bad_value(const report::BadValue& p)
{
    return fmt::format("tag {}: the value '{}' does not fit: {}", tag_text(p.tag), p.value, p.reason);
}
std::string no_tec_option(const report::NoTecOption& p)
{
    return fmt::format(
        "the device of station '{}' has no TEC OPTION function block; technology boxes have one", p.station);
}
std::string bad_tec_value(const report::BadTecValue& p)
{
    return fmt::format("{} cannot be set to '{}': {}", p.parameter, p.value, p.reason);
}
std::string would_silence(const report::WouldSilence& p)
{
    return fmt::format(
        "{} = {} would take station '{}' off the bus while a master exchanges data with it ({}); to do it anyway, add --yes",
        p.parameter, p.value, p.station, p.reason);
}
std::string line_in_use(const report::LineInUse& p)
{
    return fmt::format(
        "line {} serves {}, with which a master exchanges data: its drives would get no requests for up to a minute; to do it anyway, add --yes",
        p.line, joined(p.stations, ", "));
}
std::string probe_ended(const report::ProbeEnded& p)
{
    return fmt::format("the search for the drive of station '{}' was ended: {}", p.station, p.reason);
}
std::string bad_log_level(const report::BadLogLevel& p)
{
    return fmt::format("the log cannot be set to '{}': {}", p.level, p.reason);
}
std::string read_only(const Json&)
{
    return "the daemon only shows: 'read_only' is set in [control] of its configuration; to write, remove it and reload";
}
std::string trace_off(const Json&)
{
    return "the daemon records nothing of it: set bus_kib, of a drive line drive_kib, in [trace] of its configuration, and restart it";
}
std::string samples_off(const Json&)
{
    return "the daemon keeps no values: set samples_kib in [trace] of its configuration, and restart it";
}
std::string incidents_off(const report::IncidentsOff& p)
{
    return fmt::format("the daemon keeps no incidents: {}", p.reason);
}
std::string no_such_incident(const report::NoSuchIncident& p)
{
    std::vector<std::string> known;
    for (const std::int64_t one : p.known) known.push_back(std::to_string(one));
    return fmt::format("there is no incident {}; there {}", p.number,
                       known.empty() ? "is none" : "are: " + joined(known, ", "));
}
std::string incident_unreadable(const report::IncidentUnreadable& p)
{
    return fmt::format("the file of incident {}: {}", p.number, p.reason);
}
std::string busy(const Json&)
{
    return "the daemon has too many connections or requests at once; try again";
}
std::string invalid_parameter(const InvalidParameter& p)
{
    return fmt::format(
        "the daemon does not know the parameter '{}': dpctl and dpslaved are of different versions",
        p.parameter);
}
std::string method_not_found(const MethodNotFound& p)
{
    return fmt::format("the daemon does not know {}: dpctl and dpslaved are of different versions", p.method);
}
std::string interface_not_found(const InterfaceNotFound& p)
{
    return fmt::format("the program that answers on this socket does not know {}: it is not dpslaved",
                       p.interface);
}

/// The drive did not refuse: it has not answered in time.
bool is_silence(std::string_view reason)
{
    return reason == report::text(AccessError::no_answer) || reason == report::text(AccessError::deferred) ||
           reason == report::text(AccessError::not_known) || reason.starts_with(report::kLineDidNotServe);
}

struct Row {
    std::string_view error;
    std::string (*sentence)(const Json& parameters);
    Exit exit = kRefused;
};
constexpr std::array kSentences = std::to_array<Row>({
    {"org.dpslaved.Control.NoSuchStation", said<report::NoSuchStation, no_such_station>, kUsage},
    {"org.dpslaved.Control.NoSuchLine", said<report::NoSuchLine, no_such_line>, kUsage},
    {"org.dpslaved.Control.StationRequired", said<report::StationRequired, station_required>, kUsage},
    {"org.dpslaved.Control.OnlyListens", only_listens},
    {"org.dpslaved.Control.NotPermitted", said<report::NotPermitted, not_permitted>},
    {"org.dpslaved.Control.DriveRefused", said<report::DriveRefused, drive_refused>},
    {"org.dpslaved.Control.BadValue", said<report::BadValue, bad_value>},
    {"org.dpslaved.Control.NoTecOption", said<report::NoTecOption, no_tec_option>},
    {"org.dpslaved.Control.BadTecValue", said<report::BadTecValue, bad_tec_value>},
    {"org.dpslaved.Control.WouldSilence", said<report::WouldSilence, would_silence>},
    {"org.dpslaved.Control.LineInUse", said<report::LineInUse, line_in_use>},
    {"org.dpslaved.Control.ProbeEnded", said<report::ProbeEnded, probe_ended>, kNo},
    {"org.dpslaved.Control.BadLogLevel", said<report::BadLogLevel, bad_log_level>},
    {"org.dpslaved.Control.ReadOnly", read_only},
    {"org.dpslaved.Control.TraceOff", trace_off},
    {"org.dpslaved.Control.SamplesOff", samples_off},
    {"org.dpslaved.Control.IncidentsOff", said<report::IncidentsOff, incidents_off>},
    {"org.dpslaved.Control.NoSuchIncident", said<report::NoSuchIncident, no_such_incident>, kUsage},
    {"org.dpslaved.Control.IncidentUnreadable", said<report::IncidentUnreadable, incident_unreadable>, kNo},
    {"org.dpslaved.Control.Busy", busy},
    {"org.varlink.service.InvalidParameter", said<InvalidParameter, invalid_parameter>, kNo},
    {"org.varlink.service.MethodNotFound", said<MethodNotFound, method_not_found>, kNo},
    {"org.varlink.service.InterfaceNotFound", said<InterfaceNotFound, interface_not_found>, kNo},
});

} // namespace

Exit exit_of(const control::ReplyMessage& error)
{
    if (error.error == "org.dpslaved.Control.DriveRefused" &&
        is_silence(report::read<report::DriveRefused>(error.parameters).reason))
        return kNoAnswer;
    for (const Row& row : kSentences)
        if (row.error == error.error) return row.exit;
    return kNo;
}

std::string explain(const control::ReplyMessage& error)
{
    for (const Row& row : kSentences)
        if (row.error == error.error) return row.sentence(error.parameters);
    return fmt::format("{} {}", error.error,
                       error.parameters.dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace dpslave::dpctl
