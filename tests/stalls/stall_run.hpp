// SPDX-License-Identifier: Apache-2.0
/// Random histories of a daemon whose threads stall, drawn from a seed.
#pragma once

#include "drive_line/chance.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::stalls {

struct HistoryOptions {
    bool is_modbus = false;
    int histories = 40; ///< of one line, one behind the other
    bool traces = false;
};

struct HistoryResult {
    std::string violation; ///< empty: everything was as it has to be
    std::uint64_t histories = 0, stalls = 0, departures = 0;
    std::vector<std::string> trace; ///< the last lines, if they were wanted
};

/// A history is one stall or more, of the line, the bus thread or the main thread, each of 1 ms to 60 s, with
/// what comes before and behind it.
HistoryResult run_histories(std::uint64_t seed, const HistoryOptions& options);

std::string story(const HistoryResult& result);

} // namespace dpslave::stalls
