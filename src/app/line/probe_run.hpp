// SPDX-License-Identifier: Apache-2.0
/// Asks by the plan of line_probe.hpp, which blocks the drive thread until it is over.
#pragma once

#include "app/links/links.hpp"
#include "line_unit.hpp"

#include "dpslave/config/config.hpp"

#include <stop_token>
#include <vector>

namespace dpslave::app {

/// Looks for the drive of `unit` on `line` with other rates, formats and units, until it answers, all was
/// asked, LineLink::probe_ended has the order's number, or `stop`. No back-end of the line has the port
/// meanwhile. `units`: all of the line; the address of another one is not asked.
ProbeReport run_probe(const ProbeOrder& order, const config::LineConfig& line, const LineUnit& unit,
                      const std::vector<LineUnit>& units, LineLink& link, const std::stop_token& stop);

} // namespace dpslave::app
