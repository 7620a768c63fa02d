// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/pending_events.hpp"

namespace dpslave::dp {

void PendingEvents::add(const Event& event)
{
    last_ = event;
    // Once one event is lost, the following are lost too until the overflow was fetched: else the overflow
    // would be in the wrong place.
    if (lost_ || !events_.push(event)) lost_ = true;
}

void PendingEvents::add_once(const Event& event)
{
    if (event != last_) add(event);
}

std::optional<Event> PendingEvents::take(State state, std::uint8_t master)
{
    if (events_.empty() && lost_) {
        lost_ = false;
        return Event{.kind = Event::Kind::overflow, .state = state, .master = master};
    }
    return events_.pop();
}

} // namespace dpslave::dp
