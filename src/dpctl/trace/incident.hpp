// SPDX-License-Identifier: Apache-2.0
/// The incidents of the daemon: the list, and the telegrams of one.
#pragma once

#include "dpctl/cli/subcommands.hpp"
#include "line_entry.hpp"
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

/// What prints the entries of an incident, those of the bus first, then line by line.
struct IncidentPrinter {
    /// With a note where it is not an entry of the wire.
    std::function<void(const trace::Entry&, UnixOffset, std::string_view note)> telegram;
    std::function<void(const LineEntry&, UnixOffset)> frame;
};
/// `dpctl trace --incident N`: the head, as text or JSON unless a capture is written, then each entry.
/// `ended_at`: the last moment, since 1970. Gives the exit code.
int print_incident(const Options& options, Terminal& terminal, const IncidentPrinter& print,
                   std::int64_t& ended_at);

// Pure parts.

std::string render_incidents(const report::ListIncidentsReply& reply, Look look);
std::string render_incident(const report::IncidentHead& head);
/// What brings `stations` to Data_Exch: of each Set_Prm and Chk_Cfg of its master, with their SC, before the
/// first entry of `behind`. A station that was not there at that time (its start-up is in `behind`), or whose
/// parameters are not known, has none.
std::vector<trace::Entry> start_up(const std::vector<report::IncidentStation>& stations,
                                   const std::vector<trace::Entry>& behind);

} // namespace dpslave::dpctl
