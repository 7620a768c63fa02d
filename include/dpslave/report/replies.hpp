// SPDX-License-Identifier: Apache-2.0
/// One struct for each reply and each error of org.dpslaved.Control.varlink. The types in them: types.hpp.
#pragma once

#include "dpslave/report/types.hpp"

namespace dpslave::report {

// The replies, by method.

struct GetVersionReply {
    std::string program{}, version{}, interface {};
    DPSLAVE_FIELDS(program, version, interface)
};
struct GetStatusReply {
    Bus bus{};
    std::vector<Station> stations{};
    std::int64_t uptime_ms = 0, pid = 0;
    Log log{};
    DPSLAVE_FIELDS(bus, stations, uptime_ms, pid, log)
};
struct ListStationsReply {
    std::vector<Station> stations{};
    DPSLAVE_FIELDS(stations)
};
struct GetInfoReply {
    std::vector<Info> stations{};
    DPSLAVE_FIELDS(stations)
};
struct GetIoReply {
    std::vector<StationIo> stations{};
    DPSLAVE_FIELDS(stations)
};
struct GetDiagnosisReply {
    std::vector<Diagnosis> stations{};
    DPSLAVE_FIELDS(stations)
};
struct GetCountersReply {
    std::vector<CounterGroup> groups{};
    std::vector<Distribution> turnaround{};
    std::vector<Refresh> refresh{};
    DPSLAVE_FIELDS(groups, turnaround, refresh)
};
struct GetBusReply {
    std::string port{};
    std::int64_t baud = 0;
    std::string baud_state{};
    double load_percent = 0;
    std::vector<Member> members{};
    DPSLAVE_FIELDS(port, baud, baud_state, load_percent, members)
};
struct GetLedsReply {
    std::vector<StationLeds> stations{};
    DPSLAVE_FIELDS(stations)
};
struct GetTecReply {
    std::vector<Tec> stations{};
    DPSLAVE_FIELDS(stations)
};
struct WatchReply {
    Bus bus{};
    std::vector<Station> stations{};
    std::vector<StationWords> words{};
    DPSLAVE_FIELDS(bus, stations, words)
};
struct GetEventsReply {
    std::vector<Event> events{};
    std::int64_t lost = 0, newest = 0;
    DPSLAVE_FIELDS(events, lost, newest)
};
struct FindTagsReply {
    std::string station{};
    std::vector<NamedTag> tags{};
    DPSLAVE_FIELDS(station, tags)
};
struct GetSamplesReply {
    std::string station{};
    std::int64_t tag = 0;
    std::optional<std::string> name{}, direction{};
    std::vector<Sample> samples{};
    std::int64_t lost = 0, newest = 0;
    bool more = false;
    std::optional<std::int64_t> oldest_unix_ms{};
    std::int64_t now_unix_ms = 0;
    DPSLAVE_FIELDS(station, tag, name, direction, samples, lost, newest, more, oldest_unix_ms, now_unix_ms)
};
struct SetLogLevelReply {
    Log log{};
    DPSLAVE_FIELDS(log)
};
struct TraceReply {
    std::string records{};
    std::optional<std::string> line{};
    std::int64_t lost = 0;
    bool caught_up = false;
    std::int64_t hold_back_ns = 0, now_ns = 0, unix_ns = 0;
    DPSLAVE_FIELDS(records, line, lost, caught_up, hold_back_ns, now_ns, unix_ns)
};
struct ListIncidentsReply {
    std::string folder{};
    std::vector<Incident> incidents{};
    std::int64_t not_kept = 0, failures = 0;
    std::optional<std::string> trouble{};
    DPSLAVE_FIELDS(folder, incidents, not_kept, failures, trouble)
};
struct GetIncidentReply {
    std::string octets{};
    std::int64_t size = 0;
    DPSLAVE_FIELDS(octets, size)
};
struct ReadTagReply {
    std::string station{};
    std::int64_t tag = 0;
    std::optional<std::string> name{};
    std::int64_t raw = 0;
    std::string value{};
    DPSLAVE_FIELDS(station, tag, name, raw, value)
};
struct GetSurveyScopeReply {
    std::string station{}, protocol{}, tag_table{};
    std::vector<TagSpan> tags{};
    DPSLAVE_FIELDS(station, protocol, tag_table, tags)
};
struct SurveyReply {
    std::string station{};
    std::int64_t tag = 0;
    std::optional<std::string> mnemonic{};
    std::string outcome{};
    std::optional<std::string> text{};
    std::optional<std::int64_t> raw{};
    std::optional<std::string> reason{};
    DPSLAVE_FIELDS(station, tag, mnemonic, outcome, text, raw, reason)
};
struct WriteTagReply {
    std::string station{};
    std::int64_t tag = 0;
    std::optional<std::string> name{};
    std::int64_t raw = 0;
    std::string value{};
    std::optional<std::int64_t> master{};
    DPSLAVE_FIELDS(station, tag, name, raw, value, master)
};
struct ProbeDriveReply {
    std::string station{}, line{}, port{};
    std::int64_t tried = 0, to_try = 0, longest_s = 0;
    bool done = false;
    std::vector<Answering> answering{};
    DPSLAVE_FIELDS(station, line, port, tried, to_try, longest_s, done, answering)
};
struct SetTecReply {
    std::vector<Tec> stations{};
    DPSLAVE_FIELDS(stations)
};
struct ReloadReply {
    bool applied = false;
    std::vector<std::string> changes{};
    std::vector<LeavingStation> leaving{};
    std::vector<std::string> pending{}, warnings{}, faults{};
    DPSLAVE_FIELDS(applied, changes, leaving, pending, warnings, faults)
};

// The parameters of the errors; Busy has none.

struct NoSuchStation {
    std::string station{};
    std::vector<std::string> known{};
    DPSLAVE_FIELDS(station, known)
};
struct NoSuchLine {
    std::string line{};
    std::vector<std::string> known{};
    DPSLAVE_FIELDS(line, known)
};
struct StationRequired {
    std::vector<std::string> known{};
    DPSLAVE_FIELDS(known)
};
struct NotPermitted {
    std::string group{};
    DPSLAVE_FIELDS(group)
};
struct DriveRefused {
    std::int64_t tag = 0;
    std::string reason{};
    std::optional<std::int64_t> code{};
    DPSLAVE_FIELDS(tag, reason, code)
};
struct BadValue {
    std::int64_t tag = 0;
    std::string value{}, reason{};
    DPSLAVE_FIELDS(tag, value, reason)
};
struct IncidentsOff {
    std::string reason{};
    DPSLAVE_FIELDS(reason)
};
struct NoSuchIncident {
    std::int64_t number = 0;
    std::vector<std::int64_t> known{};
    DPSLAVE_FIELDS(number, known)
};
struct IncidentUnreadable {
    std::int64_t number = 0;
    std::string reason{};
    DPSLAVE_FIELDS(number, reason)
};
struct NoTecOption {
    std::string station{};
    DPSLAVE_FIELDS(station)
};
struct BadTecValue {
    std::string parameter{}, value{}, reason{};
    DPSLAVE_FIELDS(parameter, value, reason)
};
struct BadLogLevel {
    std::string level{}, reason{};
    DPSLAVE_FIELDS(level, reason)
};
struct LineInUse {
    std::string line{};
    std::vector<std::string> stations{};
    DPSLAVE_FIELDS(line, stations)
};
struct ProbeEnded {
    std::string station{}, reason{};
    DPSLAVE_FIELDS(station, reason)
};
struct WouldSilence {
    std::string station{}, parameter{}, value{}, reason{};
    DPSLAVE_FIELDS(station, parameter, value, reason)
};

} // namespace dpslave::report
