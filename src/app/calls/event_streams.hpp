// SPDX-License-Identifier: Apache-2.0
/// The method GetEvents: those that are there, and with "more" each new one. Main thread only.
#pragma once

#include "app/state/monitor.hpp"
#include "app/state/recent_events.hpp"
#include "streams.hpp"

#include <cstdint>
#include <string>

namespace dpslave::app {

class EventStreams {
public:
    /// All outlive this object.
    EventStreams(const Monitor& monitor, const RecentEvents& history) : monitor_(monitor), history_(history)
    {}

    control::Reply add(const control::Json& parameters, const control::Caller& caller);
    /// Sends what is new.
    void push(Instant now);

private:
    struct Follower {
        std::string station;    ///< only of this one; empty: all
        std::uint64_t sent = 0; ///< number of the newest that it has
    };

    const Monitor& monitor_;
    const RecentEvents& history_;
    Streams<Follower> followers_;
};

/// Those behind number `after`; `station`: only of this one, empty: all. `lost`: how many there were behind
/// `after` that the list has no longer.
report::GetEventsReply events_report(const RecentEvents& history, std::uint64_t after,
                                     const std::string& station, Instant now);

} // namespace dpslave::app
