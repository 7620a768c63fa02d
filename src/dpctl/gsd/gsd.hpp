// SPDX-License-Identifier: Apache-2.0
/// `dpctl gsd`: GSD and type files for the master's tool. Needs no daemon.
#pragma once

#include "dpctl/cli/subcommands.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace dpslave::dpctl {

/// Adds the subcommand with its own subcommands; the one that the command line names goes into `chosen`,
/// which outlives the parsing. Both are kept by reference.
void add_gsd(CLI::App& app, Action& chosen);

} // namespace dpslave::dpctl
