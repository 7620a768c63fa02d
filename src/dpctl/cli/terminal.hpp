// SPDX-License-Identifier: Apache-2.0
/// Where dpctl's words go, and what its exit says.
#pragma once

#include "table.hpp"

#include <cstddef>
#include <ostream>

namespace dpslave::dpctl {

struct Terminal {
    std::ostream& out;
    std::ostream& err;
    bool tty = false;       ///< out is a terminal: --follow redraws
    bool colour = false;    ///< out understands colours and no option or variable forbids them
    std::size_t width = 80; ///< characters of a line
    bool cursor = false; ///< out is a terminal whose cursor can be moved (ECMA-48): dpctl top draws a screen
    bool utf8 = false;   ///< the locale says so: block elements may be used

    Look look() const { return {colour, width}; }
};

/// Exit codes; --help lists them.
enum Exit : int {
    kFine = 0,
    kNo = 1,    ///< refused, faulty, or not so
    kUsage = 2, ///< of the command line, or there is no such station
    kNoDaemon = 3,
};

} // namespace dpslave::dpctl
