// SPDX-License-Identifier: Apache-2.0
#include "cli.hpp"

#include "arguments.hpp"
#include "commands.hpp"
#include "dpctl/gsd/gsd.hpp"
#include "suggest.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>

namespace dpslave::dpctl {
namespace {

/// Behind every subcommand, too; in the help of the program only.
void add_version(CLI::App& app)
{
    for (CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; })) {
        command->set_version_flag("--version", "dpctl " DPSLAVE_VERSION)->group("");
        add_version(*command);
    }
}

void add_commands(CLI::App& app, Options& options, Action& chosen)
{
    for (const Command& command : commands()) {
        CLI::App& own = *app.add_subcommand(command.name, command.help);
        own.group(command.group);
        own.footer(footer_of(command));
        command.group == kOffline ? add_json(own, options) : add_common(own, options);
        command.arguments(own, options);
        own.callback([&chosen, &command, &options, &own] {
            chosen = command.run;
            const auto deeper = own.get_subcommands();
            const CLI::App& level = deeper.empty() ? own : *deeper.front();
            options.station_is_option = level.get_option_no_throw("--station") != nullptr;
        });
    }
    add_gsd(app, chosen);
    app.get_subcommand("gsd")->group(kOffline);
}

/// CLI11 takes -12.5 as a number, but -.5 as an option.
std::string with_leading_zero(std::string argument)
{
    const bool bare = argument.size() > 2 && argument[0] == '-' && argument[1] == '.' &&
                      std::isdigit(static_cast<unsigned char>(argument[2])) != 0;
    return bare ? argument.insert(1, "0") : argument;
}

} // namespace

int run(const std::vector<std::string>& arguments, Terminal& terminal)
{
    Options options;
    CLI::App app{"Shows and operates a running dpslaved, the PROFIBUS-DP slave.", "dpctl"};
    app.footer(kFooter);
    app.require_subcommand(1);
    app.set_version_flag("--version", "dpctl " DPSLAVE_VERSION);
    add_common(app, options);
    Action chosen;
    add_commands(app, options, chosen);
    add_version(app);
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend()); // the order CLI11 wants
        std::transform(reversed.begin(), reversed.end(), reversed.begin(), with_leading_zero);
        app.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0 && suggest(app, arguments, terminal)) {
            terminal.err << "Run with --help for more information.\n";
            return kUsage;
        }
        return app.exit(error, terminal.out, terminal.err) == 0 ? kFine : kUsage;
    }
    return chosen(options, terminal);
}

} // namespace dpslave::dpctl
