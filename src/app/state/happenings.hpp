// SPDX-License-Identifier: Apache-2.0
/// What happened is told once, by whoever knows it, in one wording: to the log, to `dpctl events` and to the
/// flight recorder. Main thread only.
#pragma once

#include "app/log/limited_log.hpp"
#include "recent_events.hpp"
#include "station.hpp"

#include "dpslave/dp/pending_events.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dpslave::app {

struct Happening {
    Happened kind = Happened::state;
    Severity severity = Severity::info;
    std::string text;     ///< a sentence, with the name of its station in front
    std::string key = {}; ///< what makes them equal, whatever values are in the text; empty: the text
    std::vector<std::string> stations = {}; ///< names; none: it is of the bus or the daemon
    bool is_of_line = false; ///< the text names no station: the event of each begins with its name
    /// Whose telegrams the flight recorder keeps, and why: the event on the bus, or how the drive was lost
    /// ("silent", "port").
    std::vector<const Station*> recorded = {};
    const dp::Event* bus_event = nullptr;
    std::string_view drive_loss = {};
};

class Happenings {
public:
    /// What else each one goes to.
    using Sink = std::function<void(const Happening&, Instant)>;
    /// `events` outlives this object. `recorder`: the flight recorder.
    Happenings(RecentEvents& events, Sink recorder) : events_(events), recorder_(std::move(recorder)) {}

    /// In the log equal ones are one line with a count every 10 s. What a person did is a line each time.
    void tell(const Happening& happening, Instant now);
    /// To be called now and then: says what the log has held back for long enough.
    void on_time(Instant now) { log_.on_time(now); }
    void end(Instant now) { log_.end(now); } ///< of the program: nothing is held back any more

private:
    RecentEvents& events_;
    Sink recorder_;
    LimitedLog log_;
};

} // namespace dpslave::app
