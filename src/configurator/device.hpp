// SPDX-License-Identifier: Apache-2.0
/// The profile that a question names, with the tag table of the user's own in it.
#pragma once

#include "dpslave/configurator/configurator.hpp"

#include <optional>
#include <string>

namespace dpslave::configurator {

/// Nothing: `outcome` says why.
std::optional<profile::Profile> load(const Files& files, const std::string& name, Outcome& outcome);
std::optional<drive::TagTable> own_table(const Files& files, const std::string& table, Outcome& outcome);

} // namespace dpslave::configurator
