// SPDX-License-Identifier: Apache-2.0
/// Replies of the daemon as text for people. Pure: the parameters of a reply in, lines out.
#pragma once

#include "fields.hpp"
#include "table.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

std::string render_status(const Json& reply, Look look);
std::string render_stations(const Json& reply, Look look);
/// `version`: of the daemon, which is what OPTION VERSION of the board was.
std::string render_info(const Json& reply, std::string_view version, Look look);
std::string render_io(const Json& reply, Look look);
std::string render_diagnosis(const Json& reply, Look look);
std::string render_counters(const Json& reply, Look look);
std::string render_leds(const Json& reply, Look look);
/// TEC OPTION, with the three steps of its set-up where it is not set up (B-054).
std::string render_tec(const Json& reply, Look look);
/// What a reload changes, or why it is refused; of a dry run also who would leave the bus.
std::string render_reload(const Json& reply, bool is_dry_run);
/// A tag read or written.
std::string render_tag(const Json& reply, std::string_view verb);
/// The whole picture of `watch`.
std::string render_watch(const Json& reply, Look look);

/// What is different in `now`, a line each; everything when there was nothing before.
std::vector<std::string> changes(const Json& before, const Json& now);

} // namespace dpslave::dpctl
