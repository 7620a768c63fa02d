// SPDX-License-Identifier: Apache-2.0
/// Round numbers and moments for the axes of a plot. Pure but for the time zone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// An axis of values from `low` to `high`, both multiples of `step`: 1, 2 or 5 times a power of ten.
struct ValueAxis {
    double low = 0, high = 1, step = 1;
    int decimals = 0; ///< that a multiple of `step` needs

    std::string label(double value) const;
    std::vector<double> ticks() const; ///< from low to high
    double share(double value) const;  ///< 0 at low, 1 at high
};

/// With about `most` ticks, two at least, around these values.
ValueAxis value_axis(double lowest, double highest, std::size_t most);

/// Moments between both that are round, `most` at most; ms since 1970.
std::vector<std::int64_t> time_ticks(std::int64_t from_ms, std::int64_t to_ms, std::size_t most);

/// "04:15:12", local time.
std::string clock(std::int64_t unix_ms);
/// "2026-11-25 04:15:12", local time.
std::string date_and_clock(std::int64_t unix_ms);
/// "2026-11-25T04:15:12.345Z"
std::string utc_time(std::int64_t unix_ms);

} // namespace dpslave::dpctl
