// SPDX-License-Identifier: Apache-2.0
/// The profile that a question names, with the tag table of the user's own in it.
#pragma once

#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/io_map.hpp"

#include <optional>
#include <string>

namespace dpslave::configurator {

/// Returns nullopt if it cannot be loaded; `outcome` then says why. `table`: empty = that of the profile.
std::optional<profile::Profile> load(const Files& files, const std::string& name, const std::string& table,
                                     Outcome& outcome);
/// The profile of a mapping. Its tags are those of `table`, else of the mapping's own table, else its own.
std::optional<profile::Profile> load(const Files& files, const profile::Mapping& mapping,
                                     const std::string& table, Outcome& outcome);
/// Returns the names of the values of a file's I/O map, and where its tags begin. `profile` and `table`:
/// either may be empty. If one cannot be read, `outcome` says why.
gsd::MapHints hints_of(const Files& files, const std::string& profile, const std::string& table,
                       const gsd::Document& document, Outcome& outcome);

} // namespace dpslave::configurator
