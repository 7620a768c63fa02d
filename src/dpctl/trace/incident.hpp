// SPDX-License-Identifier: Apache-2.0
/// The incidents of the daemon: the list, and the telegrams of one.
#pragma once

#include "dpctl/cli/session.hpp"
#include "line_entry.hpp"
#include "trace_options.hpp"
#include "trace_text.hpp"

#include "dpslave/report/incident.hpp"
#include "dpslave/report/replies.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// `dpctl trace --incidents`. Gives the exit code.
int list_incidents(Session& session);

/// `dpctl trace --incident N`: the head, as text or JSON unless a capture is written, then each entry, those
/// of the bus first, then line by line. One that was before has the note kBefore, the cause kCause.
/// `ended_at`: the last moment, since 1970. Gives the exit code.
int print_incident(const TraceOptions& options, Session& session, const EntryPrinter& print,
                   std::int64_t& ended_at);

// Pure parts.

std::string render_incidents(const report::ListIncidentsReply& reply, Look look);
std::string render_incident(const report::IncidentHead& head);
/// What brings `stations` to Data_Exch: of each Set_Prm and Chk_Cfg of its master, with their SC, before the
/// first entry of `behind`. A station that was not there at that time (its start-up is in `behind`), or whose
/// parameters are not known, has none.
std::vector<trace::Entry> start_up(const std::vector<report::IncidentStation>& stations,
                                   const std::vector<trace::Entry>& behind);

/// Which of the telegrams is the cause that the head names: the Set_Prm or Chk_Cfg that was refused or that
/// ended the exchange, the Data_Exchange of another length, the last request of a master that was lost. The
/// last one up to the moment. Nothing: the cause is on a drive line, or it is no single telegram.
std::optional<std::size_t> cause_in(const report::IncidentHead& head,
                                    const std::vector<trace::Entry>& telegrams);
/// The same of the frames of the drive lines: the question that got no answer, the answer that was refused.
std::optional<std::size_t> cause_in(const report::IncidentHead& head, const std::vector<LineEntry>& frames);

} // namespace dpslave::dpctl
