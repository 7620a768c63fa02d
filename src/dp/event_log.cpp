// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/event_log.hpp"

namespace dpslave::dp {

void EventLog::add(const Event& event)
{
    last_ = event;
    // Once one is lost, the following are too until the overflow was fetched: else it would stand in the
    // wrong place.
    if (lost_ || !events_.push(event)) lost_ = true;
}

void EventLog::add_once(const Event& event)
{
    if (event != last_) add(event);
}

std::optional<Event> EventLog::take(State state, std::uint8_t master)
{
    if (events_.empty() && lost_) {
        lost_ = false;
        return Event{.kind = Event::Kind::overflow, .state = state, .master = master};
    }
    return events_.pop();
}

} // namespace dpslave::dp
