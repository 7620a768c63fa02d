// SPDX-License-Identifier: Apache-2.0
/// Decides whether the drive of a station counts as gone because its line stalls. Pure: times
/// come in, a decision goes out.
///
/// A line that stalls cannot say so. It gives signs while it goes round. Where none comes for the
/// `drive_lost_after_s` of the station its drive is gone, and stays gone until the line goes round again and
/// has taken note of it: then it judges its drive itself.
#pragma once

#include "dpslave/base/sign_of_life.hpp"

#include <chrono>
#include <cstdint>

namespace dpslave::app {

class StalledLine {
public:
    explicit StalledLine(std::chrono::nanoseconds after) : after_(after) {}
    void set_after(std::chrono::nanoseconds after) { after_ = after; }

    /// Call it at least every Silence::kLongestLook. `sign`: the newest of the line; `noted`: the stalls
    /// of this station that it has taken note of. True: is_stalled() or stalls() is another one.
    bool look(Instant sign, std::uint32_t noted, Instant now)
    {
        const bool is_silent = silence_.look(sign, now) >= after_;
        if (!is_stalled_ && is_silent) {
            is_stalled_ = true;
            ++stalls_;
            return true;
        }
        if (!is_stalled_ || is_silent || noted != stalls_) return false;
        is_stalled_ = false;
        return true;
    }
    /// The drive counts as gone.
    bool is_stalled() const { return is_stalled_; }
    /// How often it has come to that.
    std::uint32_t stalls() const { return stalls_; }

private:
    std::chrono::nanoseconds after_;
    Silence silence_;
    bool is_stalled_ = false;
    std::uint32_t stalls_ = 0;
};

} // namespace dpslave::app
