// SPDX-License-Identifier: Apache-2.0
/// Decides for a drive line whether the threads that it works for still go round. Pure: times come in,
/// a decision goes out.
///
/// Nobody tells a line that the bus thread has stalled, or the main thread. Then no master is heard any more,
/// and its outputs stand. So the master counts as lost, as long before the watchdog ends the program as the
/// drives need for their safe state.
#pragma once

#include "app/links/links.hpp"

#include "dpslave/base/sign_of_life.hpp"

#include <string_view>

namespace dpslave::app {

class OtherThreads {
public:
    /// Call it at least every Silence::kLongestLook. `bus`, `main`: their newest signs; one that has given
    /// none yet does not count. True: since this call one of them has stalled.
    bool look(Instant bus, Instant main, Instant now)
    {
        const bool bus_stalls = bus_.look(bus, now) >= kBusThreadMayStall;
        const bool main_stalls = main_.look(main, now) >= kMainThreadMayStall;
        const bool is_new = (bus_stalls && !bus_stalls_) || (main_stalls && !main_stalls_);
        bus_stalls_ = bus_stalls;
        main_stalls_ = main_stalls;
        return is_new;
    }
    /// The one that has stalled, as a text names it; "": none.
    std::string_view which() const
    {
        if (bus_stalls_) return "bus thread";
        return main_stalls_ ? "main thread" : "";
    }

private:
    Silence bus_, main_;
    bool bus_stalls_ = false, main_stalls_ = false;
};

} // namespace dpslave::app
