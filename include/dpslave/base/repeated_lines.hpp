// SPDX-License-Identifier: Apache-2.0
/// Limits equal lines of a log: the first one is logged at once, those that follow are counted and logged as
/// one line every 10 s. Pure; for one thread.
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
    /// For this time after a line was logged, equal lines are only counted.
    static constexpr std::chrono::seconds kQuiet{10};
    /// At most so many different keys; all others count as one.
    static constexpr std::size_t kMostKeys = 64;

    struct Line {
        int level = 0; ///< as the log has it
        std::string text;
    };

    /// `key`: what makes lines equal, such as station, tag and cause; the text may differ in its values.
    /// Returns the line to log now; none: it is counted.
    std::optional<Line> on_line(std::string_view key, Line line, Instant now);

    /// The lines that are due: the newest text of each, with how many there were. In the order of their
    /// newest.
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
