// SPDX-License-Identifier: Apache-2.0
/// Asks the daemon for all that `dpctl top` shows.
#pragma once

#include "dpctl/cli/session.hpp"
#include "figures.hpp"

#include <optional>
#include <string>
#include <utility>

namespace dpslave::dpctl {

/// One call after the other.
class Observer {
public:
    /// The replies as they came, by key as the manual page of dpctl describes them, and their moment.
    struct Replies {
        Json all;
        std::chrono::nanoseconds at{}; ///< steady clock, when the counters came
        double unix_seconds = 0;       ///< since 1970, likewise
    };

    Observer(Session& session, std::string station) : session_(session), station_(std::move(station)) {}
    Result<Replies, Stopped> look();

private:
    Json event_parameters() const;

    Session& session_;
    std::string station_;                ///< name or address; empty = all
    std::optional<std::int64_t> newest_; ///< number of the last event; none: it was not asked yet
};

/// `replies` as structs, their texts printable().
std::pair<Sighting, report::GetEventsReply> read_replies(const Observer::Replies& replies);

} // namespace dpslave::dpctl
