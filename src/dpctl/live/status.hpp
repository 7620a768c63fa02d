// SPDX-License-Identifier: Apache-2.0
/// The reply of GetStatus, of all stations or of one.
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/subcommands.hpp"

#include "dpslave/base/result.hpp"

namespace dpslave::dpctl {

/// Of `options.station` only, if one is said. If there is none, that was told, and the exit code comes back.
Result<Json, int> ask_status(const Options& options, Terminal& terminal);
void print_status(const Json& reply, const Options& options, Terminal& terminal);

} // namespace dpslave::dpctl
