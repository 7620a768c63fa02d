// SPDX-License-Identifier: Apache-2.0
/// A command of dpctl is one file in src/dpctl/commands: its options, set_up(), run() and its row.
#pragma once

#include "session.hpp"

#include <functional>
#include <memory>
#include <string>
#include <type_traits>

namespace CLI {
class App;
}

namespace dpslave::dpctl {

/// Headings in the help.
inline constexpr const char* kLook = "Look";
inline constexpr const char* kWatch = "Watch";
inline constexpr const char* kOperate = "Operate";
inline constexpr const char* kOffline = "Offline";

/// Does what the command line says. Gives the exit code.
using Action = std::function<int(Session&)>;

/// --json prints what the manual page describes.
inline constexpr const char* kOwnForm = "{}";

enum class Asks : std::uint8_t { daemon, nobody };

/// The row of a command.
struct Command {
    const char* name;  ///< "read"; of a command below another one both names: "gsd check"
    const char* group; ///< heading in the help
    const char* help;
    /// Adds the options to the command line. Null: the command only has commands below it.
    Action (*add)(CLI::App& app);
    const char* json = "";     ///< what --json prints: the method whose reply it is, or kOwnForm
    const char* examples = ""; ///< a line each
    const char* exits = "";    ///< what 0 or 1 says of this command; empty: as of all
    Asks asks = Asks::daemon;
};

/// Command::add of a command whose options are an `Options`: set_up() puts them on the command line, run()
/// takes them. Options without a member need no set_up().
template <class Options>
Action add(CLI::App& app)
{
    const auto options = std::make_shared<Options>();
    if constexpr (!std::is_empty_v<Options>) set_up(app, *options);
    return [options](Session& session) { return run(*options, session); };
}

/// What stands below the options in the help of a command: examples, JSON, exit status.
std::string footer_of(const Command& command);

} // namespace dpslave::dpctl
