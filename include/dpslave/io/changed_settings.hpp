// SPDX-License-Identifier: Apache-2.0
/// Settings of an open port that another program has changed: a terminal program, `stty`, a login prompt, a
/// search for modems.
#pragma once

#include <array>

namespace dpslave::io {

struct ChangedSettings {
    /// Octets that came or went since may be others than those on the line, or missing; or what comes may be
    /// sent back. False: only when octets come or go may differ.
    bool harms_octets = false;
    /// Ends with NUL: "ECHO and ICANON are on, 9600 instead of 500000 bit/s".
    std::array<char, 240> words{};
};

} // namespace dpslave::io
