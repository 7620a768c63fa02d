// SPDX-License-Identifier: Apache-2.0
/// Comma separated values as RFC 4180 has them, each cell with its place.
#pragma once

#include "dpslave/input/fault.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::profile {

struct Cell {
    std::string text; ///< without quotes; blanks around an unquoted cell are gone
    unsigned line = 0;
    unsigned column = 0; ///< in characters, where the cell begins
};

struct Row {
    unsigned line = 0;
    bool good = true; ///< false: it has a fault of form, and its cells mean nothing
    std::vector<Cell> cells;
    std::string_view written; ///< as written in the content, without its end of line
};

/// Returns the rows of `content`, which is UTF-8, empty lines left out. LF and CR LF end a line; a quoted
/// cell may hold either. A row with a fault (quotes, control characters) is left out, and the fault is added
/// to `faults`. Rows after more than kMaxFaults faults are not read.
std::vector<Row> read_csv(std::string_view content, const std::string& file, input::Faults& faults);

/// `text` as a cell: in quotes where it needs them.
std::string csv_cell(std::string_view text);

} // namespace dpslave::profile
