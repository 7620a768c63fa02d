// SPDX-License-Identifier: Apache-2.0
#include "cli.hpp"

#include "dpctl/commands/commands.hpp"

#include "dpslave/arguments/command_line.hpp"
#include "dpslave/arguments/exit_status.hpp"
#include "dpslave/arguments/options.hpp"

#include <CLI/CLI.hpp>

#include <chrono>
#include <utility>

namespace dpslave::dpctl {
namespace {

constexpr const char* kFooter =
    "Without a command: dpctl status. STATION is a name or an address. TAG is a number (55, 0x37, 55-57) or a name. TIME is a number with a unit (500ms, 10s, 5m, 1h, 3d); a number alone is seconds. Values are in the drive's displayed units: dpctl write 56 -12.5\n"
    "--json prints the unchanged parameters of the daemon's reply (an error with its name and parameters). The Varlink interface org.dpslaved.Control describes them: " DPSLAVE_DATA_FOLDER
    "/org.dpslaved.Control.varlink. Some commands have their own form: see JSON in dpctl(1).\n";

void add_json(CLI::App& app, CommonOptions& options)
{
    app.add_flag("-j,--json", options.json, "Print JSON");
    arguments::add_text(app, "--field", options.field, "NAME",
                        "Print only this field of the JSON: bus.baud, stations.state");
}

void add_common(CLI::App& app, CommonOptions& options)
{
    using namespace std::chrono_literals;
    add_json(app, options);
    arguments::add_text(app, "--socket", options.socket, "PATH", "The daemon's control socket");
    arguments::add_time(app, "--timeout", options.timeout, "How long to wait for an answer", {10ms, 1h});
}

void add_command(CLI::App& app, const Command& command, Chosen& chosen)
{
    const std::string names = command.name;
    const std::size_t blank = names.find(' ');
    const bool is_below = blank != std::string::npos;
    CLI::App& above = is_below ? *app.get_subcommand(names.substr(0, blank)) : app;
    CLI::App& own = *above.add_subcommand(is_below ? names.substr(blank + 1) : names, command.help);
    if (!is_below) own.group(command.group);
    own.footer(footer_of(command));
    command.asks == Asks::daemon ? add_common(own, chosen.common) : add_json(own, chosen.common);
    if (command.add == nullptr) {
        own.require_subcommand(1);
        return;
    }
    own.callback([&chosen, run = command.add(own)] { chosen.run = run; });
}

} // namespace

std::string footer_of(const Command& command)
{
    std::string footer;
    if (*command.examples != '\0') {
        footer = std::string{"Examples:\n"} + command.examples;
        for (std::size_t at = 0; (at = footer.find('\n', at)) != std::string::npos; at += 3)
            footer.insert(at + 1, "  ");
        footer += '\n';
    }
    const std::string json = command.json;
    if (json == kOwnForm)
        footer += "--json prints a form of its own: see JSON in dpctl(1).\n";
    else if (!json.empty())
        footer += "--json prints the reply of " + json + " (org.dpslaved.Control.varlink).\n";
    const std::string exits = command.exits;
    return footer + "Exit status: " + (exits.empty() ? "" : exits + "; all others: ") + "as in dpctl --help.";
}

void add_command_line(CLI::App& app, Chosen& chosen)
{
    app.footer(std::string{kFooter} + arguments::kExitTable);
    add_common(app, chosen.common);
    for (const Command* const command : commands()) add_command(app, *command, chosen);
    CLI::App without_words; // dpctl alone
    chosen.run = kStatus.add(without_words);
}

int run(std::vector<std::string> words, Terminal& terminal)
{
    CLI::App app{"Shows and operates a running dpslaved, the PROFIBUS-DP slave.", "dpctl"};
    Chosen chosen;
    add_command_line(app, chosen);
    if (const auto ended = arguments::read_command_line(app, "dpctl " DPSLAVE_VERSION, std::move(words),
                                                        terminal.out, terminal.err))
        return *ended;
    Session session{chosen.common, terminal};
    const int code = chosen.run(session);
    return session.misses_field() ? static_cast<int>(kUsage) : code;
}

} // namespace dpslave::dpctl
