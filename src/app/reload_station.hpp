// SPDX-License-Identifier: Apache-2.0
/// What a station of the new file means for the one of the present file that it continues. docs/reload.md has
/// the table of keys.
#pragma once

#include "dpslave/app/reload_plan.hpp"

#include <string>

namespace dpslave::app {

/// Keys and rows that differ, in words.
struct StationChange {
    std::string leaves;  ///< why it cannot stay on the bus: "unit"; empty: it can
    std::string applied; ///< what is applied while it is there: "output_refresh_s, other lamps"; may be empty
};

/// `now` has the address that is to be in force. Lines are not looked at.
StationChange change_of(const StationConfig& before, const StationConfig& now, const InForce& in_force);

} // namespace dpslave::app
