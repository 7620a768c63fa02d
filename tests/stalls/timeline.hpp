// SPDX-License-Identifier: Apache-2.0
/// When a thread stalled, as the script of a history knows it.
#pragma once

#include "drive_line/chance.hpp"

#include "dpslave/base/units.hpp"

#include <algorithm>
#include <vector>

namespace dpslave::stalls {

using drive_line::Chance;
using drive_line::Time;
using namespace std::chrono_literals;

class Timeline {
public:
    void stalls(Instant from) { all_.push_back({from, kNever}); }
    void goes_on(Instant at) { all_.back().to = at; }

    bool is_stalled() const { return !all_.empty() && all_.back().to == kNever; }
    /// Of the last stall. Precondition: there was one.
    Instant from() const { return all_.back().from; }
    Instant until() const { return all_.back().to; } ///< its end
    std::size_t count() const { return all_.size(); }

    /// How long it ran between two moments.
    Time ran(Instant from, Instant to) const
    {
        Time ran = to - from;
        for (auto one = all_.rbegin(); one != all_.rend() && one->to > from; ++one)
            ran -= std::max<Time>(std::min(one->to, to) - std::max(one->from, from), 0ns);
        return ran;
    }
    /// In how many stalls it was between two moments.
    int stalls_in(Instant from, Instant to) const
    {
        int count = 0;
        for (auto one = all_.rbegin(); one != all_.rend() && one->to > from; ++one)
            count += one->from < to ? 1 : 0;
        return count;
    }

private:
    struct Stall {
        Instant from, to;
    };
    std::vector<Stall> all_; ///< one after the other
};

} // namespace dpslave::stalls
