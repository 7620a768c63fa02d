// SPDX-License-Identifier: Apache-2.0
/// What the bench measures on the simulated clock: the same figures on every machine.
#pragma once

#include "rows.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace dpslave::bench {

/// M6: the refresh cycle against the time that its frames and the drive's turnaround take. `curves` gets the
/// times of each cycle.
std::vector<Row> measure_refresh(nlohmann::json& curves);
/// M7: how long Demand Data takes under a full refresh, against the longest transaction of the refresh.
Row measure_demand_data(bool quick);
/// M11: telegrams behind garbage, and telegrams on a line with bit errors.
std::vector<Row> measure_noise(bool quick);

} // namespace dpslave::bench
