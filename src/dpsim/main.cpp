// SPDX-License-Identifier: Apache-2.0
/// dpsim: a paced serial line, an EI-ASCII drive or a Modbus instrument, a DP master, and the replay of a
/// capture, for users without hardware and for the tests.
#include "dpsim/common/command_line.hpp"

#include "dpslave/arguments/command_line.hpp"
#include "dpslave/arguments/exit_status.hpp"
#include "dpslave/arguments/standard_descriptors.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <string>

namespace {

constexpr const char* kExamples =
    "Example, a whole bus on one machine (three terminals and the daemon):\n"
    "  dpsim line --baud 187.5k --a /tmp/bus-slave --b /tmp/bus-master\n"
    "  dpsim line --baud 9600 --bits 10 --a /tmp/drive-near --b /tmp/drive-end\n"
    "  dpsim drive --profile 590 --port /tmp/drive-end\n"
    "  dpsim master --port /tmp/bus-master --baud 187.5k --slave 5 --tags 55,56w,288\n"
    "With an instrument:\n"
    "  dpsim drive --profile 2408f --port /tmp/drive-end\n"
    "  dpsim master --port /tmp/bus-master --baud 187.5k --slave 5 --family controller --ident IDENT --tags 1,5,3,75,24w\n";

} // namespace

int main(int argc, char** argv)
{
    using namespace dpslave::sim;
    dpslave::arguments::fill_standard_descriptors();
    CLI::App app{
        "Simulators for dpslaved: a serial line, a drive or instrument, a PROFIBUS-DP master and the replay of a capture, all without hardware",
        "dpsim"};
    app.require_subcommand(1);
    app.footer(std::string{kExamples} + dpslave::arguments::kExitTable);
    CommandLine said;
    add_commands(app, said);
    if (const auto ended = dpslave::arguments::read_command_line(
            app, "dpsim " DPSLAVE_VERSION, {argv + 1, argv + argc}, std::cout, std::cerr))
        return *ended;
    if (app.got_subcommand("line")) return run_line(said.line);
    if (app.got_subcommand("drive")) return run_drive(said.drive);
    if (app.got_subcommand("replay")) return run_replay(said.replay);
    const auto notes = complete(said.master.settings, said.texts);
    if (!notes) {
        fmt::print(stderr, "dpsim: {}\n", notes.error());
        return kUsage;
    }
    for (const std::string& note : *notes) fmt::print("{}\n", note);
    std::fflush(stdout);
    return run_master(said.master);
}
