// SPDX-License-Identifier: Apache-2.0
/// The bench of the bus thread: rows M1 to M5, M8, M9 and M13 of the table of tools/bench.
#include "measurements.hpp"
#include "responder.hpp"

#include "dpslave/io/clock.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cstdio>
#include <functional>

namespace dpslave::bench {
namespace {

constexpr int kTries = 5;
/// So long a measurement may take with all its tries: tools/run bench has ten minutes for everything.
constexpr std::chrono::seconds kLongest{90};

struct Measurement {
    std::string name;
    Findings (*measure)(const Setup&);
};

const std::vector<Measurement> kMeasurements{
    {"turnaround", measure_turnaround},       {"other-station", measure_other_station},
    {"many-stations", measure_many_stations}, {"callers", measure_callers},
    {"watchers", measure_watchers},
};

void print(const Findings& found)
{
    for (const std::string& note : found.notes) fmt::print("    {}\n", note);
    for (const Row& row : found.rows) {
        const auto aa = row.aa_ratio();
        fmt::print("{:<5} {:<62} {:7.3f}  A/A {:<6} limit {:<5} {}\n", row.id, row.metric, row.ratio(),
                   aa ? fmt::format("{:.3f}", *aa) : "-", row.limit, verdict(row));
    }
    std::fflush(stdout);
}

/// Until A/A is within its limits, five times at most: the last try is judged.
Findings measure(const Measurement& what, Setup setup)
{
    setup.limit = io::monotonic_now() + kLongest;
    Findings found = what.measure(setup);
    for (int tried = 1;; ++tried) {
        print(found);
        const bool is_noisy = std::ranges::any_of(found.rows, &Row::is_noisy);
        if (setup.quick || !is_noisy || tried == kTries) return found;
        if (io::monotonic_now() > setup.limit) return found;
        fmt::print("    A/A is not within its limits: again\n");
        Findings next = what.measure(setup);
        if (next.rows.front().blocks.size() < kBlocks) return found; // no time was left for it
        found = std::move(next);
    }
}

} // namespace
} // namespace dpslave::bench

int main(int argc, char** argv)
{
    using namespace dpslave::bench;
    Setup setup;
    std::filesystem::path json;
    std::string direction = "none";
    std::string only;
    CLI::App app{"Measures dpslaved against a minimal null responder, over ptys.", "bench_bus"};
    app.footer("Exit status: 0 all limits kept (or --quick) · 1 a limit broken · 2 wrong usage · 3 the bench "
               "could not run · 77 the machine is too noisy");
    app.add_option("--daemon", setup.daemon, "The program dpslaved")->required()->check(CLI::ExistingFile);
    app.add_option("--dpctl", setup.dpctl, "The program dpctl")->required()->check(CLI::ExistingFile);
    app.add_option("--profiles", setup.profiles, "The profile folder")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--seed", setup.seed, "Of the order of the telegrams")->capture_default_str();
    app.add_option("--direction", direction,
                   "gpio: measures the turnaround with a driver enable (a stand-in), and nothing else")
        ->capture_default_str()
        ->check(CLI::IsMember({"none", "gpio"}));
    app.add_option("--only", only,
                   "One measurement: turnaround, other-station, many-stations, callers, watchers");
    app.add_option("--json", json, "File for the figures of each block");
    app.add_flag("--quick", setup.quick, "One small block each, nothing judged");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    setup.gpio = direction == "gpio";
    setup.cpu = reserve_cpu();
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); // the pauses are short

    Findings all;
    try {
        const std::vector<Measurement> chosen =
            setup.gpio ? std::vector<Measurement>{{"gpio", measure_driver_enable}} : kMeasurements;
        for (const Measurement& one : chosen) {
            if (!only.empty() && one.name != only) continue;
            const Findings found = measure(one, setup);
            all.rows.insert(all.rows.end(), found.rows.begin(), found.rows.end());
            all.curves.update(found.curves);
        }
        if (!json.empty()) write_json(json, all.rows, all.curves);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_bus: {}\n", error.what());
        return 3;
    }
    if (!setup.quick) return exit_status(all.rows);
    fmt::print("not judged: too few telegrams\n");
    return 0;
}
