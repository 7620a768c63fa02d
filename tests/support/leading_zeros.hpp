// SPDX-License-Identifier: Apache-2.0
/// What a command line makes of numbers with leading zeros, for every option that it has.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace dpslave::test {

/// How far `text` comes as the value of this option: what its reader makes of it, or "refused".
inline std::string taken_as(CLI::Option& option, const std::string& text)
{
    option.clear();
    try {
        option.add_result(text);
        option.run_callback();
        const auto& results = option.reduced_results();
        return results.empty() ? std::string{} : results.front();
    } catch (const CLI::Error&) {
        return "refused";
    }
}

/// Names of the options of `app` and of all its commands that take a number, but not the same one behind
/// zeros. CLI11's own reader takes 098 for no number, as 9 is no octal digit, and 017 for fifteen.
inline std::vector<std::string> options_that_mind_zeros(CLI::App& app, const std::string& command,
                                                        unsigned& numbers)
{
    std::vector<std::string> minding;
    for (CLI::Option* const option : app.get_options()) {
        if (option->get_items_expected_max() == 0) continue; // a flag
        bool takes_a_number = false, minds = false;
        for (const char* const plain :
             {"8", "9", "10", "18", "98", "980", "9800", "1000000", "0.5", "98.5"}) {
            const std::string taken = taken_as(*option, plain);
            if (taken == "refused") continue;
            takes_a_number = takes_a_number || taken_as(*option, "five") == "refused";
            const std::string with_zeros = taken_as(*option, std::string{"00"} + plain);
            const bool is_the_same = with_zeros == taken || with_zeros == "00" + taken;
            minds = minds || !is_the_same;
        }
        numbers += takes_a_number ? 1U : 0U;
        if (minds) minding.push_back(command + ' ' + option->get_name());
    }
    for (CLI::App* const own : app.get_subcommands([](const CLI::App*) { return true; }))
        for (const std::string& name :
             options_that_mind_zeros(*own, command + ' ' + own->get_name(), numbers))
            minding.push_back(name);
    return minding;
}

} // namespace dpslave::test
