// SPDX-License-Identifier: Apache-2.0
/// Settings of a drive line, for both protocols: how answers are assigned to requests.
#pragma once

#include "dpslave/drive/line_frames.hpp"

#include <chrono>
#include <cstdint>

namespace dpslave::drive {

/// Whether the transceiver hears what it sends ([[line]] echo).
enum class EchoMode : std::uint8_t {
    off,
    on,        ///< the first copy of each request is its echo
    automatic, ///< the first reads decide; until then nothing is asked whose answer looks like its request
};

struct LineRules {
    /// How late an answer may come, from the last octet of its question; 0 = ten time-outs. The wire time of
    /// all owed answers and `hold_back` come on top.
    std::chrono::nanoseconds settle{0};
    /// How long the port may keep octets that it has received. Before each question the line has been silent
    /// for as long.
    std::chrono::nanoseconds hold_back{0};
    EchoMode echo = EchoMode::off;
    FrameListener* frames = nullptr; ///< is told each frame; outlives the client
};

} // namespace dpslave::drive
