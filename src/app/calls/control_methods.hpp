// SPDX-License-Identifier: Apache-2.0
/// The methods of org.dpslaved.Control: which one is answered by what. Main thread only.
#pragma once

#include "app/incident/incidents.hpp"
#include "app/log/log_level.hpp"
#include "app/reload/reload.hpp"
#include "app/state/lamps.hpp"
#include "event_streams.hpp"
#include "pending_accesses.hpp"
#include "pending_probes.hpp"
#include "traces.hpp"
#include "watchers.hpp"

namespace dpslave::app {

class ControlMethods {
public:
    /// All that the methods ask. It outlives this object and its methods.
    struct Parts {
        Monitor& monitor;
        const Lamps& lamps;
        const ConfigFile& file;
        PendingAccesses& accesses;
        PendingProbes& probes;
        Watchers& watchers;
        Traces& traces;
        Incidents& incidents;
        Reload& reload;
        Happenings& happenings;
        EventStreams& event_streams;
        LogLevel& log_level;
    };
    /// `started`: of the program.
    ControlMethods(const Parts& parts, Instant started) : parts_(parts), started_(started) {}

    /// All methods. They refer to this object.
    control::Methods methods();

private:
    report::GetStatusReply status() const;
    report::Info info(const Station& station) const;
    report::StationLeds leds(const Station& station) const;
    control::Methods all_methods();
    report::Log log(Instant now) const;
    control::Reply set_log_level(const control::Json& parameters, const control::Caller& caller);
    control::Reply watch(const control::Json& parameters, const control::Caller& caller);
    control::Reply tec(const control::Json& parameters) const;
    control::Reply set_tec(const Station& station, const control::Json& parameters,
                           const control::Caller& caller);

    Parts parts_;
    Instant started_;
};

} // namespace dpslave::app
