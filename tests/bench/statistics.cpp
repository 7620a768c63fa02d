// SPDX-License-Identifier: Apache-2.0
#include "statistics.hpp"

#include <algorithm>
#include <cmath>

namespace dpslave::bench {
namespace {

std::size_t rank_of(double share, std::size_t count)
{
    const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(count)));
    return std::clamp<std::size_t>(rank, 1, count) - 1;
}

} // namespace

std::chrono::nanoseconds quantile(Times times, double share)
{
    const auto at = times.begin() + static_cast<std::ptrdiff_t>(rank_of(share, times.size()));
    std::nth_element(times.begin(), at, times.end());
    return *at;
}

double ratio(std::chrono::nanoseconds one, std::chrono::nanoseconds other)
{
    return static_cast<double>(one.count()) / static_cast<double>(other.count());
}

double microseconds(std::chrono::nanoseconds time)
{
    return std::chrono::duration<double, std::micro>{time}.count();
}

std::vector<std::vector<double>> cumulative(Times times)
{
    std::sort(times.begin(), times.end());
    std::vector<std::vector<double>> curve;
    for (double rest = 1; rest > 0.9e-4; rest *= 0.93) { // close where few telegrams are left
        const double share = 1 - rest + rest * 0.07;
        curve.push_back({microseconds(times[rank_of(share, times.size())]), share});
    }
    return curve;
}

} // namespace dpslave::bench
