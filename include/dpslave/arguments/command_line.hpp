// SPDX-License-Identifier: Apache-2.0
/// A command line, read by CLI11. The sentences and the help that a person sees are the project's own.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace dpslave::arguments {

/// Reads `words` into the options of `app`. Nothing: they are read, go on. Otherwise the exit status: the
/// help, the version or what is wrong has been printed.
std::optional<int> read_command_line(CLI::App& app, const std::string& version,
                                     std::vector<std::string> words, std::ostream& out, std::ostream& err);

} // namespace dpslave::arguments
