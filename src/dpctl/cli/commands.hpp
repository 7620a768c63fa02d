// SPDX-License-Identifier: Apache-2.0
/// The table of the commands. `gsd` has its own (dpctl/gsd/gsd.hpp).
#pragma once

#include "subcommands.hpp"

#include <span>
#include <string>

namespace CLI {
class App;
}

namespace dpslave::dpctl {

inline constexpr const char* kOffline = "Offline";

struct Command {
    const char* name;
    const char* group; ///< heading in the help
    const char* help;
    const char* json;     ///< what --json prints: the method whose reply it is, or the form of the object
    const char* exits;    ///< exit codes
    const char* examples; ///< a line each; may be empty
    void (*arguments)(CLI::App&, Options&);
    int (*run)(const Options&, Terminal&);
};

std::span<const Command> commands();

/// What stands below the options in the help of a command: examples, JSON, exit codes.
std::string footer_of(const Command& command);
/// And in the help of the program.
extern const char* const kFooter;

} // namespace dpslave::dpctl
