// SPDX-License-Identifier: Apache-2.0
/// The table [gsd] of a profile.
#pragma once

#include "dpslave/input/document.hpp"
#include "dpslave/profile/profile.hpp"

namespace dpslave::profile {

/// `table` is [gsd]; `profile` is what the rest of the file said already. A wrong value becomes a fault of
/// the table's document.
GsdFacts read_gsd_facts(input::Table& table, const Profile& profile);

} // namespace dpslave::profile
