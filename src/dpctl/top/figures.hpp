// SPDX-License-Identifier: Apache-2.0
/// What changes from one look at the daemon to the next: rates, and where the turnaround lies. Pure.
#pragma once

#include "dpslave/report/replies.hpp"

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// What the daemon said at one moment, printable_texts() already.
struct Sighting {
    std::chrono::nanoseconds at{}; ///< on a clock that never goes back
    double unix_seconds = 0;       ///< the same moment, since 1970
    report::GetStatusReply status{};
    report::GetCountersReply counters{};
    report::GetIoReply io{};
};

/// The counters of the bus; null: there are none.
const report::CounterGroup* bus_group(const report::GetCountersReply& reply);
/// Those of a station; null: there are none. A station may have the name of the bus or of the control socket.
const report::CounterGroup* station_group(const report::GetCountersReply& reply, std::string_view station);

/// How fast a counter grows.
struct Rate {
    std::string name;
    double per_second = 0;
};

/// The counters that are in both groups, in the order of `now`. Left out: one that went back, for it began
/// anew; one in milliseconds, for it is no count. Empty: a group is missing, or no time has passed.
std::vector<Rate> rates(const report::CounterGroup* before, const report::CounterGroup* now,
                        std::chrono::nanoseconds passed);
/// Of one of them; none: it is not there.
std::optional<double> rate_of(const std::vector<Rate>& all, std::string_view name);

/// The turnaround of the replies within the last minute, from the counts since the start of the daemon.
class RecentTurnaround {
public:
    static constexpr std::chrono::seconds kSpan{60};

    void add(std::chrono::nanoseconds at, const report::GetCountersReply& counters);
    /// In bit times where the daemon gives them. `count`, `classes` and figures belong together; none:
    /// nothing was counted. Before a second sighting, or without a reply since: everything since the start of
    /// the daemon.
    std::optional<report::Distribution> now() const;
    /// Whether now() is that of the last minute.
    bool is_recent() const;

private:
    struct Seen {
        std::chrono::nanoseconds at{};
        report::Distribution counted{};
    };
    std::deque<Seen> seen_; ///< the oldest is the last one that is older than the span
};

/// One character for each class from the lowest to the highest that holds something, as high as its count. No
/// more than `columns` of them: then a character stands for several classes. `blocks`: with the block
/// elements of Unicode, else ASCII.
std::string sparkline(const report::Distribution& distribution, std::size_t columns, bool blocks);

} // namespace dpslave::dpctl
