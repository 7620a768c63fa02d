// SPDX-License-Identifier: Apache-2.0
/// The arguments and options of each command.
#pragma once

#include "subcommands.hpp"

namespace CLI {
class App;
}

namespace dpslave::dpctl {

void add_json(CLI::App& app, Options& options);
void add_common(CLI::App& app, Options& options);
void no_arguments(CLI::App& app, Options& options);
void station_argument(CLI::App& app, Options& options);
void status_arguments(CLI::App& app, Options& options);
void io_arguments(CLI::App& app, Options& options);
void read_arguments(CLI::App& app, Options& options);
void log_level_arguments(CLI::App& app, Options& options);
void tag_and_value_arguments(CLI::App& app, Options& options);
void tec_arguments(CLI::App& app, Options& options);
void doctor_arguments(CLI::App& app, Options& options);
void port_argument(CLI::App& app, Options& options);
void query_arguments(CLI::App& app, Options& options);
void number_arguments(CLI::App& app, Options& options);
void reload_arguments(CLI::App& app, Options& options);
void octet_arguments(CLI::App& app, Options& options);
void plot_arguments(CLI::App& app, Options& options);
void metrics_arguments(CLI::App& app, Options& options);
void survey_arguments(CLI::App& app, Options& options);
void trace_arguments(CLI::App& app, Options& options);
void top_arguments(CLI::App& app, Options& options);

} // namespace dpslave::dpctl
