// SPDX-License-Identifier: Apache-2.0
/// The incidents of the daemon: the list, and the telegrams of one.
#pragma once

#include "dpctl/cli/subcommands.hpp"
#include "trace_text.hpp"

#include "dpslave/report/incident.hpp"
#include "dpslave/report/replies.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// `dpctl trace --incidents`. Gives the exit code.
int list_incidents(const Options& options, Terminal& terminal);

/// Prints an entry, with a note where it is not one of the wire.
using PrintEntry = std::function<void(const trace::Entry&, UnixOffset, std::string_view note)>;
/// `dpctl trace --incident N`: the head, as text or JSON unless a capture is written, then each telegram.
/// `ended_at`: the last moment, since 1970. Gives the exit code.
int print_incident(const Options& options, Terminal& terminal, const PrintEntry& print,
                   std::int64_t& ended_at);

// Pure parts.

std::string render_incidents(const report::ListIncidentsReply& reply, Look look);
std::string render_incident(const report::IncidentHead& head);
/// The start-up that brings a slave with the parameters of `station` to Data_Exch: Set_Prm and Chk_Cfg of its
/// master, each with its SC. None if it was not there, or they are not known.
std::vector<trace::Entry> start_up(const report::IncidentStation& station, Baud baud, Instant before);

} // namespace dpslave::dpctl
