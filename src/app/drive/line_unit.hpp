// SPDX-License-Identifier: Apache-2.0
/// One drive of a line: its data between the links of its station and the poller, and what the log says of
/// it. The drive thread's own.
#pragma once

#include "app/limited_log.hpp"
#include "app/links.hpp"
#include "sampler.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/drive/poller.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dpslave::app {

/// How the poller treats the drives of a line, in the same order.
std::vector<drive::UnitSettings> poller_settings(const std::vector<DriveUnit>& units,
                                                 const config::LineConfig& line);

class LineUnit : public DriveUnit {
public:
    explicit LineUnit(const DriveUnit& made_of);

    /// From the links to the poller, where the drive is unit `index`.
    void fetch(drive::Poller& poller, std::size_t index);
    /// From the poller to the links. `heard`: of the back-end, if there is one.
    void publish(drive::Poller& poller, std::size_t index, const std::optional<drive::AnswerCounts>& heard);
    /// Into the ring of the line, if there is something new.
    void sample(const drive::UnitSnapshot& now, trace::Ring& ring);
    /// Whether the drive answers, when that has changed.
    void log_link(const drive::UnitSnapshot& now, LimitedLog& log);

    Generation layout() const { return layout_; } ///< whose outputs the poller has; 0 = none
    bool is_busy() const { return layout_ != 0 && answered_; }
    bool is_lost() const { return layout_ != 0 && was_known_ && !answered_; }

    bool leaves = false; ///< it is not among the drives that come next

private:
    void log_ride_through(const std::optional<Instant>& ends);

    std::int64_t zero_after_ms_ = 0; ///< as the poller has it
    Generation ended_ = 0;           ///< as the poller has it
    Generation layout_ = 0;
    Sampler sampler_;
    bool was_known_ = false, answered_ = false; ///< as logged last
    std::optional<Instant> ride_ends_;          ///< as logged last
    Generation ride_layout_ = 0;                ///< whose outputs stand in a ride through
};

} // namespace dpslave::app
