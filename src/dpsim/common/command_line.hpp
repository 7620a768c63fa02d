// SPDX-License-Identifier: Apache-2.0
/// The commands of dpsim and their options.
#pragma once

#include "dpsim/common/programs.hpp"
#include "dpsim/master/master_options.hpp"

namespace CLI {
class App;
}

namespace dpslave::sim {

/// The content of the command line.
struct CommandLine {
    LineOptions line;
    DriveOptions drive;
    MasterOptions master;
    MasterTexts texts;
    ReplayOptions replay;
};

/// All commands, which write into `into`.
void add_commands(CLI::App& app, CommandLine& into);

} // namespace dpslave::sim
