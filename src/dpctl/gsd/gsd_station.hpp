// SPDX-License-Identifier: Apache-2.0
/// What the daemon says of a station, as the check of a GSD file wants it.
#pragma once

#include "dpctl/cli/session.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/configurator/station_check.hpp"

namespace dpslave::dpctl {

struct FetchedStation {
    configurator::RunningStation station;
    std::string tag_table; ///< its path on the machine of the daemon
};

/// This station, or the exit code of a failure that is printed already.
Result<FetchedStation, int> fetch_station(const std::string& station, Session& session);

} // namespace dpslave::dpctl
