// SPDX-License-Identifier: Apache-2.0
/// The table [gsd] of a profile.
#pragma once

#include "dpslave/profile/profile.hpp"
#include "dpslave/toml/document.hpp"

namespace dpslave::profile {

/// `table` is [gsd]; `profile` is what the rest of the file said already. What does not fit becomes a fault
/// of the table's document.
GsdFacts read_gsd_facts(toml::Table& table, const Profile& profile);

} // namespace dpslave::profile
