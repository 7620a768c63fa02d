// SPDX-License-Identifier: Apache-2.0
/// What the bench found, in numbers and in a verdict.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace dpslave::bench {

/// One responder's part of the run.
struct Sample {
    std::string name{};
    std::vector<std::chrono::nanoseconds>
        times{};                    ///< one per telegram; with a retry in it where one was needed
    std::chrono::nanoseconds cpu{}; ///< of the whole process, over the run
    std::size_t retries = 0;        ///< requests that had to be sent again
};

struct Ratios {
    double p50 = 0;
    double p99 = 0;
    double cpu = 0; ///< per telegram
};
Ratios ratios(const Sample& sample, const Sample& base);
/// Of each ratio by itself. Not empty.
Ratios median(const std::vector<Ratios>& runs);

/// The limits that the project has set itself, for the median of kRuns runs; 0 = none.
inline constexpr Ratios kLimits{.p50 = 1.05, .p99 = 1.30, .cpu = 1.10};
inline constexpr std::size_t kRuns = 5;
/// With an edge of the driver enable before each reply; the one after it, and the wait for it, are no part of
/// the turnaround but cost CPU time.
inline constexpr Ratios kGpioLimits{.p50 = 1.45};

void print_header();
void print(const Sample& sample);
void print(const std::string& name, const Ratios& ratios);

/// Prints a line per limit; true = all are kept.
bool judge(const Ratios& ratios, const Ratios& limits);

} // namespace dpslave::bench
