// SPDX-License-Identifier: Apache-2.0
/// The bench on the simulated clock: refresh, Demand Data and noise.
#include "simulated.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

int main(int argc, char** argv)
{
    using namespace dpslave::bench;
    std::filesystem::path json;
    bool quick = false;
    CLI::App app{"Measures the drive side and layer 2 on the simulated clock.", "bench_simulated"};
    app.footer("Exit status: 0 all limits kept · 1 a limit broken · 2 wrong usage");
    app.add_option("--json", json, "File for the figures of each block");
    app.add_flag("--quick", quick, "Fewer orders and telegrams");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    nlohmann::json curves = nlohmann::json::object();
    std::vector<Row> rows = measure_refresh(curves);
    rows.push_back(measure_demand_data(quick));
    for (Row& row : measure_noise(quick)) rows.push_back(std::move(row));
    for (const Row& row : rows)
        fmt::print("{:<5} {:<70} {:7.3f}  limit {:<5} {}\n", row.id, row.metric, row.ratio(), row.limit,
                   verdict(row));
    if (!json.empty()) write_json(json, rows, curves);
    return exit_status(rows);
}
