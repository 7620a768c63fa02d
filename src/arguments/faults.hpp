// SPDX-License-Identifier: Apache-2.0
/// Says what is wrong with a command line, in sentences of the project.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace dpslave::arguments {

/// Returns the sentence for the first word that should be a command and is none; nullopt if there is no such
/// word.
std::optional<std::string> wrong_command(const CLI::App& app, const std::vector<std::string>& words);

/// Returns the sentence for what CLI11 has refused.
std::string sentence_of(const CLI::ParseError& error, const CLI::App& app);

} // namespace dpslave::arguments
