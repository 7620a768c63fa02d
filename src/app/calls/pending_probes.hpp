// SPDX-License-Identifier: Apache-2.0
/// The method ProbeDrive: a line looks for a drive with other rates, formats and units. Main thread only.
#pragma once

#include "app/line/drive_line.hpp"
#include "app/state/monitor.hpp"
#include "waiting_calls.hpp"

#include "dpslave/report/replies.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::app {

class PendingProbes {
public:
    /// All outlive this object.
    PendingProbes(const Monitor& monitor, const DriveLines& lines) : monitor_(monitor), lines_(lines) {}

    /// A call with "more" gets the progress. The probe ends when its caller goes.
    control::Reply start(const Station& station, const control::Json& parameters,
                         const control::Caller& caller);
    /// Sends progress and results, and ends the probes whose callers have gone, whose lines stall, or that
    /// have taken too long.
    void answer(Instant now);
    /// Ends those of stations that left by a reload: what their line has found reaches nobody.
    void refuse(const std::vector<Station>& left);

private:
    struct Probe {
        std::shared_ptr<const config::StationConfig> config;
        std::shared_ptr<DriveLine> drive_line;
        std::string line, port;
        std::uint32_t questions = 0; ///< at most
        std::chrono::seconds longest{};
        std::uint32_t sent = 0; ///< questions, as sent last
    };

    using Waiting = WaitingCalls<Probe>;
    static report::ProbeDriveReply progress(const Probe& probe, std::uint32_t tried);
    void answer(const ProbeReport& report);
    static bool end(std::uint32_t number, const Waiting::Call& call, std::string_view reason);
    void take_reports();
    void send_progress();
    void end_of_stalled_lines();

    const Monitor& monitor_;
    const DriveLines& lines_;
    Waiting waiting_;
};

} // namespace dpslave::app
