// SPDX-License-Identifier: Apache-2.0
/// Asks by the plan of line_probe.hpp, which blocks the drive thread until it is over.
#pragma once

#include "app/links/links.hpp"
#include "line_unit.hpp"

#include "dpslave/config/config.hpp"

#include <functional>
#include <vector>

namespace dpslave::app {

/// Looks for the drive of `unit` on `line` with other rates, formats and units, until it answers, all was
/// asked, or `has_to_end()`, which is called before each question. No back-end of the line has the port
/// meanwhile. `units`: all of the line; the address of another one is not asked.
ProbeReport run_probe(const ProbeOrder& order, const config::LineConfig& line, const LineUnit& unit,
                      const std::vector<LineUnit>& units, LineLink& link,
                      const std::function<bool()>& has_to_end);

} // namespace dpslave::app
