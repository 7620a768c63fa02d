// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace dpslave::bench {
namespace {

using std::chrono::nanoseconds;

double microseconds(nanoseconds time)
{
    return std::chrono::duration<double, std::micro>{time}.count();
}

/// The time that a share of `percent` of the telegrams did not exceed.
nanoseconds percentile(std::vector<nanoseconds> times, std::size_t percent)
{
    const std::size_t rank = (times.size() * percent + 99) / 100;
    const auto at = times.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(times.begin(), at, times.end());
    return *at;
}

double ratio(nanoseconds one, nanoseconds other)
{
    return static_cast<double>(one.count()) / static_cast<double>(other.count());
}

nanoseconds cpu_per_telegram(const Sample& sample)
{
    return sample.cpu / static_cast<std::int64_t>(sample.times.size());
}

bool keeps(const char* what, double is, double limit)
{
    if (limit == 0) return true;
    const bool kept = is <= limit;
    std::printf("%s  %-16s %.2f (limit %.2f)\n", kept ? "kept  " : "BROKEN", what, is, limit);
    return kept;
}

} // namespace

Ratios ratios(const Sample& sample, const Sample& base)
{
    return {.p50 = ratio(percentile(sample.times, 50), percentile(base.times, 50)),
            .p99 = ratio(percentile(sample.times, 99), percentile(base.times, 99)),
            .cpu = ratio(cpu_per_telegram(sample), cpu_per_telegram(base))};
}

Ratios median(const std::vector<Ratios>& runs)
{
    const auto of = [&](double Ratios::*which) {
        std::vector<double> values;
        for (const Ratios& run : runs) values.push_back(run.*which);
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    };
    return {.p50 = of(&Ratios::p50), .p99 = of(&Ratios::p99), .cpu = of(&Ratios::cpu)};
}

void print_header()
{
    std::printf("%-34s %9s %9s %9s %9s %8s\n", "us per telegram", "p50", "p99", "max", "CPU", "retries");
}

void print(const Sample& sample)
{
    std::printf("%-34s %9.1f %9.1f %9.1f %9.1f %8zu\n", sample.name.c_str(),
                microseconds(percentile(sample.times, 50)), microseconds(percentile(sample.times, 99)),
                microseconds(percentile(sample.times, 100)), microseconds(cpu_per_telegram(sample)),
                sample.retries);
}

void print(const std::string& name, const Ratios& ratios)
{
    std::printf("%-34s %9.2f %9.2f %9s %9.2f\n", name.c_str(), ratios.p50, ratios.p99, "", ratios.cpu);
}

bool judge(const Ratios& ratios, const Ratios& limits)
{
    bool kept = keeps("p50", ratios.p50, limits.p50);
    kept = keeps("p99", ratios.p99, limits.p99) && kept;
    return keeps("CPU per telegram", ratios.cpu, limits.cpu) && kept;
}

} // namespace dpslave::bench
