// SPDX-License-Identifier: Apache-2.0
/// What is known of a drive while its line stalls. Pure.
#pragma once

#include "dpslave/drive/poller.hpp"

namespace dpslave::app {

/// `drive`: as its line said it before it stalled. Afterwards it is that of a drive that does not answer: no
/// word is good any more. `when`: of the station.
void make_old(drive::DriveSnapshot& drive, drive::WhenLost when);

} // namespace dpslave::app
