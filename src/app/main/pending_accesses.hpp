// SPDX-License-Identifier: Apache-2.0
/// Reads, writes and surveys of a tag that wait for the answer of a drive. Main thread only.
#pragma once

#include "app/watch/event_history.hpp"
#include "monitor.hpp"
#include "replies.hpp"

#include <map>

namespace dpslave::app {

class PendingAccesses {
public:
    /// All outlive this object.
    PendingAccesses(const Monitor& monitor, const Runtime& runtime, Replies& replies, EventHistory& events)
        : monitor_(monitor), runtime_(runtime), replies_(replies), events_(events)
    {}

    // The methods ReadTag, WriteTag, GetSurveyScope and Survey.
    control::Reply read(const Station& station, const control::Json& parameters,
                        const control::Caller& caller);
    control::Reply write(const Station& station, const control::Json& parameters,
                         const control::Caller& caller);
    control::Reply survey_scope(const Station& station) const;
    control::Reply survey(const Station& station, const control::Json& parameters,
                          const control::Caller& caller);

    bool empty() const { return pending_.empty(); }
    /// Sends what the drives have answered since the last call.
    void answer();
    /// Refuses those of stations that left by a reload.
    void refuse(const std::vector<Station>& left);
    /// Logs each write whose answer has not come before the end of the program.
    void log_unanswered() const;

private:
    struct Access {
        std::uint32_t station = 0; ///< its number
        std::shared_ptr<const config::StationConfig> config;
        std::uint16_t tag = 0;
        std::uint16_t word = 0;
        bool is_write = false;
        bool is_survey = false;
        bool has_text = false; ///< of a survey: the protocol carries texts, not words
        control::Caller caller;
        std::optional<std::string> before; ///< the value of the tag before a write, if it was known
    };

    control::Reply order(const Station& station, Access access);
    bool has_place_for(const control::Caller& caller) const;
    control::Reply reply(const Access& access, const drive::OperateAnswer& answer) const;
    control::Reply survey_reply(const Access& access, const drive::OperateAnswer& answer) const;
    void log_write(const Access& access, std::string_view outcome) const;

    const Monitor& monitor_;
    const Runtime& runtime_;
    Replies& replies_;
    EventHistory& events_;
    std::map<std::uint32_t, Access> pending_; ///< by the number of the order
};

} // namespace dpslave::app
