// SPDX-License-Identifier: Apache-2.0
/// Where dpctl's words go, and what its exit says.
#pragma once

#include "table.hpp"

#include "dpslave/arguments/exit_status.hpp"

#include <cstddef>
#include <istream>
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
    std::istream* user = nullptr; ///< who can be asked; null: nobody, as in a script

    Look look() const { return {colour, width}; }
};

using arguments::Exit, arguments::kFine, arguments::kNo, arguments::kUsage, arguments::kNoDaemon,
    arguments::kNoAnswer, arguments::kRefused;

} // namespace dpslave::dpctl
