// SPDX-License-Identifier: Apache-2.0
/// The command of dpctl that makes a GSD file again.
#pragma once

#include "dpslave/profile/gsd_device.hpp"

#include <string>
#include <vector>

namespace dpslave::profile {

std::string hex_of(std::uint16_t word); ///< "0x0533"

/// Returns the command without what the profile says itself, and without where the file is written to.
/// `words`: empty for the profile's own mapping; `description`: what the file says without one.
std::string make_command(const Profile& profile, const Selection& selection,
                         const std::optional<std::vector<GsdParameter>>& words,
                         const std::string& description);

} // namespace dpslave::profile
