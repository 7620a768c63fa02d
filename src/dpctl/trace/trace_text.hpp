// SPDX-License-Identifier: Apache-2.0
/// Entries of a trace as lines of text, as JSON and as packets of a capture. Pure, but for the time zone.
#pragma once

#include "dpctl/cli/fields.hpp"

#include "dpslave/fdl/telegram.hpp"
#include "dpslave/pcapng/pcapng.hpp"
#include "dpslave/trace/telegrams.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace dpslave::dpctl {

/// The telegram of an entry; nothing: its octets are none, from the first to the last. It points into them.
std::optional<fdl::Telegram> telegram_of(const trace::Entry& entry);

/// Which entries are shown.
struct TraceFilter {
    std::optional<std::uint8_t> address; ///< as sender or receiver
    std::string service;                 ///< a part of its name, in any case; empty = all
    bool bad = false;                    ///< only what is no telegram, unanswered or lost
};

/// What an entry is, in the words of the field.
struct TraceWords {
    std::optional<std::uint8_t> from, to; ///< none: the telegram does not say (SC), or it is none
    std::string service;                  ///< "Set_Prm", "Data_Exchange, reply", "no telegram: checksum"
};
TraceWords words_of(const trace::Entry& entry);
bool passes(const TraceFilter& filter, const trace::Entry& entry, const TraceWords& words);

/// From the clock of the records to CLOCK_REALTIME.
using UnixOffset = std::chrono::nanoseconds;
std::int64_t unix_ns(Instant at, UnixOffset offset);
/// The first two columns of a line: local time of day to the microsecond, and the seconds since `before`.
std::string time_columns(Instant first, UnixOffset offset, std::optional<Instant> before);

/// One line: time, seconds since the entry before, sender > receiver, service, octets. `before`: the last
/// character of the entry before.
std::string line_of(const trace::Entry& entry, const TraceWords& words, UnixOffset offset,
                    std::optional<Instant> before);
Json json_of(const trace::Entry& entry, const TraceWords& words, UnixOffset offset);

/// Nothing: it is no packet (a change of the rate, a gap in the records).
std::optional<pcapng::Packet> packet_of(const trace::Entry& entry, const TraceWords& words,
                                        UnixOffset offset);
/// The entry of a packet that packet_of() made, without its times and its rate; of a packet of another
/// program, if it is a telegram or a reply. Nothing: it is none of them.
std::optional<trace::Entry> entry_of(const pcapng::Packet& packet);
/// The first comment that packet_of() did not make; empty: there is none.
std::string_view note_of(const pcapng::Packet& packet);

} // namespace dpslave::dpctl
