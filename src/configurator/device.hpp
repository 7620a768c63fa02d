// SPDX-License-Identifier: Apache-2.0
/// The profile that a question names, with the tag table of the user's own in it.
#pragma once

#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/io_map.hpp"

#include <optional>
#include <string>

namespace dpslave::configurator {

/// Nothing: `outcome` says why. `table`: empty = that of the profile.
std::optional<profile::Profile> load(const Files& files, const std::string& name, const std::string& table,
                                     Outcome& outcome);
/// The profile of a mapping. Its tags are those of `table`, else of the mapping's own table, else its own.
std::optional<profile::Profile> load(const Files& files, const profile::Mapping& mapping,
                                     const std::string& table, Outcome& outcome);
/// What the values of an I/O map are called. `profile` and `table`: either may be empty. Where one cannot be
/// read, `outcome` says why.
gsd::MapHints hints_of(const Files& files, const std::string& profile, const std::string& table,
                       Outcome& outcome);

} // namespace dpslave::configurator
