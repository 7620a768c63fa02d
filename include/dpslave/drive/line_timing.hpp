// SPDX-License-Identifier: Apache-2.0
/// Settings of a drive line, for both protocols: how answers are assigned to requests.
#pragma once

#include "dpslave/base/echo_mode.hpp"
#include "dpslave/drive/frame_notes.hpp"

#include <chrono>
#include <cstdint>

namespace dpslave::drive {

struct LineTiming {
    /// The time within which a late answer may come, from the last octet of its question; 0 = ten timeouts.
    /// The wire time of all owed answers and `hold_back` are added.
    std::chrono::nanoseconds settle{0};
    /// The time for which the port may keep octets that it has received. Before each question the line has to
    /// be silent for that time.
    std::chrono::nanoseconds hold_back{0};
    EchoMode echo = EchoMode::off;
    FrameListener* frames = nullptr; ///< is told each frame; outlives the client
};

} // namespace dpslave::drive
