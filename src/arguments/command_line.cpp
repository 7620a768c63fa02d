// SPDX-License-Identifier: Apache-2.0
#include "dpslave/arguments/command_line.hpp"

#include "faults.hpp"
#include "help.hpp"

#include "dpslave/arguments/exit_status.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <utility>

namespace dpslave::arguments {
namespace {

/// CLI11 takes -12.5 as a number, but -.5 as an option.
std::string with_leading_zero(std::string word)
{
    const bool bare = word.size() > 2 && word[0] == '-' && word[1] == '.' &&
                      std::isdigit(static_cast<unsigned char>(word[2])) != 0;
    return bare ? word.insert(1, "0") : word;
}

/// Help, version and flags of `app` and of all its commands. The version is in the help of the program
/// only.
void prepare(CLI::App& app, const std::string& version)
{
    app.formatter(help_formatter());
    app.set_help_flag("-h,--help", "Print this help");
    app.set_version_flag("--version", version, "Print the version");
    if (app.get_parent() != nullptr) app.get_option("--version")->group("");
    bool has_words = false;
    for (CLI::Option* const option : app.get_options()) {
        has_words = has_words || option->get_positional();
        if (option->get_items_expected_max() == 0) option->disable_flag_override();
    }
    for (CLI::Option* const option :
         app.get_options()) // what stands behind a list may be a word of the command
        if (has_words && !option->get_positional()) option->allow_extra_args(false);
    for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (command->get_group() == "Subcommands") command->group("Commands");
        prepare(*command, version);
    }
}

int fault(const std::string& sentence, const CLI::App& app, std::ostream& err)
{
    err << app.get_name() << ": " << sentence << "\nRun with --help for more information.\n";
    return kUsage;
}

} // namespace

std::optional<int> read_command_line(CLI::App& app, const std::string& version,
                                     std::vector<std::string> words, std::ostream& out, std::ostream& err)
{
    prepare(app, version);
    if (const auto wrong = wrong_command(app, words)) return fault(*wrong, app, err);
    try {
        std::reverse(words.begin(), words.end()); // the order that CLI11 wants
        std::transform(words.begin(), words.end(), words.begin(), with_leading_zero);
        app.parse(std::move(words));
    } catch (const CLI::CallForHelp&) {
        out << app.help();
        return kFine;
    } catch (const CLI::CallForVersion&) {
        out << version << '\n';
        return kFine;
    } catch (const CLI::ParseError& error) {
        return fault(sentence_of(error, app), app, err);
    }
    return std::nullopt;
}

} // namespace dpslave::arguments
