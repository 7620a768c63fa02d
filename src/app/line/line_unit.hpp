// SPDX-License-Identifier: Apache-2.0
/// One drive of a line: its data between the links of its station and the poller, and what happens
/// to it. The drive thread's own.
#pragma once

#include "app/links/links.hpp"
#include "sampler.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/drive/poller.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace dpslave::app {

/// How the poller treats the drives of a line, in the same order.
std::vector<drive::DriveSettings> poller_settings(const std::vector<DriveUnit>& units,
                                                  const config::LineConfig& line);

/// "tag 56 was not written; tags 57, 58 were written and not read back"
std::string zeros_in_words(const std::vector<drive::ZeroLeft>& left);

class LineUnit : public DriveUnit {
public:
    explicit LineUnit(const DriveUnit& made_of);

    /// From the links to the poller, where the drive is unit `index`.
    void fetch(drive::Poller& poller, std::size_t index);
    /// The bus has judged that the line stalled for too long: the drive is gone until it has answered
    /// again. Behind fetch(). True: that is new.
    bool note_stall(drive::Poller& poller, std::size_t index, Instant now);
    /// What followed from that is published.
    void show_stall();
    /// The master was taken for lost here: its station leaves the bus once.
    void lose_master();
    /// From the poller to the links. `heard`: of the back-end, if there is one.
    void publish(drive::Poller& poller, std::size_t index, const std::optional<drive::AnswerCounts>& heard);
    /// Into the ring of the line, if there is something new.
    void sample(const drive::DriveSnapshot& now, trace::Ring& ring);
    /// Whether the drive answers, and a RIDE THROUGH, when that has changed.
    void tell(const drive::DriveSnapshot& now, LineHappenings& happenings);

    Generation layout() const { return layout_; } ///< whose outputs the poller has; 0 = none
    bool is_busy() const { return layout_ != 0 && answered_; }
    bool is_lost() const { return layout_ != 0 && was_known_ && !answered_; }

    bool leaves = false; ///< it is not among the drives that come next

private:
    void tell_link(const drive::DriveSnapshot& now, LineHappenings& happenings);
    void tell_ride_through(const std::optional<Instant>& ends, LineHappenings& happenings);

    std::int64_t zero_after_ms_ = 0; ///< as the poller has it
    bool is_away_;                   ///< the station is not on the bus, as StationLink::departures says
    Generation ended_ = 0;           ///< as the poller has it
    std::uint32_t stalls_ = 0;       ///< as the poller has them
    std::uint32_t ordered_ = 0;      ///< the last Demand Data order that was fetched
    Generation layout_ = 0;
    Sampler sampler_;
    bool was_known_ = false, answered_ = false; ///< as told last
    std::optional<Instant> ride_ends_;          ///< as told last
    Generation ride_layout_ = 0;                ///< whose outputs are in a ride through
};

} // namespace dpslave::app
