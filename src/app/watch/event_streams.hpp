// SPDX-License-Identifier: Apache-2.0
/// The method GetEvents: those that are there, and with "more" each new one. Main thread only.
#pragma once

#include "app/main/monitor.hpp"
#include "app/main/replies.hpp"
#include "event_history.hpp"

#include <map>

namespace dpslave::app {

class EventStreams {
public:
    /// All outlive this object.
    EventStreams(const Monitor& monitor, const EventHistory& history, Replies& replies)
        : monitor_(monitor), history_(history), replies_(replies)
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
    const EventHistory& history_;
    Replies& replies_;
    std::map<std::uint64_t, Follower> followers_; ///< by the number of the stream
};

/// Those behind number `after`; `station`: only of this one, empty: all. `lost`: how many there were behind
/// `after` that the list has no longer.
report::GetEventsReply events_report(const EventHistory& history, std::uint64_t after,
                                     const std::string& station, Instant now);

} // namespace dpslave::app
