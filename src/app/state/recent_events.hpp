// SPDX-License-Identifier: Apache-2.0
/// What happened, for `dpctl events`: a bounded list, oldest first. Pure; main thread only. The bus thread
/// has no part in it: its own events come over the rings that the log has, too.
#pragma once

#include "dpslave/base/units.hpp"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace dpslave::app {

/// What an event is about; code() has its word in the control interface.
enum class Happened : std::uint8_t {
    state,   ///< a station has another state of the bus, or another master
    refused, ///< a Set_Prm or Chk_Cfg was refused
    drive,   ///< a drive is lost or answers again, or the port of its line
    device,  ///< fault, network state, trip: what the device of a station reports
    port,    ///< the port of the bus or its driver enable
    write,   ///< an operator wrote a tag
    setting, ///< an operator set an input of the function block, or the level of the log
    reload,  ///< the configuration was read again
    daemon,  ///< the daemon started
};
std::string_view code(Happened kind) noexcept; ///< "state", "refused" ...

class RecentEvents {
public:
    static constexpr std::size_t kMost = 1000;   ///< events
    static constexpr std::size_t kLongest = 400; ///< octets of a text; what is longer is cut
    /// Equal events within this time of the first of them are one with a count, if nothing else of their kind
    /// and station lies between.
    static constexpr std::chrono::seconds kJoined{10};
    /// Of so many of a kind and a station within that time further equal ones join, whatever lies between.
    static constexpr std::size_t kMostOfOne = 8;

    struct Event {
        std::uint64_t number = 0; ///< the first is 1
        Instant at{};
        std::string station; ///< its name; empty: the bus or the daemon
        Happened kind = Happened::state;
        std::string text;
        std::uint64_t count = 1;
        std::string key{}; ///< what makes events equal
    };

    /// `station`: its name; empty: of none.
    void add(Happened kind, std::string_view station, std::string_view text, Instant now);
    /// Events are equal if their keys are, whatever values are in `text`; the newest text stands.
    void add(Happened kind, std::string_view station, std::string_view text, std::string_view key,
             Instant now);
    /// At most kMost, by number.
    const std::deque<Event>& events() const { return events_; }
    /// Number of the newest; 0: there is none.
    std::uint64_t newest() const { return newest_; }

private:
    Event* to_join(Happened kind, std::string_view station, std::string_view key, Instant now);

    std::deque<Event> events_;
    std::uint64_t newest_ = 0;
};

} // namespace dpslave::app
