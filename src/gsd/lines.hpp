// SPDX-License-Identifier: Apache-2.0
/// From octets to logical lines: character set, line ends, comments, continuation.
#pragma once

#include "dpslave/gsd/document.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::gsd {

struct LogicalLine {
    std::string text; ///< trimmed, without comments, continued lines joined; never empty
    unsigned number = 0;
};

/// What is odd about the text goes into `remarks`.
std::vector<LogicalLine> logical_lines(std::string_view content, Remarks& remarks);

} // namespace dpslave::gsd
