// SPDX-License-Identifier: Apache-2.0
/// Drives that are lost or answer again, as the main thread sees them. Pure; main thread only.
#pragma once

#include "app/main/station.hpp"
#include "event_history.hpp"

#include <map>
#include <span>

namespace dpslave::app {

class DriveNews {
public:
    /// Adds what is different since the last call. A drive of which nothing is known yet is no news, nor is a
    /// port that was not open yet.
    void look(std::span<const Station> stations, EventHistory& events, Instant now);

private:
    enum class Link : std::uint8_t { unknown, answers, silent, port_gone };
    static Link link_of(const Station& station);

    std::map<std::uint32_t, Link> known_; ///< by the number of the station
};

} // namespace dpslave::app
