// SPDX-License-Identifier: Apache-2.0
/// The reply of GetStatus, of all stations or of one.
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/subcommands.hpp"

#include "dpslave/base/result.hpp"

namespace dpslave::dpctl {

/// Of `options.station` only, if it is set. An unknown station is reported, and its exit code returned.
Result<Json, int> ask_status(const Options& options, Terminal& terminal);
void print_status(const Json& reply, const Options& options, Terminal& terminal);

} // namespace dpslave::dpctl
