// SPDX-License-Identifier: Apache-2.0
/// What a station of the new file means for the one of the present file that it continues.
/// docs/guide/reload.md has the table of keys.
#pragma once

#include "differences.hpp"
#include "reload_plan.hpp"

namespace dpslave::app {

/// Keys and rows that differ, in words.
struct StationChange {
    Differences leaves;  ///< why it cannot stay on the bus: "unit"; empty: it can
    Differences applied; ///< what is applied while it is there: "output_refresh_s, other lamps"
};

/// `now` has the address that is to be in force. Lines are not looked at.
StationChange change_of(const config::StationConfig& before, const config::StationConfig& now,
                        const InForce& in_force);

} // namespace dpslave::app
