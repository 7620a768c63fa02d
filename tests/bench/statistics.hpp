// SPDX-License-Identifier: Apache-2.0
/// Times of telegrams in numbers.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace dpslave::bench {

using Times = std::vector<std::chrono::nanoseconds>;

/// The time that a share of `share` (above 0, at most 1) of the telegrams did not exceed. Not empty.
std::chrono::nanoseconds quantile(Times times, double share);
double ratio(std::chrono::nanoseconds one, std::chrono::nanoseconds other);
double microseconds(std::chrono::nanoseconds time);

/// Times in us that growing shares did not exceed, each with its share: a curve to draw.
std::vector<std::vector<double>> cumulative(Times times);

} // namespace dpslave::bench
