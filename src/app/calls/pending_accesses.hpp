// SPDX-License-Identifier: Apache-2.0
/// Reads, writes and surveys of a tag that wait for the answer of a drive. Main thread only.
#pragma once

#include "app/line/drive_line.hpp"
#include "app/state/happenings.hpp"
#include "app/state/monitor.hpp"
#include "waiting_calls.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::app {

class PendingAccesses {
public:
    /// All outlive this object.
    PendingAccesses(const Monitor& monitor, const DriveLines& lines, Happenings& happenings)
        : monitor_(monitor), lines_(lines), happenings_(happenings)
    {}

    // The methods ReadTag, WriteTag, GetSurveyScope and Survey.
    control::Reply read(const Station& station, const control::Json& parameters,
                        const control::Caller& caller);
    control::Reply write(const Station& station, const control::Json& parameters,
                         const control::Caller& caller);
    control::Reply survey_scope(const Station& station, const control::Json& parameters) const;
    control::Reply survey(const Station& station, const control::Json& parameters,
                          const control::Caller& caller);

    bool empty() const { return waiting_.empty(); }
    /// Sends what the drives have answered since the last call, and refuses what has waited too long. What
    /// has not begun when its caller goes is not carried out.
    void answer(Instant now);
    /// Refuses those of stations that left by a reload.
    void refuse(const std::vector<Station>& left);
    /// The program ends: nothing that waits is carried out. Logs each write.
    void end();

private:
    struct Access {
        std::shared_ptr<const config::StationConfig> config;
        std::shared_ptr<DriveLine> line; ///< that has the order
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool is_write = false;
        bool is_survey = false;
        bool has_text = false;                   ///< of a survey: the protocol carries texts, not words
        std::optional<drive::MnemonicRule> rule; ///< of a survey; nothing = that of the profile
        control::Caller caller;
        std::optional<std::string> before; ///< the value of the tag before a write, if it was known
    };

    using Waiting = WaitingCalls<Access>;
    bool refuse(std::uint32_t number, const Waiting::Call& call, const std::string& reason) const;
    control::Reply order(const Station& station, Access access);
    void take_answers();
    void end_of_stalled_lines();
    void end_of(DriveLine& line);
    void end_of_callers_gone();
    bool has_place_for(const control::Caller& caller) const;
    control::LastReply reply(const Waiting::Call& call, const drive::OperateAnswer& answer) const;
    control::LastReply survey_reply(const Waiting::Call& call, const drive::OperateAnswer& answer) const;
    void log_write(const Access& access, std::string_view outcome) const;

    const Monitor& monitor_;
    const DriveLines& lines_;
    Happenings& happenings_;
    Waiting waiting_;
};

} // namespace dpslave::app
