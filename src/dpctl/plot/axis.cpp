// SPDX-License-Identifier: Apache-2.0
#include "axis.hpp"

#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

namespace dpslave::dpctl {
namespace {

constexpr std::int64_t kDay_s = 86'400;

std::chrono::system_clock::time_point moment(std::int64_t unix_ms)
{
    return std::chrono::system_clock::time_point{std::chrono::milliseconds{unix_ms}};
}

/// The round number that is not below `least`.
double round_step(double least)
{
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

} // namespace

std::string ValueAxis::label(double value) const
{
    const double least = std::pow(10.0, -decimals) / 2;
    return fmt::format("{:.{}f}", std::abs(value) < least ? 0.0 : value, decimals); // never "-0.0"
}

std::vector<double> ValueAxis::ticks() const
{
    std::vector<double> all;
    const auto count = static_cast<std::size_t>(std::lround((high - low) / step));
    for (std::size_t i = 0; i <= count; ++i) all.push_back(low + static_cast<double>(i) * step);
    return all;
}

double ValueAxis::share(double value) const
{
    return std::clamp((value - low) / (high - low), 0.0, 1.0);
}

ValueAxis value_axis(double lowest, double highest, std::size_t most)
{
    if (lowest == highest) { // a line that stays where it is, in the middle
        const double room = std::max(1.0, std::abs(lowest) / 10);
        lowest -= room;
        highest += room;
    }
    ValueAxis axis;
    axis.step = round_step((highest - lowest) / static_cast<double>(std::max<std::size_t>(most, 2) - 1));
    axis.low = std::floor(lowest / axis.step + 1e-9) * axis.step;
    axis.high = std::ceil(highest / axis.step - 1e-9) * axis.step;
    axis.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(axis.step) + 1e-9)));
    return axis;
}

std::vector<std::int64_t> time_ticks(std::int64_t from_ms, std::int64_t to_ms, std::size_t most)
{
    constexpr std::array<std::int64_t, 16> kSteps_s{1,   2,   5,    10,   15,   30,    60,    120,
                                                    300, 600, 1800, 3600, 7200, 21600, 43200, kDay_s};
    std::int64_t step = kSteps_s.back();
    for (const std::int64_t one : kSteps_s)
        if ((to_ms - from_ms) / (one * 1000) < static_cast<std::int64_t>(most)) {
            step = one;
            break;
        }
    while ((to_ms - from_ms) / (step * 1000) >= static_cast<std::int64_t>(std::max<std::size_t>(most, 1)))
        step += kDay_s;
    std::vector<std::int64_t> all;
    for (std::int64_t at = (from_ms + step * 1000 - 1) / (step * 1000) * step * 1000; at <= to_ms;
         at += step * 1000)
        all.push_back(at);
    return all;
}

std::string clock(std::int64_t unix_ms)
{
    return time_of_day(moment(unix_ms)).substr(0, 8);
}

std::string date_and_clock(std::int64_t unix_ms)
{
    return date_and_time(moment(unix_ms)).substr(0, 19);
}

std::string utc_time(std::int64_t unix_ms)
{
    const std::time_t seconds = unix_ms / 1000;
    std::tm parts{};
    ::gmtime_r(&seconds, &parts);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                       parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec, unix_ms % 1000);
}

} // namespace dpslave::dpctl
