// SPDX-License-Identifier: Apache-2.0
/// Looking for a drive that was never heard, for `dpctl doctor --probe`: a search as in drive/line_search.hpp
/// that begins with the settings of the line. Pure.
#pragma once

#include "dpslave/config/config.hpp"
#include "dpslave/drive/line_search.hpp"

#include <chrono>
#include <vector>

namespace dpslave::app {

/// How long one question may take: the line's timeout, within 100 and 300 ms.
std::chrono::milliseconds probe_timeout(const config::LineConfig& line);

/// `others`: the units of the other stations of the line. What answers there is not the drive looked for.
drive::LineSearch probe_search(const config::LineConfig& line, const config::StationConfig& station,
                               const std::vector<drive::UnitAddress>& others);

} // namespace dpslave::app
