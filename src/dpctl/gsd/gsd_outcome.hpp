// SPDX-License-Identifier: Apache-2.0
/// What the commands of `dpctl gsd` share: options, and how an outcome of the configurator is printed.
#pragma once

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/session.hpp"
#include "dpctl/cli/whole_file.hpp"

#include "dpslave/configurator/configurator.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// --output: the file, or the folder, that is written; empty: standard output.
struct OutputOption {
    std::string output;
    bool force = false; ///< replaces what is there
};

/// The keys of a station by which it differs from its profile, as typed.
struct KeyOptions {
    std::string ident;
    std::string tags_at;                  ///< a number
    std::vector<std::string> identifiers; ///< "52", "C0 40 40"
};
void add_keys(CLI::App& app, KeyOptions& options);
/// --table FILE: names for the tags.
void add_own_table(CLI::App& app, std::string& table);
/// --modules: names of a list.
void add_modules(CLI::App& app, std::vector<std::string>& modules, const char* help);

/// Puts what is typed over what `selection` says. What is wrong goes to `outcome`.
void read_keys(const KeyOptions& options, profile::Selection& selection, configurator::Outcome& outcome);
/// A number from `least` to 65535. Nothing: it is not said, or wrong, and `outcome` has why.
std::optional<std::uint32_t> read_limited(const char* option, const std::string& text, std::uint32_t least,
                                          configurator::Outcome& outcome);
/// What the file of --mapping says; empty without it. Nothing: `outcome` has the faults.
std::optional<profile::Mapping> read_mapping(const std::string& file, configurator::Outcome& outcome);

configurator::Outcome refused(std::string sentence, int exit = kNo);
/// `why` is one refusal more, because of the command line.
void refuse(configurator::Outcome& outcome, std::string why);

/// The disk, with the profiles of this folder.
configurator::Files files_of(const std::string& profiles);

/// `use` of the content of a file, or why it cannot be read.
template <class Use>
configurator::Outcome with_file(const std::string& file, const Use& use)
{
    const auto content = read_file(file);
    return content ? use(*content) : refused(file + " cannot be read: " + content.error().why + '.');
}

/// Gives the exit code.
int print_outcome(const configurator::Outcome& outcome, Session& session);
/// The file that was asked for goes where the command line says.
int write_and_print(configurator::Outcome outcome, const OutputOption& options, Session& session);

} // namespace dpslave::dpctl
