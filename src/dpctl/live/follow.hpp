// SPDX-License-Identifier: Apache-2.0
/// `status --follow` and `io --follow`: the replies of Watch, redrawn on a terminal, elsewhere their changes.
#pragma once

#include "dpctl/cli/session.hpp"
#include "dpctl/cli/table.hpp"

#include <string>
#include <vector>

namespace dpslave::dpctl {

/// What of the replies of Watch a command follows.
struct Followed {
    std::string (*picture)(const Json& now, Look look);
    std::vector<std::string> (*changes)(const Json& before, const Json& now);
};

/// Until Ctrl-C. Gives the exit code.
int follow_pictures(const Followed& followed, const std::string& station, Session& session);

} // namespace dpslave::dpctl
