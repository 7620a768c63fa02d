// SPDX-License-Identifier: Apache-2.0
/// Two texts line by line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::configurator {

/// A line that only one of them has, or both.
struct Line {
    unsigned left = 0, right = 0; ///< its number from 1; 0 = this text does not have it
    std::string_view text;        ///< points into the texts, without the end of the line
};

/// The lines of both in their order, as few of them different as possible; where the texts are too different
/// to be compared in reasonable time, more.
std::vector<Line> compare_lines(std::string_view left, std::string_view right);

} // namespace dpslave::configurator
