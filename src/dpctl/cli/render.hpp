// SPDX-License-Identifier: Apache-2.0
/// Replies of the daemon as text. Pure: the parameters of a reply in, lines out.
#pragma once

#include "fields.hpp"
#include "table.hpp"

#include "dpslave/report/replies.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

std::string render_status(const Json& reply, Look look);
/// `document` as the manual page of dpctl describes it.
std::string render_show(const Json& document, Look look);
std::string render_io(const Json& reply, Look look);
std::string render_diagnosis(const Json& reply, Look look);
std::string render_counters(const Json& reply, Look look);
/// One line for each address, then whom the masters ask without an answer.
std::string render_bus(const report::GetBusReply& reply, Look look);
/// TEC OPTION of a station, with the three steps of its set-up where it is not set up (B-054).
std::string render_tec(const report::Tec& tec, Look look);
/// What a reload changes, or why it is refused; of a dry run also who would leave the bus.
std::string render_reload(const report::ReloadReply& reply, bool is_dry_run);
/// "info"; "debug, for 9 min more".
std::string log_level_text(const report::Log& log);
/// A line for each event, with the time of day. `now`: seconds since 1970, in which the ages count back.
std::string render_events(const report::GetEventsReply& reply, double now);
/// A tag read or written.
std::string render_tag(const Json& reply, std::string_view verb);
/// The whole picture of `status --follow` and `io --follow`, of a reply of Watch.
std::string render_followed_status(const Json& reply, Look look);
std::string render_followed_io(const Json& reply, Look look);

/// What is different in `now`, a reply of Watch, a line each; everything when there was nothing before.
std::vector<std::string> status_changes(const Json& before, const Json& now);
std::vector<std::string> io_changes(const Json& before, const Json& now);

} // namespace dpslave::dpctl
