// SPDX-License-Identifier: Apache-2.0
/// The mapping of a GSD file whose profile is known.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/gsd/document.hpp"
#include "dpslave/profile/gsd_device.hpp"

#include <string>
#include <vector>

namespace dpslave::configurator {

/// The failure is sentences.
Result<profile::Mapping, std::vector<std::string>> mapping_of_file(const gsd::Document& document,
                                                                   const profile::Profile& profile);

} // namespace dpslave::configurator
