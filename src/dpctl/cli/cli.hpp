// SPDX-License-Identifier: Apache-2.0
/// The command line of dpctl, made from the table of the commands (dpctl/commands/commands.hpp).
#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace dpslave::dpctl {

/// Does what `words` (without the program's name) say. Returns the exit status.
int run(std::vector<std::string> words, Terminal& terminal);

/// What the command line chose.
struct Chosen {
    CommonOptions common;
    Action run; ///< without a command: that of `status`
};

/// All commands with their options. What is parsed goes into `chosen`, which outlives the parsing.
void add_command_line(CLI::App& app, Chosen& chosen);

} // namespace dpslave::dpctl
