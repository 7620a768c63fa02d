// SPDX-License-Identifier: Apache-2.0
/// Limits equal lines of a log: the first one is logged at once, those that follow are counted and logged as
/// one line every 10 s. It is pure and for one thread.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave {

class RepeatedLines {
public:
    /// Equal lines are only counted for this time after one was logged.
    static constexpr std::chrono::seconds kQuiet{10};
    /// At most this number of different keys is kept; all others count as one. A start-up of 126 stations has
    /// some for each.
    static constexpr std::size_t kMostKeys = 1024;

    struct Line {
        int level = 0; ///< as the log has it
        std::string text;
    };

    /// `key`: what makes lines equal, such as station, tag and cause; the text may differ in its values.
    /// Returns the line to log now; none: it is counted.
    std::optional<Line> on_line(std::string_view key, Line line, Instant now);

    /// Returns the lines that are due, in the order of their newest: the newest text of each, with their
    /// number.
    std::vector<Line> on_time(Instant now);

private:
    struct Known {
        Line newest;
        Instant quiet_until{};
        std::uint64_t held = 0;  ///< since the last one that was logged
        std::uint64_t order = 0; ///< of `newest` among all
    };
    std::map<std::string, Known, std::less<>> known_;
    std::uint64_t lines_ = 0;
};

} // namespace dpslave
