// SPDX-License-Identifier: Apache-2.0
/// Which command was perhaps meant.
#pragma once

#include "terminal.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dpslave::dpctl {

/// Names the first of `arguments` that should be a command and is none, and the command that is nearest to
/// it, if one is near. False: each is one.
bool suggest(const CLI::App& app, const std::vector<std::string>& arguments, Terminal& terminal);

} // namespace dpslave::dpctl
