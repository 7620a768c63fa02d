// SPDX-License-Identifier: Apache-2.0
#include "suggest.hpp"

#include "dpslave/toml/wording.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>

namespace dpslave::dpctl {
namespace {

/// The command that `word` is near to, or the first one that begins with it; nothing: none.
std::string_view meant_by(const std::string& word, const std::vector<std::string>& names)
{
    constexpr std::size_t kShort = 4; // every short word is near to another one
    const std::string_view near =
        word.size() < kShort ? toml::nearest(word, names, 1) : toml::nearest(word, names);
    if (!near.empty()) return near;
    const auto begins = std::find_if(names.begin(), names.end(),
                                     [&word](const std::string& name) { return name.starts_with(word); });
    return begins == names.end() ? std::string_view{} : std::string_view{*begins};
}

} // namespace

bool suggest(const CLI::App& app, const std::vector<std::string>& arguments, Terminal& terminal)
{
    const CLI::App* level = &app;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word == "--socket" || word == "--timeout") ++i; // their values
        if (word.empty() || word.front() == '-') continue;
        std::vector<std::string> names;
        const CLI::App* found = nullptr;
        for (const CLI::App* command : level->get_subcommands([](const CLI::App*) { return true; })) {
            names.push_back(command->get_name());
            if (names.back() == word) found = command;
        }
        if (names.empty()) return false; // arguments
        if (found == nullptr) {
            const std::string_view meant = meant_by(word, names);
            terminal.err << "dpctl: there is no command '" << word << "'";
            if (!meant.empty()) terminal.err << "; did you mean '" << meant << "'?";
            terminal.err << '\n';
            return true;
        }
        level = found;
    }
    return false;
}

} // namespace dpslave::dpctl
