// SPDX-License-Identifier: Apache-2.0
/// Keeps equal lines of a log apart: each is said at once, and what repeats it is counted and said in one
/// line every 10 s. Pure; for one thread.
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
    /// After a line was said: so long its like are only counted.
    static constexpr std::chrono::seconds kQuiet{10};
    /// So many unlike lines are kept apart; what comes beyond them counts as one.
    static constexpr std::size_t kMostKeys = 64;

    struct Line {
        int level = 0; ///< as the log has it
        std::string text;
    };

    /// `key`: what makes lines equal, such as station, tag and cause; the text may differ in its values. The
    /// line to say now; none: it is counted.
    std::optional<Line> on_line(std::string_view key, Line line, Instant now);

    /// The lines that are due: the newest text of each, with how many there were. In the order of their
    /// newest.
    std::vector<Line> on_time(Instant now);

private:
    struct Known {
        Line newest;
        Instant quiet_until{};
        std::uint64_t held = 0;  ///< since the last one that was said
        std::uint64_t order = 0; ///< of `newest` among all
    };
    std::map<std::string, Known, std::less<>> known_;
    std::uint64_t lines_ = 0;
};

} // namespace dpslave
