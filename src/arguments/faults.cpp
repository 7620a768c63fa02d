// SPDX-License-Identifier: Apache-2.0
#include "faults.hpp"

#include "dpslave/input/wording.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace dpslave::arguments {
namespace {

/// Returns the one of `names` that `word` is near to, or the first that begins with it; empty if there is
/// none.
std::string_view meant_by(const std::string& word, const std::vector<std::string>& names)
{
    constexpr std::size_t kShort = 4; // every short word is near to another one
    const std::string_view near =
        word.size() < kShort ? input::nearest(word, names, 1) : input::nearest(word, names);
    if (!near.empty()) return near;
    const auto begins = std::find_if(names.begin(), names.end(),
                                     [&word](const std::string& name) { return name.starts_with(word); });
    return begins == names.end() ? std::string_view{} : std::string_view{*begins};
}

std::string with_suggestion(std::string sentence, std::string_view meant)
{
    if (!meant.empty()) sentence += fmt::format("; did you mean '{}'?", meant);
    return sentence;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app)
{
    return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands)
{
    std::vector<std::string> names;
    for (const CLI::App* command : commands) names.push_back(command->get_name());
    return names;
}

/// The command that was chosen last: `check` of `dpctl gsd check`.
const CLI::App& chosen(const CLI::App& app)
{
    const auto commands = app.get_subcommands();
    return commands.empty() ? app : chosen(*commands.front());
}

std::string unknown_option(std::string word, const CLI::App& app)
{
    word.resize(std::min(word.find('='), word.size()));
    std::vector<std::string> names;
    for (const CLI::App* level = &chosen(app); level != nullptr; level = level->get_parent())
        for (const CLI::Option* option : level->get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    const bool is_long = word.starts_with("--");
    return with_suggestion(fmt::format("there is no option '{}'", word),
                           is_long ? meant_by(word, names) : std::string_view{});
}

/// The option stands before `end` in what CLI11 says.
std::string_view name_before(std::string_view text, std::string_view end)
{
    return text.substr(0, text.find(end));
}

std::string wrong_number_of_values(std::string_view said, const CLI::App& app)
{
    if (said.find("flag override") != std::string_view::npos)
        return fmt::format("--{} takes no value", name_before(said, " "));
    const std::string name{name_before(said, ":")};
    if (said.find("t Most") != std::string_view::npos || said.find("t most") != std::string_view::npos)
        return fmt::format("{} can be given only once", name);
    const CLI::Option* const option = chosen(app).get_option_no_throw(name);
    const std::string type = option != nullptr ? option->get_type_name() : std::string{};
    return type.empty() ? fmt::format("{} needs a value", name)
                        : fmt::format("{} needs a value: {} {}", name, name, type);
}

} // namespace

std::optional<std::string> wrong_command(const CLI::App& app, const std::vector<std::string>& words)
{
    const CLI::App* level = &app;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--") return std::nullopt;
        if (word.empty() || word.front() == '-') {
            const CLI::Option* const option = level->get_option_no_throw(word);
            if (option != nullptr && option->get_items_expected_max() > 0) ++i; // its value
            continue;
        }
        const auto commands = commands_of(*level);
        if (commands.empty()) return std::nullopt; // the words of a command
        const auto found = std::find_if(commands.begin(), commands.end(), [&word](const CLI::App* command) {
            return command->get_name() == word;
        });
        if (found == commands.end())
            return with_suggestion(fmt::format("there is no command '{}'", word),
                                   meant_by(word, names_of(commands)));
        level = *found;
    }
    return std::nullopt;
}

std::string sentence_of(const CLI::ParseError& error, const CLI::App& app)
{
    const std::string_view said = error.what();
    if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr) return std::string{said};
    // A missing option may be one that was misspelled.
    const auto words = app.remaining(true);
    const auto option = std::find_if(words.begin(), words.end(),
                                     [](const std::string& word) { return word.starts_with('-'); });
    if (option != words.end()) return unknown_option(*option, app);
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr)
        return fmt::format("the word '{}' is one too many", words.empty() ? "" : words.front());
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
        const auto commands = names_of(commands_of(chosen(app)));
        if (!commands.empty()) return fmt::format("name a command: {}", fmt::join(commands, ", "));
        return fmt::format("{} is missing", name_before(said, " is required"));
    }
    if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
        const std::string_view name = name_before(said, " requires ");
        return fmt::format("{} needs {}", name,
                           said.substr(name.size() + std::string_view{" requires "}.size()));
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
        const std::string_view name = name_before(said, " excludes ");
        return fmt::format("{} and {} exclude each other", name,
                           said.substr(name.size() + std::string_view{" excludes "}.size()));
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
        return wrong_number_of_values(said, app);
    return "the command line cannot be read";
}

} // namespace dpslave::arguments
