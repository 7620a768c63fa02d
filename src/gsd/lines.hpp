// SPDX-License-Identifier: Apache-2.0
/// Makes logical lines of octets: character set, line ends, comments, continuation.
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

/// Why the octets cannot be read as a GSD file at all, and how to mend that; empty: they can.
std::string unreadable(std::string_view content);

/// Returns the lines; remarks about unusual text go into `remarks`.
std::vector<LogicalLine> logical_lines(std::string_view content, Remarks& remarks);

} // namespace dpslave::gsd
