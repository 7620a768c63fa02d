// SPDX-License-Identifier: Apache-2.0
/// The tables of rules, one a family, and what they look at. They go by states, codes and counters of the
/// daemon, never by its sentences. Steps are those of the manuals, with what the gateway has in the place of
/// the board's own switches and with the command that shows more.
#pragma once

#include "doctor.hpp"

#include <array>

namespace dpslave::dpctl {

std::span<const Rule> port_rules();
std::span<const Rule> bus_rules();
std::span<const Rule> drive_rules();
std::span<const Rule> board_rules();
std::span<const Rule> box_rules();
std::span<const Rule> controller_rules();
std::span<const Rule> station_rules();
std::span<const Rule> lamp_rules();

// Where a rule comes from.
inline constexpr std::string_view kGateway = "dpslaved";
inline constexpr std::string_view kBoard = "HA389815 chapter 9";
inline constexpr std::string_view kBox = "HA463561U002, Troubleshooting";
inline constexpr std::string_view kHandbook = "2408f/2404f handbook chapter 6";

bool is_in(const Facts& f, std::string_view state);
bool exchanges(const Facts& f);

/// One counter: since the start, within the last minute, and when.
struct Count {
    std::int64_t total = 0;
    std::int64_t minute = 0;
    std::optional<double> last_ms;  ///< age of the last one; none = never
    std::optional<double> since_ms; ///< how long it has counted without a quiet minute
    /// It counted within this time; exact to the second.
    bool within(double ms) const { return last_ms && *last_ms <= ms; }
};
Count counted(const report::CounterGroup& group, std::string_view name);
/// "in the last minute, since 12 min": for how long it has counted.
std::string lately(const Count& count);

/// Has a master asked this station for anything but its FDL status within the last ten seconds?
bool is_asked(const report::CounterGroup& station_counters);
/// Octets come from the bus, or the port is not there: what is wrong then is no silence.
bool bus_is_heard(const Facts& f);
/// Telegrams with a checksum come from the bus.
bool telegrams_are_heard(const Facts& f);
/// The station waits for a master, and too little time has passed since the start to say why. The counters
/// are looked at once a second.
bool has_just_started(const Facts& f);

// Each of these says what it sees in words, or nothing.
/// Nothing, or nothing that has a checksum, is heard on the bus.
std::string silence(const Facts& f);
/// Silence of the bus, or what the master does not do.
std::string no_exchange(const Facts& f);
std::string not_asked(const Facts& f); ///< what is heard in place of a request for the station
/// The last refused telegram.
std::string refusal(const Facts& f);
/// What the drive or the tag table said no to, for the master.
std::string tag_trouble(const Facts& f);
std::string drive_silence(const Facts& f);
/// How often Data_Exch was left, where that is more than once in the last minute.
std::string restlessness(const Facts& f);
/// Does the last way out of Data_Exch have a rule of its own?
bool master_left(const Facts& f);

} // namespace dpslave::dpctl
