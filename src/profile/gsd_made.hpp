// SPDX-License-Identifier: Apache-2.0
/// The device of a selection, before a station judges its file.
#pragma once

#include "dpslave/profile/gsd_device.hpp"

namespace dpslave::profile {

Draft made(const Profile& profile, const Selection& selection);

} // namespace dpslave::profile
