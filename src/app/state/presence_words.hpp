// SPDX-License-Identifier: Apache-2.0
/// What log, events, dpctl and doctor say of a drive that is gone or back. Pure.
#pragma once

#include "station.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::app {

/// A line for the log.
struct Sentence {
    bool is_warning = false;
    std::string text;
};

/// Why the station is silent, or asks for diagnosis, and what to do; empty: its drive is here, or nothing
/// follows from it (when_drive_lost = "hold").
std::string gone_words(const Station& station);

/// Of the tag of DriveSnapshot::not_zeroed.
std::string not_zeroed_words(std::uint16_t tag);

/// One sentence for each time that the drive was found gone, and one for its return.
class PresenceNews {
public:
    std::vector<Sentence> take(const Station& station);

private:
    std::uint32_t departures_ = 0;
    drive::DrivePresence presence_ = drive::DrivePresence::awaited;
    std::uint16_t not_zeroed_ = 0;
};

} // namespace dpslave::app
