// SPDX-License-Identifier: Apache-2.0
/// The head of the file of an incident, as JSON (trace/incident_file.hpp). The daemon writes it, dpctl reads
/// it. docs/internals/trace.md says what each key means.
#pragma once

#include "dpslave/report/fields.hpp"

namespace dpslave::report {

/// What makes an incident of one kind, station and reason.
struct IncidentPart {
    std::string kind{};
    std::optional<std::string> station{}; ///< null: the bus
    std::string reason{}, text{};
    DPSLAVE_FIELDS(kind, station, reason, text)
};
/// A station as it was at the incident.
struct IncidentStation {
    std::string name{};
    std::int64_t address = 0;
    std::string profile{}, state{};
    std::optional<std::int64_t> master{};
    std::string set_prm{}, chk_cfg{}; ///< data of the last ones, hexadecimal; empty: there was none
    DPSLAVE_FIELDS(name, address, profile, state, master, set_prm, chk_cfg)
};
struct IncidentHead {
    std::int64_t number = 0;
    IncidentPart what{};
    std::int64_t at_ns = 0, unix_ns = 0; ///< the moment: on the clock of the records, and since 1970
    std::int64_t hold_back_ns = 0;       ///< as in the reply of Trace
    std::vector<IncidentPart> also{};
    std::vector<IncidentStation> stations{};
    std::string program{}; ///< version of the daemon
    DPSLAVE_FIELDS(number, what, at_ns, unix_ns, hold_back_ns, also, stations, program)
};
/// Beside the files: what changes too often for them.
struct IncidentCount {
    std::int64_t number = 0, count = 1, last_unix_ns = 0;
    DPSLAVE_FIELDS(number, count, last_unix_ns)
};
struct IncidentCounts {
    std::int64_t next = 1; ///< number of the next incident
    std::vector<IncidentCount> counts{};
    DPSLAVE_FIELDS(next, counts)
};

} // namespace dpslave::report
