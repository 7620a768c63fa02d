// SPDX-License-Identifier: Apache-2.0
/// The lamps of a device: from the condition of a station to the pattern of each lamp. It is pure.
/// Source: HA389815 ch. 9 (rows A-084); HA463561U002, "Understanding the LED Indications" (B-030 to
/// B-035); 2408f/2404f handbook ch. 4 (C-009).
#pragma once

#include "dpslave/base/option_state.hpp"
#include "dpslave/base/units.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::led {

/// The conditions that the lamps show.
struct Condition {
    bool running = false;       ///< the gateway serves this station at all
    bool data_exchange = false; ///< with the master
    bool drive_answers = true;  ///< the link to the drive
    // These are of a technology box only:
    OptionFault fault = OptionFault::none;
    NetworkState network = NetworkState::disabled;
    bool health = false; ///< of the drive, mirrored while it answers
    bool run = false;    ///< likewise
};

/// One lamp shows a square wave; period 0 = steady.
struct Pattern {
    std::chrono::milliseconds period{0};
    std::chrono::milliseconds on{0}; ///< lit from the start of each period; with period 0: > 0 = lit
    friend bool operator==(const Pattern&, const Pattern&) = default;
};

struct Lamp {
    std::string_view name; ///< "red", "network" ...: the key of [station.leds]
    Pattern pattern;
};

/// The lamp language of a profile.
enum class Language : std::uint8_t {
    option_board,     ///< 584S, 590: red steady for an internal fault
    option_board_620, ///< red flashes 2 Hz for an internal fault (X-32)
    technology_box,   ///< network, module, health, run (HA463561U002; B-030 to B-035)
    controller,       ///< rem: the REM beacon of a 2408f/2404f flashes while data exchange runs (C-009)
};

/// Returns the lamps of this language. Those of the option board are in the order of their places (red left,
/// green right), those of the technology box are network, module, health, run.
std::vector<Lamp> lamps(Language language, const Condition& condition);

/// Returns the meaning in words, for `dpctl show`: "normal operation: data exchange with the master" ...
std::string_view meaning(Language language, const Condition& condition);

/// Returns what a lamp shows, as the manual of this language calls it: "off", "on", "flashing 2 Hz"; for a
/// technology box "short flash (10 % of 1 s)", "flash (50 % of 1 s)", "long flash (90 % of 1 s)" (B-034).
std::string words(Language language, const Pattern& pattern);

/// Is a lamp with this pattern lit at `now`? All lamps share the time line: equal patterns flash together.
bool lit(const Pattern& pattern, Instant now);

/// Returns when a lamp with this pattern changes next after `now`; kNever = steady.
Instant next_change(const Pattern& pattern, Instant now);

} // namespace dpslave::led
