// SPDX-License-Identifier: Apache-2.0
/// The command line of dpctl: a table of subcommands.
#pragma once

#include "terminal.hpp"

#include <string>
#include <vector>

namespace dpslave::dpctl {

/// Does what `arguments` (without the program's name) say. Returns the exit code.
int run(const std::vector<std::string>& arguments, Terminal& terminal);

} // namespace dpslave::dpctl
